#include "model/gear_file/syntax_sentence.hpp"

#include <fmt/format.h>

#include <cctype>
#include <optional>
#include <regex>

namespace strainwave {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
    text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.remove_suffix(1);
  return text;
}

std::string_view line_of(std::string_view text, int line) {
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos)
      return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// The heading that a line belongs to, and its line number; ("", 0) at the top of the file.
std::pair<std::string, int> heading_above(std::string_view text, int line) {
  for (int i = line - 1; i >= 1; --i) {
    const std::string_view candidate = trimmed(line_of(text, i));
    const std::size_t end = candidate.find(']');
    if (candidate.starts_with("[") && !candidate.starts_with("[[") && end != std::string_view::npos)
      return {std::string(trimmed(candidate.substr(1, end - 1))), i};
  }
  return {"", 0};
}

/// The line that first gives `key`, searched after line `from`, or opens the table [key]; 0 if none is found.
int first_line_with(std::string_view text, std::string_view key, bool heading, int from, int before) {
  for (int i = from + 1; i < before; ++i) {
    std::string_view line = trimmed(line_of(text, i));
    if (heading) {
      if (!line.starts_with("["))
        continue;
      line = line.substr(1, line.find(']') - 1);
      if (trimmed(line) == key)
        return i;
    } else if (trimmed(line.substr(0, line.find('='))) == key) {
      return i;
    }
  }
  return 0;
}

std::optional<FileFault> duplicate_fault(std::string_view text, Place place, std::string_view description) {
  if (description.find("cannot redefine") == std::string_view::npos)
    return std::nullopt;
  const std::size_t open = description.find('\'');
  const std::size_t close = description.rfind('\'');
  if (open == std::string_view::npos || close <= open + 1)
    return std::nullopt;
  const std::string name(description.substr(open + 1, close - open - 1));
  const bool heading = trimmed(line_of(text, place.line)).starts_with("[");
  const auto [table, table_line] = heading_above(text, place.line);
  const int first = first_line_with(text, name, heading, heading ? 0 : table_line, place.line);
  const std::string where = first > 0 ? fmt::format(" (first in line {})", first) : "";
  if (heading)
    return FileFault{place, name,
                     fmt::format("the table [{}] is opened twice{}; put its keys together", name, where), ""};
  const Place start{place.line, static_cast<int>(line_of(text, place.line).find_first_not_of(" \t")) + 1};
  return FileFault{start, table.empty() ? name : table + "." + name,
                   fmt::format("the key is given twice{}; keep one of the two", where), ""};
}

std::optional<std::string> usual_slip(std::string_view whole_line, std::string_view description) {
  const std::string line(trimmed(whole_line.substr(0, 300)));
  std::smatch found;
  const auto is = [&](const char* pattern) { return std::regex_search(line, found, std::regex(pattern)); };
  if (is("^(//|%|;|/\\*|!|--)"))
    return "a comment begins with #";
  if (is("[\"'0-9\\]] *(//|%|;|/\\*)"))
    return "a comment begins with #";
  if (is("^[A-Za-z_]\\w* *:"))
    return "a key and its value are joined by =, as in  module_mm = 0.2";
  if (is("= *[-+]?\\d+,\\d+ *(#.*)?$"))
    return "a decimal number is written with a point: " +
           std::regex_replace(found.str().substr(1), std::regex("^ *|(,)|( *#.*)$"), "") + " has a comma";
  if (is("= *([-+]?[\\d.]+(?:e[-+]?\\d+)?) *(mm|um|µm|MPa|GPa|deg|°|rad|Nm|N·m|%)\\b"))
    return "a number stands without its unit, which is in the key's name: write " + found[1].str();
  if (is("= *(\\.\\d+)"))
    return "a number begins with a digit: write 0" + found[1].str();
  if (is("= *(\\d+\\.)(?!\\d)"))
    return "a number needs a digit after the point: write " + found[1].str() + "0";
  if (is("= *0(\\d[\\d.]*)") && description.find("zero") != std::string_view::npos)
    return "a number has no zeros in front: write " + found[1].str();
  if (is("= *(“|”|„|‘|’|«)"))
    return "a text stands in plain quotes: \"…\"";
  if (is("= *([A-Za-z_][\\w./-]*)"))
    return "a text stands in quotes: write \"" + found[1].str() + "\"";
  if (is("= *(#.*)?$"))
    return "the value is missing after =";
  if (is("^\\[[^\\]]*$"))
    return "a table's heading ends with ]";
  if (is("= *\\[[^\\]]*$"))
    return "the list is not closed; it ends with ]";
  if (is("= *\"[^\"]*$"))
    return "the text is not closed; it ends with \"";
  if (is("^[A-Za-z_][\\w.]*$"))
    return "a key needs a value, as in  module_mm = 0.2";
  return std::nullopt;
}

} // namespace

FileFault syntax_fault(std::string_view text, Place place, std::string_view description) {
  if (auto duplicate = duplicate_fault(text, place, description))
    return *duplicate;
  if (description.find("utf-8") != std::string_view::npos)
    return {place, "", "not a text file in UTF-8; save it in that encoding", ""};
  // toml++ places some errors on the line break, that is behind the line that is meant.
  if (auto slip = usual_slip(line_of(text, place.line), description))
    return {place, "", *slip, ""};
  constexpr std::string_view opening = "Error while parsing ";
  if (description.starts_with(opening))
    description.remove_prefix(opening.size());
  return {place, "", fmt::format("not TOML, in this {}", description), ""};
}

} // namespace strainwave
