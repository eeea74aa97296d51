#pragma once
// How keys and tables of a study file are written down: from a member of a struct follow kind, reading and
// writing. For the sources that list keys only. The names of an enumeration are names_of(Enum), found beside
// it.

#include "strainwave/studies/file/kind.hpp"

#include <array>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace strainwave::study_rows {

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
StudyKey row(std::string_view path, std::string_view unit, Range range, std::string_view sentence,
             bool required = false) {
  using Table = typename class_of<decltype(Member)>::type;
  using Type = typename class_of<decltype(Member)>::member;
  StudyKey key;
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
  key.read = [](const void* from) -> FieldValue {
    const Table& table = *static_cast<const Table*>(from);
    if constexpr (is_optional<Type>::value)
      return table.*Member ? FieldValue(*(table.*Member)) : FieldValue();
    else
      return table.*Member;
  };
  key.write = [](void* to, const FieldValue& value) {
    Table& table = *static_cast<Table*>(to);
    if constexpr (is_optional<Type>::value)
      table.*Member = std::get<typename Type::value_type>(value);
    else
      table.*Member = std::get<Type>(value);
  };
  return key;
}

/// A row for an enumeration, by the names of its values.
template <auto Member>
StudyKey choice_row(std::string_view path, std::string_view sentence, bool required = false) {
  using Table = typename class_of<decltype(Member)>::type;
  using Enum = typename class_of<decltype(Member)>::member;
  StudyKey key;
  key.field.path = path;
  key.field.kind = FieldKind::choice;
  key.field.choices = names_of(Enum{});
  key.field.sentence = sentence;
  key.field.required = required;
  key.read = [](const void* from) -> FieldValue {
    return std::string(names_of(Enum{})[static_cast<std::size_t>(static_cast<const Table*>(from)->*Member)]);
  };
  key.write = [](void* to, const FieldValue& value) {
    const auto& text = std::get<std::string>(value);
    const auto legal = names_of(Enum{});
    for (std::size_t i = 0; i < legal.size(); ++i)
      if (legal[i] == text)
        static_cast<Table*>(to)->*Member = static_cast<Enum>(i);
  };
  return key;
}

template <class Table>
const void* blank() {
  static const Table table{};
  return &table;
}

/// name = { … }: a member std::optional<Inner>.
template <auto Member>
StudyKey inner_row(std::string_view path, std::string_view example, std::string_view sentence) {
  using Table = typename class_of<decltype(Member)>::type;
  using Inner = typename class_of<decltype(Member)>::member::value_type;
  static const std::array<StudyShape, 1> shapes{
      StudyShape{.name = "",
                 .keys = [] { return study_keys(Inner{}); },
                 .blank = blank<Inner>,
                 .put = [](void* to) -> void* { return &(static_cast<Table*>(to)->*Member).emplace(); },
                 .get = [](const void* from) -> const void* {
                   const auto& inner = static_cast<const Table*>(from)->*Member;
                   return inner ? &*inner : nullptr;
                 }}};
  StudyKey key;
  key.field.path = path;
  key.field.sentence = sentence;
  key.holds = StudyKey::Holds::table;
  key.shapes = shapes;
  key.example = example;
  return key;
}

template <auto Member, std::size_t I>
StudyShape alternative(std::string_view name) {
  using Table = typename class_of<decltype(Member)>::type;
  using Inner = std::variant_alternative_t<I, typename class_of<decltype(Member)>::member>;
  return {.name = name,
          .keys = [] { return study_keys(Inner{}); },
          .blank = blank<Inner>,
          .put = [](void* to) -> void* { return &(static_cast<Table*>(to)->*Member).template emplace<I>(); },
          .get = [](const void* from) -> const void* {
            return std::get_if<I>(&(static_cast<const Table*>(from)->*Member));
          }};
}

/// name = { ALTERNATIVE = { … } }: a member std::variant, by the names of its alternatives.
template <auto Member, std::size_t N>
StudyKey one_of_row(std::string_view path, const std::array<std::string_view, N>& names,
                    std::string_view what, std::string_view example, std::string_view sentence) {
  static const auto shapes = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<StudyShape, N>{alternative<Member, I>(names[I])...};
  }
  (std::make_index_sequence<N>());
  StudyKey key;
  key.field.path = path;
  key.field.sentence = sentence;
  key.holds = StudyKey::Holds::one_of;
  key.shapes = shapes;
  key.what = what;
  key.example = example;
  return key;
}

/// name = ["…", …]: a member std::vector<std::string>.
template <auto Member>
StudyKey names_row(std::string_view path, std::string_view sentence) {
  using Table = typename class_of<decltype(Member)>::type;
  StudyKey key;
  key.field.path = path;
  key.field.sentence = sentence;
  key.holds = StudyKey::Holds::names;
  key.names = [](void* table) { return &(static_cast<Table*>(table)->*Member); };
  key.list = [](const void* table) -> const std::vector<std::string>& {
    return static_cast<const Table*>(table)->*Member;
  };
  return key;
}

/// The outputs that a study records.
template <auto Member>
StudyKey outputs_row() {
  return names_row<Member>("outputs", "what is recorded; absent: everything that there is");
}

/// Another number of the gear that moves along.
template <auto Member>
StudyKey link_row() {
  return inner_row<Member>("link", "{ path = \"…\", ratio = … }",
                           "another number of the gear that moves along: ratio times this one");
}

template <class T>
struct is_vector : std::false_type {};
template <class T>
struct is_vector<std::vector<T>> : std::true_type {
  using item = T;
};

/// The struct of a study that has a table as its member: the study itself, or its kind's part.
template <class Owner>
Owner& owner_in(StudyFile& study) {
  if constexpr (std::is_same_v<Owner, StudyFile>)
    return study;
  else
    return study.template part<Owner>();
}
template <class Owner>
const Owner& owner_in(const StudyFile& study) {
  if constexpr (std::is_same_v<Owner, StudyFile>)
    return study;
  else
    return study.template part<Owner>();
}

/// A table [name], or [[name]] where the member is a list. `missing`: what is said where it is needed and not
/// there; empty: it is not needed.
template <auto Member>
StudyTable table(std::string_view name, std::string_view sentence, std::string_view missing = "") {
  using Owner = typename class_of<decltype(Member)>::type;
  using Type = typename class_of<decltype(Member)>::member;
  StudyTable t{.name = name, .sentence = sentence, .missing = missing};
  if constexpr (is_vector<Type>::value) {
    using Item = typename Type::value_type;
    t.repeated = true;
    t.keys = [] { return study_keys(Item{}); };
    t.blank = blank<Item>;
    t.count = [](const StudyFile& study) { return (owner_in<Owner>(study).*Member).size(); };
    t.at = [](StudyFile& study, std::size_t i) -> void* { return &(owner_in<Owner>(study).*Member)[i]; };
    t.read = [](const StudyFile& study, std::size_t i) -> const void* {
      return &(owner_in<Owner>(study).*Member)[i];
    };
    t.add = [](StudyFile& study) -> void* { return &(owner_in<Owner>(study).*Member).emplace_back(); };
  } else {
    t.keys = [] { return study_keys(Type{}); };
    t.blank = blank<Type>;
    t.count = [](const StudyFile&) { return std::size_t{1}; };
    t.at = [](StudyFile& study, std::size_t) -> void* { return &(owner_in<Owner>(study).*Member); };
    t.read = [](const StudyFile& study, std::size_t) -> const void* {
      return &(owner_in<Owner>(study).*Member);
    };
  }
  return t;
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
