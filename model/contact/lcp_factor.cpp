#include "model/contact/lcp_factor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace strainwave {

namespace {

// As many doubles side by side as a register of the processor holds.
#if defined(__AVX512F__)
constexpr int lanes = 8;
#elif defined(__AVX__)
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif
typedef double Pack __attribute__((vector_size(8 * lanes), aligned(8), may_alias));
constexpr std::size_t line = 8; ///< doubles of one cache line

inline Pack load(const double* p) { return *reinterpret_cast<const Pack*>(p); }
inline void store(double* p, const Pack& v) { *reinterpret_cast<Pack*>(p) = v; }

/// Sum over the lanes, pairwise.
inline double across(Pack s) {
  for (int width = lanes / 2; width > 0; width /= 2)
    for (int c = 0; c < width; ++c) s[c] += s[c + width];
  return s[0];
}

/// Sum in a fixed order: one partial sum for each lane, then pairwise, then the rest.
inline double dot(const double* x, const double* y, int n) {
  double sum = 0.0;
  int i = 0;
  if (n >= lanes) {
    Pack s = load(x) * load(y);
    for (i = lanes; i + lanes <= n; i += lanes) s += load(x + i) * load(y + i);
    sum = across(s);
  }
  for (; i < n; ++i) sum += x[i] * y[i];
  return sum;
}

} // namespace

NotPositiveDefinite::NotPositiveDefinite(int index_in, double pivot_in)
    : std::runtime_error("the contact matrix is not positive definite: pivot " + std::to_string(pivot_in) +
                         " mm/N at index " + std::to_string(index_in)),
      index(index_in), pivot(pivot_in) {}

void ActiveFactor::reset(int n) {
  size_ = 0;
  if (n <= capacity_) return;
  capacity_ = n;
  stride_ = (static_cast<std::size_t>(n) + 2 + 2 * line - 1) / line * line;
  if (stride_ % 64 == 0) stride_ += line; // columns a page apart would share cache sets
  memory_.assign(stride_ * static_cast<std::size_t>(n) + 2 * line, 0.0);
  const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
  storage_ = memory_.data() + (64 - address % 64) % 64 / sizeof(double);
  for (auto* v : {&inverse_diagonal_, &yq_, &yr_, &work_}) v->assign(static_cast<std::size_t>(n), 0.0);
  order_.assign(static_cast<std::size_t>(n), 0);
}

double ActiveFactor::root_of_pivot(int index, double pivot, double diagonal) {
  const double floor = 4.0 * std::numeric_limits<double>::epsilon() * diagonal;
  if (!(pivot > floor)) throw NotPositiveDefinite(index, pivot);
  return std::sqrt(pivot);
}

/// Cholesky of the columns first … first + Columns − 1 once the columns before them are taken off: the square on the
/// diagonal by scalars, then the rows below it in one pass.
template <int Columns> void ActiveFactor::finish_columns(int first, int rows) {
  double* const l = column(first);
  const auto at = [&](int i, int c) -> double& { return l[c * stride_ + first + i]; };
  double inverse[Columns];
  for (int c = 0; c < Columns; ++c) {
    const auto j = static_cast<std::size_t>(first + c);
    for (int p = 0; p < c; ++p)
      for (int i = c; i < Columns; ++i) at(i, c) -= at(i, p) * at(c, p);
    const double root = root_of_pivot(order_[j], at(c, c), work_[j]);
    inverse_diagonal_[j] = inverse[c] = 1.0 / root;
    at(c, c) = root;
    for (int i = c + 1; i < Columns; ++i) at(i, c) *= inverse[c];
  }
  int i = first + Columns;
  const auto row = [&]<class Number>(Number (&x)[Columns]) {
    for (int c = 0; c < Columns; ++c) {
      for (int p = 0; p < c; ++p) x[c] -= x[p] * at(c, p);
      x[c] *= inverse[c];
    }
  };
  for (; i + lanes <= rows; i += lanes) {
    Pack x[Columns];
    for (int c = 0; c < Columns; ++c) x[c] = load(l + c * stride_ + i);
    row(x);
    for (int c = 0; c < Columns; ++c) store(l + c * stride_ + i, x[c]);
  }
  for (; i < rows; ++i) {
    double x[Columns];
    for (int c = 0; c < Columns; ++c) x[c] = l[c * stride_ + i];
    row(x);
    for (int c = 0; c < Columns; ++c) l[c * stride_ + i] = x[c];
  }
}

/// Columns first … first + Columns − 1 minus what the columns before them contribute, from row `first` on.
template <int Columns> void ActiveFactor::update_columns(int first, int rows) {
  double* const target = column(first);
  int i = first / lanes * lanes;
  for (; i + lanes < rows; i += 2 * lanes) {
    Pack a[Columns], b[Columns];
    for (int c = 0; c < Columns; ++c) {
      a[c] = load(target + c * stride_ + i);
      b[c] = load(target + c * stride_ + i + lanes);
    }
    const double* l = storage_;
    for (int p = 0; p < first; ++p, l += stride_) {
      const Pack u = load(l + i), v = load(l + i + lanes);
      for (int c = 0; c < Columns; ++c) {
        a[c] -= u * l[first + c];
        b[c] -= v * l[first + c];
      }
    }
    for (int c = 0; c < Columns; ++c) {
      store(target + c * stride_ + i, a[c]);
      store(target + c * stride_ + i + lanes, b[c]);
    }
  }
  if (i < rows) {
    Pack a[Columns];
    for (int c = 0; c < Columns; ++c) a[c] = load(target + c * stride_ + i);
    const double* l = storage_;
    for (int p = 0; p < first; ++p, l += stride_) {
      const Pack u = load(l + i);
      for (int c = 0; c < Columns; ++c) a[c] -= u * l[first + c];
    }
    for (int c = 0; c < Columns; ++c) store(target + c * stride_ + i, a[c]);
  }
}

void ActiveFactor::factorize(const ContactProblem& problem, std::span<const int> set) {
  const int k = static_cast<int>(set.size());
  assert(k <= capacity_);
  size_ = 0;
  const int rows = k + 2; // the last two: q and r
  for (int j = 0; j < k; ++j) {
    const int column_index = set[static_cast<std::size_t>(j)];
    const double* source = problem.m.data() + static_cast<std::size_t>(column_index) * problem.m.outerStride();
    double* target = column(j);
    for (int i = j; i < k; ++i) target[i] = source[set[static_cast<std::size_t>(i)]];
    work_[static_cast<std::size_t>(j)] = target[j];
    target[k] = problem.q[column_index];
    target[k + 1] = problem.r[column_index];
    order_[static_cast<std::size_t>(j)] = column_index;
  }
  const auto columns = [&]<int Columns>(std::integral_constant<int, Columns>, int first) {
    if (first > 0) update_columns<Columns>(first, rows);
    finish_columns<Columns>(first, rows);
  };
  int first = 0;
  for (; first + 4 <= k; first += 4) columns(std::integral_constant<int, 4>{}, first);
  if (k - first == 3) columns(std::integral_constant<int, 3>{}, first);
  else if (k - first == 2) columns(std::integral_constant<int, 2>{}, first);
  else if (k - first == 1) columns(std::integral_constant<int, 1>{}, first);
  for (int j = 0; j < k; ++j) {
    yq_[static_cast<std::size_t>(j)] = column(j)[k];
    yr_[static_cast<std::size_t>(j)] = column(j)[k + 1];
  }
  size_ = k;
}

void ActiveFactor::append(const ContactProblem& problem, int index) {
  assert(size_ < capacity_);
  const int k = size_;
  double* x = work_.data();
  const double* source = problem.m.data() + static_cast<std::size_t>(index) * problem.m.outerStride();
  for (int p = 0; p < k; ++p) x[p] = source[order_[static_cast<std::size_t>(p)]];
  forward_substitute(x);
  const double pivot = root_of_pivot(index, source[index] - dot(x, x, k), source[index]);
  const auto at = static_cast<std::size_t>(k);
  yq_[at] = (problem.q[index] - dot(x, yq_.data(), k)) / pivot;
  yr_[at] = (problem.r[index] - dot(x, yr_.data(), k)) / pivot;
  for (int p = 0; p < k; ++p) column(p)[k] = x[p];
  column(k)[k] = pivot;
  inverse_diagonal_[at] = 1.0 / pivot;
  order_[at] = index;
  ++size_;
}

void ActiveFactor::remove(int position) {
  assert(position >= 0 && position < size_);
  const int k = size_;
  const int tail = k - position - 1;
  for (int p = 0; p < position; ++p)
    std::memmove(column(p) + position, column(p) + position + 1, static_cast<std::size_t>(tail) * sizeof(double));
  // Trailing block: L₃₃ L₃₃ᵀ + w wᵀ, one plane rotation for each column; q and r are turned along.
  double* w = work_.data();
  std::memcpy(w, column(position) + position + 1, static_cast<std::size_t>(tail) * sizeof(double));
  double wq = yq_[static_cast<std::size_t>(position)], wr = yr_[static_cast<std::size_t>(position)];
  for (int c = position + 1; c < k; ++c, ++w) {
    const double* from = column(c) + c;
    double* to = column(c - 1) + c - 1;
    const double pivot = std::sqrt(from[0] * from[0] + w[0] * w[0]);
    const double inverse = 1.0 / pivot, cosine = from[0] * inverse, sine = w[0] * inverse;
    to[0] = pivot;
    const int below = k - c;
    double* __restrict wi = w;
    for (int i = 1; i < below; ++i) { // `to` is another column than `from`
      const double l = from[i];
      to[i] = cosine * l + sine * wi[i];
      wi[i] = cosine * wi[i] - sine * l;
    }
    const auto here = static_cast<std::size_t>(c);
    const double q = yq_[here], r = yr_[here];
    yq_[here - 1] = cosine * q + sine * wq;
    wq = cosine * wq - sine * q;
    yr_[here - 1] = cosine * r + sine * wr;
    wr = cosine * wr - sine * r;
    inverse_diagonal_[here - 1] = inverse;
    order_[here - 1] = order_[here];
  }
  --size_;
}

/// x ← L⁻¹ x, four unknowns at a time.
void ActiveFactor::forward_substitute(double* x) const {
  const int k = size_;
  for (int first = 0; first < k; first += 4) {
    const int next = std::min(first + 4, k);
    for (int p = first; p < next; ++p) {
      x[p] *= inverse_diagonal_[static_cast<std::size_t>(p)];
      for (int i = p + 1; i < next; ++i) x[i] -= x[p] * column(p)[i];
    }
    if (next == k) break;
    const double *a = column(first), *b = column(first + 1), *c = column(first + 2), *d = column(first + 3);
    const double xa = x[first], xb = x[first + 1], xc = x[first + 2], xd = x[first + 3];
    double* __restrict rest = x;
    for (int i = next; i < k; ++i) rest[i] -= (xa * a[i] + xb * b[i]) + (xc * c[i] + xd * d[i]);
  }
}

/// x ← L⁻ᵀ x for several x at once, four unknowns at a time: the sums over what is known already run side by side.
template <std::size_t Sides> void ActiveFactor::back_substitute(double* const (&x)[Sides]) const {
  const int k = size_;
  const auto solve_square = [&](int first, int count, const double (*known)[Sides]) {
    for (int c = count - 1; c >= 0; --c) {
      const double* l = column(first + c) + first;
      for (std::size_t side = 0; side < Sides; ++side) {
        double sum = known ? known[c][side] : 0.0;
        for (int below = c + 1; below < count; ++below) sum += l[below] * x[side][first + below];
        x[side][first + c] = (x[side][first + c] - sum) * inverse_diagonal_[static_cast<std::size_t>(first + c)];
      }
    }
  };
  const int odd = k % 4;
  if (odd) solve_square(k - odd, odd, nullptr);
  for (int first = k - odd - 4; first >= 0; first -= 4) {
    const double* l = column(first);
    double known[4][Sides];
    int i = first + 4;
    if (i + lanes <= k) {
      Pack sum[4][Sides];
      for (int c = 0; c < 4; ++c)
        for (std::size_t side = 0; side < Sides; ++side) sum[c][side] = load(l + c * stride_ + i) * load(x[side] + i);
      for (i += lanes; i + lanes <= k; i += lanes)
        for (std::size_t side = 0; side < Sides; ++side) {
          const Pack v = load(x[side] + i);
          for (int c = 0; c < 4; ++c) sum[c][side] += load(l + c * stride_ + i) * v;
        }
      for (int c = 0; c < 4; ++c)
        for (std::size_t side = 0; side < Sides; ++side) known[c][side] = across(sum[c][side]);
    } else {
      for (auto& row : known)
        for (double& value : row) value = 0.0;
    }
    for (; i < k; ++i)
      for (int c = 0; c < 4; ++c)
        for (std::size_t side = 0; side < Sides; ++side) known[c][side] += l[c * stride_ + i] * x[side][i];
    solve_square(first, 4, known);
  }
}

void ActiveFactor::solve(double weight_q, double weight_r, double* x) const {
  for (std::size_t p = 0; p < static_cast<std::size_t>(size_); ++p) x[p] = weight_q * yq_[p] + weight_r * yr_[p];
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

double ActiveFactor::r_r() const { return dot(yr_.data(), yr_.data(), size_); }
double ActiveFactor::r_q() const { return dot(yr_.data(), yq_.data(), size_); }

void add_columns(const Eigen::MatrixXd& m, std::span<const int> order, const double* x, const double* base, double* out) {
  const auto n = static_cast<std::size_t>(m.rows());
  const double* const data = m.data();
  if (n > 0) std::memcpy(out, base, n * sizeof(double));
  double* __restrict result = out;
  std::size_t p = 0;
  for (; p + 4 <= order.size(); p += 4) {
    const double* a = data + static_cast<std::size_t>(order[p]) * n;
    const double* b = data + static_cast<std::size_t>(order[p + 1]) * n;
    const double* c = data + static_cast<std::size_t>(order[p + 2]) * n;
    const double* d = data + static_cast<std::size_t>(order[p + 3]) * n;
    const double xa = x[p], xb = x[p + 1], xc = x[p + 2], xd = x[p + 3];
    for (std::size_t i = 0; i < n; ++i) result[i] += (xa * a[i] + xb * b[i]) + (xc * c[i] + xd * d[i]);
  }
  for (; p < order.size(); ++p) {
    const double* a = data + static_cast<std::size_t>(order[p]) * n;
    const double xa = x[p];
    for (std::size_t i = 0; i < n; ++i) result[i] += xa * a[i];
  }
}

void add_columns(const Eigen::MatrixXd& m, std::span<const int> order, const double* x, const double* y, double* out_x,
                 double* out_y) {
  const auto n = static_cast<std::size_t>(m.rows());
  const double* const data = m.data();
  double *__restrict u = out_x, *__restrict v = out_y;
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
