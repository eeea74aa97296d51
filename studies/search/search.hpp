#pragma once
// Searches: kind "optimize" looks for one design, "pareto" for a front of two aims.
//
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

#include "strainwave/studies/report/reported_kind.hpp"

#include <optional>
#include <string>
#include <vector>

namespace strainwave {

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

struct SearchPart : StudyPart {
  std::vector<StudyVariable> variables; ///< never empty
  StudyObjective objective;
  std::vector<StudyConstraint> constraints;
  StudyMethod method;
  std::unique_ptr<StudyPart> copy() const override { return std::make_unique<SearchPart>(*this); }
};

struct ParetoPart : SearchPart {
  StudyPareto pareto;
  std::unique_ptr<StudyPart> copy() const override { return std::make_unique<ParetoPart>(*this); }
};

const ReportedKind& optimize_kind();
const ReportedKind& pareto_kind();

} // namespace strainwave
