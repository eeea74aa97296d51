#include "studies/study_keys.hpp"

#include <type_traits>

namespace strainwave {

namespace {

constexpr std::array<std::string_view, 2> goal_names{"minimise", "maximise"};

std::span<const std::string_view> names_of(Goal) {
  return goal_names;
}
std::span<const std::string_view> names_of(Direction direction) {
  return choice_names(direction);
}

template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};

template <class T>
struct class_of;
template <class T, class M>
struct class_of<M T::*> {
  using type = T;
  using member = M;
};

/// A row for a plain member: the kind follows from its type.
template <auto Member>
auto row(std::string_view path, std::string_view unit, Range range, std::string_view sentence,
         bool required = false) {
  using Table = typename class_of<decltype(Member)>::type;
  using Type = typename class_of<decltype(Member)>::member;
  StudyKey<Table> key;
  key.field.path = path;
  key.field.unit = unit;
  key.field.range = range;
  key.field.sentence = sentence;
  key.field.required = required;
  if constexpr (std::is_same_v<Type, std::string>)
    key.field.kind = FieldKind::text;
  else if constexpr (std::is_same_v<Type, int>)
    key.field.kind = FieldKind::integer;
  else
    key.field.kind = FieldKind::number;
  key.read = [](const Table& table) -> FieldValue {
    if constexpr (is_optional<Type>::value)
      return table.*Member ? FieldValue(*(table.*Member)) : FieldValue();
    else
      return table.*Member;
  };
  key.write = [](Table& table, const FieldValue& value) {
    if constexpr (is_optional<Type>::value)
      table.*Member = std::get<typename Type::value_type>(value);
    else
      table.*Member = std::get<Type>(value);
  };
  return key;
}

/// A row for an enumeration, by the names of its values.
template <auto Member>
auto choice_row(std::string_view path, std::string_view sentence) {
  using Table = typename class_of<decltype(Member)>::type;
  using Enum = typename class_of<decltype(Member)>::member;
  StudyKey<Table> key;
  key.field.path = path;
  key.field.kind = FieldKind::choice;
  key.field.choices = names_of(Enum{});
  key.field.sentence = sentence;
  key.read = [](const Table& table) -> FieldValue {
    return std::string(names_of(Enum{})[static_cast<std::size_t>(table.*Member)]);
  };
  key.write = [](Table& table, const FieldValue& value) {
    const auto& text = std::get<std::string>(value);
    const auto legal = names_of(Enum{});
    for (std::size_t i = 0; i < legal.size(); ++i)
      if (legal[i] == text)
        table.*Member = static_cast<Enum>(i);
  };
  return key;
}

constexpr bool needed = true;
constexpr Range any{};
constexpr Range from_zero(double upper) {
  return {.lower = 0.0, .upper = upper};
}
constexpr Range above_zero(double upper) {
  return {.lower = 0.0, .upper = upper, .lower_open = true};
}
constexpr Range within(double lower, double upper) {
  return {.lower = lower, .upper = upper};
}

} // namespace

std::span<const StudyKey<StudyFile>> study_keys(const StudyFile&) {
  static const auto kind = [] {
    StudyKey<StudyFile> key;
    key.field.path = "kind";
    key.field.kind = FieldKind::choice;
    key.field.choices = study_kinds;
    key.field.required = true;
    key.field.sentence = "what kind of study this is";
    key.read = [](const StudyFile& study) -> FieldValue {
      return std::string(study_kinds[static_cast<std::size_t>(study.kind)]);
    };
    key.write = [](StudyFile& study, const FieldValue& value) { // only kinds that run get this far
      const bool pareto =
          std::get<std::string>(value) == study_kinds[static_cast<std::size_t>(StudyKind::pareto)];
      study.kind = pareto ? StudyKind::pareto : StudyKind::optimize;
    };
    return key;
  }();
  static const std::array keys{
      kind,
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
                                       "share of evaluations that may fail"),
  };
  return keys;
}

} // namespace strainwave
