#include "strainwave/model/gear/fields.hpp"

#include "strainwave/common/core/nearest.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace strainwave {

namespace {

/// "above 0 and at most 100 mm"; empty if every number is allowed.
std::string range_words(const Field& field) {
  std::string words;
  const Range& range = field.range;
  if (std::isfinite(range.lower))
    words.append(range.lower_open ? "above " : "at least ").append(shortest(range.lower));
  if (std::isfinite(range.upper)) {
    if (!words.empty())
      words += " and ";
    words.append(range.upper_open ? "below " : "at most ").append(shortest(range.upper));
  }
  if (!words.empty() && !field.unit.empty())
    words.append(" ").append(field.unit);
  return words;
}

std::string joined(std::span<const std::string_view> names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0)
      words += i + 1 == names.size() ? " or " : ", ";
    words += names[i];
  }
  return words;
}

std::optional<std::string> complain_about_number(const Field& field, double value) {
  if (!std::isfinite(value))
    return "must be a finite number, is " + shortest(value);
  if (!field.range.contains(value))
    return "must be " + range_words(field) + ", is " + shortest(value);
  return std::nullopt;
}

std::optional<Complaint> complain_about_list(const Field& field, const std::vector<double>& list) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (auto words = complain_about_number(field, list[i]))
      return Complaint{"every number of the list " + *words, i};
  if (field.list_length == 0 || list.empty())
    return std::nullopt;
  if (list.size() != field.list_length)
    return Complaint{"must hold " + std::to_string(field.list_length) + " numbers or none, holds " +
                         std::to_string(list.size()),
                     std::nullopt};
  for (std::size_t i = 1; i < list.size(); ++i)
    if (!(list[i - 1] < list[i]))
      return Complaint{
          "the numbers must rise, but " + shortest(list[i]) + " follows " + shortest(list[i - 1]), i};
  return std::nullopt;
}

bool fits_kind(const Field& field, const FieldValue& value) {
  if (std::holds_alternative<std::monostate>(value))
    return field.may_be_absent;
  switch (field.kind) {
  case FieldKind::number:
    return std::holds_alternative<double>(value);
  case FieldKind::integer:
    return std::holds_alternative<int>(value);
  case FieldKind::text:
  case FieldKind::choice:
    return std::holds_alternative<std::string>(value);
  case FieldKind::number_list:
    return std::holds_alternative<std::vector<double>>(value);
  }
  return false;
}

/// "a.b[3]" → "a.b" and 3; no item if there is no well-formed index.
std::pair<std::string_view, std::optional<std::size_t>> split_item(std::string_view path) {
  const std::size_t open = path.rfind('[');
  if (open == std::string_view::npos || path.back() != ']')
    return {path, std::nullopt};
  std::size_t item = 0;
  const char* const end = path.data() + path.size() - 1;
  const auto [stop, error] = std::from_chars(path.data() + open + 1, end, item);
  if (error != std::errc() || stop != end)
    return {path, std::nullopt};
  return {path.substr(0, open), item};
}

struct Bits {
  std::string bytes;

  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8)
      bytes.push_back(static_cast<char>((word >> shift) & 0xff));
  }
  void add(std::string_view text) {
    add(text.size());
    bytes += text;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number == 0.0 ? 0.0 : number)); }

  void operator()(std::monostate) {}
  void operator()(double number) { add(number); }
  void operator()(int number) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(number))); }
  void operator()(const std::string& text) { add(std::string_view(text)); }
  void operator()(const std::vector<double>& list) {
    add(list.size());
    for (const double number : list)
      add(number);
  }
};

/// Whether a path is one of these or lies in a table of these.
bool lies_in(std::string_view path, std::span<const std::string_view> parts) {
  return std::any_of(parts.begin(), parts.end(), [&](std::string_view one) {
    return path == one || (path.starts_with(one) && path.size() > one.size() && path[one.size()] == '.');
  });
}

} // namespace

std::string_view Field::table() const {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

std::string_view Field::key() const {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

const Field* find_field(std::string_view path) {
  static const auto index = [] {
    std::unordered_map<std::string_view, const Field*> map;
    for (const Field& field : gear_fields())
      map.emplace(field.path, &field);
    return map;
  }();
  const auto found = index.find(path);
  return found == index.end() ? nullptr : found->second;
}

const FieldTable* find_table(std::string_view path) {
  for (const FieldTable& table : gear_tables())
    if (table.path == path)
      return &table;
  return nullptr;
}

std::string shortest(double value) {
  if (std::isnan(value))
    return "nan";
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  // Six-digit numbers and the like read better without an exponent: 100000, not 1e+05.
  if (std::abs(value) >= 1e4 && std::abs(value) < 1e15 && value == std::floor(value))
    return std::to_string(static_cast<long long>(value));
  return error == std::errc() ? std::string(buffer.data(), end) : std::string();
}

std::string expectation(const Field& field) {
  std::string unit;
  if (!field.unit.empty())
    unit.append(" in ").append(field.unit);
  Field bare = field;
  bare.unit = {};
  const std::string range = range_words(bare).empty() ? "" : ", " + range_words(bare);
  switch (field.kind) {
  case FieldKind::number:
    return "a number" + unit + range;
  case FieldKind::integer:
    return "a whole number" + range;
  case FieldKind::text:
    return "a text in quotes";
  case FieldKind::choice:
    return "one of the texts " + joined(field.choices);
  case FieldKind::number_list:
    return "a list of numbers" + unit + (range.empty() ? "" : ", each" + range.substr(1));
  }
  return {};
}

std::optional<Complaint> find_complaint(const Field& field, const FieldValue& value) {
  if (!fits_kind(field, value))
    return Complaint{"must be " + expectation(field), std::nullopt};
  if (const double* number = std::get_if<double>(&value)) {
    if (auto words = complain_about_number(field, *number))
      return Complaint{*words, std::nullopt};
  } else if (const int* whole = std::get_if<int>(&value)) {
    if (auto words = complain_about_number(field, *whole))
      return Complaint{*words, std::nullopt};
  } else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    return complain_about_list(field, *list);
  } else if (const auto* text = std::get_if<std::string>(&value); text && field.kind == FieldKind::choice) {
    if (std::find(field.choices.begin(), field.choices.end(), *text) != field.choices.end())
      return std::nullopt;
    std::string words = "must be " + joined(field.choices) + ", is \"" + text->substr(0, 60) + "\"";
    const Nearest nearest = nearest_name(*text, field.choices);
    if (nearest.close)
      words += "; did you mean \"" + std::string(nearest.name) + "\"?";
    return Complaint{words, std::nullopt};
  }
  return std::nullopt;
}

const FormerChoice* find_former_choice(const Field& field, const FieldValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (!text)
    return nullptr;
  const auto found = std::find_if(field.former_choices.begin(), field.former_choices.end(),
                                  [&](const FormerChoice& former) { return former.name == *text; });
  return found == field.former_choices.end() ? nullptr : &*found;
}

FieldValue present_value(const Field& field, FieldValue value) {
  if (const FormerChoice* former = find_former_choice(field, value))
    return std::string(former->now);
  return value;
}

std::string renamed_sentence(const FormerChoice& former) {
  return "\"" + std::string(former.name) + "\" is called \"" + std::string(former.now) +
         "\" now: " + std::string(former.sentence);
}

std::string unknown_key_sentence(std::string_view path, std::string* nearest) {
  std::vector<std::string_view> siblings, all;
  const std::size_t dot = path.rfind('.');
  const std::string_view table = dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
  const std::string_view key = dot == std::string_view::npos ? path : path.substr(dot + 1);
  for (const Field& field : gear_fields()) {
    all.push_back(field.path);
    if (field.table() == table)
      siblings.push_back(field.key());
  }
  const auto answer = [&](std::string_view found, std::string words) {
    if (nearest)
      *nearest = found;
    return words;
  };
  const Nearest sibling = nearest_name(key, siblings);
  const std::string sibling_path =
      std::string(table) + (table.empty() ? "" : ".") + std::string(sibling.name);
  if (sibling.close)
    return answer(sibling_path, "no such key; did you mean " + std::string(sibling.name) + "?");
  for (const Field& field : gear_fields()) // the right key in the wrong table
    if (field.key() == key) {
      if (field.table().empty())
        return answer(field.path,
                      "no such key here; " + std::string(key) + " stands at the top, above all tables");
      return answer(field.path, "no such key here; " + std::string(key) + " belongs to [" +
                                    std::string(field.table()) + "]");
    }
  std::vector<std::string_view> leaves;
  for (const Field& field : gear_fields())
    leaves.push_back(field.key());
  if (const Nearest leaf = nearest_name(key, leaves); leaf.close && leaf.distance <= 2)
    for (const Field& field : gear_fields())
      if (field.key() == leaf.name && !field.table().empty())
        return answer(field.path, "no such key here; did you mean " + std::string(leaf.name) + " in [" +
                                      std::string(field.table()) + "]?");
  const Nearest anywhere = nearest_name(path, all);
  if (anywhere.close)
    return answer(anywhere.name, "no such key; did you mean " + std::string(anywhere.name) + "?");
  if (siblings.size() > 1)
    return answer(sibling_path, "no such key; the nearest legal key is " + std::string(sibling.name));
  return answer(anywhere.name, "no such key; the nearest legal key is " + std::string(anywhere.name));
}

void set_value(Gear& gear, std::string_view path, FieldValue value) {
  const Field* field = find_field(path);
  if (!field)
    throw FieldError(std::string(path), unknown_key_sentence(path));
  if (const int* whole = std::get_if<int>(&value); whole && field->kind == FieldKind::number)
    value = static_cast<double>(*whole);
  value = present_value(*field, std::move(value));
  if (const auto complaint = find_complaint(*field, value))
    throw FieldError(std::string(path), complaint->sentence);
  field->write(gear, value);
}

NumberPath::NumberPath(std::string_view path) {
  const auto [list_path, item] = split_item(path);
  field_ = find_field(list_path);
  item_ = item;
  if (!field_)
    throw FieldError(std::string(path), unknown_key_sentence(list_path));
  const bool is_list = field_->kind == FieldKind::number_list;
  const bool is_number = field_->kind == FieldKind::number || field_->kind == FieldKind::integer;
  if (is_list && !item_)
    throw FieldError(std::string(path),
                     "is a list; name one of its numbers, counted from 0: " + std::string(path) + "[0]");
  if (!is_list && item_)
    throw FieldError(std::string(path), "is not a list, so it takes no [" + std::to_string(*item_) + "]");
  if (!is_list && !is_number)
    throw FieldError(std::string(path), "is not a number; it is " + expectation(*field_));
}

std::string NumberPath::path() const {
  std::string path(field_->path);
  if (item_)
    path.append("[").append(std::to_string(*item_)).append("]");
  return path;
}

double NumberPath::get(const Gear& gear) const {
  const FieldValue value = field_->read(gear);
  if (const double* number = std::get_if<double>(&value))
    return *number;
  if (const int* whole = std::get_if<int>(&value))
    return *whole;
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    if (*item_ < list->size())
      return (*list)[*item_];
    throw FieldError(path(), "this gear's list holds only " + std::to_string(list->size()) +
                                 " numbers, counted from 0");
  }
  throw FieldError(path(), "this gear has no value for it");
}

void NumberPath::set(Gear& gear, double number) const {
  FieldValue value = number;
  if (field_->kind == FieldKind::integer) {
    if (!(std::abs(number) < 1e9) || number != std::floor(number))
      throw FieldError(path(), "must be a whole number, is " + shortest(number));
    value = static_cast<int>(number);
  } else if (item_) {
    get(gear); // throws where the list is too short
    auto list = std::get<std::vector<double>>(field_->read(gear));
    list[*item_] = number;
    value = std::move(list);
  }
  if (const auto complaint = find_complaint(*field_, value))
    throw FieldError(path(), complaint->sentence);
  field_->write(gear, value);
}

std::string canonical_bits(const Gear& gear, std::span<const std::string_view> parts) {
  Bits bits;
  for (const Field& field : gear_fields()) {
    if (field.path == "name" || (!parts.empty() && !lies_in(field.path, parts)))
      continue;
    const FieldValue value = field.read(gear);
    bits.add(field.path);
    bits.add(static_cast<std::uint64_t>(value.index()));
    std::visit(bits, value);
  }
  return std::move(bits.bytes);
}

Gear part_of(const Gear& gear, std::span<const std::string_view> parts) {
  Gear part;
  for (const Field& field : gear_fields())
    if (lies_in(field.path, parts))
      field.write(part, field.read(gear));
  return part;
}

} // namespace strainwave
