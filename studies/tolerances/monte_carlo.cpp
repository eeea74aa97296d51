// Rows of a Monte Carlo study: sample k of the design through all sources.

#include "strainwave/studies/tolerances/monte_carlo.hpp"

#include "strainwave/common/sampling/design.hpp"
#include "strainwave/studies/tolerances/sampled_gear.hpp"

namespace strainwave {

Outcome<SampledStudy> make_monte_carlo_rows(const StudyFile& study, const RunContext& context) {
  const StudySampling& sampling = study.part<MonteCarloPart>().sampling;
  auto made = SampledGear::make(study, sampling.outputs, sampling.positions, context);
  if (!made)
    return made.failure();
  const std::shared_ptr<const SampledGear> gear = *made;
  const auto design =
      std::make_shared<const SampleDesign>(DesignPlan{.design = sampling.design,
                                                      .seed = static_cast<std::uint64_t>(study.seed),
                                                      .samples = static_cast<std::uint64_t>(sampling.samples),
                                                      .dimensions = static_cast<int>(gear->inputs()),
                                                      .randomisations = sampling.randomisations});
  SampledStudy rows =
      study_of(gear, [gear, design](std::uint64_t first, std::size_t count, std::span<double> to) {
        design->points(first, count, to);
        const std::size_t n = gear->inputs();
        for (std::size_t i = 0; i < count; ++i)
          gear->sources().transform(to.subspan(i * n, n));
      });
  rows.rows = static_cast<std::uint64_t>(sampling.samples);
  return rows;
}

} // namespace strainwave
