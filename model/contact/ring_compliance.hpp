#pragma once
// The free cup as contact sees it: unit responses folded over equal lobes, with the wall's rows interpolated
// to where the discs are, and dense matrices for chosen teeth and wall stations.
//
// Folding: with an even number of sectors and both lobes alike, every load acts at φ and φ + π at once, so
// responses are G[k] + G[k + N/2] with period N/2. Otherwise nothing is folded and the period is N.
//
// Rows: cubic Lagrange interpolation P along the axis. The same weights spread a load over the rows and
// average the displacement, so PᵀGP stays symmetric and positive definite, and force and moment of a load are
// kept exactly.
//
// The cup is turned by the meshing phase s against the wave generator: tooth k stands at 2π(k + s)/N, station
// o of its sector at 2π(k + o + s)/N.

#include "strainwave/model/flexspline/unit_responses.hpp"

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace strainwave {

/// One point where the wall can touch the wave generator.
struct WallStation {
  int sector = 0;
  int station = 0; ///< index into UnitResponses::wall_offset
  int row = 0;     ///< index into RingCompliance::rows_mm
  double phi_rad = 0.0;
  double z_mm = 0.0;
};

/// Weights on the flank functionals of one sector: a tooth load at its own contact height and direction.
struct ToothFunctional {
  int sector = 0;
  std::vector<std::pair<int, double>> weights; ///< (functional index in UnitResponses, weight)
};

class RingCompliance {
public:
  /// rows_mm: where along the axis the wall may touch (ascending). fold: lobes alike (needs an even number of
  /// sectors).
  RingCompliance(const UnitResponses& responses, std::vector<double> rows_mm, bool fold);

  int sectors() const { return responses_->sectors; }
  int period() const { return period_; }
  bool folded() const { return period_ != responses_->sectors; }
  const std::vector<double>& rows_mm() const { return rows_; }
  const UnitResponses& responses() const { return *responses_; }

  /// Every station of the period at meshing phase s, angles in (−π/2, π/2] when folded, else (−π, π];
  /// ordered by angle, then row.
  std::vector<WallStation> stations(double phase) const;

  /// The flank functional of a tooth at a radius of the undeformed flank: linear between two heights (held at
  /// the ends), `circumferential` times the circumferential and `inwards` times the inward radial one, on one
  /// face slice or (−1) shared by all of them as their hats share the face. `side`: the flank it stands on;
  /// the directions are the same.
  ToothFunctional tooth(int sector, double radius_mm, double circumferential, double inwards, int slice = -1,
                        FlankSide side = FlankSide::drive) const;

  // Compliances, mm/N; `normal` columns are (radial, circumferential) components of a contact normal per
  // station. wall × wall: displacement along normal i from unit force along normal j.
  Eigen::MatrixXd wall_wall(std::span<const WallStation> stations, const Eigen::MatrixX2d& normal) const;
  void wall_wall(std::span<const WallStation> stations, const Eigen::MatrixX2d& normal,
                 Eigen::Ref<Eigen::MatrixXd> result) const;
  // wall × tooth, displacement along the normals from unit tooth loads (towards larger φ).
  Eigen::MatrixXd wall_tooth(std::span<const WallStation> stations, const Eigen::MatrixX2d& normal,
                             std::span<const ToothFunctional> teeth) const;
  /// Both components of the same: lines 2i (radial) and 2i + 1 (circumferential) for station i.
  Eigen::MatrixXd wall_components_of_teeth(std::span<const WallStation> stations,
                                           std::span<const ToothFunctional> teeth) const;
  Eigen::MatrixXd tooth_tooth(std::span<const ToothFunctional> teeth) const;

  /// Displacements of stations, columns (w, v), from wall forces (columns radial, circumferential; N) and
  /// tooth forces (towards larger φ; N).
  Eigen::MatrixX2d wall_displacement(std::span<const WallStation> at, std::span<const WallStation> loaded,
                                     const Eigen::MatrixX2d& wall_force,
                                     std::span<const ToothFunctional> teeth,
                                     const Eigen::VectorXd& tooth_force) const;

  /// Displacement of the teeth's functionals from forces on other ones (N, along the functionals).
  Eigen::VectorXd tooth_displacement(std::span<const ToothFunctional> of,
                                     std::span<const ToothFunctional> loaded,
                                     const Eigen::VectorXd& force) const;
  /// The same from wall forces (columns radial, circumferential; N).
  Eigen::VectorXd tooth_displacement(std::span<const ToothFunctional> teeth,
                                     std::span<const WallStation> loaded,
                                     const Eigen::MatrixX2d& wall_force) const;

  /// Displacement of the neutral surface under tooth centres at axial position z, from wall and tooth forces:
  /// columns radial, circumferential [mm], rotation about the axis, meridian tilt [rad]; one line per sector
  /// given.
  Eigen::MatrixX4d section(std::span<const int> at_sectors, double z_mm, std::span<const WallStation> loaded,
                           const Eigen::MatrixX2d& wall_force, std::span<const ToothFunctional> teeth,
                           const Eigen::VectorXd& tooth_force) const;

private:
  template <class Add>
  Eigen::VectorXd measured(std::span<const ToothFunctional> teeth, const Add& add) const;
  int wrapped(int k) const {
    int w = k % period_;
    return w < 0 ? w + period_ : w;
  }
  int wall_index(const WallStation& s) const {
    return 2 * (s.station * static_cast<int>(rows_.size()) + s.row);
  }

  const UnitResponses* responses_;
  std::vector<double> rows_;
  int period_;
  std::vector<Eigen::MatrixXd> all_;       ///< [k]: folded, all functionals of the responses
  std::vector<Eigen::MatrixXd> wall_wall_; ///< [k]: (2 stations rows)², rows interpolated
  std::vector<Eigen::MatrixXd> wall_all_;  ///< [k]: response of interpolated wall points to all functionals
  std::vector<Eigen::MatrixXd>
      flank_wall_; ///< [k]: of all functionals of the flanks, drive then coast, to wall points
};

/// normal · (radial, circumferential) of each station, from wall_components_of_teeth().
Eigen::MatrixXd along_normals(const Eigen::MatrixX2d& normal, const Eigen::MatrixXd& components);

/// Lagrange weights on the (up to four) nodes nearest to x; exact where x is a node. nodes ascending, at
/// least one.
std::vector<std::pair<int, double>> lagrange_weights(std::span<const double> nodes, double x);

} // namespace strainwave
