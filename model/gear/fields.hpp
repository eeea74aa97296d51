#pragma once
// The one table of everything that can be said about a gear.
//
// Each row (Field) names a key of a gear file by its path, "wave_generator.max_radial_deformation_mm", with
// its kind, unit, range, choices, one sentence, and two functions that read it from and write it into a Gear.
// Reading files, checks, the JSON Schema, the reference page, overrides and design variables of studies and
// the keys of stored results all walk this table, so a new key is added in two places: gear.hpp and
// field_table.cpp.
//
// A default is what a default-constructed Gear holds. A range says which values make sense for one key alone
// (thickness above zero); whether several numbers fit together is not asked here.

#include "strainwave/model/gear/gear.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace strainwave {

enum class FieldKind { number, integer, text, choice, number_list };

/// std::monostate: the key is absent, and absence has a meaning of its own. A choice is held by its name.
using FieldValue = std::variant<std::monostate, double, int, std::string, std::vector<double>>;

struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false; ///< lower itself is not allowed
  bool upper_open = false;

  /// NaN lies in no range.
  bool contains(double value) const {
    return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
  }
};

/// A name that a choice had in files of earlier versions; it is still read.
struct FormerChoice {
  std::string_view name;     ///< "event_path"
  std::string_view now;      ///< "direct"
  std::string_view sentence; ///< what is done, without a full stop
};

struct Field {
  std::string_view path; ///< tables joined by dots, then the key
  FieldKind kind = FieldKind::number;
  std::string_view unit;       ///< as printed: "mm", "µm", "degrees"; empty for a plain number
  bool required = false;       ///< no sensible default exists
  bool may_be_absent = false;  ///< no default either, but absence has a meaning (the sentence says which)
  Range range;                 ///< of a number, an integer, or each number of a list
  std::size_t list_length = 0; ///< lists: the only length besides empty, ascending; 0 for any
  std::span<const std::string_view> choices;
  std::span<const FormerChoice> former_choices;
  std::string_view sentence; ///< what it is, without a full stop
  FieldValue (*read)(const Gear&) = nullptr;
  void (*write)(Gear&, const FieldValue&) = nullptr; ///< unchecked; the alternative must fit the kind

  std::string_view table() const; ///< "wave_generator"; empty for keys of the top level
  std::string_view key() const;   ///< "max_radial_deformation_mm"
};

/// A heading of the file: "flank_modification.flexspline" and what belongs under it.
struct FieldTable {
  std::string_view path;
  std::string_view sentence;
};

/// All keys, in the order in which files show them; keys of one table stand together.
std::span<const Field> gear_fields();
std::span<const FieldTable> gear_tables();

/// Null if there is no such key.
const Field* find_field(std::string_view path);
const FieldTable* find_table(std::string_view path);

/// Names of the choices, by the order of the enumerators.
std::span<const std::string_view> choice_names(WaveGeneratorShape);
std::span<const std::string_view> choice_names(Fidelity);
std::span<const std::string_view> choice_names(AssemblyModel);
std::span<const std::string_view> choice_names(LoadMethod);
std::span<const std::string_view> choice_names(ForceDirection);
std::span<const std::string_view> choice_names(DiscGap);
std::span<const std::string_view> choice_names(GapModel);
std::span<const std::string_view> choice_names(Direction);
template <class Enum>
std::string_view choice_name(Enum value) {
  return choice_names(value)[static_cast<std::size_t>(value)];
}

/// The former choice that a value is; null for every other value.
const FormerChoice* find_former_choice(const Field& field, const FieldValue& value);
/// A former choice becomes the present one; every other value stays.
FieldValue present_value(const Field& field, FieldValue value);
/// "is called \"direct\" now: every load is solved directly …".
std::string renamed_sentence(const FormerChoice& former);

/// What a value of this field has to be, as words: "a number in mm, above 0 and at most 100".
std::string expectation(const Field& field);

/// Why a value is not allowed, as words, and which item of a list is meant. Nothing if it is allowed.
struct Complaint {
  std::string sentence;
  std::optional<std::size_t> item;
};
std::optional<Complaint> find_complaint(const Field& field, const FieldValue& value);

/// A path that does not exist or a value that its field does not allow: the user's fault.
struct FieldError : std::invalid_argument {
  FieldError(std::string path_, const std::string& sentence_)
      : std::invalid_argument(path_ + ": " + sentence_), path(std::move(path_)), sentence(sentence_) {}
  std::string path;
  std::string sentence;
};

/// Checks and writes one value; an integer is accepted for a number. Throws FieldError.
void set_value(Gear& gear, std::string_view path, FieldValue value);

/// A number of a gear by its path: a number or integer field, or one item of a list, "…spline_um[3]" counted
/// from 0. Look it up once and use it for many gears (design variables). Throws FieldError for paths that are
/// no number.
class NumberPath {
public:
  explicit NumberPath(std::string_view path);
  const Field& field() const { return *field_; }
  std::string path() const;
  /// Throws FieldError where the gear has no value (an absent key, a list that is too short).
  double get(const Gear& gear) const;
  void set(Gear& gear, double value) const;

private:
  const Field* field_;
  std::optional<std::size_t> item_;
};

/// Words for a path that is not in the table: "no such key; did you mean module_mm?". `nearest` gets the full
/// legal path.
std::string unknown_key_sentence(std::string_view path, std::string* nearest = nullptr);

/// Shortest decimal form that reads back to the same bits: 0.2, 206000, 1e-07.
std::string shortest(double value);

/// The exact bits of a gear for keys of stored results: every field in table order, with its path, except
/// `name`, which no result depends on. −0 counts as 0. With `parts`, only these keys and those of these
/// tables and of tables inside them. wave_generator.table_file enters as a path: who reads that file adds its
/// content.
std::string canonical_bits(const Gear& gear, std::span<const std::string_view> parts = {});

/// A gear of these keys and tables alone; everything else is a default-constructed Gear's.
Gear part_of(const Gear& gear, std::span<const std::string_view> parts);

} // namespace strainwave
