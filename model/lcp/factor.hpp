#pragma once
// Cholesky factor of M_AA for a closed set A that changes one index at a time.
//
//     M_AA = L Lᵀ,    y_q = L⁻¹ q_A,    y_r = L⁻¹ r_A
//
// The two right-hand sides of contact ride along as extra rows of the factor, so that the torque needs no
// back-substitution:
//     r · M⁻¹ r = |y_r|²,   r · M⁻¹ q = y_r · y_q.
//
// factorize(): fresh, k³/6 multiplications, left-looking with four columns at a time (each number of L that
// is loaded is used four times). append(): one forward substitution, k²/2. remove(): a rank-one update of the
// trailing block, k² (Golub, Van Loan, Matrix Computations, section 6.5.4). Column-major, leading dimension a
// multiple of 8 numbers.

#include <Eigen/Dense>

#include <span>
#include <stdexcept>
#include <vector>

namespace strainwave {

/// gap(θ) = q − θ r + M z. Only M, q, r: no state.
struct ContactProblem {
  Eigen::MatrixXd m; ///< mm/N, n × n, symmetric positive definite
  Eigen::VectorXd q; ///< mm, n
  Eigen::VectorXd r; ///< mm, n; > 0 drive flank, < 0 coast flank, 0 support
  int size() const { return static_cast<int>(q.size()); }
};

/// The contact matrix has a pivot that is not positive: what was handed over is no compliance.
class NotPositiveDefinite : public std::runtime_error {
public:
  NotPositiveDefinite(int index_in, double pivot_in);
  int index;    ///< of the contact problem
  double pivot; ///< mm/N
};

class ActiveFactor {
public:
  /// Room for n indices; keeps what it has when that is enough. Empties the set.
  void reset(int n);
  /// Fresh factor of the given indices, in the given order.
  void factorize(const ContactProblem& problem, std::span<const int> set);
  void append(const ContactProblem& problem, int index);
  void remove(int position);

  int size() const { return size_; }
  /// Index of the contact problem at each position.
  std::span<const int> order() const { return {order_.data(), static_cast<std::size_t>(size_)}; }
  double r_r() const; ///< r · M⁻¹ r, N·mm/rad
  double r_q() const; ///< r · M⁻¹ q
  /// x = M_AA⁻¹ (weight_q q_A + weight_r r_A), by position.
  void solve(double weight_q, double weight_r, double* x) const;
  /// Forces and their rates at a rotation: M_AA⁻¹ (θ r_A − q_A) and M_AA⁻¹ r_A, by position.
  void solve(double rotation, double* force, double* rate) const;
  /// Solves M_AA x = b in place, by position.
  void solve(double* b) const;

private:
  double* column(int j) { return storage_ + static_cast<std::size_t>(j) * stride_; }
  const double* column(int j) const { return storage_ + static_cast<std::size_t>(j) * stride_; }
  static double root_of_pivot(int index, double pivot, double diagonal);
  template <int Columns>
  void update_columns(int first, int rows);
  template <int Columns>
  void finish_columns(int first, int rows);
  void forward_substitute(double* x) const;
  template <std::size_t Sides>
  void back_substitute(double* const (&x)[Sides]) const;

  int capacity_ = 0, size_ = 0;
  std::size_t stride_ = 0;
  std::vector<double> memory_;
  double* storage_ = nullptr; ///< 64-byte aligned start inside memory_
  std::vector<double> inverse_diagonal_, yq_, yr_, work_;
  std::vector<int> order_;
};

/// out = base + Σ_p x_p M(:, order_p); all n rows. Four columns at a time.
void add_columns(const Eigen::MatrixXd& m, std::span<const int> order, const double* x, const double* base,
                 double* out);

/// The same for two vectors, reading M once: out_x += Σ x_p M(:, order_p), out_y += Σ y_p M(:, order_p).
void add_columns(const Eigen::MatrixXd& m, std::span<const int> order, const double* x, const double* y,
                 double* out_x, double* out_y);

} // namespace strainwave
