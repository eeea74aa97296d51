#pragma once
// Small vector kernels of the contact factor: packs of doubles, sums in a fixed order. Not for other rooms.

#include <cstddef>

namespace strainwave::lanewise {

// As many doubles side by side as a register of the processor holds.
#if defined(__AVX512F__)
inline constexpr int lanes = 8;
#elif defined(__AVX__)
inline constexpr int lanes = 4;
#else
inline constexpr int lanes = 2;
#endif
typedef double Pack __attribute__((vector_size(8 * lanes), aligned(8), may_alias));
inline constexpr std::size_t line = 8; ///< doubles of one cache line

inline Pack load(const double* p) {
  return *reinterpret_cast<const Pack*>(p);
}
inline void store(double* p, const Pack& v) {
  *reinterpret_cast<Pack*>(p) = v;
}

/// Sum over the lanes, pairwise.
inline double across(Pack s) {
  for (int width = lanes / 2; width > 0; width /= 2)
    for (int c = 0; c < width; ++c)
      s[c] += s[c + width];
  return s[0];
}

/// Sum in a fixed order: one partial sum for each lane, then pairwise, then the rest.
inline double dot(const double* x, const double* y, int n) {
  double sum = 0.0;
  int i = 0;
  if (n >= lanes) {
    Pack s = load(x) * load(y);
    for (i = lanes; i + lanes <= n; i += lanes)
      s += load(x + i) * load(y + i);
    sum = across(s);
  }
  for (; i < n; ++i)
    sum += x[i] * y[i];
  return sum;
}

} // namespace strainwave::lanewise
