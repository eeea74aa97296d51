#include "strainwave/studies/tolerances/sources.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/tolerance/error_motion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace strainwave {

namespace {

ToleranceKind tolerance_kind(SourceKind kind) {
  switch (kind) {
  case SourceKind::adjacent_pitch:
    return ToleranceKind::adjacent_pitch;
  case SourceKind::cumulative_pitch:
    return ToleranceKind::cumulative_pitch;
  case SourceKind::run_out:
    return ToleranceKind::run_out;
  case SourceKind::tooth_thickness:
    return ToleranceKind::tooth_thickness;
  case SourceKind::centre_offset:
    return ToleranceKind::centre_offset;
  case SourceKind::ovality:
    return ToleranceKind::ovality;
  case SourceKind::backlash_noise:
    return ToleranceKind::backlash_noise;
  case SourceKind::profile_slope:
    return ToleranceKind::profile_slope;
  case SourceKind::profile_form:
    return ToleranceKind::profile_form;
  case SourceKind::wear:
    return ToleranceKind::wear;
  case SourceKind::gear_key:
    break;
  }
  return ToleranceKind::gear_key;
}

bool has_phase(ToleranceKind kind) {
  return kind == ToleranceKind::cumulative_pitch || kind == ToleranceKind::run_out ||
         kind == ToleranceKind::ovality;
}

/// A source by its path. Throws FieldError for keys that the finite elements or the search for contact depend
/// on.
void set_key(const StudyFile& study, const std::string& at, SampledSources::Source& source,
             const std::string& path) {
  if (path == "wave_generator.max_radial_deformation_mm") {
    source.role = SourceRole::radial_deformation;
  } else if (path == "wave_generator.eccentricity_mm") {
    source.role = SourceRole::eccentricity;
  } else if (const auto load = load_key(path)) {
    source.role = SourceRole::torque;
    source.load_case = load->number;
    if (!load->torque || load->number >= study.load_cases.size() || !study.load_cases[load->number].torque_nm)
      throw FieldError(at + ".path", fmt::format("load case {} is not given by a torque", load->number));
  } else if (!path.starts_with("circular_spline.") && !path.starts_with("flank_modification.")) {
    throw FieldError(
        at + ".path",
        fmt::format("{} cannot be a source: samples share one cup; expected a key of circular_spline or "
                    "flank_modification, wave_generator.max_radial_deformation_mm or eccentricity_mm, or "
                    "load_case[0].torque_nm. Other keys can be swept",
                    path));
  }
  const bool disc = source.role == SourceRole::radial_deformation || source.role == SourceRole::eccentricity;
  const WaveGenerator& wg = study.gear.wave_generator;
  if (disc && wg.shape != WaveGeneratorShape::two_disc && wg.shape != WaveGeneratorShape::two_disc_exact)
    throw FieldError(at + ".path", fmt::format("{} as a source needs a wave generator with two discs", path));
  if (disc && !wg.eccentricity_mm)
    throw FieldError(at + ".path",
                     fmt::format("{} as a source needs wave_generator.eccentricity_mm instead of "
                                 "wrap_angle_deg in the gear",
                                 path));
  source.unit = plain_unit(source.role == SourceRole::torque ? "N·m" : NumberPath(path).field().unit);
}

} // namespace

SampledSources::SampledSources(const StudyFile& study) {
  for (std::size_t i = 0; i < study.part<UncertainPart>().sources.size(); ++i) {
    const StudySource& given = study.part<UncertainPart>().sources[i];
    Source source;
    source.name = given.name;
    source.distribution = given.distribution;
    source.mean = mean_of(given.distribution);
    source.std = std_of(given.distribution);
    source.tolerance = {.kind = tolerance_kind(given.kind),
                        .member = given.member == SourceMember::flexspline ? Member::flexspline
                                                                           : Member::circular_spline,
                        .harmonic = given.harmonic,
                        .unit_mm = 1e-3,
                        .path = given.path};
    source.unit = "um";
    if (given.kind == SourceKind::gear_key)
      set_key(study, fmt::format("source[{}]", i), source, given.path);
    source.count = source.role == SourceRole::flank
                       ? tolerance_dimensions(source.tolerance, study.gear.flexspline.teeth,
                                              study.gear.circular_spline.teeth)
                       : 1;
    sources_.push_back(std::move(source));
  }
  place(study);
  draw(study);
}

/// Order of the numbers: flank sources before the others, correlated ones side by side in the middle.
void SampledSources::place(const StudyFile& study) {
  const auto correlated = [&](const Source& s) {
    return std::ranges::any_of(study.part<UncertainPart>().correlations, [&](const StudyCorrelation& c) {
      return c.first == s.name || c.second == s.name;
    });
  };
  for (const int part : {0, 1, 2, 3}) {
    for (Source& s : sources_) {
      const int own = s.role == SourceRole::flank ? (correlated(s) ? 1 : 0) : (correlated(s) ? 2 : 3);
      if (own != part)
        continue;
      s.first = dimensions_;
      dimensions_ += s.count;
    }
    if (part == 1)
      flank_dimensions_ = dimensions_;
  }
}

void SampledSources::draw(const StudyFile& study) {
  std::vector<Distribution> distributions(dimensions_);
  std::vector<const Source*> correlated;
  for (const Source& s : sources_) {
    for (std::size_t d = 0; d < s.count; ++d)
      distributions[s.first + d] = s.distribution;
    if (s.role == SourceRole::flank && has_phase(s.tolerance.kind))
      distributions[s.first + 1] = Uniform{0.0, 2.0 * std::numbers::pi};
    if (std::ranges::any_of(study.part<UncertainPart>().correlations, [&](const StudyCorrelation& c) {
          return c.first == s.name || c.second == s.name;
        }))
      correlated.push_back(&s);
  }
  std::vector<CorrelatedGroup> groups;
  if (!correlated.empty()) {
    std::ranges::sort(correlated, {}, [](const Source* s) { return s->first; });
    const std::size_t n = correlated.size();
    std::vector<double> matrix(n * n, 0.0);
    const auto at = [&](const std::string& name) {
      return static_cast<std::size_t>(
          std::ranges::find_if(correlated, [&](const Source* s) { return s->name == name; }) -
          correlated.begin());
    };
    for (std::size_t i = 0; i < n; ++i)
      matrix[i * n + i] = 1.0;
    for (const StudyCorrelation& c : study.part<UncertainPart>().correlations) {
      const std::size_t i = at(c.first), j = at(c.second);
      matrix[i * n + j] = matrix[j * n + i] = normal_correlation_of_rank(c.rank);
    }
    try {
      groups.push_back({correlated.front()->first, GaussianCopula(n, matrix)});
    } catch (const std::invalid_argument& error) {
      throw FieldError("correlation", error.what());
    }
  }
  values_.emplace(distributions, std::move(groups));
}

std::vector<ToleranceSource> SampledSources::flank_sources() const {
  std::vector<const Source*> ordered;
  for (const Source& s : sources_)
    if (s.role == SourceRole::flank)
      ordered.push_back(&s);
  std::ranges::sort(ordered, {}, [](const Source* s) { return s->first; });
  std::vector<ToleranceSource> result;
  for (const Source* s : ordered)
    result.push_back(s->tolerance);
  return result;
}

const SampledSources::Source* SampledSources::find(SourceRole role, std::size_t load_case) const {
  for (const Source& s : sources_)
    if (s.role == role && s.load_case == load_case)
      return &s;
  return nullptr;
}

std::vector<double> SampledSources::mean_row() const {
  std::vector<double> row(dimensions_, 0.0);
  for (const Source& s : sources_) {
    for (std::size_t d = 0; d < s.count; ++d)
      row[s.first + d] = s.mean;
    if (s.role == SourceRole::flank && has_phase(s.tolerance.kind))
      row[s.first + 1] = 0.0;
  }
  return row;
}

void SampledSources::named_values(std::span<const double> row, std::span<double> named) const {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& s = sources_[i];
    named[i] = row[s.first];
    if (s.role != SourceRole::flank || s.count == 1 || has_phase(s.tolerance.kind))
      continue;
    double sum = 0.0;
    for (std::size_t d = 0; d < s.count; ++d)
      sum += row[s.first + d] * row[s.first + d];
    named[i] = std::sqrt(
        s.tolerance.kind == ToleranceKind::centre_offset ? sum : sum / static_cast<double>(s.count));
  }
}

} // namespace strainwave
