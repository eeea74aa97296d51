#pragma once
// Factor of a small symmetric quasi-definite matrix with the two right-hand sides of contact riding along.
//
//     A = [S  B; Bᵀ −C] = L Σ Lᵀ,     S, C symmetric positive definite,  Σ = diag(+1 …, −1 …)
//
// Such a matrix has this factor for every order of its rows (Vanderbei 1995, SIAM J. Optim. 5:100); here the
// rows of S come first, so that every pivot is one of a definite Schur complement. With ℓ_q = Σ L⁻¹ b_q and
// ℓ_r = Σ L⁻¹ b_r as two more rows of L,
//     x = A⁻¹ (b_q + θ b_r) = L⁻ᵀ (ℓ_q + θ ℓ_r),     b_r · x = ℓ_r · Σ (ℓ_q + θ ℓ_r).
//
// Left-looking, four columns at a time; the size is filled up to a multiple of four with rows of the unit
// matrix.

#include <span>
#include <vector>

namespace strainwave {

class SignedFactor {
public:
  /// Room for n rows.
  void reset(int n);
  /// rows[p] of the n × n column-major matrix `a` (leading dimension `stride`), b_q and b_r by the same
  /// index; the first `positive` rows belong to S. False: a pivot has the wrong sign.
  bool factorize(const double* a, std::size_t stride, std::span<const int> rows, int positive,
                 const double* b_q, const double* b_r);
  double r_r() const { return r_r_; } ///< b_r · A⁻¹ b_r
  double r_q() const { return r_q_; } ///< b_r · A⁻¹ b_q
  /// x = A⁻¹ (b_q + θ b_r) by position.
  void solve(double rotation, double* x) const;

private:
  double* column(int j) { return storage_ + static_cast<std::size_t>(j) * stride_; }
  const double* column(int j) const { return storage_ + static_cast<std::size_t>(j) * stride_; }
  void update(int first);
  bool finish(int first);

  int capacity_ = 0, size_ = 0, padded_ = 0;
  std::size_t stride_ = 0;
  std::vector<double> memory_, sign_, inverse_;
  std::vector<double> lq_, lr_;
  double* storage_ = nullptr;
  double r_r_ = 0.0, r_q_ = 0.0;
};

} // namespace strainwave
