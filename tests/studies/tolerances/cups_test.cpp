// What a tolerance study costs before its first row: one solution of the finite elements.

#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/studies/commands/plan.hpp"
#include "tests/studies/tolerances/sampled_rows.hpp"
#include "tests/support/coarse_seed.hpp"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(CupsOfAToleranceStudy, PlanSolvesOneWithoutAnyCache) {
  StudyFile study = teeth_study();
  study.gear.mesh = testing_support::coarsest_mesh;
  study.part<MonteCarloPart>().sampling.samples = 4;
  for (const int threads : {1, 2}) {
    const std::uint64_t before = cups_solved();
    const auto estimate = pilot(study, {.threads = threads, .disk_cache = false});
    ASSERT_TRUE(estimate.ok()) << estimate.failure().message;
    EXPECT_EQ(cups_solved() - before, 1u) << threads;
  }
}

TEST(CupsOfAToleranceStudy, OtherDiscsNeedNoOther) {
  StudyFile study = study_with({one_number("u0", "wave_generator.max_radial_deformation_mm", 0.2, 0.0005)});
  study.gear.mesh = testing_support::coarsest_mesh;
  const std::uint64_t before = cups_solved();
  ASSERT_TRUE(SampledGear::make(study, {}, 1, {.disk_cache = false}).ok());
  EXPECT_EQ(cups_solved() - before, 1u);
}

} // namespace
} // namespace strainwave
