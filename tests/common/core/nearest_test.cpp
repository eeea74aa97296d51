#include "strainwave/common/core/nearest.hpp"

#include <gtest/gtest.h>

#include <array>

namespace strainwave {
namespace {

// Textbook distances (kitten → sitting is Wagner and Fischer's example) and the house rules on case and -.
TEST(EditDistance, CountsSingleLetterSteps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("teeth", "teeht"), 1u); // swapped neighbours
  EXPECT_EQ(edit_distance("Tip-Relief", "tip_relief"), 0u);
}

TEST(NearestName, FindsTheMisspeltName) {
  constexpr std::array<std::string_view, 3> names{"teeth", "module_mm", "profile_shift"};
  EXPECT_EQ(nearest_name("modul_mm", names).name, "module_mm");
  EXPECT_TRUE(nearest_name("modul_mm", names).close);
}

TEST(NearestName, ForgottenEndingIsClose) {
  constexpr std::array<std::string_view, 2> names{"teeth", "youngs_modulus_mpa"};
  EXPECT_EQ(nearest_name("youngs_modulus", names).name, "youngs_modulus_mpa");
  EXPECT_TRUE(nearest_name("youngs_modulus", names).close);
  EXPECT_TRUE(nearest_name("youngs", names).close);
}

TEST(NearestName, UnrelatedNameIsNamedButNotClose) {
  constexpr std::array<std::string_view, 2> names{"teeth", "module_mm"};
  EXPECT_FALSE(nearest_name("colour", names).name.empty());
  EXPECT_FALSE(nearest_name("colour", names).close);
}

TEST(NearestName, NoCandidatesGiveAnEmptyName) {
  EXPECT_TRUE(nearest_name("x", {}).name.empty());
}

} // namespace
} // namespace strainwave
