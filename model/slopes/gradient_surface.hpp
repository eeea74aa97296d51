#pragma once
// How the rigid surface under the wall moves with the wave generator's numbers: change of the gap and turn of
// its normal at a held wall point. Discs are known in closed form. A cam is differenced, as are eccentricity
// over a given wrap angle and every shape but discs: the surface alone, not the solution; central steps of
// 1e-4 (1e-4 of the number, at least 1e-4 of a mm or degree) and their halves, extrapolated, are good to some
// 1e-9.

#include "strainwave/model/contact/wave_generator_surface.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace strainwave {

/// The wave generator's numbers whose effect is known: on the neutral curve (poses), on the surface, or on
/// both.
bool is_surface_parameter(const Gear& gear, const std::string& path);

class SurfaceSlopes {
public:
  /// Columns for those of `parameters` that move the surface; the last one is the shift of both discs
  /// outwards.
  SurfaceSlopes(const Gear& gear, const NeutralCurve& curve, const WaveGeneratorSurface& surface,
                std::span<const std::string> parameters, double disc_shift_mm);

  /// Position of each column's parameter; the shift is not among them.
  const std::vector<Eigen::Index>& parameter() const { return parameter_; }
  Eigen::Index columns() const { return static_cast<Eigen::Index>(parameter_.size()) + 1; }

  /// From now on the discs are shifted along with the parameters: d shift/d parameter by column.
  void follow_shift(std::vector<double> slopes) { shift_ = std::move(slopes); }

  struct Change {
    double gap = 0.0;  ///< mm per unit of the parameter
    double turn = 0.0; ///< rad per unit
  };
  Change at(Eigen::Index column, double phi_rad, double z_mm, double w_mm, double v_mm) const;

private:
  Change alone(Eigen::Index column, double phi_rad, double z_mm, double w_mm, double v_mm) const;

  struct Disc {
    double eccentricity = 0.0, radius = 0.0, taper = 0.0;
  };
  struct Moved { ///< surfaces at −2, −1, 1, 2 steps
    std::vector<WaveGeneratorSurface> surface;
    double step = 0.0;
  };
  WaveGeneratorSurface surface_;
  std::vector<Eigen::Index> parameter_;
  std::vector<Disc> disc_;
  std::vector<Moved> cam_; ///< one for each parameter of a cam, else empty
  std::vector<double> shift_;
};

} // namespace strainwave
