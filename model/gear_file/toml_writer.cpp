#include "strainwave/model/gear_file/toml_writer.hpp"

#include <fmt/format.h>

namespace strainwave {

namespace {

constexpr std::size_t comment_column = 44;

std::string toml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\')
      quoted += fmt::format("\\{}", letter);
    else if (byte < 0x20 || byte == 0x7f)
      quoted += fmt::format("\\u{:04X}", byte);
    else
      quoted += letter;
  }
  return quoted + "\"";
}

/// A TOML float: shortest digits that read back to the same bits, and never an integer.
std::string toml_number(double value) {
  std::string digits = shortest(value);
  if (digits.find_first_of(".e") == std::string::npos)
    digits += ".0";
  return digits;
}

} // namespace

std::string toml_value(const FieldValue& value) {
  if (const double* number = std::get_if<double>(&value))
    return toml_number(*number);
  if (const int* whole = std::get_if<int>(&value))
    return std::to_string(*whole);
  if (const auto* text = std::get_if<std::string>(&value))
    return toml_text(*text);
  std::string list = "[";
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
    for (const double number : *numbers)
      list.append(list.size() > 1 ? ", " : "").append(toml_number(number));
  return list + "]";
}

std::string toml_line(const std::string& statement, std::string_view remark) {
  const std::size_t gap = statement.size() < comment_column ? comment_column - statement.size() : 1;
  return statement + std::string(gap, ' ') + "# " + std::string(remark) + "\n";
}

} // namespace strainwave
