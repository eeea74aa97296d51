#pragma once
// Tolerance studies of the seed gear for tests, and their rows.

#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "strainwave/studies/tolerances/outputs.hpp"
#include "strainwave/studies/tolerances/sampled_gear.hpp"
#include "tests/studies/tolerances/cup_cache.hpp"

#include <string>
#include <utility>
#include <vector>

namespace strainwave {

inline StudySource one_number(std::string name, std::string path, double mean, double std) {
  return {.name = std::move(name),
          .kind = SourceKind::gear_key,
          .path = std::move(path),
          .distribution = Normal{mean, std}};
}

inline StudySource error(std::string name, SourceKind kind, Distribution distribution,
                         SourceMember member = SourceMember::flexspline) {
  return {.name = std::move(name),
          .kind = kind,
          .member = member,
          .path = {},
          .distribution = std::move(distribution)};
}

inline StudyFile study_with(std::vector<StudySource> sources) {
  StudyFile study(monte_carlo_kind());
  study.gear = seed_gear();
  study.load_cases = {{.torque_nm = 7.0, .rotation_rad = {}}};
  study.part<MonteCarloPart>().sources = std::move(sources);
  study.part<MonteCarloPart>().sampling.design = SamplingDesign::random;
  study.part<MonteCarloPart>().sampling.samples = 64;
  return study;
}

inline std::shared_ptr<const SampledGear> gear_of(const StudyFile& study, int positions = 1) {
  return SampledGear::make(study, {}, positions, cup_cache()).value();
}

struct Rows {
  std::vector<double> outputs;
  std::vector<std::uint8_t> status;
  std::vector<RowMessage> messages;
  std::size_t width = 0;
  double operator()(std::size_t row, std::string_view output) const {
    return outputs[row * width + *find_response(sampled_responses(), output)];
  }
};

inline Rows evaluate(const SampledGear& gear, std::span<const double> inputs) {
  Rows rows;
  rows.width = gear.outputs();
  const std::size_t n = inputs.size() / gear.inputs();
  rows.outputs.assign(n * rows.width, 0.0);
  rows.status.assign(n, row_ok);
  RowSlice slice{.first = 0,
                 .rows = n,
                 .inputs = inputs,
                 .outputs = rows.outputs,
                 .status = rows.status,
                 .messages = &rows.messages};
  gear.worker()->evaluate(slice);
  return rows;
}

/// Draws rows as the study does.
inline std::vector<double> drawn(const StudyFile& study, std::uint64_t first, std::size_t count) {
  const SampledStudy rows = make_monte_carlo_rows(study, cup_cache()).value();
  std::vector<double> values(count * rows.model->inputs());
  rows.inputs(first, count, values);
  return values;
}

inline StudyFile teeth_study() {
  return study_with(
      {error("flexspline", SourceKind::adjacent_pitch, Normal{0.0, 0.43}),
       error("circular spline", SourceKind::adjacent_pitch, Normal{0.0, 0.43}, SourceMember::circular_spline),
       error("run-out", SourceKind::run_out, Lognormal{1.0, 0.5}),
       error("offset", SourceKind::centre_offset, Normal{0.0, 1.0})});
}

} // namespace strainwave
