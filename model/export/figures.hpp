#pragma once
// The figures of a forward result:
//   initial-backlash   backlash of every tooth over φ, drive and coast flank
//   meshing-forces     force of every tooth over φ, one curve for each load
//   contact-pressure   largest contact pressure of every tooth over φ
//   loaded-backlash    what is left of the backlash over φ under each load
//   torque-rotation    torque over rotation, with the loads asked for and the events of the load path
//   assembled-shape    radial displacement of the inner wall and its contact force over φ, one curve for each
//                      row across the discs
// Maps over flank and face: flank_figures.hpp.
// Figures whose numbers the result does not have are left out.

#include "strainwave/model/export/figure.hpp"
#include "strainwave/model/loading/contact_forces.hpp"
#include "strainwave/model/results/load_path.hpp"
#include "strainwave/model/results/result.hpp"

#include <vector>

namespace strainwave {

std::vector<Figure> backlash_figures(const ForwardResult& result);

/// Meshing forces, loaded backlash, contact pressure.
std::vector<Figure> load_figures(const ForwardResult& result);

/// Rotations, equidistant from 0 to a little past the largest of the result's loads, at which
/// torque_rotation_figure wants the torque; empty without loads.
std::vector<double> sweep_rotations_rad(const ForwardResult& result, int count = 60);

/// `sweep` is the result of the same gear at those rotations; `path`: its events are marked.
Figure torque_rotation_figure(const ForwardResult& result, const ForwardResult& sweep,
                              const LoadPath* path = nullptr);

Figure assembled_shape_figure(const ContactForces& assembled);

} // namespace strainwave
