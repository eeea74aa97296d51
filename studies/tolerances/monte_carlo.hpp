#pragma once
// Monte Carlo: samples of gears with errors.
//
//     kind = "monte_carlo"
//     [[source]] …                                # uncertain.hpp
//     [sampling]
//     samples = 65536
//     [[exceedance]]
//     output = "peak_force_n"
//     limit = 45.0

#include "strainwave/common/sampling/design.hpp"
#include "strainwave/studies/tables/row_kind.hpp"
#include "strainwave/studies/tolerances/uncertain.hpp"

#include <optional>

namespace strainwave {

/// The study ends once the 95 % interval of this number has at most this half width. Without quantile and
/// limit: the mean.
struct StudyStop {
  std::string output;
  std::optional<double> quantile; ///< probability
  std::optional<double> limit;    ///< probability of exceeding this value
  double half_width = 0.0;        ///< in the unit of the output; limit: of the probability
};

struct StudySampling {
  SamplingDesign design = SamplingDesign::sobol;
  int samples = 65536;
  int randomisations = 16; ///< independent ones of latin_hypercube and sobol
  int positions = 1;       ///< of the wave generator, spread over a turn; a sample is the worst of them
  std::vector<std::string> outputs;
  std::vector<double> quantiles{0.01, 0.05, 0.5, 0.95, 0.99};
  std::optional<StudyStop> stop;
};

struct StudyExceedance {
  std::string output;
  double limit = 0.0; ///< P(output > limit) is asked for
};

struct MonteCarloPart : UncertainPart {
  StudySampling sampling;
  std::vector<StudyExceedance> exceedances;
  std::unique_ptr<StudyPart> copy() const override { return std::make_unique<MonteCarloPart>(*this); }
};

const RowKind& monte_carlo_kind();

/// Row k is sample k of the design through all sources.
Outcome<SampledStudy> make_monte_carlo_rows(const StudyFile& study, const RunContext& context);

} // namespace strainwave
