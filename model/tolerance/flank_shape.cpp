#include "strainwave/model/tolerance/flank_shape.hpp"

#include "strainwave/model/gear/fields.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace strainwave {

namespace {

/// Knots of the spline that carries a form error: a period of a cosine through 33 of them is met to 3e-6 of
/// its height.
constexpr int form_pieces = 32;
constexpr double step_um = 0.01;

/// Material that an error of one unit removes at flank coordinate h.
double removed(ToleranceKind kind, double h) {
  switch (kind) {
  case ToleranceKind::profile_slope:
    return 0.5 - h;
  case ToleranceKind::profile_form:
    return -0.5 * std::cos(2.0 * std::numbers::pi * h);
  default:
    return 1.0;
  }
}

/// The spline of a modification with the error added: its own knots and enough for the error. A natural
/// spline through values of another on finer knots that contain its own is that spline.
std::vector<double> spline_with(const FlankModification& own, Member member, ToleranceKind kind,
                                double error_um, double offset_um) {
  FlankModification alone;
  alone.spline_um = own.spline_um;
  const int pieces = std::max<int>(1, static_cast<int>(own.spline_um.size()) - 1);
  const int times = kind == ToleranceKind::profile_form ? (form_pieces + pieces - 1) / pieces : 1;
  std::vector<double> values;
  for (int k = 0; k <= pieces * times; ++k) {
    const double h = static_cast<double>(k) / (pieces * times);
    const double before = own.spline_um.empty() ? 0.0 : 1e3 * removal_mm(alone, member, h, 0.0, 1.0);
    values.push_back(before + offset_um + error_um * removed(kind, h));
  }
  return values;
}

} // namespace

Gear with_profile_error(const Gear& gear, const ToleranceSource& source, double error_mm, double offset_mm) {
  Gear changed = gear;
  FlankModification& flank = source.member == Member::flexspline ? changed.flank_modification.flexspline
                                                                 : changed.flank_modification.circular_spline;
  flank.spline_um = spline_with(flank, source.member, source.kind, 1e3 * error_mm, 1e3 * offset_mm);
  return changed;
}

Outcome<ShapePair> shape_pair(const Gear& gear, const ToleranceSource& source) {
  Gear up = gear, down = gear;
  double step = 1e-3 * step_um;
  if (source.kind == ToleranceKind::gear_key) {
    if (!source.path.starts_with("circular_spline.") && !source.path.starts_with("flank_modification.")) {
      return Failure{
          Status::not_available,
          fmt::format("{} moves more than flanks; it cannot be a source of tolerance samples", source.path)};
    }
    const NumberPath number(source.path);
    const double value = number.get(gear);
    if (value == 0.0 && (source.path.ends_with(".slope_um") || source.path.ends_with(".lead_taper_um"))) {
      return Failure{
          Status::not_available,
          fmt::format(
              "{} is 0: it removes at one end above 0 and at the other below, so small values have no "
              "common effect; kind \"profile_slope\" is the error of a slope",
              source.path)};
    }
    step = number.field().unit == "µm" ? step_um : 1e-6 * std::max(1.0, std::abs(value));
    const Range& range = number.field().range;
    const double most = range.contains(value + step) ? value + step : value;
    const double least = range.contains(value - step) ? value - step : value;
    number.set(up, most);
    number.set(down, least);
    step = 0.5 * (most - least); // at an end of the range: one-sided
  } else {
    up = with_profile_error(gear, source, step, step);
    down = with_profile_error(gear, source, -step, step);
  }
  auto above = FlankPair::make(up);
  if (!above)
    return above.failure();
  auto below = FlankPair::make(down);
  if (!below)
    return below.failure();
  return ShapePair{*above, *below, step};
}

} // namespace strainwave
