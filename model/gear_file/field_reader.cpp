#include "strainwave/model/gear_file/field_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

namespace strainwave {

namespace {

/// Does a text look like a number that somebody put into quotes?
bool is_number_text(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

bool wants_number(FieldKind kind) {
  return kind == FieldKind::number || kind == FieldKind::integer;
}

std::optional<double> as_number(const toml::node& node) {
  if (const auto* number = node.as_floating_point())
    return number->get();
  if (const auto* whole = node.as_integer())
    return static_cast<double>(whole->get());
  return std::nullopt;
}

FileFault wrong_type(const Field& field, std::string_view key, const toml::node& node) {
  std::string sentence = fmt::format("expected {}, got {}", expectation(field), node_words(node));
  if (const auto* text = node.as_string(); text && wants_number(field.kind) && is_number_text(text->get()))
    sentence += "; remove the quotes";
  if (const auto* number = node.as_floating_point(); number && field.kind == FieldKind::integer)
    sentence += "; write it without a decimal point";
  if (field.kind == FieldKind::number_list && as_number(node))
    sentence += fmt::format("; write [{}]", shortest(*as_number(node)));
  return {place_of(node), std::string(key), sentence, ""};
}

std::optional<FieldValue> read_list(std::string_view key, const toml::array& array,
                                    std::vector<FileFault>& faults) {
  std::vector<double> list;
  bool good = true;
  for (const toml::node& item : array) {
    if (const auto number = as_number(item)) {
      list.push_back(*number);
    } else {
      faults.push_back({place_of(item), std::string(key),
                        fmt::format("expected only numbers in the list, got {}", node_words(item)), ""});
      good = false;
    }
  }
  if (!good)
    return std::nullopt;
  return FieldValue(std::move(list));
}

/// The value by kind alone; ranges come later.
std::optional<FieldValue> read_kind(const Field& field, std::string_view key, const toml::node& node,
                                    std::vector<FileFault>& faults) {
  switch (field.kind) {
  case FieldKind::number:
    if (const auto number = as_number(node))
      return FieldValue(*number);
    break;
  case FieldKind::integer:
    if (const auto* whole = node.as_integer()) {
      const auto number = static_cast<double>(whole->get());
      if (field.range.contains(number))
        return FieldValue(static_cast<int>(whole->get()));
      // Perhaps too large for an int: complain through the double.
      Field as_double = field;
      as_double.kind = FieldKind::number;
      faults.push_back({place_of(node), std::string(key), find_complaint(as_double, number)->sentence, ""});
      return std::nullopt;
    }
    break;
  case FieldKind::text:
  case FieldKind::choice:
    if (const auto* text = node.as_string())
      return FieldValue(text->get());
    break;
  case FieldKind::number_list:
    if (const auto* array = node.as_array())
      return read_list(key, *array, faults);
    break;
  }
  faults.push_back(wrong_type(field, key, node));
  return std::nullopt;
}

/// Empty stays empty; otherwise absolute, and there.
bool find_table_file(FieldValue& value, std::string_view key, const toml::node& node,
                     const std::filesystem::path& folder, std::vector<FileFault>& faults) {
  auto& text = std::get<std::string>(value);
  if (text.empty())
    return true;
  const std::filesystem::path path = std::filesystem::absolute(folder / text).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    faults.push_back(
        {place_of(node), std::string(key), fmt::format("there is no file {}", path.string()), ""});
    return false;
  }
  text = path.string();
  return true;
}

void override_below(Gear& gear, const toml::table& table, const std::string& prefix,
                    const std::filesystem::path& folder, std::vector<FileFault>& faults) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (node.is_table() && find_table(path))
      override_below(gear, *node.as_table(), path + ".", folder, faults);
    else
      apply_override(gear, path, node, place_of(key), folder, faults);
  }
}

} // namespace

std::string node_words(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    std::string shown = text->get().substr(0, 60);
    if (shown.size() < text->get().size()) {
      while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80)
        shown.pop_back();
      if (!shown.empty() && static_cast<unsigned char>(shown.back()) >= 0x80)
        shown.pop_back();
      shown += "…";
    }
    return fmt::format("the text \"{}\"", shown);
  }
  if (const auto number = as_number(node))
    return fmt::format("the number {}", shortest(*number));
  if (const auto* truth = node.as_boolean())
    return truth->get() ? "true" : "false";
  if (node.is_array())
    return "a list";
  if (node.is_table())
    return "a table";
  return "a date or time";
}

std::optional<FieldValue> plain_value(const toml::node& node) {
  if (const auto* text = node.as_string())
    return FieldValue(text->get());
  if (const auto* whole = node.as_integer(); whole && std::abs(whole->get()) <= 2147483647)
    return FieldValue(static_cast<int>(whole->get()));
  if (const auto number = as_number(node))
    return FieldValue(*number);
  std::vector<FileFault> faults;
  return node.is_array() ? read_list("", *node.as_array(), faults) : std::nullopt;
}

std::optional<FieldValue> read_value(const Field& field, std::string_view key, const toml::node& node,
                                     std::vector<FileFault>& faults) {
  std::optional<FieldValue> value = read_kind(field, key, node, faults);
  if (!value)
    return std::nullopt;
  value = present_value(field, std::move(*value));
  const auto complaint = find_complaint(field, *value);
  if (!complaint)
    return value;
  const bool item = complaint->item && node.is_array();
  const toml::node& place = item ? *node.as_array()->get(*complaint->item) : node;
  faults.push_back({place_of(place), std::string(key), complaint->sentence, ""});
  return std::nullopt;
}

void apply_override(Gear& gear, std::string_view path, const toml::node& node, Place key_place,
                    const std::filesystem::path& folder, std::vector<FileFault>& faults) {
  if (const Field* field = find_field(path)) {
    auto value = read_value(*field, path, node, faults);
    if (value && path == "wave_generator.table_file" && !find_table_file(*value, path, node, folder, faults))
      return;
    if (value)
      field->write(gear, *value);
    return;
  }
  if (find_table(path)) {
    faults.push_back(
        {key_place, std::string(path),
         fmt::format("is a table of the gear file, expected keys in it, got {}", node_words(node)), ""});
    return;
  }
  if (path.ends_with(']')) { // one item of a list
    try {
      const NumberPath item(path);
      if (const auto number = as_number(node))
        item.set(gear, *number);
      else
        faults.push_back(
            {place_of(node), std::string(path), "expected a number, got " + node_words(node), ""});
    } catch (const FieldError& error) {
      faults.push_back({place_of(node), std::string(path), error.sentence, ""});
    }
    return;
  }
  std::string nearest;
  const std::string sentence = unknown_key_sentence(path, &nearest);
  faults.push_back({key_place, std::string(path), sentence, nearest});
}

void apply_overrides(Gear& gear, const toml::table& table, const std::filesystem::path& folder,
                     std::vector<FileFault>& faults) {
  override_below(gear, table, "", folder, faults);
}

} // namespace strainwave
