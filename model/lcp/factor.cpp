#include "strainwave/model/lcp/factor.hpp"
#include "strainwave/model/lcp/lanes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace strainwave {

using namespace lanewise;

NotPositiveDefinite::NotPositiveDefinite(int index_in, double pivot_in)
    : std::runtime_error("the contact matrix is not positive definite: pivot " + std::to_string(pivot_in) +
                         " mm/N at index " + std::to_string(index_in)),
      index(index_in), pivot(pivot_in) {}

void ActiveFactor::reset(int n) {
  size_ = 0;
  if (n <= capacity_)
    return;
  capacity_ = n;
  stride_ = (static_cast<std::size_t>(n) + 2 + 2 * line - 1) / line * line;
  if (stride_ % 64 == 0)
    stride_ += line; // columns a page apart would share cache sets
  memory_.assign(stride_ * static_cast<std::size_t>(n) + 2 * line, 0.0);
  const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
  storage_ = memory_.data() + (64 - address % 64) % 64 / sizeof(double);
  for (auto* v : {&inverse_diagonal_, &yq_, &yr_, &work_})
    v->assign(static_cast<std::size_t>(n), 0.0);
  order_.assign(static_cast<std::size_t>(n), 0);
}

double ActiveFactor::root_of_pivot(int index, double pivot, double diagonal) {
  const double floor = 4.0 * std::numeric_limits<double>::epsilon() * diagonal;
  if (!(pivot > floor))
    throw NotPositiveDefinite(index, pivot);
  return std::sqrt(pivot);
}

/// Cholesky of the columns first … first + Columns − 1 once the columns before them are taken off: the square
/// on the diagonal by scalars, then the rows below it in one pass.
template <int Columns>
void ActiveFactor::finish_columns(int first, int rows) {
  double* const l = column(first);
  const auto at = [&](int i, int c) -> double& { return l[c * stride_ + first + i]; };
  double inverse[Columns];
  for (int c = 0; c < Columns; ++c) {
    const auto j = static_cast<std::size_t>(first + c);
    for (int p = 0; p < c; ++p)
      for (int i = c; i < Columns; ++i)
        at(i, c) -= at(i, p) * at(c, p);
    const double root = root_of_pivot(order_[j], at(c, c), work_[j]);
    inverse_diagonal_[j] = inverse[c] = 1.0 / root;
    at(c, c) = root;
    for (int i = c + 1; i < Columns; ++i)
      at(i, c) *= inverse[c];
  }
  int i = first + Columns;
  const auto row = [&]<class Number>(Number(&x)[Columns]) {
    for (int c = 0; c < Columns; ++c) {
      for (int p = 0; p < c; ++p)
        x[c] -= x[p] * at(c, p);
      x[c] *= inverse[c];
    }
  };
  for (; i + lanes <= rows; i += lanes) {
    Pack x[Columns];
    for (int c = 0; c < Columns; ++c)
      x[c] = load(l + c * stride_ + i);
    row(x);
    for (int c = 0; c < Columns; ++c)
      store(l + c * stride_ + i, x[c]);
  }
  for (; i < rows; ++i) {
    double x[Columns];
    for (int c = 0; c < Columns; ++c)
      x[c] = l[c * stride_ + i];
    row(x);
    for (int c = 0; c < Columns; ++c)
      l[c * stride_ + i] = x[c];
  }
}

/// Columns first … first + Columns − 1 minus what the columns before them contribute, from row `first` on.
template <int Columns>
void ActiveFactor::update_columns(int first, int rows) {
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
    for (int c = 0; c < Columns; ++c)
      a[c] = load(target + c * stride_ + i);
    const double* l = storage_;
    for (int p = 0; p < first; ++p, l += stride_) {
      const Pack u = load(l + i);
      for (int c = 0; c < Columns; ++c)
        a[c] -= u * l[first + c];
    }
    for (int c = 0; c < Columns; ++c)
      store(target + c * stride_ + i, a[c]);
  }
}

void ActiveFactor::factorize(const ContactProblem& problem, std::span<const int> set) {
  const int k = static_cast<int>(set.size());
  assert(k <= capacity_);
  size_ = 0;
  const int rows = k + 2; // the last two: q and r
  for (int j = 0; j < k; ++j) {
    const int column_index = set[static_cast<std::size_t>(j)];
    const double* source =
        problem.m.data() + static_cast<std::size_t>(column_index) * problem.m.outerStride();
    double* target = column(j);
    for (int i = j; i < k; ++i)
      target[i] = source[set[static_cast<std::size_t>(i)]];
    work_[static_cast<std::size_t>(j)] = target[j];
    target[k] = problem.q[column_index];
    target[k + 1] = problem.r[column_index];
    order_[static_cast<std::size_t>(j)] = column_index;
  }
  const auto columns = [&]<int Columns>(std::integral_constant<int, Columns>, int first) {
    if (first > 0)
      update_columns<Columns>(first, rows);
    finish_columns<Columns>(first, rows);
  };
  int first = 0;
  for (; first + 4 <= k; first += 4)
    columns(std::integral_constant<int, 4>{}, first);
  if (k - first == 3)
    columns(std::integral_constant<int, 3>{}, first);
  else if (k - first == 2)
    columns(std::integral_constant<int, 2>{}, first);
  else if (k - first == 1)
    columns(std::integral_constant<int, 1>{}, first);
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
  for (int p = 0; p < k; ++p)
    x[p] = source[order_[static_cast<std::size_t>(p)]];
  forward_substitute(x);
  const double pivot = root_of_pivot(index, source[index] - dot(x, x, k), source[index]);
  const auto at = static_cast<std::size_t>(k);
  yq_[at] = (problem.q[index] - dot(x, yq_.data(), k)) / pivot;
  yr_[at] = (problem.r[index] - dot(x, yr_.data(), k)) / pivot;
  for (int p = 0; p < k; ++p)
    column(p)[k] = x[p];
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
    std::memmove(column(p) + position, column(p) + position + 1,
                 static_cast<std::size_t>(tail) * sizeof(double));
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

} // namespace strainwave
