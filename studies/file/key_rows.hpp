#pragma once
// How a row of study_keys() is written down: from a member of a table's struct follow kind, reading and
// writing. For the sources that list keys only.

#include "strainwave/studies/file/keys.hpp"

#include <optional>
#include <type_traits>

namespace strainwave::study_rows {

inline constexpr std::array<std::string_view, 2> goal_names{"minimise", "maximise"};
inline constexpr std::array<std::string_view, 2> sweep_mode_names{"factorial", "list"};
inline constexpr std::array<std::string_view, 2> source_member_names{"flexspline", "circular_spline"};
inline constexpr std::array<std::string_view, 3> design_names{"random", "latin_hypercube", "sobol"};
inline constexpr std::array<std::string_view, 3> sensitivity_method_names{"sobol", "morris", "local"};

inline std::span<const std::string_view> names_of(Goal) {
  return goal_names;
}
inline std::span<const std::string_view> names_of(Direction direction) {
  return choice_names(direction);
}
inline std::span<const std::string_view> names_of(StudyKind) {
  return study_kinds;
}
inline std::span<const std::string_view> names_of(SweepMode) {
  return sweep_mode_names;
}
inline std::span<const std::string_view> names_of(SourceKind) {
  return source_kind_names;
}
inline std::span<const std::string_view> names_of(SourceMember) {
  return source_member_names;
}
inline std::span<const std::string_view> names_of(SamplingDesign) {
  return design_names;
}
inline std::span<const std::string_view> names_of(SensitivityMethod) {
  return sensitivity_method_names;
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
template <class T>
struct content_of {
  using type = T;
};
template <class T>
struct content_of<std::optional<T>> {
  using type = T;
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
  using Content = typename content_of<Type>::type;
  if constexpr (std::is_same_v<Content, std::string>)
    key.field.kind = FieldKind::text;
  else if constexpr (std::is_same_v<Content, int>)
    key.field.kind = FieldKind::integer;
  else if constexpr (std::is_same_v<Content, std::vector<double>>)
    key.field.kind = FieldKind::number_list;
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
auto choice_row(std::string_view path, std::string_view sentence, bool required = false) {
  using Table = typename class_of<decltype(Member)>::type;
  using Enum = typename class_of<decltype(Member)>::member;
  StudyKey<Table> key;
  key.field.path = path;
  key.field.kind = FieldKind::choice;
  key.field.choices = names_of(Enum{});
  key.field.sentence = sentence;
  key.field.required = required;
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

inline constexpr bool needed = true;
inline constexpr Range any{};
constexpr Range from_zero(double upper) {
  return {.lower = 0.0, .upper = upper};
}
constexpr Range above_zero(double upper) {
  return {.lower = 0.0, .upper = upper, .lower_open = true};
}
constexpr Range within(double lower, double upper) {
  return {.lower = lower, .upper = upper};
}

} // namespace strainwave::study_rows
