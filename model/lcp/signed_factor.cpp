#include "strainwave/model/lcp/signed_factor.hpp"

#include "strainwave/model/lcp/lanes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace strainwave {

using namespace lanewise;

namespace {
constexpr int width = 4; ///< columns treated together
}

void SignedFactor::reset(int n) {
  size_ = padded_ = 0;
  if (n <= capacity_)
    return;
  capacity_ = (n + width - 1) / width * width;
  stride_ = (static_cast<std::size_t>(capacity_) + 2 + 2 * line - 1) / line * line;
  if (stride_ % 64 == 0)
    stride_ += line; // columns a page apart would share cache sets
  memory_.assign(stride_ * static_cast<std::size_t>(capacity_) + 2 * line, 0.0);
  const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
  storage_ = memory_.data() + (64 - address % 64) % 64 / sizeof(double);
  for (auto* v : {&sign_, &inverse_, &lq_, &lr_})
    v->assign(static_cast<std::size_t>(capacity_), 0.0);
}

/// Columns first … first + 3 minus what the columns before them contribute, from row `first` on.
void SignedFactor::update(int first) {
  double* const target = column(first);
  const int rows = padded_ + 2;
  for (int i = first / lanes * lanes; i < rows; i += 2 * lanes) {
    Pack a[width], b[width];
    for (int c = 0; c < width; ++c) {
      a[c] = load(target + static_cast<std::size_t>(c) * stride_ + i);
      b[c] = load(target + static_cast<std::size_t>(c) * stride_ + i + lanes);
    }
    const double* l = storage_;
    for (int p = 0; p < first; ++p, l += stride_) {
      const Pack u = load(l + i), v = load(l + i + lanes);
      const double s = sign_[static_cast<std::size_t>(p)];
      for (int c = 0; c < width; ++c) {
        const double w = s * l[first + c];
        a[c] -= u * w;
        b[c] -= v * w;
      }
    }
    for (int c = 0; c < width; ++c) {
      store(target + static_cast<std::size_t>(c) * stride_ + i, a[c]);
      store(target + static_cast<std::size_t>(c) * stride_ + i + lanes, b[c]);
    }
  }
}

/// The square on the diagonal by scalars, then the rows below it.
bool SignedFactor::finish(int first) {
  double* const l = column(first);
  const auto at = [&](int i, int c) -> double& {
    return l[static_cast<std::size_t>(c) * stride_ + first + i];
  };
  double inverse[width], sign[width];
  for (int c = 0; c < width; ++c) {
    const auto j = static_cast<std::size_t>(first + c);
    sign[c] = sign_[j];
    for (int p = 0; p < c; ++p)
      for (int i = c; i < width; ++i)
        at(i, c) -= at(i, p) * sign[p] * at(c, p);
    const double pivot = sign[c] * at(c, c);
    if (!(pivot > 0.0))
      return false;
    const double root = std::sqrt(pivot);
    at(c, c) = root;
    inverse_[j] = inverse[c] = 1.0 / root;
    for (int i = c + 1; i < width; ++i)
      at(i, c) *= sign[c] * inverse[c];
  }
  double factor[width][width];
  for (int c = 0; c < width; ++c)
    for (int p = 0; p < c; ++p)
      factor[c][p] = sign[p] * at(c, p);
  const int rows = padded_ + 2;
  for (int i = first + width; i < rows; ++i) {
    double x[width];
    for (int c = 0; c < width; ++c) {
      x[c] = l[static_cast<std::size_t>(c) * stride_ + i];
      for (int p = 0; p < c; ++p)
        x[c] -= x[p] * factor[c][p];
      x[c] *= sign[c] * inverse[c];
      l[static_cast<std::size_t>(c) * stride_ + i] = x[c];
    }
  }
  return true;
}

bool SignedFactor::factorize(const double* a, std::size_t stride, std::span<const int> rows, int positive,
                             const double* b_q, const double* b_r) {
  const int k = static_cast<int>(rows.size());
  assert(k <= capacity_);
  size_ = k;
  padded_ = (k + width - 1) / width * width;
  for (int j = 0; j < k; ++j) {
    const double* source = a + static_cast<std::size_t>(rows[static_cast<std::size_t>(j)]) * stride;
    double* target = column(j);
    for (int i = j / width * width / lanes * lanes; i < j; ++i)
      target[i] = 0.0; // above the diagonal: read along, never used
    for (int i = j; i < k; ++i)
      target[i] = source[rows[static_cast<std::size_t>(i)]];
    for (int i = k; i < padded_; ++i)
      target[i] = 0.0;
    const int index = rows[static_cast<std::size_t>(j)];
    target[padded_] = b_q[index];
    target[padded_ + 1] = b_r[index];
    sign_[static_cast<std::size_t>(j)] = j < positive ? 1.0 : -1.0;
  }
  for (int j = k; j < padded_; ++j) {
    const int from = j / width * width / lanes * lanes;
    std::fill_n(column(j) + from, padded_ + 2 - from, 0.0);
    column(j)[j] = 1.0;
    sign_[static_cast<std::size_t>(j)] = 1.0;
  }
  for (int first = 0; first < padded_; first += width) {
    if (first > 0)
      update(first);
    if (!finish(first))
      return false;
  }
  r_r_ = r_q_ = 0.0;
  for (int j = 0; j < k; ++j) {
    const auto p = static_cast<std::size_t>(j);
    lq_[p] = column(j)[padded_];
    lr_[p] = column(j)[padded_ + 1];
    r_r_ += sign_[p] * lr_[p] * lr_[p];
    r_q_ += sign_[p] * lr_[p] * lq_[p];
  }
  return true;
}

void SignedFactor::solve(double rotation, double* x) const {
  for (int j = size_ - 1; j >= 0; --j) {
    const auto p = static_cast<std::size_t>(j);
    const double* l = column(j);
    const double known = lanewise::dot(l + j + 1, x + j + 1, size_ - j - 1);
    x[p] = (lq_[p] + rotation * lr_[p] - known) * inverse_[p];
  }
}

} // namespace strainwave
