// The layer read back by itself and, where the file's inside matters, by HDF5's own calls.

#include "strainwave/common/files/hdf5.hpp"

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

#include <cerrno>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace strainwave {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

const std::vector<std::string> names = {"", "Verzahnung µ", "φ"};

void write_some(const fs::path& path) {
  hdf5::write_file(path, {"some", 3}, [](const hdf5::Group& root) {
    const hdf5::Group load = root.make_group("load");
    const hdf5::Dataset phi = load.put("phi", std::vector{1.0, 2.0, 3.0});
    phi.set_text("units", "°");
    phi.make_scale("phi");
    load.put("force", std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, {2, 3}).attach_scale(1, phi);
    load.put("tooth", std::vector{-1, 0, 7});
    load.put("large", std::vector<std::uint64_t>{0xffffffffffffffffu});
    load.put("bytes", std::vector<std::uint8_t>{0, 255});
    load.put("none", std::vector<double>{});
    load.put_number("one", 0.1);
    root.put_text("config", "Größe = 1\n");
    root.put_texts("names", names);
    root.put_texts("no names", {});
    root.set_texts("names", names);
    root.set_number("count", std::uint64_t{5});
  });
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::system_error& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(Hdf5, WhatWasWrittenIsReadBack) {
  const TemporaryFolder folder;
  write_some(folder / "a.h5");
  const hdf5::File file(folder / "a.h5");
  EXPECT_EQ(file.format().name, "some");
  EXPECT_EQ(file.format().version, 3);
  const hdf5::Dataset force = file.dataset("load/force");
  EXPECT_EQ(force.shape(), (hdf5::Shape{2, 3}));
  EXPECT_EQ(force.read<double>(), (std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
  const hdf5::Group load = file.group("load");
  EXPECT_EQ(load.dataset("phi").text("units"), "°");
  EXPECT_EQ(load.dataset("tooth").read<int>(), (std::vector{-1, 0, 7}));
  EXPECT_EQ(load.dataset("tooth").read<double>(), (std::vector{-1.0, 0.0, 7.0}));
  EXPECT_EQ(load.dataset("large").read<std::uint64_t>().front(), 0xffffffffffffffffu);
  EXPECT_EQ(load.dataset("bytes").read<std::uint8_t>(), (std::vector<std::uint8_t>{0, 255}));
  EXPECT_TRUE(load.dataset("none").read<double>().empty());
  EXPECT_EQ(load.dataset("one").shape(), hdf5::Shape{});
  EXPECT_EQ(load.dataset("one").read<double>(), std::vector{0.1});
  EXPECT_EQ(file.dataset("config").read_text(), "Größe = 1\n");
  EXPECT_EQ(file.dataset("names").read_texts(), names);
  EXPECT_TRUE(file.dataset("no names").read_texts().empty());
  EXPECT_EQ(file.texts("names"), names);
  EXPECT_EQ(file.number<std::uint64_t>("count"), 5U);
  EXPECT_TRUE(file.has("load/force"));
  EXPECT_FALSE(file.has("load/torque"));
  EXPECT_FALSE(file.has("cup/force"));
}

TEST(Hdf5, RowsOfAMatrixComeOneAfterTheOther) {
  const TemporaryFolder folder;
  hdf5::write_file(folder / "a.h5", {"rows", 1}, [](const hdf5::Group& root) {
    const hdf5::Dataset set = root.make_dataset<double>("m", {3, 2});
    set.write_rows(1, std::vector{3.0, 4.0, 5.0, 6.0});
    set.write_rows(0, std::vector{1.0, 2.0});
    EXPECT_THROW(set.write_rows(0, std::vector{1.0}), std::invalid_argument);
    EXPECT_THROW(root.put("n", std::vector{1.0, 2.0}, {3, 1}), std::invalid_argument);
  });
  EXPECT_EQ(hdf5::File(folder / "a.h5").dataset("m").read<double>(),
            (std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
}

TEST(Hdf5, TextsSayThatTheyAreUtf8AndAxesKnowTheirScales) {
  const TemporaryFolder folder;
  write_some(folder / "a.h5");
  const hid_t file = H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t phi = H5Dopen2(file, "load/phi", H5P_DEFAULT);
  const hid_t force = H5Dopen2(file, "load/force", H5P_DEFAULT);
  EXPECT_GT(H5DSis_scale(phi), 0);
  EXPECT_EQ(H5DSis_scale(force), 0);
  EXPECT_EQ(H5DSget_num_scales(force, 0), 0);
  EXPECT_EQ(H5DSget_num_scales(force, 1), 1);
  EXPECT_GT(H5DSis_attached(force, phi, 1), 0);
  const hid_t unit = H5Aopen(phi, "units", H5P_DEFAULT), config = H5Dopen2(file, "config", H5P_DEFAULT);
  const hid_t unit_type = H5Aget_type(unit), config_type = H5Dget_type(config);
  EXPECT_EQ(H5Tget_cset(unit_type), H5T_CSET_UTF8);
  EXPECT_EQ(H5Tget_cset(config_type), H5T_CSET_UTF8);
  H5O_info_t about{};
  H5Oget_info2(force, &about, H5O_INFO_TIME);
  EXPECT_EQ(about.mtime, 0) << "no times: the same content is the same bytes";
  for (const hid_t type : {unit_type, config_type})
    H5Tclose(type);
  H5Aclose(unit);
  for (const hid_t set : {phi, force, config})
    H5Dclose(set);
  H5Fclose(file);
}

TEST(Hdf5, TheSameContentIsTheSameBytes) {
  const TemporaryFolder folder;
  write_some(folder / "a.h5");
  write_some(folder / "b.h5");
  EXPECT_TRUE(text_of(folder / "a.h5") == text_of(folder / "b.h5"));
}

TEST(Hdf5, TextsOfFixedLengthAreRead) {
  const TemporaryFolder folder;
  const hid_t made = H5Fcreate((folder / "old.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5LTmake_dataset_string(made, "config", "kind");
  H5LTset_attribute_string(made, "/", "plan_hash", "0123");
  H5Fclose(made);
  const hdf5::File file(folder / "old.h5");
  EXPECT_EQ(file.dataset("config").read_text(), "kind");
  EXPECT_EQ(file.text("plan_hash"), "0123");
  EXPECT_EQ(file.format().version, 0);
}

TEST(Hdf5, WhatIsNotThereOrElseIsNamedWithItsFile) {
  const TemporaryFolder folder;
  write_some(folder / "a.h5");
  const std::string read = "cannot read " + (folder / "a.h5").string();
  {
    const hdf5::File file(folder / "a.h5");
    EXPECT_EQ(refusal([&] { (void)file.dataset("load/torque"); }),
              read + " (/load/torque): Input/output error");
    EXPECT_EQ(refusal([&] { (void)file.group("load").text("config"); }),
              read + " (/load/config): Input/output error");
    EXPECT_EQ(refusal([&] { (void)file.dataset("config").read<double>(); }),
              read + " (/config): Input/output error");
    EXPECT_EQ(refusal([&] { (void)file.dataset("load/one").read<int>(); }),
              read + " (/load/one): Input/output error");
    EXPECT_EQ(refusal([&] { (void)file.dataset("load/phi").read_texts(); }),
              read + " (/load/phi): Input/output error");
    EXPECT_EQ(refusal([&] { (void)file.dataset("names").read_text(); }),
              read + " (/names): Input/output error");
  }
  fs::resize_file(folder / "a.h5", fs::file_size(folder / "a.h5") / 2);
  EXPECT_EQ(refusal([&] { const hdf5::File file(folder / "a.h5"); }), read + ": Input/output error");
  fs::remove(folder / "a.h5");
  EXPECT_EQ(refusal([&] { const hdf5::File file(folder / "a.h5"); }), read + ": No such file or directory");
}

TEST(Hdf5, FailedWritingSaysWhereAndLeavesNothing) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.h5";
  EXPECT_EQ(refusal([&] { write_some(folder / "nowhere/a.h5"); }),
            "cannot write " + (folder / "nowhere/a.h5").string() + ": No such file or directory");
  const std::string twice = refusal([&] {
    hdf5::write_file(path, {"some", 1}, [](const hdf5::Group& root) {
      const hdf5::Group load = root.make_group("load");
      load.put("phi", std::vector{1.0});
      load.put("phi", std::vector{1.0});
    });
  });
  EXPECT_TRUE(twice.starts_with("cannot write " + path.string() + " (/load/phi): ")) << twice;
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Hdf5, FullDiskLeavesTheOldFileAndNothingBeside) {
  const TemporaryFolder folder;
  put_text(folder / "a.h5", "old");
  const pid_t child = start_child([&] {
    limit_file_size(100000);
    try {
      hdf5::write_file(folder / "a.h5", {"large", 1}, [](const hdf5::Group& root) {
        root.put("numbers", std::vector<double>(100000, 1.0));
      });
    } catch (const std::system_error& error) {
      return error.code().value();
    }
    return 0;
  });
  EXPECT_EQ(end_of_child(child), EFBIG);
  EXPECT_EQ(text_of(folder / "a.h5"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Hdf5, ThreadsTakeTurns) {
  const TemporaryFolder folder;
  std::vector<int> wrong(4, 0);
  {
    std::vector<std::jthread> crew;
    for (int t = 0; t < 4; ++t)
      crew.emplace_back([&, t] {
        for (int k = 0; k < 20; ++k) {
          const fs::path path = folder / (std::to_string(t) + ".h5");
          hdf5::write_file(path, {"mine", 1},
                           [&](const hdf5::Group& root) { root.put("list", std::vector<double>(1000, t)); });
          const hdf5::File file(path);
          wrong[static_cast<std::size_t>(t)] +=
              file.dataset("list").read<double>() != std::vector<double>(1000, t);
        }
      });
  }
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

} // namespace
} // namespace strainwave
