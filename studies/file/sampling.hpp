#pragma once
// What study files say about sweeps, tolerances and sensitivities.
//
//     [[variable]]                                # sweep: values, or lower, upper and count
//     path = "flexspline.cup_length_mm"           # any number of the gear, or "load_case[0].torque_nm"
//     values = [10.0, 12.0]
//     [sweep]
//     mode = "factorial"                          # or "list": row i takes value i of every variable
//     outputs = ["peak_force_n"]                  # none: every output that the loads give
//
//     [[source]]                                  # monte_carlo, sensitivity
//     name = "pitch of the flexspline"
//     kind = "adjacent_pitch"
//     member = "flexspline"
//     distribution = { normal = { mean = 0.0, std = 2.0 } }        # µm; gear_key: the unit of the key
//     [[correlation]]
//     first = "pitch of the flexspline"
//     second = "run-out"
//     rank = 0.6
//     [sampling]
//     design = "sobol"
//     samples = 65536
//     quantiles = [0.01, 0.5, 0.99]
//     outputs = ["peak_force_n"]
//     stop = { output = "peak_force_n", quantile = 0.99, half_width = 0.5 }
//     [[exceedance]]                              # probability that the output is above the limit
//     output = "peak_force_n"
//     limit = 45.0
//     [sensitivity]
//     method = "sobol"
//     samples = 1024                              # blocks (sobol) or trajectories (morris)

#include "strainwave/common/sampling/design.hpp"
#include "strainwave/common/sampling/distribution.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// Another number of the gear that moves with a variable: number at `path` = ratio · variable.
struct VariableLink {
  std::string path;
  double ratio = 1.0;
};

/// `values`, or `lower`, `upper` and `count` (ends included).
struct SweepVariable {
  std::string path; ///< a number of the gear, or load_case[I].torque_nm, load_case[I].rotation_rad
  std::vector<double> values;
  std::optional<double> lower;
  std::optional<double> upper;
  std::optional<int> count;
  std::optional<VariableLink> link;
};

std::vector<double> sweep_values(const SweepVariable& variable);

/// "load_case[2].torque_nm": nothing for other paths.
struct SweepLoad {
  std::size_t number = 0;
  bool torque = true; ///< else rotation
};
std::optional<SweepLoad> sweep_load(std::string_view path);

enum class SweepMode {
  factorial, ///< every value with every other; the last variable moves fastest
  list       ///< value i of all variables together
};

struct StudySweep {
  SweepMode mode = SweepMode::factorial;
  std::vector<std::string> outputs; ///< empty: all that the loads give
};

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
  std::string path;          ///< gear_key: a continuous number of the gear
  Distribution distribution; ///< of each of its numbers; µm, or the unit of the gear's key
};

/// Rank correlation (Spearman) between two sources that are one number each.
struct StudyCorrelation {
  std::string first;
  std::string second;
  double rank = 0.0;
};

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

enum class SensitivityMethod { sobol, morris, local };

struct StudySensitivity {
  SensitivityMethod method = SensitivityMethod::sobol;
  int samples = 1024; ///< blocks of (sources + 2) rows, or trajectories of (sources + 1) rows
  int positions = 1;
  int levels = 4; ///< morris: levels of each source
  std::vector<std::string> outputs;
};

} // namespace strainwave
