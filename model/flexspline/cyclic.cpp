#include "strainwave/model/flexspline/cyclic.hpp"

#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/model/flexspline/blas.hpp"
#include "strainwave/model/flexspline/harmonics.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace strainwave {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// 2π h k / N, the product reduced to one turn.
double harmonic_angle(int h, int k, int sectors) {
  const long turns = static_cast<long>(h) * k % sectors;
  return 2.0 * std::numbers::pi * static_cast<double>(turns) / sectors;
}

/// Weight of a harmonic in the inverse transform; those of 0 < h < N/2 stand for N − h too.
double harmonic_share(int h, int sectors) {
  return (h == 0 || 2 * h == sectors ? 1.0 : 2.0) / sectors;
}

/// cos and −sin of 2π h k/N: real parts of e^{iαk} (real + i imaginary), one column a sector.
MatrixXd inverse_waves(int sectors) {
  const int harmonics = sectors / 2 + 1;
  MatrixXd waves(2 * harmonics, sectors);
  for (int k = 0; k < sectors; ++k)
    for (int h = 0; h < harmonics; ++h) {
      waves(h, k) = std::cos(harmonic_angle(h, k, sectors));
      waves(harmonics + h, k) = -std::sin(harmonic_angle(h, k, sectors));
    }
  return waves;
}

} // namespace

std::vector<double> cyclic_responses(const SectorMesh& mesh, const Material& material,
                                     const std::vector<Functional>& functionals, int threads) {
  openblas_set_num_threads(1);
  const HarmonicSolver solver(mesh, material, functionals);
  const int sectors = mesh.sectors, harmonics = sectors / 2 + 1;
  const int square = static_cast<int>(functionals.size() * functionals.size());

  // Row-major G_h in the columns, real parts then imaginary parts, with the weights of the inverse transform.
  const int terms = 2 * harmonics;
  MatrixXd spectrum(square, terms);
  parallel_for(static_cast<std::size_t>(harmonics), threads, [&](std::size_t index) {
    const int h = static_cast<int>(index);
    const HarmonicResponse g = solver.response(h);
    const double share = harmonic_share(h, sectors);
    const MatrixXd real = share * g.real.transpose(), imaginary = share * g.imaginary.transpose();
    spectrum.col(h) = real.reshaped();
    spectrum.col(harmonics + h) = imaginary.reshaped();
  });
  const MatrixXd waves = inverse_waves(sectors);
  std::vector<double> data(static_cast<std::size_t>(square) * static_cast<std::size_t>(sectors));
  const double one = 1.0, zero = 0.0;
  dgemm_("N", "N", &square, &sectors, &terms, &one, spectrum.data(), &square, waves.data(), &terms, &zero,
         data.data(), &square);
  return data;
}

} // namespace strainwave
