#pragma once
// A measured or foreign wave-generator shape: a text file with two columns, polar angle in degrees
// (ascending, first 0, last 90) and radial displacement of the neutral line in mm; '#' starts a comment.
// Between the rows an even, pi-periodic cubic spline: slope zero at both axes, u'' continuous.

#include "strainwave/model/kinematics/displacement.hpp"

#include <string>
#include <vector>

namespace strainwave {

class ShapeTable {
public:
  /// Throws FieldError of wave_generator.table_file, "file:line: what is wrong", and std::system_error when
  /// reading is refused.
  static ShapeTable read(const std::string& file);
  /// Angles [rad] ascending from 0 to pi/2, displacements [mm]; at least two rows.
  ShapeTable(std::vector<double> angle_rad, std::vector<double> u_mm);

  Displacement<double> operator()(double phi) const;
  const std::vector<double>& angles_rad() const { return angle_; }

private:
  std::vector<double> angle_, u_, second_;
};

} // namespace strainwave
