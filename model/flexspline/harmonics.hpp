#pragma once
// One harmonic of the ring at a time: factor, displacements, responses. The formulas stand in cyclic.hpp.
//
// Complex columns are kept as real matrices: real parts of all functionals first, imaginary parts behind
// them.

#include "strainwave/model/flexspline/condensation.hpp"
#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/flexspline/mesh.hpp"

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace strainwave {

/// G_h as real and imaginary part.
struct HarmonicResponse {
  Eigen::MatrixXd real, imaginary;
};

class HarmonicSolver {
public:
  /// Throws NotPositiveStiffness when the sector is not positive definite, std::logic_error when it is not
  /// its own mirror image.
  HarmonicSolver(const SectorMesh& mesh, const Material& material,
                 const std::vector<Functional>& functionals);

  /// G_h of all functionals; any number of threads may call this at once.
  HarmonicResponse response(int harmonic) const;

private:
  struct Wave {
    double cosine, sine; ///< of α = 2πh/N
  };
  struct Columns {
    Eigen::MatrixXd force;    ///< f̂ on all unknowns
    Eigen::MatrixXd boundary; ///< û on both boundaries
  };
  Wave wave_of(int harmonic) const;
  Eigen::MatrixXd factor(int harmonic, const Wave& wave) const;
  Eigen::MatrixXd forward(const Eigen::MatrixXd& lower, const Wave& wave) const;
  Columns displaced(const Eigen::MatrixXd& lower, Eigen::MatrixXd y, const Wave& wave) const;
  HarmonicResponse hermitian(const Eigen::MatrixXd& product) const;
  HarmonicResponse inside(const Wave& wave) const;
  bool circumferential(Eigen::Index p) const { return sector.boundary[static_cast<std::size_t>(p)] % 3 == 1; }

  int sectors;
  Eigen::Index count; ///< functionals
  /// Functionals with a part on the next sector; these parts are the loads behind the others.
  std::vector<Eigen::Index> with_next;
  CondensedSector sector;
  Eigen::MatrixXd base, even, odd; ///< Dᴴ K_h D = base + cos α · even + sin α · odd, lower triangles
};

} // namespace strainwave
