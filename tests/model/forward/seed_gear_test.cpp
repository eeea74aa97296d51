// The seed gear from file numbers to torques, against three independent columns (physics of the seed gear,
// section "what the source text reports"). They load every tooth at its tip edge; the forward model loads
// each tooth at its own contact height, which leaves the torque and moves the peak: with the same heights the
// peaks are compared in tests/model/contact/toothed_cup_test.cpp.

#include "tests/model/forward/shared_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

Gear seed_at(std::vector<double> rotations, Fidelity fidelity, DiscGap gap) {
  Gear gear = seed_gear();
  gear.contact.window_deg = {-21.0, 51.0};
  gear.contact.fidelity = fidelity;
  gear.contact.disc_gap = gap;
  gear.load.torque_nm.clear();
  gear.load.rotation_rad = std::move(rotations);
  return gear;
}

struct Column {
  Fidelity fidelity;
  DiscGap gap;
  std::vector<double> torque_nm; ///< at 1e-3, 2e-3, 3.38e-3, 4.5e-3 rad
};

class SeedGear : public ::testing::TestWithParam<Column> {};

TEST_P(SeedGear, ReproducesTheIndependentColumn) {
  const Column& column = GetParam();
  const ForwardResult result = testing_support::shared_model().analyze(
      seed_at({1e-3, 2e-3, 3.38e-3, 4.5e-3}, column.fidelity, column.gap));
  ASSERT_EQ(result.status, Status::ok) << result.message;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(result.load[i].torque_nm, column.torque_nm[i], 0.04 * column.torque_nm[i]) << i;
  }
  EXPECT_TRUE(result.certificate->holds());
}

INSTANTIATE_TEST_SUITE_P(
    Columns, SeedGear,
    ::testing::Values(Column{Fidelity::linear, DiscGap::linearised, {3.3, 7.9, 14.5, 19.9}},
                      Column{Fidelity::unilateral, DiscGap::linearised, {2.79, 5.81, 11.3, 16.3}},
                      Column{Fidelity::unilateral, DiscGap::exact, {3.02, 6.26, 11.85, 16.9}}));

TEST(SeedGearLoad, FirstToothToEngageIsTheOneNearestToTheLeastBacklash) {
  const ForwardResult backlash = testing_support::shared_model().analyze(seed_gear(), Want::backlash);
  const double first = backlash.backlash->min_um * 1e-3 / 14.7714;
  const ForwardResult result =
      testing_support::shared_model().analyze(seed_at({first * 1.05}, Fidelity::unilateral, DiscGap::exact));
  ASSERT_EQ(result.load[0].engaged_count, 1);
  EXPECT_NEAR(result.load[0].peak_phi_deg, 2 * 360.0 / 140.0, 1e-9); // 5.14°, nearest to 5.22°
}

TEST(SeedGearLoad, PeakMovesTowardsSmallerAnglesAtHighLoad) {
  Gear gear = seed_gear();
  gear.load.torque_nm = {1.0, 11.5};
  const ForwardResult result = testing_support::shared_model().analyze(gear);
  EXPECT_LT(result.load[1].peak_phi_deg, result.load[0].peak_phi_deg);
}

} // namespace
} // namespace strainwave
