#pragma once
// A sparse symmetric matrix gathered from elements, and its Cholesky factor L Lᵀ = P A Pᵀ by CHOLMOD
// (supernodal).
//
// Each factor owns its cholmod_common, so factors in different threads are independent. BLAS runs on one
// thread; the program is parallel over harmonics and evaluations instead.

#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>

namespace strainwave {

/// A pivot that should be positive is not: a stiffness spread wider than double precision holds.
struct NotPositiveStiffness : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Lower triangle of a symmetric n × n matrix, as sums of entries.
class SparseAssembly {
public:
  explicit SparseAssembly(int size) : n(size) {}
  int size() const { return n; }
  /// Adds a symmetric element matrix; unknown −1 leaves its row and column out.
  void add(const std::array<int, 60>& unknown, const Eigen::Matrix<double, 60, 60>& matrix);

  std::vector<int> row, column;
  std::vector<double> value;

private:
  int n;
};

/// f − K u, accumulated in twice the working precision: every sum is an unevaluated pair of doubles (Dekker
/// 1971: two-sum, and two-product by fused multiply-add).
Eigen::MatrixXd residual(const SparseAssembly& k, const Eigen::MatrixXd& f, const Eigen::MatrixXd& u);

class SparseCholesky {
public:
  /// `inside`: the unknowns from this one on are kept last in the order; −1: any order that keeps L sparse
  /// (METIS or AMD). Throws NotPositiveStiffness when the matrix is not positive definite, std::bad_alloc
  /// without memory.
  explicit SparseCholesky(const SparseAssembly& assembly, int inside = -1);
  ~SparseCholesky();
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  /// A⁻¹ b for every column.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// Solution of the first b.rows() unknowns with all others held at zero; they must be the ones kept inside.
  Eigen::MatrixXd solve_inside(const Eigen::MatrixXd& b) const;
  /// L⁻¹ P b: rows in the factor's order.
  Eigen::MatrixXd forward(const Eigen::MatrixXd& b) const;
  /// order()[row of the factor] = unknown.
  std::vector<int> order() const;
  /// Lower triangle of L from row and column `first` on, dense.
  Eigen::MatrixXd last_block(int first) const;
  /// Entries of L that are stored.
  double fill() const;

private:
  struct Content;
  std::unique_ptr<Content> content;
};

} // namespace strainwave
