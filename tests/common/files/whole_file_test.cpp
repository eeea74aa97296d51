#include "strainwave/common/files/whole_file.hpp"

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

#include <cerrno>
#include <gtest/gtest.h>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>

namespace strainwave {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

/// errno and sentence of what a call throws.
template <class Call>
std::pair<int, std::string> refusal(const Call& call) {
  try {
    call();
  } catch (const std::system_error& error) {
    return {error.code().value(), error.what()};
  }
  return {0, "nothing was refused"};
}

TEST(WholeFile, IsThereAndAlone) {
  const TemporaryFolder folder;
  write_whole_text(folder / "a", "first");
  write_whole_text(folder / "a", "");
  EXPECT_EQ(text_of(folder / "a"), "");
  write_whole_text(folder / "a", "second");
  EXPECT_EQ(text_of(folder / "a"), "second");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeFile, NobodySeesItBeforeItIsWhole) {
  const TemporaryFolder folder;
  write_whole_file(folder / "a", [&](const fs::path& beside) {
    put_text(beside, "text");
    EXPECT_FALSE(fs::exists(folder / "a"));
    EXPECT_EQ(beside.parent_path(), folder.path);
    EXPECT_EQ(beside.extension(), ".part");
  });
  EXPECT_EQ(text_of(folder / "a"), "text");
}

TEST(WholeFile, FailureOfTheWriterLeavesTheOldFileAndNothingBeside) {
  const TemporaryFolder folder;
  put_text(folder / "a", "old");
  EXPECT_THROW(write_whole_file(folder / "a",
                                [&](const fs::path& beside) {
                                  put_text(beside, "half");
                                  throw std::runtime_error("no more");
                                }),
               std::runtime_error);
  EXPECT_EQ(text_of(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeFile, FullDiskLeavesTheOldFileAndNothingBeside) {
  const TemporaryFolder folder;
  put_text(folder / "a", "old");
  const pid_t child = start_child([&] {
    limit_file_size(4096);
    return refusal([&] { write_whole_text(folder / "a", std::string(5000, 'x')); }).first;
  });
  EXPECT_EQ(end_of_child(child), EFBIG);
  EXPECT_EQ(text_of(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeFile, TwoProcessesWritingOneFileDoNotMeet) {
  const TemporaryFolder folder;
  const auto text = [](char letter) { return std::string(200000, letter); };
  const auto writer = [&](char letter) {
    return start_child([&folder, letter, &text] {
      for (int k = 0; k < 50; ++k)
        write_whole_text(folder / "a", text(letter));
      return 0;
    });
  };
  const pid_t x = writer('x'), y = writer('y');
  for (int k = 0; k < 200; ++k)
    if (fs::exists(folder / "a")) {
      const std::string seen = text_of(folder / "a");
      ASSERT_TRUE(seen == text('x') || seen == text('y')) << seen.size();
    }
  EXPECT_EQ(end_of_child(x), 0);
  EXPECT_EQ(end_of_child(y), 0);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeFile, NamesThatAreTakenBesideArePassedOver) {
  const TemporaryFolder folder;
  fs::path first;
  write_whole_file(folder / "a", [&](const fs::path& beside) { first = beside; });
  // NAME.PID-N.part of the next numbers, as another machine's process may have left on a shared disk
  const std::string name = first.stem().string();
  const int number = std::stoi(name.substr(name.rfind('-') + 1));
  for (int k = 1; k <= 3; ++k)
    put_text(folder / (name.substr(0, name.rfind('-') + 1) + std::to_string(number + k) + ".part"), "theirs");
  write_whole_text(folder / "a", "mine");
  EXPECT_EQ(text_of(folder / "a"), "mine");
  EXPECT_EQ(folder.entries(), 4) << "theirs stay";
}

TEST(WholeFile, PermissionsFollowTheUmask) {
  const TemporaryFolder folder;
  const pid_t child = start_child([&] {
    ::umask(027);
    write_whole_text(folder / "a", "x");
    return 0;
  });
  ASSERT_EQ(end_of_child(child), 0);
  struct stat about {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777, 0640U);
}

TEST(WholeFile, LinkStaysALink) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  fs::create_symlink("real/file", folder / "link"); // leads nowhere yet
  write_whole_text(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(text_of(folder / "real/file"), "new");
  write_whole_text(folder / "link", "newer");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(text_of(folder / "real/file"), "newer");
}

TEST(WholeFile, DevicesAreWrittenIntoAndStayDevices) {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder / "null");
  write_whole_text(folder / "null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full")) {
    fs::create_symlink("/dev/full", folder / "full");
    EXPECT_EQ(refusal([&] { write_whole_text(folder / "full", "x"); }).first, ENOSPC);
  }
  EXPECT_EQ(refusal([&] { write_whole_file(folder / "null", [](const fs::path&) {}); }).first, EINVAL);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WholeFile, PlacesThatCannotBeWrittenAreNamedWithTheCause) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "d");
  const fs::path nowhere = folder / "nowhere/a", taken = folder / "d";
  for (const auto& write : {+[](const fs::path& path) { write_whole_text(path, "x"); },
                            +[](const fs::path& path) { try_to_write(path); }}) {
    const auto missing = refusal([&] { write(nowhere); });
    EXPECT_EQ(missing.first, ENOENT);
    EXPECT_EQ(missing.second, "cannot write " + nowhere.string() + ": No such file or directory");
    const auto directory = refusal([&] { write(taken); });
    EXPECT_EQ(directory.second, "cannot write " + taken.string() + ": Is a directory");
  }
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WholeFile, TryingLeavesNothingAndTakesNothing) {
  const TemporaryFolder folder;
  put_text(folder / "a", "old");
  try_to_write(folder / "a");
  try_to_write(folder / "b");
  EXPECT_EQ(text_of(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

} // namespace
} // namespace strainwave
