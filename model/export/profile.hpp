#pragma once
// Outlines of tooth and space for CAD and measuring machines: closed polylines in the plane of one section of
// the face, modification included, lengths in mm, x along the major axis of the wave generator.
//
//   design      one flexspline tooth and one circular-spline space, both centred on the x axis, not deformed
//   assembled   the chosen teeth in the poses that the wave generator's curve gives them, and the spaces that
//               belong to them (first lobe, phase 0, circular spline not turned)
//   neutral     the neutral line
//
// A flank has `flank_points` points at equidistant flank coordinates; tip and root are arcs of their circles
// (the fillets are not part of the model). Outlines run counter-clockwise:
//   coast flank outwards → outer arc → drive flank inwards → inner arc.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace strainwave {

enum class OutlineKind { tooth, space, assembled_tooth, assembled_space, neutral_line };
enum class OutlinePart { coast_flank, outer_arc, drive_flank, inner_arc, curve };

struct OutlinePoint {
  double x_mm = 0.0, y_mm = 0.0;
  OutlinePart part = OutlinePart::curve;
  double flank_coordinate = std::numeric_limits<double>::quiet_NaN(); ///< on flanks
  double removal_um = 0.0;                                            ///< on flanks
  double radius_mm() const { return std::hypot(x_mm, y_mm); }
};

struct Outline {
  OutlineKind kind = OutlineKind::tooth;
  int tooth = 0;                    ///< assembled: material index
  double phi_deg = 0.0;             ///< its material angle
  std::vector<OutlinePoint> points; ///< closed: the last point is joined to the first
};

struct ProfileOptions {
  std::vector<int> teeth; ///< assembled; empty: those between −10° and 20°, where the flanks meet
  int flank_points = 41;  ///< ≥ 2
  double zeta = 0.0;      ///< section of the face: −1 diaphragm end, 0 middle, +1 open end
};

/// Failures: contradictions of the gear, a tooth that does not stand on the first lobe.
Outcome<std::vector<Outline>> profile_outlines(const Gear& gear, const ProfileOptions& options = {});

/// "FLEXSPLINE_TOOTH", … : layer of a drawing.
const char* layer_name(OutlineKind kind);
const char* part_name(OutlinePart part);

} // namespace strainwave
