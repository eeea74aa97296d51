#include "strainwave/model/flexspline/response_store.hpp"

#include "tests/model/flexspline/bodies.hpp"
#include "tests/support/temporary_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace strainwave {
namespace {

namespace fs = std::filesystem;

class Store : public ::testing::Test {
protected:
  void SetUp() override {
    request = testing_bodies::broad_toothed_cup();
    request.flank_heights = 2;
    request.wall_z_mm = {22.5, 26.5};
  }
  ResponseStore store() {
    return ResponseStore(folder, [this](const std::string& sentence) { warnings.push_back(sentence); });
  }
  void expect_rebuilt(const char* reason) {
    const Outcome<StoredResponses> again = stored_unit_responses(request, store());
    ASSERT_TRUE(again.ok());
    EXPECT_FALSE(again->reused) << reason;
    ASSERT_EQ(warnings.size(), 1u) << reason;
    EXPECT_NE(warnings.front().find(reason), std::string::npos) << warnings.front();
    EXPECT_TRUE(stored_unit_responses(request, store())->reused) << "after " << reason;
  }
  testing_support::TemporaryFolder temporary;
  fs::path folder = temporary / "store"; // which the store makes
  ResponseRequest request;
  std::vector<std::string> warnings;
};

TEST_F(Store, gives_back_what_was_kept_bit_by_bit) {
  request.estimate = true;
  const StoredResponses first = stored_unit_responses(request, store()).value();
  const StoredResponses second = stored_unit_responses(request, store()).value();
  EXPECT_FALSE(first.reused);
  EXPECT_TRUE(second.reused);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(first.responses.data, second.responses.data);
  EXPECT_EQ(first.responses.sectors, second.responses.sectors);
  EXPECT_EQ(first.responses.flank_radius_mm, second.responses.flank_radius_mm);
  EXPECT_EQ(first.responses.flank_centre_mm, second.responses.flank_centre_mm);
  EXPECT_EQ(first.responses.flank_z_mm, second.responses.flank_z_mm);
  EXPECT_EQ(first.responses.wall_offset, second.responses.wall_offset);
  EXPECT_EQ(first.responses.wall_z_mm, second.responses.wall_z_mm);
  EXPECT_EQ(first.responses.section_z_mm, second.responses.section_z_mm);
  EXPECT_EQ(first.responses.reciprocity_error, second.responses.reciprocity_error);
  EXPECT_EQ(first.responses.discretisation_estimate, second.responses.discretisation_estimate);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1)
      << "nothing half-written is left";
}

TEST_F(Store, any_change_of_the_request_is_another_key) {
  const auto key = response_key(request);
  const auto differs = [&](void (*change)(ResponseRequest&)) {
    ResponseRequest other = request;
    change(other);
    return response_key(other) != key && store().file(other) != store().file(request);
  };
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.flexspline.root_radius_mm += 1e-12; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.flexspline.boss_radius_mm += 1e-12; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.material.poisson_ratio = 0.31; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.mesh.diaphragm += 1; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.teeth = false; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.sectors = 20; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.face_slices = 3; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.both_flanks = true; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.sections = false; }));
  EXPECT_TRUE(differs([](ResponseRequest& r) {
    r.section_z_mm = r.wall_z_mm;
    r.wall_z_mm.clear();
  }));
  EXPECT_TRUE(differs([](ResponseRequest& r) { r.wall_offset = {0.0}; }));
}

TEST_F(Store, a_truncated_file_is_rebuilt) {
  (void)stored_unit_responses(request, store());
  const fs::path file = store().file(request);
  fs::resize_file(file, fs::file_size(file) / 2);
  expect_rebuilt("cannot be read");
}

TEST_F(Store, a_flipped_bit_is_noticed_and_rebuilt) {
  (void)stored_unit_responses(request, store());
  const fs::path path = store().file(request);
  const auto middle = static_cast<std::streamoff>(fs::file_size(path) * 3 / 4); // inside the responses
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(middle);
  const char byte = static_cast<char>(file.get() ^ 0x10);
  file.seekp(middle);
  file.put(byte);
  file.close();
  expect_rebuilt("damaged");
}

TEST_F(Store, a_foreign_file_is_rebuilt) {
  fs::create_directories(folder);
  std::ofstream(store().file(request)) << "not an HDF5 file\n";
  expect_rebuilt("cannot be read");
}

TEST_F(Store, a_file_of_another_flexspline_under_this_name_is_rebuilt) {
  ResponseRequest other = request;
  other.material.poisson_ratio = 0.25;
  (void)stored_unit_responses(other, store());
  fs::copy_file(store().file(other), store().file(request));
  expect_rebuilt("another flexspline");
}

TEST_F(Store, a_folder_that_cannot_be_written_is_a_warning) {
  std::ofstream(folder) << "a file where the folder should be\n";
  const Outcome<StoredResponses> computed = stored_unit_responses(request, store());
  ASSERT_TRUE(computed.ok());
  EXPECT_FALSE(computed->responses.data.empty());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().find("cannot be kept"), std::string::npos);
}

TEST_F(Store, the_folder_follows_the_environment) {
  const auto with = [](const char* own, const char* xdg, const char* home) {
    const auto set = [](const char* name, const char* value) {
      value ? setenv(name, value, 1) : unsetenv(name);
    };
    set("STRAINWAVE_CACHE", own);
    set("XDG_CACHE_HOME", xdg);
    set("HOME", home);
    return cache_folder().string();
  };
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "/";
  EXPECT_EQ(with("/a", "/b", "/c"), "/a");
  EXPECT_EQ(with(nullptr, "/b", "/c"), "/b/strainwave");
  EXPECT_EQ(with(nullptr, "relative", "/c"), "/c/.cache/strainwave");
  EXPECT_EQ(with(nullptr, nullptr, "/c"), "/c/.cache/strainwave");
  EXPECT_EQ(with(nullptr, nullptr, nullptr), "");
  with(nullptr, nullptr, home.c_str());
}

} // namespace
} // namespace strainwave
