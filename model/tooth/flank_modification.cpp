#include "strainwave/model/tooth/flank_modification.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/tooth/gear_numbers.hpp"

#include <boost/math/tools/minima.hpp>
#include <fmt/format.h>

namespace strainwave {
namespace {

using units::mm_per_um;

const char* table_name(Member member) {
  return member == Member::flexspline ? "flank_modification.flexspline"
                                      : "flank_modification.circular_spline";
}

RemovalLaw<double> law_of(const FlankModification& m, Member member, double zeta, double face_width_mm) {
  return removal_law(modification_numbers<double>(m), member, zeta, face_width_mm);
}

struct Least {
  double at, value;
};

/// Least value of a function that is smooth between the given ascending points.
template <class Function>
Least least(const Function& f, const std::vector<double>& points) {
  Least best{points.front(), f(points.front())};
  const auto keep = [&](double x, double value) {
    if (value < best.value)
      best = {x, value};
  };
  constexpr int samples = 16;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double width = (points[i] - points[i - 1]) / samples;
    if (!(width > 0.0))
      continue;
    for (int k = 0; k <= samples; ++k)
      keep(points[i - 1] + k * width, f(points[i - 1] + k * width));
    const double lo = std::max(points[i - 1], best.at - width), hi = std::min(points[i], best.at + width);
    if (lo < hi) {
      const auto [x, value] = boost::math::tools::brent_find_minima(f, lo, hi, 40);
      keep(x, value);
    }
  }
  return best;
}

} // namespace

double removal_mm(const FlankModification& modification, Member member, double h, double zeta,
                  double face_width_mm) {
  return law_of(modification, member, zeta, face_width_mm).at(h).depth;
}

std::optional<Failure> find_added_material(const FlankModification& m, Member member, double face_width_mm) {
  const auto contradiction = [&](const std::string& sentence) {
    return Failure{Status::contradiction, fmt::format("{}: {}", table_name(member), sentence)};
  };
  if (m.tip_relief_um != 0.0 && !(m.tip_relief_power >= 1.0))
    return contradiction(
        fmt::format("tip_relief_power {} must be at least 1: below, the relief starts with a vertical "
                    "step",
                    m.tip_relief_power));
  if (m.tip_relief_um != 0.0 && !(m.tip_relief_start >= 0.0 && m.tip_relief_start < 1.0))
    return contradiction(fmt::format("tip_relief_start {} must lie in 0 <= start < 1", m.tip_relief_start));
  if (m.root_relief_um != 0.0 && !(m.root_relief_start > 0.0 && m.root_relief_start <= 1.0))
    return contradiction(fmt::format("root_relief_start {} must lie in 0 < start <= 1", m.root_relief_start));
  if (m.end_relief_um != 0.0 && !(m.end_relief_length_mm > 0.0))
    return contradiction(fmt::format("end_relief_um {} needs end_relief_length_mm > 0", m.end_relief_um));

  const RemovalLaw<double> law = law_of(m, member, 0.0, face_width_mm);
  std::vector<double> heights{0.0, 1.0};
  for (const Break<double>& b : law.breaks())
    heights.push_back(b.height);
  std::sort(heights.begin(), heights.end());
  const Least profile = least([&](double h) { return law.at(h).depth - law.lead; }, heights);
  std::vector<double> sections{-1.0, 0.0, 1.0};
  if (m.end_relief_length_mm > 0.0 && face_width_mm > 0.0) {
    const double start = std::clamp(1.0 - 2.0 * m.end_relief_length_mm / face_width_mm, -1.0, 1.0);
    sections.insert(sections.end(), {-start, start});
    std::sort(sections.begin(), sections.end());
  }
  const Least lead =
      least([&](double zeta) { return law_of(m, member, zeta, face_width_mm).lead; }, sections);
  const double total_um = (profile.value + lead.value) / mm_per_um;
  if (total_um < -1e-9)
    return contradiction(
        fmt::format("the removal is {:.4f} um at flank coordinate {:.3f} and face coordinate {:.3f}; a "
                    "modification only takes material away",
                    total_um, profile.at, lead.at));
  return std::nullopt;
}

} // namespace strainwave
