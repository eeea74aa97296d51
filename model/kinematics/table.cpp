#include "strainwave/model/kinematics/table.hpp"

#include "strainwave/model/gear/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace strainwave {
namespace {

constexpr std::size_t most_rows = 100000; ///< one per 0.001 degrees, ten times as many as make sense

[[noreturn]] void fail(const std::string& what) {
  throw FieldError("wave_generator.table_file", what);
}
[[noreturn]] void fail(const std::string& file, int line, const std::string& what) {
  fail(fmt::format("{}:{}: {}", file, line, what));
}

/// A word of the file for a message: short, and without what a terminal would obey.
std::string shown(const std::string& word) {
  std::string safe;
  for (const char c : word.substr(0, 30))
    safe += c >= ' ' && c <= '~' ? c : '?';
  return word.size() > 30 ? safe + "..." : safe;
}

std::ifstream open_table(const std::string& file) {
  std::error_code ignored;
  const std::filesystem::file_type type = std::filesystem::status(file, ignored).type();
  if (type == std::filesystem::file_type::not_found)
    fail(
        fmt::format("{}: there is no such file; expected a table of the wave generator's shape, two columns: "
                    "angle in degrees, radial deformation in mm",
                    file));
  if (type == std::filesystem::file_type::directory)
    fail(fmt::format("{}: is a folder, not a table of the wave generator's shape", file));
  errno = 0;
  std::ifstream stream(file);
  if (!stream)
    throw std::system_error(errno ? errno : EIO, std::generic_category(), "cannot read " + file);
  return stream;
}

bool parse_number(const std::string& word, double& number) {
  try {
    std::size_t used = 0;
    number = std::stod(word, &used);
    return used == word.size() && std::isfinite(number);
  } catch (const std::logic_error&) {
    return false;
  }
}

} // namespace

ShapeTable ShapeTable::read(const std::string& file) {
  std::ifstream stream = open_table(file);
  std::vector<double> angle_deg, u;
  std::string text;
  int line = 0;
  while (std::getline(stream, text)) {
    ++line;
    text.resize(std::min(text.size(), text.find('#')));
    std::istringstream words(text);
    std::string first, second, rest;
    if (!(words >> first))
      continue;
    double phi = 0.0, value = 0.0;
    if (!(words >> second))
      fail(file, line, "expected two columns (angle in degrees, displacement in mm), found one");
    if (words >> rest)
      fail(file, line, fmt::format("expected two columns, found a third: '{}'", shown(rest)));
    if (!parse_number(first, phi))
      fail(file, line, fmt::format("'{}' is not a finite number", shown(first)));
    if (!parse_number(second, value))
      fail(file, line, fmt::format("'{}' is not a finite number", shown(second)));
    if (angle_deg.empty() && phi != 0.0)
      fail(file, line, fmt::format("the first angle must be 0, not {}", phi));
    if (!angle_deg.empty() && phi <= angle_deg.back())
      fail(file, line, fmt::format("angles must ascend: {} after {}", phi, angle_deg.back()));
    if (phi > 90.0)
      fail(file, line,
           fmt::format("the last angle must be 90, not {}: the shape is even and repeats after 180 degrees",
                       phi));
    if (angle_deg.size() == most_rows)
      fail(file, line, fmt::format("more than {} rows", most_rows));
    angle_deg.push_back(phi);
    u.push_back(value);
  }
  if (stream.bad())
    throw std::system_error(errno ? errno : EIO, std::generic_category(), "cannot read " + file);
  if (angle_deg.empty())
    fail(file, std::max(line, 1), "the table has no rows");
  if (angle_deg.back() != 90.0)
    fail(file, line, fmt::format("the last angle must be 90, not {}", angle_deg.back()));
  for (double& phi : angle_deg)
    phi *= std::numbers::pi / 180.0;
  angle_deg.back() = 0.5 * std::numbers::pi;
  return {std::move(angle_deg), std::move(u)};
}

ShapeTable::ShapeTable(std::vector<double> angle_rad, std::vector<double> u_mm)
    : angle_(std::move(angle_rad)), u_(std::move(u_mm)), second_(u_.size(), 0.0) {
  if (angle_.size() < 2 || angle_.size() != u_.size())
    throw std::invalid_argument("a shape table needs at least two rows of angle and displacement");
  // Spline with zero end slopes (evenness about both axes): tridiagonal system for u'' at the rows, solved by
  // elimination.
  const std::size_t n = u_.size();
  std::vector<double> above(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = i > 0 ? angle_[i] - angle_[i - 1] : 0.0;
    const double right = i + 1 < n ? angle_[i + 1] - angle_[i] : 0.0;
    const double slope_left = i > 0 ? (u_[i] - u_[i - 1]) / left : 0.0;
    const double slope_right = i + 1 < n ? (u_[i + 1] - u_[i]) / right : 0.0;
    const double pivot = 2.0 * (left + right) - (i > 0 ? left * above[i - 1] : 0.0);
    above[i] = right / pivot;
    second_[i] = (6.0 * (slope_right - slope_left) - (i > 0 ? left * second_[i - 1] : 0.0)) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 0;)
    second_[i] -= above[i] * second_[i + 1];
}

Displacement<double> ShapeTable::operator()(double phi) const {
  const auto above = std::upper_bound(angle_.begin() + 1, angle_.end() - 1, phi);
  const auto i = static_cast<std::size_t>(above - angle_.begin());
  const double width = angle_[i] - angle_[i - 1];
  const double b = (phi - angle_[i - 1]) / width, a = 1.0 - b;
  const double low = second_[i - 1] * width * width / 6.0, high = second_[i] * width * width / 6.0;
  return {a * u_[i - 1] + b * u_[i] + (a * a * a - a) * low + (b * b * b - b) * high,
          (u_[i] - u_[i - 1] - (3.0 * a * a - 1.0) * low + (3.0 * b * b - 1.0) * high) / width,
          a * second_[i - 1] + b * second_[i]};
}

} // namespace strainwave
