// Rows of a sensitivity study. Every source of the study is one input of the indices, however many numbers it
// has.
//
//     sobol    blocks A, B, A with all numbers of source i from B (grouped indices: Sobol', Math. Comput.
//     Simul. 55, 2001):
//              the share of the variance that source i as a whole makes. Points: one Sobol' point of 2 × all
//              numbers a block.
//     morris   trajectories of sampling/morris_points.hpp. Its u is the probability of a source that is one
//     number or an
//              amplitude; of errors of single teeth and centre offsets it scales the deviations from their
//              mean by 2 u, so that the effect is that of their spread. Their pattern, and phases, are drawn
//              once for each trajectory.
//     local    row 0 with every source at its mean, then each source that is one number or an amplitude (at
//     phase 0) a
//              hundredth of its standard deviation up and down: derivatives by central differences.

#include "strainwave/studies/tolerances/sensitivity.hpp"

#include "strainwave/common/sampling/counter_random.hpp"
#include "strainwave/common/sampling/sobol_points.hpp"
#include "strainwave/common/statistics/association.hpp"
#include "strainwave/studies/tolerances/sampled_gear.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace strainwave {

namespace {

using Source = SampledSources::Source;

/// Errors of single teeth and centre offsets: a pattern, and how large it is.
bool is_pattern(const Source& s) {
  return s.role == SourceRole::flank && s.count > 1 &&
         (is_per_tooth(s.tolerance.kind) || s.tolerance.kind == ToleranceKind::centre_offset);
}

RowInputs sobol_rows(const std::shared_ptr<const SampledGear>& gear, std::uint64_t seed) {
  const auto points = std::make_shared<const SobolPoints>(2 * static_cast<int>(gear->inputs()), seed, 0);
  return [gear, points](std::uint64_t first, std::size_t count, std::span<double> to) {
    const std::size_t n = gear->inputs();
    const auto& sources = gear->sources().sources();
    const std::uint64_t rows = sources.size() + 2;
    std::vector<double> pair(2 * n);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t in_block = (first + i) % rows;
      if (i == 0 || in_block == 0)
        points->points((first + i) / rows, 1, pair);
      const auto a = std::span(pair).first(n), b = std::span(pair).last(n), row = to.subspan(i * n, n);
      const auto& from = in_block == 1 ? b : a;
      for (std::size_t d = 0; d < n; ++d)
        row[d] = from[d];
      if (in_block >= 2) {
        const Source& s = sources[in_block - 2];
        for (std::size_t d = s.first; d < s.first + s.count; ++d)
          row[d] = b[d];
      }
      gear->sources().transform(row);
    }
  };
}

RowInputs morris_rows(const std::shared_ptr<const SampledGear>& gear, const MorrisPoints& points,
                      std::uint64_t seed) {
  return [gear, points, seed](std::uint64_t first, std::size_t count, std::span<double> to) {
    const std::size_t n = gear->inputs();
    const auto& sources = gear->sources().sources();
    std::vector<double> u(sources.size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = to.subspan(i * n, n);
      random_uniforms({seed, RandomPurpose::model}, (first + i) / (sources.size() + 1), row);
      points.points(first + i, 1, u);
      for (std::size_t k = 0; k < sources.size(); ++k)
        if (!is_pattern(sources[k]))
          row[sources[k].first] = u[k];
      gear->sources().transform(row);
      for (std::size_t k = 0; k < sources.size(); ++k) {
        if (!is_pattern(sources[k]))
          continue;
        for (double& x : row.subspan(sources[k].first, sources[k].count))
          x = sources[k].mean + 2.0 * u[k] * (x - sources[k].mean);
      }
    }
  };
}

constexpr double local_share = 0.01; ///< of a standard deviation

/// The sources that have a derivative: one number, or an amplitude.
using Places = std::shared_ptr<const std::vector<std::size_t>>;
Places local_sources(const SampledSources& sources) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < sources.sources().size(); ++k)
    if (!is_pattern(sources.sources()[k]))
      found.push_back(k);
  return std::make_shared<const std::vector<std::size_t>>(std::move(found));
}

RowInputs local_rows(const std::shared_ptr<const SampledGear>& gear, const Places& which) {
  return [gear, which](std::uint64_t first, std::size_t count, std::span<double> to) {
    const std::size_t n = gear->inputs();
    const std::vector<double> mean = gear->sources().mean_row();
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = to.subspan(i * n, n);
      std::copy_n(mean.data(), n, row.data());
      const std::uint64_t k = first + i;
      if (k == 0)
        continue;
      const Source& s = gear->sources().sources()[(*which)[(k - 1) / 2]];
      row[s.first] += (k % 2 == 1 ? local_share : -local_share) * s.std;
    }
  };
}

std::vector<LocalElasticity> elasticities_of(const SampledGear& gear, const std::vector<std::size_t>& which,
                                             const RowTable& table) {
  std::vector<LocalElasticity> all;
  const auto columns = gear.output_columns();
  for (std::uint32_t output = 0; output < columns.size(); ++output) {
    for (std::size_t k = 0; k < which.size(); ++k) {
      const Source& s = gear.sources().sources()[which[k]];
      const double rise = table.value(1 + 2 * k, output) - table.value(2 + 2 * k, output);
      LocalElasticity e{columns[output].name, s.name, rise / (2.0 * local_share * s.std), 0.0};
      const double here = table.value(0, output);
      if (here != 0.0)
        e.elasticity = elasticity(e.derivative, s.mean, here);
      all.push_back(std::move(e));
    }
  }
  return all;
}

} // namespace

Outcome<SampledStudy> make_sensitivity_rows(const StudyFile& study, const RunContext& context) {
  const StudySensitivity& wanted = study.part<SensitivityPart>().sensitivity;
  auto made = SampledGear::make(study, wanted.outputs, wanted.positions, context);
  if (!made)
    return made.failure();
  const std::shared_ptr<const SampledGear> gear = *made;
  const auto& sources = gear->sources().sources();
  const auto seed = static_cast<std::uint64_t>(study.seed);
  const auto samples = static_cast<std::uint64_t>(wanted.samples);
  SampledStudy rows;
  switch (wanted.method) {
  case SensitivityMethod::sobol:
    if (2 * gear->inputs() > static_cast<std::size_t>(SobolPoints::max_dimensions))
      throw FieldError("source", fmt::format("the sources are {} numbers; Sobol' indices take at most {}",
                                             gear->inputs(), SobolPoints::max_dimensions / 2));
    rows = study_of(gear, sobol_rows(gear, seed));
    rows.rows = samples * (sources.size() + 2);
    break;
  case SensitivityMethod::morris: {
    const MorrisPoints points(seed, static_cast<int>(sources.size()), samples, wanted.levels);
    rows = study_of(gear, morris_rows(gear, points, seed));
    rows.rows = points.rows();
    rows.morris = points;
    break;
  }
  case SensitivityMethod::local: {
    const Places which = local_sources(gear->sources());
    if (which->empty())
      throw FieldError("source",
                       "errors of single teeth have no derivative by one number; local elasticities need "
                       "a source that is one number");
    rows = study_of(gear, local_rows(gear, which));
    rows.rows = 1 + 2 * which->size();
    rows.elasticities = [gear, which](const RowTable& table) {
      return elasticities_of(*gear, *which, table);
    };
    break;
  }
  }
  for (const Source& s : sources)
    rows.index_names.push_back(s.name);
  return rows;
}

} // namespace strainwave
