// write_gear(): the complete file, one commented line per key.

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/gear_file/gear_file.hpp"
#include "strainwave/model/gear_file/toml_writer.hpp"

#include <fmt/format.h>

namespace strainwave {

namespace {

std::string comment(const Field& field) {
  std::string text;
  if (!field.unit.empty())
    text.append(field.unit).append("; ");
  for (const std::string_view choice : field.choices)
    text.append(choice).append(choice == field.choices.back() ? "; " : ", ");
  return text.append(field.sentence);
}

} // namespace

std::string write_gear(const Gear& gear) {
  std::string text;
  std::string_view open_table;
  for (const Field& field : gear_fields()) {
    if (field.table() != open_table) {
      open_table = field.table();
      text.append("\n").append(toml_line(fmt::format("[{}]", open_table), find_table(open_table)->sentence));
    }
    const FieldValue value = field.read(gear);
    const bool absent = std::holds_alternative<std::monostate>(value);
    text += toml_line(absent ? fmt::format("# {} =", field.key())
                             : fmt::format("{} = {}", field.key(), toml_value(value)),
                      comment(field));
  }
  return text;
}

} // namespace strainwave
