#pragma once
// Small linear programmes:   minimise costᵀx   subject to   each row · x ≤ (or =) its bound,   x ≥ 0.
//
// Dense two-phase simplex with Bland's rule (R. Bland, Math. Oper. Res. 2, 1977), which cannot cycle. For the
// force bound: a row or two for each tooth of a lobe that may carry, so some tens of unknowns and rows. Its
// table has rows × (unknowns + 2 rows) numbers and every step touches all of them; nothing is factorised
// again, so rounding grows with the steps. Coefficients and bounds should be about 1 (costs are compared with
// 1e-10, feasibility with 1e-8). For hundreds of rows take a library (Debian: coinor-libclp-dev).

#include <optional>
#include <vector>

namespace strainwave {

struct LinearRow {
  std::vector<double> coefficient;
  double bound = 0.0;
  bool equal = false; ///< else at most
};

struct LinearSolution {
  std::vector<double> x;
  double cost = 0.0;
};

/// Nothing if no x keeps all rows. Throws std::domain_error if the cost has no lower bound.
std::optional<LinearSolution> solve_linear_program(const std::vector<double>& cost,
                                                   const std::vector<LinearRow>& rows);

} // namespace strainwave
