#include "strainwave/model/gear_file/syntax_sentence.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <optional>
#include <regex>
#include <vector>

namespace strainwave {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
    text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.remove_suffix(1);
  return text;
}

/// The line up to its comment. Good enough for messages: a quote inside quotes is not looked for.
std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"')
      quoted = !quoted;
    if (line[i] == '#' && !quoted)
      return line.substr(0, i);
  }
  // With a quote left open, a comment is the likelier reading of #.
  return quoted ? line.substr(0, line.find('#')) : line;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines.push_back(trimmed(without_comment(text.substr(0, end))));
    if (end == std::string_view::npos)
      return lines;
    text.remove_prefix(end + 1);
  }
}

std::string_view key_in(std::string_view line) {
  const std::string_view key = trimmed(line.substr(0, line.find_first_of("=:")));
  for (const char letter : key)
    if (!std::isalnum(static_cast<unsigned char>(letter)) && letter != '_' && letter != '.')
      return {};
  return key;
}

/// "x" for the headings [x] and [[x]].
std::string_view table_in(std::string_view line) {
  if (line.starts_with("[[") && line.ends_with("]]"))
    return trimmed(line.substr(2, line.size() - 4));
  return line.starts_with("[") && line.ends_with("]") ? trimmed(line.substr(1, line.size() - 2))
                                                      : std::string_view();
}

/// A file's lines, trimmed and without comments, and the line of the error (counted from 0).
struct Context {
  std::vector<std::string_view> lines;
  std::size_t here = 0;

  std::string_view line() const { return lines[here]; }

  /// The heading above the error, counted from 0; `lines.size()` if there is none.
  std::size_t heading() const {
    for (std::size_t i = here; i-- > 0;)
      if (!table_in(lines[i]).empty())
        return i;
    return lines.size();
  }

  /// "flexspline.module_mm" for the key of a line.
  std::string full_key(std::string_view key) const {
    const std::size_t above = heading();
    if (above == lines.size() || key.empty())
      return std::string(key);
    return fmt::format("{}.{}", table_in(lines[above]), key);
  }
};

/// " (first in line 13)"; empty if no earlier line fits.
template <class Fits>
std::string first_line(const Context& context, std::size_t from, Fits fits) {
  for (std::size_t i = from; i < context.here; ++i)
    if (fits(context.lines[i]))
      return fmt::format(" (first in line {})", i + 1);
  return "";
}

std::optional<FileFault> duplicate_fault(const Context& context, Place place, std::string_view description) {
  if (description.find("cannot redefine") == std::string_view::npos)
    return std::nullopt;
  const std::size_t open = description.find('\'');
  const std::size_t close = description.find('\'', open + 1);
  if (open == std::string_view::npos || close == std::string_view::npos)
    return std::nullopt;
  const std::string name(description.substr(open + 1, close - open - 1));
  if (const std::string_view table = table_in(context.line()); !table.empty()) {
    if (description.find("existing table") == std::string_view::npos)
      return FileFault{place, name,
                       fmt::format("[{}] opens a table, but a key of this name stands above", name), ""};
    const std::string first =
        first_line(context, 0, [&](std::string_view line) { return table_in(line) == table; });
    return FileFault{place, name,
                     fmt::format("the table [{}] is opened twice{}; put its keys together", name, first), ""};
  }
  const std::size_t above = context.heading();
  const std::string first = first_line(context, above == context.lines.size() ? 0 : above + 1,
                                       [&](std::string_view line) { return key_in(line) == name; });
  place.column = 1;
  return FileFault{place, context.full_key(name),
                   fmt::format("the key is given twice{}; keep one of the two", first), ""};
}

/// A pattern for the line and what to say; $1 is the pattern's first group.
struct Slip {
  const char* pattern;
  const char* sentence;
};

constexpr std::array<Slip, 19> slips{{
    {"^(//|%|;|/\\*|!|--)", "a comment begins with #"},
    {"[\"'0-9\\]]\\s*(//|%|;|/\\*)", "a comment begins with #"},
    {"^\\{", "this is not TOML (JSON, perhaps); `strainwave example` prints a gear file"},
    {"^[A-Za-z_][\\w.]*\\s*:", "a key and its value are joined by =, as in  module_mm = 0.2"},
    {"^\\[[^\\]]*$", "a table's heading ends with ]"},
    {"^[^\\[=]*\\]$", "a table's heading begins with ["},
    {"^[A-Za-z_][\\w.]*$", "the key has no value; write it as in  module_mm = 0.2"},
    {"=$", "the value is missing after ="},
    {"=\\s*([-+]?\\d+),(\\d+)$", "a decimal number is written with a point: $1.$2"},
    {"=\\s*([-+]?[\\d.]+(?:[eE][-+]?\\d+)?)\\s*(mm|um|µm|MPa|GPa|deg|°|rad|Nm|N·m)",
     "a number stands without its unit, which is in the key's name: $1"},
    {"=\\s*([-+]?)(\\.\\d+)", "a number begins with a digit: $010$2"},
    {"=\\s*([-+]?\\d+\\.)(?!\\d)", "a number has a digit after the point: $010"},
    {"=\\s*[-+]?0+(\\d[\\d.]*)$", "a number has no zeros in front: $1"},
    {"=\\s*[-+]?\\d{19,}$", "the number is too large"},
    {"=\\s*[-+]?\\d", "the value cannot be read as a number; numbers are written like 0.2, -3 or 1e-3"},
    {"=\\s*(“|”|„|‘|’|«)", "a text stands in plain quotes: \"…\""},
    {"=\\s*([A-Za-z_][^\\s\"]*)$", "a text stands in quotes: \"$1\""},
    {"=\\s*\"[^\"]*$", "the text is not closed; it ends with \""},
    {"=\\s*\\[", "the numbers of a list are separated by commas, and the list ends with ]"},
}};

/// In a sentence $1 and $01 are the first group; $01 stays one even before another digit.
std::optional<std::string> usual_slip(std::string_view whole_line) {
  const std::string line(whole_line.substr(0, 300));
  for (const Slip& slip : slips) {
    std::smatch found;
    if (std::regex_search(line, found, std::regex(slip.pattern)))
      return found.format(slip.sentence);
  }
  return std::nullopt;
}

} // namespace

FileFault syntax_fault(std::string_view text, Place place, std::string_view description) {
  if (description.find("utf-8") != std::string_view::npos)
    return {place, "", "not a text file in UTF-8; save it in that encoding", ""};
  Context context{split_lines(text), 0};
  context.here = std::min<std::size_t>(place.line > 0 ? place.line - 1 : 0, context.lines.size() - 1);
  if (auto duplicate = duplicate_fault(context, place, description))
    return *duplicate;
  // A list that is not closed is noticed only lines later: go back to where it began.
  if (description.find("parsing array") != std::string_view::npos) {
    std::size_t start = context.here;
    if (place.column == 1 && start > 0)
      --start;
    while (start > 0 && context.lines[start].find("= [") == std::string_view::npos)
      --start;
    if (start != context.here && context.lines[start].find("= [") != std::string_view::npos) {
      context.here = start;
      place = {static_cast<int>(start) + 1, 1};
    }
  }
  if (auto slip = usual_slip(context.line()))
    return {place, context.full_key(key_in(context.line())), *slip, ""};
  constexpr std::string_view opening = "Error while parsing ";
  if (description.starts_with(opening))
    description.remove_prefix(opening.size());
  return {place, "", fmt::format("not TOML, in this {}", description), ""};
}

} // namespace strainwave
