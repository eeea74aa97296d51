#include "model/kinematics/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace strainwave {
namespace {

[[noreturn]] void fail(const std::string& file, int line, const std::string& what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file, line, what));
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
  std::ifstream stream(file);
  if (!stream)
    throw std::runtime_error(fmt::format("{}:1: cannot open the table of the wave generator's shape", file));
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
      fail(file, line, fmt::format("expected two columns, found a third: '{}'", rest));
    if (!parse_number(first, phi))
      fail(file, line, fmt::format("'{}' is not a finite number", first));
    if (!parse_number(second, value))
      fail(file, line, fmt::format("'{}' is not a finite number", second));
    if (angle_deg.empty() && phi != 0.0)
      fail(file, line, fmt::format("the first angle must be 0, not {}", phi));
    if (!angle_deg.empty() && phi <= angle_deg.back())
      fail(file, line, fmt::format("angles must ascend: {} after {}", phi, angle_deg.back()));
    if (phi > 90.0)
      fail(file, line,
           fmt::format("the last angle must be 90, not {}: the shape is even and repeats after 180 degrees",
                       phi));
    angle_deg.push_back(phi);
    u.push_back(value);
  }
  if (stream.bad())
    fail(file, line, "reading failed");
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
