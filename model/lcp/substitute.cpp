#include "strainwave/model/lcp/factor.hpp"
#include "strainwave/model/lcp/lanes.hpp"

#include <algorithm>
#include <cstring>

namespace strainwave {

using namespace lanewise;

/// x ← L⁻¹ x, four unknowns at a time.
void ActiveFactor::forward_substitute(double* x) const {
  const int k = size_;
  for (int first = 0; first < k; first += 4) {
    const int next = std::min(first + 4, k);
    for (int p = first; p < next; ++p) {
      x[p] *= inverse_diagonal_[static_cast<std::size_t>(p)];
      for (int i = p + 1; i < next; ++i)
        x[i] -= x[p] * column(p)[i];
    }
    if (next == k)
      break;
    const double *a = column(first), *b = column(first + 1), *c = column(first + 2), *d = column(first + 3);
    const double xa = x[first], xb = x[first + 1], xc = x[first + 2], xd = x[first + 3];
    double* __restrict rest = x;
    for (int i = next; i < k; ++i)
      rest[i] -= (xa * a[i] + xb * b[i]) + (xc * c[i] + xd * d[i]);
  }
}

/// x ← L⁻ᵀ x for several x at once, four unknowns at a time: the sums over what is known already run side by
/// side.
template <std::size_t Sides>
void ActiveFactor::back_substitute(double* const (&x)[Sides]) const {
  const int k = size_;
  const auto solve_square = [&](int first, int count, const double(*known)[Sides]) {
    for (int c = count - 1; c >= 0; --c) {
      const double* l = column(first + c) + first;
      for (std::size_t side = 0; side < Sides; ++side) {
        double sum = known ? known[c][side] : 0.0;
        for (int below = c + 1; below < count; ++below)
          sum += l[below] * x[side][first + below];
        x[side][first + c] =
            (x[side][first + c] - sum) * inverse_diagonal_[static_cast<std::size_t>(first + c)];
      }
    }
  };
  const int odd = k % 4;
  if (odd)
    solve_square(k - odd, odd, nullptr);
  for (int first = k - odd - 4; first >= 0; first -= 4) {
    const double* l = column(first);
    double known[4][Sides];
    int i = first + 4;
    if (i + lanes <= k) {
      Pack sum[4][Sides];
      for (int c = 0; c < 4; ++c)
        for (std::size_t side = 0; side < Sides; ++side)
          sum[c][side] = load(l + c * stride_ + i) * load(x[side] + i);
      for (i += lanes; i + lanes <= k; i += lanes)
        for (std::size_t side = 0; side < Sides; ++side) {
          const Pack v = load(x[side] + i);
          for (int c = 0; c < 4; ++c)
            sum[c][side] += load(l + c * stride_ + i) * v;
        }
      for (int c = 0; c < 4; ++c)
        for (std::size_t side = 0; side < Sides; ++side)
          known[c][side] = across(sum[c][side]);
    } else {
      for (auto& row : known)
        for (double& value : row)
          value = 0.0;
    }
    for (; i < k; ++i)
      for (int c = 0; c < 4; ++c)
        for (std::size_t side = 0; side < Sides; ++side)
          known[c][side] += l[c * stride_ + i] * x[side][i];
    solve_square(first, 4, known);
  }
}

void ActiveFactor::solve(double weight_q, double weight_r, double* x) const {
  for (std::size_t p = 0; p < static_cast<std::size_t>(size_); ++p)
    x[p] = weight_q * yq_[p] + weight_r * yr_[p];
  double* const sides[1] = {x};
  back_substitute(sides);
}

void ActiveFactor::solve(double rotation, double* force, double* rate) const {
  for (std::size_t p = 0; p < static_cast<std::size_t>(size_); ++p) {
    force[p] = rotation * yr_[p] - yq_[p];
    rate[p] = yr_[p];
  }
  double* const sides[2] = {force, rate};
  back_substitute(sides);
}

void ActiveFactor::solve(double* b) const {
  forward_substitute(b);
  double* const sides[1] = {b};
  back_substitute(sides);
}

double ActiveFactor::r_r() const {
  return dot(yr_.data(), yr_.data(), size_);
}
double ActiveFactor::r_q() const {
  return dot(yr_.data(), yq_.data(), size_);
}

void add_columns(const Eigen::MatrixXd& m, std::span<const int> order, const double* x, const double* base,
                 double* out) {
  const auto n = static_cast<std::size_t>(m.rows());
  const double* const data = m.data();
  if (n > 0)
    std::memcpy(out, base, n * sizeof(double));
  double* __restrict result = out;
  std::size_t p = 0;
  for (; p + 4 <= order.size(); p += 4) {
    const double* a = data + static_cast<std::size_t>(order[p]) * n;
    const double* b = data + static_cast<std::size_t>(order[p + 1]) * n;
    const double* c = data + static_cast<std::size_t>(order[p + 2]) * n;
    const double* d = data + static_cast<std::size_t>(order[p + 3]) * n;
    const double xa = x[p], xb = x[p + 1], xc = x[p + 2], xd = x[p + 3];
    for (std::size_t i = 0; i < n; ++i)
      result[i] += (xa * a[i] + xb * b[i]) + (xc * c[i] + xd * d[i]);
  }
  for (; p < order.size(); ++p) {
    const double* a = data + static_cast<std::size_t>(order[p]) * n;
    const double xa = x[p];
    for (std::size_t i = 0; i < n; ++i)
      result[i] += xa * a[i];
  }
}

void add_columns(const Eigen::MatrixXd& m, std::span<const int> order, const double* x, const double* y,
                 double* out_x, double* out_y) {
  const auto n = static_cast<std::size_t>(m.rows());
  const double* const data = m.data();
  double* __restrict u = out_x, * __restrict v = out_y;
  std::size_t p = 0;
  for (; p + 4 <= order.size(); p += 4) {
    const double* a = data + static_cast<std::size_t>(order[p]) * n;
    const double* b = data + static_cast<std::size_t>(order[p + 1]) * n;
    const double* c = data + static_cast<std::size_t>(order[p + 2]) * n;
    const double* d = data + static_cast<std::size_t>(order[p + 3]) * n;
    const double xa = x[p], xb = x[p + 1], xc = x[p + 2], xd = x[p + 3];
    const double ya = y[p], yb = y[p + 1], yc = y[p + 2], yd = y[p + 3];
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += (xa * a[i] + xb * b[i]) + (xc * c[i] + xd * d[i]);
      v[i] += (ya * a[i] + yb * b[i]) + (yc * c[i] + yd * d[i]);
    }
  }
  for (; p < order.size(); ++p) {
    const double* a = data + static_cast<std::size_t>(order[p]) * n;
    const double xa = x[p], ya = y[p];
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += xa * a[i];
      v[i] += ya * a[i];
    }
  }
}

} // namespace strainwave
