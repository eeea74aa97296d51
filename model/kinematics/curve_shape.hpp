#pragma once
// What every shape answers for the first quarter; NeutralCurve adds evenness and period. Internal to this
// room.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"

namespace strainwave {

class CurveShape {
public:
  CurveShape() = default;
  CurveShape(const CurveShape&) = delete;
  CurveShape& operator=(const CurveShape&) = delete;
  virtual ~CurveShape() = default;
  /// 0 <= phi <= pi/2.
  virtual Pose pose(double phi) const = 0;
  virtual PoseDerivatives pose_derivatives(double phi) const = 0;
  virtual RadialDisplacement displacement(double polar) const = 0;
  virtual CurveSummary summary() const = 0;
};

using MadeShape = Outcome<std::shared_ptr<const CurveShape>>;

/// two_disc, four_force, ellipse, cosine, table.
MadeShape make_polar_curve(const WaveGenerator&, double neutral_radius_mm);
/// two_disc_exact.
MadeShape make_elastica(const WaveGenerator&, double neutral_radius_mm);

} // namespace strainwave
