#pragma once
// What is not exact, as study files say it: the sources and correlations of monte_carlo and sensitivity.
//
//     [[source]]
//     name = "u0"
//     kind = "gear_key"
//     path = "wave_generator.max_radial_deformation_mm"   # or load_case[0].torque_nm
//     distribution = { normal = { mean = 0.2, std = 0.0005 } }
//     [[correlation]]
//     first = "u0"
//     second = "wear"
//     rank = -0.5

#include "strainwave/common/sampling/distribution.hpp"
#include "strainwave/studies/file/checker.hpp"
#include "strainwave/studies/file/kind.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

enum class SourceKind {
  adjacent_pitch,
  cumulative_pitch,
  run_out,
  tooth_thickness,
  centre_offset,
  ovality,
  backlash_noise,
  profile_slope,
  profile_form,
  wear,
  gear_key
};

inline constexpr std::array<std::string_view, 11> source_kind_names{
    "adjacent_pitch", "cumulative_pitch", "run_out",       "tooth_thickness", "centre_offset",
    "ovality",        "backlash_noise",   "profile_slope", "profile_form",    "wear",
    "gear_key"};

enum class SourceMember { flexspline, circular_spline };

struct StudySource {
  std::string name; ///< unique
  SourceKind kind = SourceKind::adjacent_pitch;
  SourceMember member = SourceMember::flexspline;
  int harmonic = 1;          ///< cumulative_pitch: periods over one turn
  std::string path;          ///< gear_key: a continuous number of the gear, or load_case[I].torque_nm
  Distribution distribution; ///< of each of its numbers; µm, or the unit of the gear's key
};

/// Rank correlation (Spearman) between two sources that are one number each.
struct StudyCorrelation {
  std::string first;
  std::string second;
  double rank = 0.0;
};

struct UncertainPart : StudyPart {
  std::vector<StudySource> sources; ///< never empty
  std::vector<StudyCorrelation> correlations;
};

/// The alternatives of Distribution, by name and in its order.
inline constexpr std::array<std::string_view, 6> distribution_names{
    "normal", "truncated_normal", "uniform", "triangular", "lognormal", "table"};

StudyKeys study_keys(const StudySource&);
StudyKeys study_keys(const StudyCorrelation&);
/// [[source]] and [[correlation]]
StudyTable source_table();
StudyTable correlation_table();

void check_uncertain(StudyChecker& checker);
nlohmann::ordered_json plan_sources(const StudyFile& study);

} // namespace strainwave
