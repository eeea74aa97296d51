#include "strainwave/model/flexspline/sparse.hpp"

#include "strainwave/common/core/memory.hpp"
#include "strainwave/model/flexspline/blas.hpp"

#include <algorithm>
#include <cmath>
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
    common.supernodal = STRAINWAVE_GPL ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL; // docs/licences.md
    common.final_ll = 1;
    common.print = 0;
    common.error_handler = nullptr;
  }
  ~Content() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  void check(const cholmod_common& state, const char* what) const {
    if (state.status == CHOLMOD_OUT_OF_MEMORY)
      throw std::bad_alloc();
    if (state.status == CHOLMOD_TOO_LARGE)
      throw OutOfMemory(
          "the factor of the stiffness matrix has more than 2^31 numbers; take a coarser [mesh]");
    if (state.status == CHOLMOD_NOT_POSDEF || (factor != nullptr && factor->minor < factor->n))
      throw NotPositiveStiffness(fmt::format("pivot {} of {} of the sector's stiffness is not positive",
                                             factor ? factor->minor : 0, factor ? factor->n : 0));
    if (state.status < CHOLMOD_OK)
      throw std::logic_error(fmt::format("CHOLMOD failed in {} ({})", what, state.status));
  }
  /// Several threads may solve at once: the factor is only read, the workspace is each call's own.
  Eigen::MatrixXd solve(int system, const Eigen::MatrixXd& b) const {
    struct Workspace : cholmod_common {
      Workspace() : cholmod_common{} { cholmod_start(this); }
      ~Workspace() { cholmod_finish(this); }
    } workspace;
    workspace.print = 0;
    cholmod_dense view{};
    view.nrow = static_cast<std::size_t>(b.rows());
    view.ncol = static_cast<std::size_t>(b.cols());
    view.nzmax = view.nrow * view.ncol;
    view.d = view.nrow;
    view.x = const_cast<double*>(b.data()); // CHOLMOD reads it only
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_solve(system, factor, &view, &workspace);
    if (x == nullptr)
      check(workspace, "a solve");
    Eigen::MatrixXd result =
        Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), b.rows(), b.cols());
    cholmod_free_dense(&x, &workspace);
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

Eigen::MatrixXd residual(const SparseAssembly& k, const Eigen::MatrixXd& f, const Eigen::MatrixXd& u) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor x = u;
  RowMajor high = f, low = RowMajor::Zero(f.rows(), f.cols());
  const Eigen::Index columns = f.cols();
  const auto subtract = [&](Eigen::Index row, double factor, Eigen::Index from) {
    double* h = &high(row, 0);
    double* l = &low(row, 0);
    const double* at = &x(from, 0);
    for (Eigen::Index c = 0; c < columns; ++c) {
      const double p = -factor * at[c], lost = std::fma(-factor, at[c], -p);
      const double sum = h[c] + p, back = sum - h[c];
      l[c] += (h[c] - (sum - back)) + (p - back) + lost;
      h[c] = sum;
    }
  };
  for (std::size_t n = 0; n < k.value.size(); ++n) {
    subtract(k.row[n], k.value[n], k.column[n]);
    if (k.row[n] != k.column[n])
      subtract(k.column[n], k.value[n], k.row[n]);
  }
  return high + low;
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
    content->check(*common, "gathering the matrix");
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
  const cholmod_common after = *common; // freeing resets the status
  cholmod_free_sparse(&matrix, common);
  content->check(after, "the factorization");
}

SparseCholesky::~SparseCholesky() = default;

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& b) const {
  return content->solve(CHOLMOD_A, b);
}

Eigen::MatrixXd SparseCholesky::forward(const Eigen::MatrixXd& b) const {
  return content->solve(CHOLMOD_L, content->solve(CHOLMOD_P, b));
}

Eigen::MatrixXd SparseCholesky::solve_inside(const Eigen::MatrixXd& b) const {
  const auto size = static_cast<Eigen::Index>(content->factor->n), inside = b.rows();
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(size, b.cols());
  x.topRows(inside) = b;
  x = forward(x);
  x.bottomRows(size - inside).setZero();
  return content->solve(CHOLMOD_Pt, content->solve(CHOLMOD_Lt, x)).topRows(inside);
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
  if (!f.is_super) {
    const int* start = static_cast<const int*>(f.p);
    const int* height = static_cast<const int*>(f.nz);
    const int* row = static_cast<const int*>(f.i);
    const double* value = static_cast<const double*>(f.x);
    for (int c = first; c < n; ++c)
      for (int k = start[c]; k < start[c] + height[c]; ++k)
        block(row[k] - first, c - first) = value[k];
    return block;
  }
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
  return static_cast<double>(content->factor->is_super ? content->factor->xsize : content->factor->nzmax);
}

} // namespace strainwave
