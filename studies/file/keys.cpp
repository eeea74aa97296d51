#include "strainwave/studies/file/key_rows.hpp"

namespace strainwave {

using namespace study_rows;

std::span<const StudyKey<StudyFile>> study_keys(const StudyFile&) {
  static const std::array keys{
      choice_row<&StudyFile::kind>("kind", "what kind of study this is", needed),
      row<&StudyFile::gear_file>("gear", "", any, "the gear file, relative to this file", needed),
      row<&StudyFile::seed>("seed", "", from_zero(2147483647.0), "seed of everything random"),
  };
  return keys;
}

std::span<const StudyKey<LoadCase>> study_keys(const LoadCase&) {
  static const std::array keys{
      row<&LoadCase::torque_nm>("torque_nm", "N·m", from_zero(1e6), "torque on the circular spline"),
      row<&LoadCase::rotation_rad>("rotation_rad", "rad", from_zero(1.0),
                                   "rotation of the circular spline, instead"),
      row<&LoadCase::phases>("phases", "", within(1, 1000), "meshing positions over one pitch"),
      choice_row<&LoadCase::direction>("direction", "which flanks carry the load"),
  };
  return keys;
}

std::span<const StudyKey<StudyVariable>> study_keys(const StudyVariable&) {
  static const std::array keys{
      row<&StudyVariable::path>("path", "", any, "the number of the gear that varies", needed),
      row<&StudyVariable::lower>("lower", "", any, "lower bound, in the unit of the key", needed),
      row<&StudyVariable::upper>("upper", "", any, "upper bound", needed),
      row<&StudyVariable::start>("start", "", any, "where the search begins"),
      row<&StudyVariable::scale>("scale", "", above_zero(1e9), "typical change"),
  };
  return keys;
}

std::span<const StudyKey<VariableLink>> study_keys(const VariableLink&) {
  static const std::array keys{
      row<&VariableLink::path>("path", "", any, "the number of the gear that moves along", needed),
      row<&VariableLink::ratio>("ratio", "", any, "that number over the variable", needed),
  };
  return keys;
}

std::span<const StudyKey<StudyObjective>> study_keys(const StudyObjective&) {
  static const std::array keys{
      row<&StudyObjective::output>("output", "", any, "the result that is to become small", needed),
      choice_row<&StudyObjective::goal>("goal", "or large"),
  };
  return keys;
}

std::span<const StudyKey<StudyConstraint>> study_keys(const StudyConstraint&) {
  static const std::array keys{
      row<&StudyConstraint::output>("output", "", any, "the result that is limited", needed),
      row<&StudyConstraint::min>("min", "", any, "it stays at or above"),
      row<&StudyConstraint::max>("max", "", any, "it stays at or below"),
      row<&StudyConstraint::min_ratio_to_baseline>("min_ratio_to_baseline", "", above_zero(1e9),
                                                   "it stays at or above this times the baseline's value"),
      row<&StudyConstraint::max_ratio_to_baseline>("max_ratio_to_baseline", "", above_zero(1e9),
                                                   "it stays at or below this times the baseline's value"),
  };
  return keys;
}

std::span<const StudyKey<StudyPareto>> study_keys(const StudyPareto&) {
  static const std::array keys{
      row<&StudyPareto::output>("output", "", any, "the result that competes with the objective", needed),
      choice_row<&StudyPareto::goal>("goal", "whether less or more of it is wanted"),
      row<&StudyPareto::points>("points", "", within(2, 1000), "points of the front, ends included"),
  };
  return keys;
}

std::span<const StudyKey<StudyMethod>> study_keys(const StudyMethod&) {
  static const std::array keys{
      row<&StudyMethod::name>("name", "", any, "the method of the search"),
      row<&StudyMethod::budget>("budget", "", within(1, 100000000), "evaluations at most"),
      row<&StudyMethod::tolerance>("tolerance", "", above_zero(1.0),
                                   "relative change at which the search ends"),
      row<&StudyMethod::starts>("starts", "", within(1, 100000), "starting points"),
  };
  return keys;
}

std::span<const StudyKey<StudyLimits>> study_keys(const StudyLimits&) {
  static const std::array keys{
      row<&StudyLimits::failure_share>("failure_share", "", within(0.0, 1.0),
                                       "share of evaluations that may fail; more: exit code 3"),
  };
  return keys;
}

} // namespace strainwave
