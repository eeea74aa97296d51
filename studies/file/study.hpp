#pragma once
// Study files: TOML that names a gear, what may vary, what is wanted and how to search. What sweeps,
// tolerances and sensitivities say stands in sampling.hpp; the rest here.
//
//     kind = "optimize"
//     gear = "seed.toml"                          # relative to the study file
//     [override]                                  # any key of the gear, by its path
//     "contact.lobes" = 2
//     [[load_case]]                               # default: the gear's [load]
//     torque_nm = 7.0
//     [[variable]]
//     path = "wave_generator.max_radial_deformation_mm"
//     lower = 0.19
//     upper = 0.21
//     link = { path = "wave_generator.eccentricity_mm", ratio = 3.0 }   # e = 3 u0 moves along
//     [objective]
//     output = "peak_force_n"
//     [[constraint]]
//     output = "rotation_rad"
//     max_ratio_to_baseline = 1.05
//     [pareto]                                    # kind = "pareto": the aim that competes
//     output = "wind_up_rad"
//     [method]
//     budget = 200
//     [reduced]                                   # what --reduced changes: keys of this file or of the gear
//     "method.budget" = 20
//
// Every fault of a file is reported at once (FileError), with the same words as in gear files.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/file_error.hpp"
#include "strainwave/studies/file/sampling.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

enum class StudyKind { optimize, pareto, sweep, monte_carlo, sensitivity };

/// Their names in files.
inline constexpr std::array<std::string_view, 5> study_kinds{"optimize", "pareto", "sweep", "monte_carlo",
                                                             "sensitivity"};

/// Exactly one of torque and rotation is given.
struct LoadCase {
  std::optional<double> torque_nm;
  std::optional<double> rotation_rad;
  int phases = 1; ///< meshing positions over one pitch
  Direction direction = Direction::drive;
};

struct StudyVariable {
  std::string path; ///< a continuous number of the gear, or an item of a list ("….spline_um[3]")
  double lower = 0.0;
  double upper = 0.0;
  std::optional<double> start; ///< within the bounds; absent: the gear's value, moved into the bounds
  std::optional<double> scale; ///< typical change, > 0; absent: upper − lower
  std::optional<VariableLink> link;
};

enum class Goal { minimise, maximise };

struct StudyObjective {
  std::string output;
  Goal goal = Goal::minimise;
};

/// At least one limit is given.
struct StudyConstraint {
  std::string output;
  std::optional<double> min;
  std::optional<double> max;
  std::optional<double> min_ratio_to_baseline; ///< times the baseline's value
  std::optional<double> max_ratio_to_baseline; ///< the same
};

/// pareto: the second aim.
struct StudyPareto {
  std::string output;
  Goal goal = Goal::minimise;
  int points = 7; ///< of the front, ends included
};

struct StudyMethod {
  std::string name; ///< empty: the default of the kind
  int budget = 200; ///< evaluations
  double tolerance = 1e-4;
  int starts = 1;
};

struct StudyLimits {
  double failure_share = 0.01; ///< of the evaluations that may fail
};

/// Where a file does not say: 0.5 of a search, 0.01 of rows.
double default_failure_share(StudyKind kind);

/// One line of [override] or [reduced].
struct StudyChange {
  std::string path;
  FieldValue value;
};

struct StudyFile {
  std::string file;
  StudyKind kind = StudyKind::optimize;
  std::string gear_file; ///< absolute
  int seed = 1;
  bool reduced = false;
  Gear gear; ///< the gear's file with [override] applied (and [reduced], if asked for): the baseline
  std::vector<LoadCase> load_cases;     ///< never empty
  std::vector<StudyVariable> variables; ///< never empty in optimize and pareto
  StudyObjective objective;
  std::vector<StudyConstraint> constraints;
  StudyPareto pareto; ///< output is empty in other kinds
  StudyMethod method;
  std::vector<SweepVariable> sweep_variables; ///< sweep: never empty
  StudySweep sweep;
  std::vector<StudySource> sources; ///< monte_carlo, sensitivity: never empty
  std::vector<StudyCorrelation> correlations;
  StudySampling sampling;                   ///< monte_carlo
  std::vector<StudyExceedance> exceedances; ///< monte_carlo
  StudySensitivity sensitivity;             ///< sensitivity
  StudyLimits limits;
  std::vector<StudyChange> overrides; ///< already in `gear`
  std::vector<StudyChange>
      reduced_changes; ///< empty if `reduced`: they are applied, those of the gear to `overrides`
};

/// What the reader cannot know by itself; an empty list accepts every name.
struct StudyVocabulary {
  std::span<const std::string_view> outputs; ///< of a forward result that may be objective or constraint
  std::span<const std::string_view> methods;
  std::span<const std::string_view> sampled_outputs = {}; ///< of a row of monte_carlo or sensitivity
  /// Why an output that exists is not to be had in this study, and the remedy; may be empty.
  std::function<std::optional<std::string>(std::string_view output, const StudyFile&)> unavailable = {};
};

/// Throws FileError (of the study file, or of the gear file that it names), std::system_error.
StudyFile load_study(const std::string& path, bool reduced = false, const StudyVocabulary& vocabulary = {});

/// `name` stands in messages; the gear file is looked for beside it.
StudyFile parse_study(std::string_view text, const std::string& name, bool reduced = false,
                      const StudyVocabulary& vocabulary = {});

/// A study from what write_study() and write_gear(study.gear) have given: needs no other file, so that a
/// study's folder can be read on another machine. `name`: of the file that holds both, for messages.
StudyFile restore_study(std::string_view text, std::string_view gear_text, const std::string& name,
                        const StudyVocabulary& vocabulary = {});

/// Does this TOML text describe a study (and not a gear)? False for what is no TOML.
bool is_study_text(std::string_view text);

/// The study as a file with every default filled in; it reads back to the same study. What `reduced` changed
/// stays changed, so the printed file needs no --reduced.
std::string write_study(const StudyFile& study);

} // namespace strainwave
