#include "model/flexspline/cyclic.hpp"

#include "model/flexspline/blas.hpp"
#include "model/flexspline/harmonics.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <thread>

#include <Eigen/Core>

namespace strainwave {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Runs work(0 … count − 1) on several threads (0: as many as cores); the first exception is thrown again
/// here.
template <class Work>
void parallel_for(int count, int threads, const Work& work) {
  if (threads <= 0)
    threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
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
  parallel_for(harmonics, threads, [&](int h) {
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

std::vector<Point> ring_displacements(const SectorMesh& mesh, const Material& material,
                                      const std::vector<Functional>& functionals,
                                      const std::vector<RingLoad>& loads, int threads) {
  openblas_set_num_threads(1);
  const HarmonicSolver solver(mesh, material, functionals);
  const int sectors = mesh.sectors, harmonics = sectors / 2 + 1;
  const auto count = static_cast<Index>(functionals.size());
  int unknowns = 0;
  for (const int unknown : solver.unknown())
    unknowns = std::max(unknowns, unknown + 1);

  // û_h in the columns, then û^(j) = (1/N) Σ_h û_h e^{iαj} for the sectors j.
  const int terms = 2 * harmonics;
  MatrixXd spectrum(unknowns, terms);
  parallel_for(harmonics, threads, [&](int h) {
    Eigen::VectorXd real = Eigen::VectorXd::Zero(count), imaginary = real;
    for (const RingLoad& load : loads) { // f̂_h = Σ_j f^(j) e^{−iαj}
      const double angle = harmonic_angle(h, load.sector, sectors);
      real[static_cast<Index>(load.functional)] += load.factor * std::cos(angle);
      imaginary[static_cast<Index>(load.functional)] -= load.factor * std::sin(angle);
    }
    const MatrixXd u = solver.displacement(h, real, imaginary);
    spectrum.col(h) = harmonic_share(h, sectors) * u.col(0);
    spectrum.col(harmonics + h) = harmonic_share(h, sectors) * u.col(1);
  });
  const MatrixXd waves = inverse_waves(sectors);
  MatrixXd displacement(unknowns, sectors);
  const double one = 1.0, zero = 0.0;
  dgemm_("N", "N", &unknowns, &sectors, &terms, &one, spectrum.data(), &unknowns, waves.data(), &terms, &zero,
         displacement.data(), &unknowns);

  std::vector<Point> result(mesh.ring_nodes());
  for (int j = 0; j < sectors; ++j)
    for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
      if (mesh.ring_index[static_cast<std::size_t>(node)] < 0)
        continue;
      double u[3];
      for (int c = 0; c < 3; ++c) {
        const int unknown = solver.unknown()[static_cast<std::size_t>(3 * node + c)];
        u[c] = unknown < 0 ? 0.0 : displacement(unknown, j);
      }
      const double angle = mesh.angle(node, j), cosine = std::cos(angle), sine = std::sin(angle);
      result[static_cast<std::size_t>(mesh.ring_node(node, j))] = {cosine * u[0] - sine * u[1],
                                                                   sine * u[0] + cosine * u[1], u[2]};
    }
  return result;
}

} // namespace strainwave
