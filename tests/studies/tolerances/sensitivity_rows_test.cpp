// Sensitivity rows of the gear against closed forms. Errors that are alike on all spaces of the circular
// spline turn its drive flanks as a whole: by 2 Δx2 tan α/z2 for its profile shift and ds/(2 r2) for wider
// spaces, which is what the rotation under load changes by, exactly, and no force changes. So indices and
// elasticities of the rotation are known.

#include "strainwave/common/statistics/morris.hpp"
#include "strainwave/common/statistics/sobol_indices.hpp"
#include "strainwave/common/statistics/summary.hpp"
#include "strainwave/studies/tolerances/sampled_gear.hpp"

#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "strainwave/studies/tolerances/sensitivity.hpp"
#include "tests/studies/tolerances/cup_cache.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strainwave {
namespace {

const double tangent = std::tan(20.0 * std::numbers::pi / 180.0);
const double by_x2 = 2.0 * tangent / 142.0; // rad per 1
const double by_width = 0.5e-3 / 14.2;      // rad per µm
constexpr double spread_x2 = 0.005, spread_width = 1.0;

StudyFile turning(SensitivityMethod method, int samples) {
  StudyFile study(sensitivity_kind());
  auto& part = study.part<SensitivityPart>();
  study.gear = seed_gear();
  study.load_cases = {{.torque_nm = 7.0, .rotation_rad = {}}};
  part.sources = {
      {.name = "x2",
       .kind = SourceKind::gear_key,
       .path = "circular_spline.profile_shift",
       .distribution = Normal{2.19, spread_x2}},
      {.name = "width",
       .kind = SourceKind::tooth_thickness,
       .member = SourceMember::circular_spline,
       .path = {},
       .distribution = Normal{0.0, spread_width}},
      {.name = "pitch", .kind = SourceKind::adjacent_pitch, .path = {}, .distribution = Normal{0.0, 1e-3}}};
  part.sensitivity.method = method;
  part.sensitivity.samples = samples;
  part.sensitivity.outputs = {"rotation_rad"};
  return study;
}

RowTable evaluated(const SampledStudy& study) {
  RowTable table(study.rows, static_cast<std::uint32_t>(study.output_columns.size()), 1024);
  const auto worker = study.model->worker();
  for (std::uint64_t first = 0; first < study.rows; first += 1024) {
    const auto rows = static_cast<std::uint32_t>(std::min<std::uint64_t>(1024, study.rows - first));
    RowBlock block{.first = first, .rows = rows, .outputs = table.outputs()};
    std::vector<double> inputs(rows * study.model->inputs());
    study.inputs(first, rows, inputs);
    block.values.assign(rows * table.outputs(), 0.0);
    block.status.assign(rows, row_ok);
    RowSlice slice{.first = first,
                   .rows = rows,
                   .inputs = inputs,
                   .outputs = block.values,
                   .status = block.status,
                   .messages = &block.messages};
    worker->evaluate(slice);
    EXPECT_FALSE(table.insert(block));
  }
  return table;
}

TEST(SensitivityRows, SobolIndicesAreSharesOfTheVariance) {
  const SampledStudy study =
      make_sensitivity_rows(turning(SensitivityMethod::sobol, 1024), cup_cache()).value();
  ASSERT_EQ(study.index_names.size(), 3u);
  ASSERT_EQ(study.rows, 5u * 1024u);
  const RowTable table = evaluated(study);
  const SobolIndices indices = sobol_indices(table.values(), table.status(), 3);
  const double a = std::pow(by_x2 * spread_x2, 2), b = std::pow(by_width * spread_width, 2);
  EXPECT_NEAR(indices.variance, a + b, 0.05 * (a + b));
  EXPECT_NEAR(indices.inputs[0].total.value, a / (a + b), 0.03);
  EXPECT_NEAR(indices.inputs[1].total.value, b / (a + b), 0.03);
  EXPECT_LT(indices.inputs[2].total.value, 1e-3); // a nanometre of pitch
  EXPECT_LT(indices.inputs[0].first.ci95.lower, a / (a + b));
  EXPECT_GT(indices.inputs[0].first.ci95.upper, a / (a + b));
}

TEST(SensitivityRows, ABlockChangesOneSourceWithAllItsNumbers) {
  const StudyFile file = turning(SensitivityMethod::sobol, 8);
  const SampledStudy study = make_sensitivity_rows(file, cup_cache()).value();
  const SampledSources sources(file);
  const std::size_t n = study.model->inputs();
  std::vector<double> block(5 * n);
  study.inputs(3 * 5, 5, block);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t d = 0; d < n; ++d) {
      const auto& s = sources.sources()[i];
      const bool own = d >= s.first && d < s.first + s.count;
      EXPECT_EQ(block[(2 + i) * n + d], block[(own ? 1 : 0) * n + d]);
      EXPECT_NE(block[d], block[n + d]);
    }
  }
  std::vector<double> single(n); // one row alone is the same row
  study.inputs(3 * 5 + 4, 1, single);
  EXPECT_TRUE(std::equal(single.begin(), single.end(), block.begin() + static_cast<std::ptrdiff_t>(4 * n)));
}

TEST(SensitivityRows, ElasticitiesAreTheDerivativesOfTheTurn) {
  const SampledStudy study = make_sensitivity_rows(turning(SensitivityMethod::local, 8), cup_cache()).value();
  ASSERT_EQ(study.rows, 5u); // pitch errors of single teeth have no derivative
  const RowTable table = evaluated(study);
  const auto all = study.elasticities(table);
  ASSERT_EQ(all.size(), 2u);
  const double rotation = table.value(0, 0);
  EXPECT_EQ(all[0].input, "x2");
  EXPECT_NEAR(all[0].derivative, by_x2, 1e-4 * by_x2);
  EXPECT_NEAR(all[0].elasticity, by_x2 * 2.19 / rotation, 1e-3);
  EXPECT_NEAR(all[1].derivative, by_width, 1e-4 * by_width);
  EXPECT_EQ(all[1].elasticity, 0.0); // its mean is 0
}

TEST(SensitivityRows, MorrisStepsOfALinearOutput) {
  const SampledStudy study =
      make_sensitivity_rows(turning(SensitivityMethod::morris, 16), cup_cache()).value();
  ASSERT_TRUE(study.morris);
  const RowTable table = evaluated(study);
  const MorrisResult result = morris_effects(*study.morris, table.values(), table.status());
  // 4 levels u = 1/8 … 7/8, steps of ½: 1/8 ↔ 5/8 and 3/8 ↔ 7/8, alike by symmetry
  const double step = (1.1503493803760079 + 0.3186393639643752) / 0.5; // quantiles of 7/8 and 5/8
  EXPECT_NEAR(result.inputs[0].mu_star.value, by_x2 * spread_x2 * step, 1e-3 * by_x2 * spread_x2 * step);
  EXPECT_NEAR(result.inputs[1].mu_star.value, by_width * spread_width * step,
              1e-3 * by_width * spread_width * step);
  EXPECT_LT(result.inputs[0].sigma, 1e-3 * by_x2 * spread_x2);
}

TEST(SensitivityRows, MonteCarloOfALinearGaussianCase) {
  const StudyFile same = turning(SensitivityMethod::sobol, 8);
  StudyFile file(monte_carlo_kind());
  file.gear = same.gear;
  file.load_cases = same.load_cases;
  auto& part = file.part<MonteCarloPart>();
  part.sources = same.part<UncertainPart>().sources;
  part.sources.resize(2);
  part.sampling.design = SamplingDesign::sobol;
  part.sampling.samples = 16 * 256;
  part.sampling.outputs = {"rotation_rad"};
  const SampledStudy study = make_monte_carlo_rows(file, cup_cache()).value();
  const RowTable table = evaluated(study);
  std::vector<std::span<const double>> parts;
  for (std::size_t r = 0; r < 16; ++r)
    parts.push_back(table.values().subspan(r * 256, 256));
  const Summary summary = summarise_randomised(parts, {.quantiles = {0.05, 0.5, 0.95}, .limits = {}});
  const SampledStudy local = make_sensitivity_rows(turning(SensitivityMethod::local, 8), cup_cache()).value();
  const double nominal = evaluated(local).value(0, 0);
  const double std = std::hypot(by_x2 * spread_x2, by_width * spread_width);
  EXPECT_NEAR(summary.mean.value, nominal, 0.01 * std);
  EXPECT_NEAR(summary.std.value, std, 0.01 * std);
  EXPECT_NEAR(summary.quantiles[0].estimate.value, nominal - 1.6448536269514722 * std, 0.04 * std);
  EXPECT_NEAR(summary.quantiles[2].estimate.value, nominal + 1.6448536269514722 * std, 0.04 * std);
}

} // namespace
} // namespace strainwave
