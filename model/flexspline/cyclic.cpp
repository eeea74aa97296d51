#include "model/flexspline/cyclic.hpp"

#include "model/flexspline/blas.hpp"
#include "model/flexspline/condensation.hpp"
#include "model/flexspline/sparse.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <thread>

#include <Eigen/Core>
#include <fmt/format.h>

namespace strainwave {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Dᴴ K_h D = base + cos α · even + sin α · odd.
struct HarmonicPencil {
  MatrixXd base, even, odd;
};

HarmonicPencil mirror_pencil(const CondensedSector& sector) {
  const auto n = static_cast<Index>(sector.boundary.size());
  const auto sign = [&](Index p) {
    return sector.boundary[static_cast<std::size_t>(p)] % 3 == 1 ? -1.0 : 1.0;
  };
  const MatrixXd& s = sector.stiffness;
  const double scale = s.cwiseAbs().maxCoeff();
  double unevenness = 0.0;
  HarmonicPencil pencil = {MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  for (Index q = 0; q < n; ++q)
    for (Index p = q; p < n; ++p) {
      const double both = sign(p) * sign(q);
      const double left = s(p, q), right = s(n + p, n + q), across = s(p, n + q), back = s(n + p, q);
      unevenness = std::max({unevenness, std::fabs(right - both * left), std::fabs(back - both * across)});
      if (both > 0.0) {
        pencil.base(p, q) = left + right;
        pencil.even(p, q) = across + back;
      } else {
        pencil.odd(p, q) = sign(p) > 0.0 ? back - across : across - back;
      }
    }
  if (unevenness > 1e-9 * scale)
    throw std::logic_error(fmt::format("the sector is not its own mirror image (relative difference {:.1e})",
                                       unevenness / scale));
  return pencil;
}

/// G_h as real and imaginary part.
struct HarmonicResponse {
  MatrixXd real, imaginary;
};

class HarmonicSolver {
public:
  HarmonicSolver(const SectorMesh& mesh_in, const Material& material,
                 const std::vector<Functional>& functionals)
      : mesh(mesh_in), count(static_cast<Index>(functionals.size())) {
    std::vector<const SectorWeights*> loads;
    for (const Functional& functional : functionals)
      loads.push_back(&functional.here);
    for (std::size_t a = 0; a < functionals.size(); ++a)
      if (!functionals[a].next.dof.empty()) {
        loads.push_back(&functionals[a].next);
        with_next.push_back(static_cast<Index>(a));
      }
    sector = condense(mesh, material, loads);
    pencil = mirror_pencil(sector);
  }

  HarmonicResponse solve(int harmonic) const {
    const double alpha = 2.0 * std::numbers::pi * harmonic / mesh.sectors;
    const double cosine = std::cos(alpha), sine = std::sin(alpha);
    MatrixXd stiffness = pencil.base + cosine * pencil.even + sine * pencil.odd;
    const int n = static_cast<int>(stiffness.rows()), columns = static_cast<int>(2 * count);
    int info = 0;
    dpotrf_("L", &n, stiffness.data(), &n, &info);
    if (info != 0)
      throw NotPositiveStiffness(fmt::format("pivot {} of {} of the ring's harmonic {} is not positive", info, n,
                                             harmonic));

    // Real parts in the first columns, imaginary parts behind them.
    MatrixXd y(n, 2 * count);
    const auto parts = static_cast<Index>(with_next.size());
    MatrixXd real = sector.load.topRows(n) + cosine * sector.load.bottomRows(n);
    MatrixXd imaginary = -sine * sector.load.bottomRows(n);
    y.leftCols(count) = real.leftCols(count);
    y.rightCols(count) = imaginary.leftCols(count);
    for (Index p = 0; p < parts; ++p) { // times e^{−iα}
      const Index a = with_next[static_cast<std::size_t>(p)];
      y.col(a) += cosine * real.col(count + p) + sine * imaginary.col(count + p);
      y.col(count + a) += cosine * imaginary.col(count + p) - sine * real.col(count + p);
    }
    for (Index p = 0; p < n; ++p) // Dᴴ: times −i on circumferential rows
      if (sector.boundary[static_cast<std::size_t>(p)] % 3 == 1) {
        const Eigen::RowVectorXd old = y.row(p).head(count);
        y.row(p).head(count) = y.row(p).tail(count);
        y.row(p).tail(count) = -old;
      }
    const double one = 1.0, zero = 0.0;
    dtrsm_("L", "L", "N", "N", &n, &columns, &one, stiffness.data(), &n, y.data(), &n);
    MatrixXd product(columns, columns);
    dsyrk_("L", "T", &columns, &n, &one, y.data(), &n, &zero, product.data(), &columns);
    product.triangularView<Eigen::StrictlyUpper>() = product.transpose();

    HarmonicResponse g = inside(cosine, sine);
    g.real += product.topLeftCorner(count, count) + product.bottomRightCorner(count, count);
    g.imaginary += product.topRightCorner(count, count) - product.bottomLeftCorner(count, count);
    return g;
  }

private:
  /// f̂ᴴ W f̂ with f̂ = here + e^{−iα} next.
  HarmonicResponse inside(double cosine, double sine) const {
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

  const SectorMesh& mesh;
  Index count;
  std::vector<Index>
      with_next; ///< functionals with a part on the next sector: their columns follow the others
  CondensedSector sector;
  HarmonicPencil pencil;
};

/// Runs work(0 … count − 1) on several threads; the first exception is thrown again here.
template <class Work>
void parallel_for(int count, int threads, const Work& work) {
  std::atomic<int> next = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto loop = [&] {
    try {
      for (int index = next++; index < count; index = next++)
        work(index);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure)
        failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> crew;
    for (int t = 1; t < std::min(threads, count); ++t)
      crew.emplace_back(loop);
    loop();
  }
  if (failure)
    std::rethrow_exception(failure);
}

} // namespace

std::vector<double> cyclic_responses(const SectorMesh& mesh, const Material& material,
                                     const std::vector<Functional>& functionals, int threads) {
  openblas_set_num_threads(1);
  if (threads <= 0)
    threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const HarmonicSolver solver(mesh, material, functionals);
  const int sectors = mesh.sectors, harmonics = sectors / 2 + 1;
  const int square = static_cast<int>(functionals.size() * functionals.size());

  // Row-major G_h in the columns, real parts then imaginary parts, with the weights of the inverse transform.
  const int terms = 2 * harmonics;
  MatrixXd spectrum(square, terms);
  parallel_for(harmonics, threads, [&](int h) {
    const HarmonicResponse g = solver.solve(h);
    const double share = (h == 0 || 2 * h == sectors ? 1.0 : 2.0) / sectors;
    const MatrixXd real = share * g.real.transpose(), imaginary = share * g.imaginary.transpose();
    spectrum.col(h) = real.reshaped();
    spectrum.col(harmonics + h) = imaginary.reshaped();
  });
  MatrixXd waves(terms, sectors);
  for (int k = 0; k < sectors; ++k)
    for (int h = 0; h < harmonics; ++h) {
      const double angle = 2.0 * std::numbers::pi * ((static_cast<long>(h) * k) % sectors) / sectors;
      waves(h, k) = std::cos(angle);
      waves(harmonics + h, k) = -std::sin(angle);
    }
  std::vector<double> data(static_cast<std::size_t>(square) * static_cast<std::size_t>(sectors));
  const double one = 1.0, zero = 0.0;
  dgemm_("N", "N", &square, &sectors, &terms, &one, spectrum.data(), &square, waves.data(), &terms, &zero,
         data.data(), &square);
  return data;
}

} // namespace strainwave
