#pragma once
// Is a derivative right? Central differences with steps h, h/2, h/4 must come nearer to it as h^2 does
// (factor 4 each time), down to the rounding of the differences. A wrong derivative leaves an error that does
// not fall.

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace strainwave::testing_support {

struct OrderReport {
  bool good = false;
  std::string text;
};

/// f: function of the change x of the variable, f(0) the base. noise: rounding of one value of f. Where f
/// bends so sharply that the first step is outside the range of h^2, a twentieth of it must do.
template <class Function>
OrderReport order_of_convergence(const Function& f, double derivative, double step, double noise) {
  OrderReport report;
  for (const double start : {step, 0.05 * step}) {
    double error[3];
    bool at_rounding = false;
    for (int k = 0; k < 3; ++k) {
      const double h = start / (1 << k);
      error[k] = std::abs((f(h) - f(-h)) / (2.0 * h) - derivative);
      at_rounding = error[k] < 10.0 * noise / h;
    }
    // The factor between neighbours is 4 + O(h^2); 20 % leaves room for that and for a little noise.
    const double factor = error[1] > 0.0 && error[2] > 0.0 ? error[1] / error[2] : 4.0;
    report.good = at_rounding || (factor > 3.2 && factor < 4.8);
    report.text += fmt::format("derivative {:.10g}, step {:.3g}: errors {:.3g} {:.3g} {:.3g}; ", derivative,
                               start, error[0], error[1], error[2]);
    if (report.good)
      break;
  }
  return report;
}

} // namespace strainwave::testing_support
