#include "studies/study_checks.hpp"

#include "model/gear/fields.hpp"
#include "model/gear/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace strainwave {

namespace {

class Checker {
public:
  Checker(const StudyFile& study, const StudyPlaces& places, const StudyVocabulary& vocabulary,
          std::vector<FileFault>& faults)
      : study_(study), places_(places), vocabulary_(vocabulary), faults_(faults) {}

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
  bool given(const std::string& key) const { return places_.contains(key); }

  /// The place of the key, or of the table around it.
  Place place(std::string key) const {
    while (true) {
      const auto found = places_.find(key);
      if (found != places_.end())
        return found->second;
      const std::size_t dot = key.rfind('.');
      if (dot == std::string::npos)
        return {1, 1};
      key.resize(dot);
    }
  }

  void fault(const std::string& key, std::string sentence, std::string nearest = "") {
    faults_.push_back({place(key), key, std::move(sentence), std::move(nearest)});
  }

  void check_name(const std::string& key, const std::string& name, std::span<const std::string_view> legal,
                  std::string_view what) {
    if (!given(key) || legal.empty() || std::find(legal.begin(), legal.end(), name) != legal.end())
      return;
    const Nearest nearest = nearest_name(name, legal);
    fault(key,
          fmt::format(fmt::runtime(nearest.close ? "there is no {} \"{}\"; did you mean \"{}\"?"
                                                 : "there is no {} \"{}\"; the nearest legal one is \"{}\""),
                      what, name, nearest.name),
          std::string(nearest.name));
  }

  void check_output(const std::string& key, const std::string& name) {
    check_name(key, name, vocabulary_.outputs, "output");
    if (!given(key) || !vocabulary_.unavailable)
      return;
    if (const auto sentence = vocabulary_.unavailable(name, study_))
      fault(key, fmt::format("{} {}", name, *sentence));
  }

  void check_load_case(std::size_t i) {
    const std::string table = fmt::format("load_case[{}]", i);
    if (!given(table))
      return; // made from the gear's [load]
    const LoadCase& load = study_.load_cases[i];
    if (load.torque_nm.has_value() == load.rotation_rad.has_value())
      fault(table, load.torque_nm ? "has both torque_nm and rotation_rad; a load case has one of them"
                                  : "needs torque_nm or rotation_rad");
  }

  /// The number that a path names; a fault if it names none that can vary continuously.
  std::optional<NumberPath> continuous_number(const std::string& key, const std::string& path) {
    if (!given(key))
      return std::nullopt;
    try {
      NumberPath number(path);
      if (number.field().kind == FieldKind::integer) {
        fault(key, fmt::format("{} is a whole number; only continuous numbers can vary here", path));
        return std::nullopt;
      }
      if (number.field().kind == FieldKind::number_list && !study_.gear_file.empty())
        (void)number.get(study_.gear); // the item has to exist
      return number;
    } catch (const FieldError& error) {
      fault(key, fmt::format("{}: {}", error.path, error.sentence));
      return std::nullopt;
    }
  }

  void check_in_range(const std::string& key, const NumberPath& number, double value) {
    const Field& field = number.field();
    if (field.range.contains(value) || !given(key))
      return;
    Field one = field;
    if (one.kind == FieldKind::number_list)
      one.kind = FieldKind::number;
    fault(key, fmt::format("{} {}", number.path(), find_complaint(one, value)->sentence));
  }

  void claim(const std::string& key, const std::string& path) {
    const auto [first, is_new] = claimed_.emplace(path, place(key).line);
    if (!is_new)
      fault(key, fmt::format("{} varies already (line {})", path, first->second));
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

  const StudyFile& study_;
  const StudyPlaces& places_;
  const StudyVocabulary& vocabulary_;
  std::vector<FileFault>& faults_;
  std::map<std::string, int> claimed_; ///< numbers that vary, and the line that says so
};

} // namespace

void check_study(const StudyFile& study, const StudyPlaces& places, const StudyVocabulary& vocabulary,
                 std::vector<FileFault>& faults) {
  Checker(study, places, vocabulary, faults).run();
}

} // namespace strainwave
