#include "model/contact/lcp_factor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

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

/// y −= a x
inline void subtract_scaled(double a, const double* __restrict x, double* __restrict y, int n) {
  for (int i = 0; i < n; ++i) y[i] -= a * x[i];
}

/// Sum in a fixed order: one partial sum for each lane, then pairwise, then the rest.
inline double dot(const double* x, const double* y, int n) {
  double sum = 0.0;
  int i = 0;
  if (n >= lanes) {
    Pack s = load(x) * load(y);
    for (i = lanes; i + lanes <= n; i += lanes) s += load(x + i) * load(y + i);
    for (int width = lanes / 2; width > 0; width /= 2)
      for (int c = 0; c < width; ++c) s[c] += s[c + width];
    sum = s[0];
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

double ActiveFactor::checked_pivot(const ContactProblem& problem, int index, double pivot) const {
  const double floor = 4.0 * std::numeric_limits<double>::epsilon() * problem.m(index, index);
  if (!(pivot > floor)) throw NotPositiveDefinite(index, pivot);
  return pivot;
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
    target[k] = problem.q[column_index];
    target[k + 1] = problem.r[column_index];
    order_[static_cast<std::size_t>(j)] = column_index;
  }
  for (int first = 0; first < k; first += 4) {
    const int columns = std::min(4, k - first);
    if (first > 0) {
      if (columns == 4) update_columns<4>(first, rows);
      else if (columns == 3) update_columns<3>(first, rows);
      else if (columns == 2) update_columns<2>(first, rows);
      else update_columns<1>(first, rows);
    }
    for (int j = first; j < first + columns; ++j) {
      double* l = column(j);
      for (int p = first; p < j; ++p) subtract_scaled(column(p)[j], column(p) + j, l + j, rows - j);
      const double pivot = std::sqrt(checked_pivot(problem, order_[static_cast<std::size_t>(j)], l[j]));
      const double inverse = 1.0 / pivot;
      l[j] = pivot;
      for (int i = j + 1; i < rows; ++i) l[i] *= inverse;
      inverse_diagonal_[static_cast<std::size_t>(j)] = inverse;
      yq_[static_cast<std::size_t>(j)] = l[k];
      yr_[static_cast<std::size_t>(j)] = l[k + 1];
    }
  }
  size_ = k;
}

void ActiveFactor::append(const ContactProblem& problem, int index) {
  assert(size_ < capacity_);
  const int k = size_;
  double* x = work_.data();
  const double* source = problem.m.data() + static_cast<std::size_t>(index) * problem.m.outerStride();
  for (int p = 0; p < k; ++p) x[p] = source[order_[static_cast<std::size_t>(p)]];
  for (int p = 0; p < k; ++p) {
    x[p] *= inverse_diagonal_[static_cast<std::size_t>(p)];
    subtract_scaled(x[p], column(p) + p + 1, x + p + 1, k - p - 1);
  }
  const double pivot = std::sqrt(checked_pivot(problem, index, source[index] - dot(x, x, k)));
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

double ActiveFactor::r_r() const { return dot(yr_.data(), yr_.data(), size_); }
double ActiveFactor::r_q() const { return dot(yr_.data(), yq_.data(), size_); }

void ActiveFactor::back_substitute(double* x) const {
  for (int p = size_ - 1; p >= 0; --p) {
    const int below = size_ - p - 1;
    x[p] = (x[p] - dot(column(p) + p + 1, x + p + 1, below)) * inverse_diagonal_[static_cast<std::size_t>(p)];
  }
}

void ActiveFactor::solve(double weight_q, double weight_r, double* x) const {
  for (std::size_t p = 0; p < static_cast<std::size_t>(size_); ++p) x[p] = weight_q * yq_[p] + weight_r * yr_[p];
  back_substitute(x);
}

void ActiveFactor::solve(double* b) const {
  for (int p = 0; p < size_; ++p) {
    b[p] *= inverse_diagonal_[static_cast<std::size_t>(p)];
    subtract_scaled(b[p], column(p) + p + 1, b + p + 1, size_ - p - 1);
  }
  back_substitute(b);
}

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
