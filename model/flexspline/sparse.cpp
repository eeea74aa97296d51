#include "model/flexspline/sparse.hpp"

#include "model/flexspline/blas.hpp"
#include "model/gear/memory.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <new>
#include <stdexcept>

#include <cholmod.h>
#include <fmt/format.h>

namespace strainwave {

struct SparseCholesky::Content {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;

  Content() {
    openblas_set_num_threads(1);
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
    common.print = 0;
    common.error_handler = nullptr;
  }
  ~Content() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  void check(const char* what) const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY)
      throw std::bad_alloc();
    if (common.status == CHOLMOD_TOO_LARGE)
      throw OutOfMemory("the factor of the stiffness matrix has more than 2^31 numbers; take a coarser [mesh]");
    if (common.status == CHOLMOD_NOT_POSDEF)
      throw NotPositiveStiffness(fmt::format("pivot {} of {} of the sector's stiffness is not positive",
                                             factor ? factor->minor + 1 : 0, factor ? factor->n : 0));
    if (common.status < CHOLMOD_OK)
      throw std::logic_error(fmt::format("CHOLMOD failed in {} ({})", what, common.status));
  }
  Eigen::MatrixXd solve(int system, const Eigen::MatrixXd& b) {
    cholmod_dense view{};
    view.nrow = static_cast<std::size_t>(b.rows());
    view.ncol = static_cast<std::size_t>(b.cols());
    view.nzmax = view.nrow * view.ncol;
    view.d = view.nrow;
    view.x = const_cast<double*>(b.data()); // CHOLMOD reads it only
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_solve(system, factor, &view, &common);
    if (x == nullptr)
      check("solve");
    Eigen::MatrixXd result =
        Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), b.rows(), b.cols());
    cholmod_free_dense(&x, &common);
    return result;
  }
};

void SparseAssembly::add(const std::array<int, 60>& unknown, const Eigen::Matrix<double, 60, 60>& matrix) {
  for (int b = 0; b < 60; ++b) {
    const int ub = unknown[static_cast<std::size_t>(b)];
    if (ub < 0)
      continue;
    for (int a = 0; a <= b; ++a) {
      const int ua = unknown[static_cast<std::size_t>(a)];
      if (ua < 0)
        continue;
      // Equal unknowns of one element: both triangles fall on the diagonal.
      row.push_back(std::max(ua, ub));
      column.push_back(std::min(ua, ub));
      value.push_back(a != b && ua == ub ? 2.0 * matrix(a, b) : matrix(a, b));
    }
  }
}

SparseCholesky::SparseCholesky(const SparseAssembly& assembly, int inside)
    : content(std::make_unique<Content>()) {
  cholmod_common* common = &content->common;
  const auto n = static_cast<std::size_t>(assembly.size());
  cholmod_triplet triplet{};
  triplet.nrow = triplet.ncol = n;
  triplet.nnz = triplet.nzmax = assembly.value.size();
  triplet.i = const_cast<int*>(assembly.row.data());
  triplet.j = const_cast<int*>(assembly.column.data());
  triplet.x = const_cast<double*>(assembly.value.data());
  triplet.stype = -1;
  triplet.itype = CHOLMOD_INT;
  triplet.xtype = CHOLMOD_REAL;
  triplet.dtype = CHOLMOD_DOUBLE;
  cholmod_sparse* matrix = cholmod_triplet_to_sparse(&triplet, triplet.nnz, common);
  if (matrix == nullptr)
    content->check("gathering the matrix");
  if (inside >= 0) {
    std::vector<int> member(n, 0), order(n);
    std::fill(member.begin() + inside, member.end(), 1);
    cholmod_camd(matrix, nullptr, 0, member.data(), order.data(), common);
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    content->factor = cholmod_analyze_p(matrix, order.data(), nullptr, 0, common);
  } else {
    content->factor = cholmod_analyze(matrix, common);
  }
  if (content->factor != nullptr)
    cholmod_factorize(matrix, content->factor, common);
  cholmod_free_sparse(&matrix, common);
  content->check("the factorization");
}

SparseCholesky::~SparseCholesky() = default;

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& b) const {
  return content->solve(CHOLMOD_A, b);
}

Eigen::MatrixXd SparseCholesky::forward(const Eigen::MatrixXd& b) const {
  return content->solve(CHOLMOD_L, content->solve(CHOLMOD_P, b));
}

std::vector<int> SparseCholesky::order() const {
  const int* perm = static_cast<const int*>(content->factor->Perm);
  return {perm, perm + content->factor->n};
}

Eigen::MatrixXd SparseCholesky::last_block(int first) const {
  const cholmod_factor& f = *content->factor;
  const int n = static_cast<int>(f.n), size = n - first;
  for (int at = first; at < n; ++at)
    if (static_cast<const int*>(f.Perm)[at] < first)
      throw std::logic_error("the factor's order mixes inside and boundary");
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  const int* super = static_cast<const int*>(f.super);
  const int* row_start = static_cast<const int*>(f.pi);
  const int* value_start = static_cast<const int*>(f.px);
  const int* rows = static_cast<const int*>(f.s);
  const double* values = static_cast<const double*>(f.x);
  for (std::size_t s = 0; s < f.nsuper; ++s) {
    if (super[s + 1] <= first)
      continue;
    const int height = row_start[s + 1] - row_start[s];
    for (int c = std::max(super[s], first); c < super[s + 1]; ++c)
      for (int r = 0; r < height; ++r) {
        const int to = rows[row_start[s] + r];
        if (to >= c)
          block(to - first, c - first) = values[value_start[s] + r + (c - super[s]) * height];
      }
  }
  return block;
}

double SparseCholesky::fill() const {
  return static_cast<double>(content->factor->xsize);
}

} // namespace strainwave
