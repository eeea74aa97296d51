#include "strainwave/model/flexspline/harmonics.hpp"

#include "strainwave/model/flexspline/blas.hpp"
#include "strainwave/model/flexspline/sparse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace strainwave {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Harmonics in which the cup moves most: axially and about its axis, tilt, the oval, the clover.
constexpr int refined_harmonics = 4;

std::vector<Index> functionals_with_next(const std::vector<Functional>& functionals) {
  std::vector<Index> result;
  for (std::size_t a = 0; a < functionals.size(); ++a)
    if (!functionals[a].next.dof.empty())
      result.push_back(static_cast<Index>(a));
  return result;
}

std::vector<const SectorWeights*> sector_loads(const std::vector<Functional>& functionals) {
  std::vector<const SectorWeights*> loads;
  for (const Functional& functional : functionals)
    loads.push_back(&functional.here);
  for (const Index a : functionals_with_next(functionals))
    loads.push_back(&functionals[static_cast<std::size_t>(a)].next);
  return loads;
}

} // namespace

HarmonicSolver::HarmonicSolver(const SectorMesh& mesh, const Material& material,
                               const std::vector<Functional>& functionals)
    : sectors(mesh.sectors), count(static_cast<Index>(functionals.size())),
      with_next(functionals_with_next(functionals)), sector(mesh, material, sector_loads(functionals)) {
  const auto n = static_cast<Index>(sector.boundary.size());
  const auto sign = [&](Index p) {
    return sector.boundary[static_cast<std::size_t>(p)] % 3 == 1 ? -1.0 : 1.0;
  };
  const MatrixXd& s = sector.stiffness;
  const double scale = s.cwiseAbs().maxCoeff();
  double unevenness = 0.0;
  base = even = odd = MatrixXd::Zero(n, n);
  for (Index q = 0; q < n; ++q)
    for (Index p = q; p < n; ++p) {
      const double both = sign(p) * sign(q);
      const double left = s(p, q), right = s(n + p, n + q), across = s(p, n + q), back = s(n + p, q);
      unevenness = std::max({unevenness, std::fabs(right - both * left), std::fabs(back - both * across)});
      if (both > 0.0) {
        base(p, q) = left + right;
        even(p, q) = across + back;
      } else {
        odd(p, q) = sign(p) > 0.0 ? back - across : across - back;
      }
    }
  if (unevenness > 1e-7 * scale && unevenness < 1e-4 * scale) // rounding; an uneven mesh shows more
    throw NotPositiveStiffness(fmt::format("rounding makes the sector uneven by {:.1e}", unevenness / scale));
  if (unevenness > 1e-7 * scale)
    throw std::logic_error(fmt::format("the sector is not its own mirror image (relative difference {:.1e})",
                                       unevenness / scale));
}

HarmonicResponse HarmonicSolver::response(int harmonic) const {
  const Wave wave = wave_of(harmonic);
  const MatrixXd lower = factor(harmonic, wave), y = forward(lower, wave);
  if (harmonic < refined_harmonics) {
    const Columns columns = displaced(lower, y, wave);
    return hermitian(sector.energy(columns.force, columns.boundary));
  }
  const int n = static_cast<int>(y.rows()), columns = static_cast<int>(y.cols());
  const double one = 1.0, zero = 0.0;
  MatrixXd product(columns, columns);
  dsyrk_("L", "T", &columns, &n, &one, y.data(), &n, &zero, product.data(), &columns);
  product.triangularView<Eigen::StrictlyUpper>() = product.transpose();
  const HarmonicResponse outside = hermitian(product), within = inside(wave);
  return {outside.real + within.real, outside.imaginary + within.imaginary};
}

HarmonicSolver::Wave HarmonicSolver::wave_of(int harmonic) const {
  const double alpha = 2.0 * std::numbers::pi * harmonic / sectors;
  return {std::cos(alpha), std::sin(alpha)};
}

/// Lower Cholesky factor of Dᴴ K_h D.
MatrixXd HarmonicSolver::factor(int harmonic, const Wave& wave) const {
  MatrixXd lower = base + wave.cosine * even + wave.sine * odd;
  const int n = static_cast<int>(lower.rows());
  int info = 0;
  dpotrf_("L", &n, lower.data(), &n, &info);
  if (info != 0)
    throw NotPositiveStiffness(
        fmt::format("pivot {} of {} of the ring's harmonic {} is not positive", info, n, harmonic));
  return lower;
}

/// Y = L⁻¹ Dᴴ (f̂_l + e^{−iα} f̂_r): real parts in the first columns, imaginary parts behind them.
MatrixXd HarmonicSolver::forward(const MatrixXd& lower, const Wave& wave) const {
  const auto [cosine, sine] = wave;
  const int n = static_cast<int>(lower.rows()), columns = static_cast<int>(2 * count);
  MatrixXd y(n, 2 * count);
  const auto parts = static_cast<Index>(with_next.size());
  const MatrixXd real = sector.load.topRows(n) + cosine * sector.load.bottomRows(n);
  const MatrixXd imaginary = -sine * sector.load.bottomRows(n);
  y.leftCols(count) = real.leftCols(count);
  y.rightCols(count) = imaginary.leftCols(count);
  for (Index p = 0; p < parts; ++p) { // times e^{−iα}
    const Index a = with_next[static_cast<std::size_t>(p)];
    y.col(a) += cosine * real.col(count + p) + sine * imaginary.col(count + p);
    y.col(count + a) += cosine * imaginary.col(count + p) - sine * real.col(count + p);
  }
  for (Index p = 0; p < n; ++p)
    if (circumferential(p)) { // Dᴴ: times −i
      const Eigen::RowVectorXd old = y.row(p).head(count);
      y.row(p).head(count) = y.row(p).tail(count);
      y.row(p).tail(count) = -old;
    }
  const double one = 1.0;
  dtrsm_("L", "L", "N", "N", &n, &columns, &one, lower.data(), &n, y.data(), &n);
  return y;
}

/// f̂ and, from Y, û on both boundaries.
HarmonicSolver::Columns HarmonicSolver::displaced(const MatrixXd& lower, MatrixXd x, const Wave& wave) const {
  const auto [cosine, sine] = wave;
  const int n = static_cast<int>(x.rows()), columns = static_cast<int>(x.cols());
  const double one = 1.0;
  dtrsm_("L", "L", "T", "N", &n, &columns, &one, lower.data(), &n, x.data(), &n);
  for (Index p = 0; p < n; ++p)
    if (circumferential(p)) { // D: times i
      const Eigen::RowVectorXd old = x.row(p).head(count);
      x.row(p).head(count) = -x.row(p).tail(count);
      x.row(p).tail(count) = old;
    }
  MatrixXd boundary(2 * n, columns);
  boundary.topRows(n) = x;
  boundary.bottomRows(n).leftCols(count) = cosine * x.leftCols(count) - sine * x.rightCols(count);
  boundary.bottomRows(n).rightCols(count) = sine * x.leftCols(count) + cosine * x.rightCols(count);
  MatrixXd force = MatrixXd::Zero(sector.loads.rows(), columns);
  force.leftCols(count) = sector.loads.leftCols(count);
  for (std::size_t p = 0; p < with_next.size(); ++p) {
    const auto next = sector.loads.col(count + static_cast<Index>(p));
    force.col(with_next[p]) += cosine * next;
    force.col(count + with_next[p]) -= sine * next;
  }
  return {force, boundary};
}

/// Zᴴ Z from the product of its real and imaginary columns with themselves.
HarmonicResponse HarmonicSolver::hermitian(const MatrixXd& product) const {
  return {product.topLeftCorner(count, count) + product.bottomRightCorner(count, count),
          product.topRightCorner(count, count) - product.bottomLeftCorner(count, count)};
}

/// f̂ᴴ W f̂ with f̂ = here + e^{−iα} next.
HarmonicResponse HarmonicSolver::inside(const Wave& wave) const {
  const auto [cosine, sine] = wave;
  const MatrixXd& w = sector.inside;
  HarmonicResponse g = {w.topLeftCorner(count, count), MatrixXd::Zero(count, count)};
  const auto parts = static_cast<Index>(with_next.size());
  for (Index p = 0; p < parts; ++p) {
    const Index a = with_next[static_cast<std::size_t>(p)];
    g.real.row(a) += cosine * w.row(count + p).head(count); // conj(e^{−iα}) on the response's side
    g.imaginary.row(a) += sine * w.row(count + p).head(count);
    g.real.col(a) += cosine * w.col(count + p).head(count);
    g.imaginary.col(a) -= sine * w.col(count + p).head(count);
    for (Index q = 0; q < parts; ++q)
      g.real(a, with_next[static_cast<std::size_t>(q)]) += w(count + p, count + q);
  }
  return g;
}

} // namespace strainwave
