#include "strainwave/optimize/problem/gradient_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace strainwave {

namespace {

constexpr int coarsest = 7, finest = 19;
constexpr int steps = finest - coarsest + 1;

/// f at −h, h (and at 2h, where only that side is open) for every step, largest first.
struct Line {
  bool central = false;
  double side = 1.0; ///< of a one-sided line
  std::array<double, steps> h{}, low{}, high{}, far{};
  double middle = 0.0;
  double terms = 0.0; ///< size of what the value is made of, whose rounding it has

  double difference(std::size_t k) const {
    return central ? (high[k] - low[k]) / (2.0 * h[k])
                   : side * (4.0 * high[k] - 3.0 * middle - far[k]) / (2.0 * h[k]);
  }
};

/// Both ends of the range of relative error that one difference may have by rounding.
double rounding(const Line& line, std::size_t k, double noise, double size) {
  return 4.0 * noise * std::max(line.terms, 1e-300) / (line.h[k] * size);
}

void judge(const Line& line, double range, double noise, SlopeCheck& check) {
  const double size = std::max({std::abs(check.exact), 1e-6 * std::abs(check.value) / range, 1e-300});
  std::array<double, steps> error{};
  check.least_error = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  bool within_rounding = false;
  for (std::size_t k = 0; k < steps; ++k) {
    error[k] = std::abs(line.difference(k) - check.exact) / size;
    within_rounding = within_rounding || error[k] <= std::min(1e-2, 3.0 * rounding(line, k, noise, size));
    if (error[k] < check.least_error) {
      check.least_error = error[k];
      best = k;
    }
  }
  check.difference = line.difference(best);
  bool order_two = false;
  std::size_t first = std::min<std::size_t>(best > 1 ? best - 2 : 0, steps - 3);
  for (std::size_t k = 0; k + 2 < steps; ++k) {
    const double once = error[k] / error[k + 1], again = error[k + 1] / error[k + 2];
    if (once > 3.2 && once < 4.8 && again > 3.2 && again < 4.8) {
      order_two = true;
      first = k;
      break;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    check.error[k] = error[first + k];
    check.step[k] = line.h[first + k];
  }
  const bool right = check.least_error < 1e-5 || within_rounding || (order_two && check.least_error < 1e-3);
  if (!std::isfinite(check.least_error)) {
    check.verdict = SlopeVerdict::unknown;
    return;
  }
  // One-sided slopes at the smallest steps at which rounding does not matter.
  std::size_t fine = steps - 1;
  while (fine > 1 && rounding(line, fine, noise, size) > 1e-5)
    --fine;
  check.left = check.right = line.difference(best);
  if (line.central) {
    check.left = (line.middle - line.low[fine]) / line.h[fine];
    check.right = (line.high[fine] - line.middle) / line.h[fine];
  }
  if (right) {
    check.verdict = SlopeVerdict::right;
    check.left = check.right = check.difference;
    return;
  }
  const double jump = std::abs(check.right - check.left),
               wider = std::abs((line.high[fine - 1] - 2.0 * line.middle + line.low[fine - 1]) /
                                line.h[fine - 1]);
  const double slack = 1e-3 * jump;
  const bool between = check.exact >= std::min(check.left, check.right) - slack &&
                       check.exact <= std::max(check.left, check.right) + slack;
  // A jump of the slope stays as the step shrinks; of a smooth function it halves.
  const bool kink = line.central && jump > 1e-4 * size && jump > 0.75 * wider && between;
  check.verdict = kink ? SlopeVerdict::kink : SlopeVerdict::wrong;
}

/// Evaluations along one variable.
struct Neighbours {
  bool ok = false, central = false;
  double side = 1.0;
  std::array<double, steps> h{};
  std::array<Evaluation, steps> low, high, far;
};

Neighbours neighbours_of(Evaluator& evaluator, const DesignVariable& variable, std::span<const double> x,
                         std::size_t i, std::size_t pieces) {
  Neighbours all;
  const auto at = [&](double x_i) {
    std::vector<double> near(x.begin(), x.end());
    near[i] = x_i;
    return evaluator.evaluate(near);
  };
  const double widest = std::ldexp(variable.upper - variable.lower, -coarsest);
  all.central = x[i] - widest >= variable.lower && x[i] + widest <= variable.upper;
  all.side = x[i] + 2.0 * widest <= variable.upper ? 1.0 : -1.0;
  all.ok = true;
  for (std::size_t k = 0; k < steps && all.ok; ++k) {
    all.h[k] = std::ldexp(widest, -static_cast<int>(k));
    all.high[k] = at(x[i] + (all.central ? 1.0 : all.side) * all.h[k]);
    (all.central ? all.low[k] : all.far[k]) = at(x[i] + (all.central ? -1.0 : 2.0 * all.side) * all.h[k]);
    for (const Evaluation* e : {&all.high[k], all.central ? &all.low[k] : &all.far[k]})
      all.ok = all.ok && e->ok && e->pieces.size() == pieces;
  }
  return all;
}

Line line_of(const Neighbours& near, const std::vector<double> Evaluation::*list, std::size_t r,
             double middle) {
  Line line{.central = near.central,
            .side = near.side,
            .h = near.h,
            .low = {},
            .high = {},
            .far = {},
            .middle = middle,
            .terms = std::abs(middle)};
  for (std::size_t k = 0; k < steps; ++k) {
    line.high[k] = (near.high[k].*list)[r];
    (near.central ? line.low[k] : line.far[k]) = ((near.central ? near.low[k] : near.far[k]).*list)[r];
  }
  return line;
}

/// The transmission error is a small difference of rotations and has their rounding; others have that of
/// their own size.
double terms_of(std::string_view response, double value, std::span<const Response> responses,
                const std::vector<double>& values) {
  constexpr double arcsec_per_rad = 180.0 * 3600.0 / std::numbers::pi;
  const auto rotation = find_response(responses, "rotation_rad");
  if (response != "transmission_error_arcsec" || !rotation)
    return std::abs(value);
  return std::max(std::abs(value), arcsec_per_rad * std::abs(values[*rotation]));
}

bool worse(const SlopeCheck& a, const SlopeCheck& b) {
  return std::tuple(static_cast<int>(a.verdict), -a.least_error) <
         std::tuple(static_cast<int>(b.verdict), -b.least_error);
}

} // namespace

GradientCheck check_gradient(Evaluator& evaluator, const DesignSpace& design, std::span<const double> x,
                             const GradientCheckOptions& options) {
  GradientCheck result;
  const Evaluation base = evaluator.evaluate(x);
  const std::vector<double> gradient = base.ok ? evaluator.gradient(x) : std::vector<double>();
  const std::vector<double> piece_gradient = base.ok ? evaluator.piece_gradient(x) : std::vector<double>();
  if (!base.ok || gradient.empty()) {
    result.message = base.ok ? "the evaluator states no gradient" : base.message;
    return result;
  }
  result.ok = true;
  const auto responses = evaluator.responses();
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    const DesignVariable& variable = design.variables()[i];
    const double range = variable.upper - variable.lower;
    const Neighbours near = neighbours_of(evaluator, variable, x, i, base.pieces.size());
    const auto check = [&](std::string name, const std::vector<double> Evaluation::*list, std::size_t r,
                           double slope) {
      SlopeCheck one{.response = std::move(name), .variable = i, .value = (base.*list)[r], .exact = slope};
      if (!near.ok || !std::isfinite(slope))
        one.verdict = SlopeVerdict::unknown;
      else {
        Line line = line_of(near, list, r, one.value);
        line.terms = terms_of(one.response, one.value, responses, base.values);
        judge(line, range, options.noise, one);
      }
      return one;
    };
    for (std::size_t r = 0; r < responses.size(); ++r)
      if (std::isfinite(base.values[r]))
        result.slopes.push_back(
            check(std::string(responses[r].name), &Evaluation::values, r, gradient[r * n + i]));
    std::vector<SlopeCheck> pieces;
    for (std::size_t r = 0; r < base.pieces.size() && !piece_gradient.empty(); ++r)
      pieces.push_back(
          check("piece " + std::to_string(r) + " of " + std::string(responses[*evaluator.pieces_of()].name),
                &Evaluation::pieces, r, piece_gradient[r * n + i]));
    if (!pieces.empty())
      result.slopes.push_back(*std::min_element(pieces.begin(), pieces.end(), worse));
  }
  std::stable_sort(result.slopes.begin(), result.slopes.end(), worse);
  result.wrong = static_cast<std::size_t>(
      std::count_if(result.slopes.begin(), result.slopes.end(),
                    [](const SlopeCheck& check) { return check.verdict == SlopeVerdict::wrong; }));
  return result;
}

} // namespace strainwave
