#include "strainwave/studies/file/checks.hpp"

#include "strainwave/studies/file/checker.hpp"

namespace strainwave {

namespace {

class Checker : StudyChecker {
public:
  using StudyChecker::StudyChecker;

  void run() {
    for (std::size_t i = 0; i < study_.load_cases.size(); ++i)
      check_load_case(i);
    for (std::size_t i = 0; i < study_.variables.size(); ++i)
      check_variable(i);
    check_output("objective.output", study_.objective.output);
    check_output("pareto.output", study_.pareto.output);
    for (std::size_t i = 0; i < study_.constraints.size(); ++i)
      check_constraint(i);
    if (!study_.method.name.empty())
      check_name("method.name", study_.method.name, vocabulary_.methods, "method");
  }

private:
  void check_load_case(std::size_t i) {
    const std::string table = fmt::format("load_case[{}]", i);
    if (!given(table))
      return; // made from the gear's [load]
    const LoadCase& load = study_.load_cases[i];
    if (load.torque_nm.has_value() == load.rotation_rad.has_value())
      fault(table, load.torque_nm ? "has both torque_nm and rotation_rad; a load case has one of them"
                                  : "needs torque_nm or rotation_rad");
  }

  void check_variable(std::size_t i) {
    const StudyVariable& variable = study_.variables[i];
    const std::string table = fmt::format("variable[{}].", i);
    const auto number = continuous_number(table + "path", variable.path);
    const bool bounded = given(table + "lower") && given(table + "upper");
    if (bounded && !(variable.lower < variable.upper))
      fault(table + "upper", fmt::format("must be above lower = {}, is {}", shortest(variable.lower),
                                         shortest(variable.upper)));
    if (variable.start && bounded &&
        !(variable.lower <= *variable.start && *variable.start <= variable.upper))
      fault(table + "start",
            fmt::format("must lie between lower = {} and upper = {}, is {}", shortest(variable.lower),
                        shortest(variable.upper), shortest(*variable.start)));
    if (number) {
      check_in_range(table + "lower", *number, variable.lower);
      check_in_range(table + "upper", *number, variable.upper);
      claim(table + "path", number->path());
    }
    if (variable.link)
      check_link(table, variable);
  }

  void check_link(const std::string& table, const StudyVariable& variable) {
    const auto number = continuous_number(table + "link.path", variable.link->path);
    if (!number)
      return;
    claim(table + "link.path", number->path());
    for (const double bound : {variable.lower, variable.upper}) {
      const std::size_t before = faults_.size();
      check_in_range(table + "link.ratio", *number, variable.link->ratio * bound);
      if (faults_.size() > before)
        return;
    }
  }

  void check_constraint(std::size_t i) {
    const StudyConstraint& constraint = study_.constraints[i];
    const std::string table = fmt::format("constraint[{}]", i);
    check_output(table + ".output", constraint.output);
    if (!constraint.min && !constraint.max && !constraint.min_ratio_to_baseline &&
        !constraint.max_ratio_to_baseline)
      fault(table, "limits nothing; give min, max, min_ratio_to_baseline or max_ratio_to_baseline");
    if (constraint.min && constraint.max && !(*constraint.min <= *constraint.max))
      fault(table + ".max", fmt::format("must not be below min = {}, is {}", shortest(*constraint.min),
                                        shortest(*constraint.max)));
  }
};

} // namespace

void check_study(const StudyFile& study, const StudyPlaces& places, const StudyVocabulary& vocabulary,
                 std::vector<FileFault>& faults) {
  Checker(study, places, vocabulary, faults).run();
  check_sampled_study(study, places, vocabulary, faults);
}

} // namespace strainwave
