#pragma once
// Derivatives of a forward result with respect to continuous numbers of the gear file, exact through the
// whole chain: flanks → gaps → contact by the implicit function theorem on the closed sets → forces,
// rotations, stiffness (gradient_phase.hpp).
//
// Exact are all keys that act through flanks, poses and assembly alone: flank_modification.*,
// circular_spline.profile_shift, tip_radius_mm and root_radius_mm, and of the wave generator u0, eccentricity
// or wrap angle, and disc_taper_um. The others act through the finite elements too (cup geometry, material,
// the flexspline's own tooth, contact_width_mm); who needs them takes differences of whole results.
//
// Everything is per unit of the file's key: N per µm, rad per mm.

#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/results/forward_gradient.hpp"

#include <memory>
#include <span>
#include <string>

namespace strainwave {

/// Whether ForwardSolution::gradient() takes this path for this gear.
bool has_exact_gradient(const Gear& gear, const std::string& path);

struct Run; // run.hpp

/// An analysis that has come to its end, with its contact states.
class ForwardSolution {
public:
  explicit ForwardSolution(std::shared_ptr<const Run> run) : run_(std::move(run)) {}
  /// Throws std::invalid_argument for a path without exact gradient. Several threads may ask.
  ForwardGradient gradient(std::span<const std::string> parameters) const;

private:
  std::shared_ptr<const Run> run_;
};

} // namespace strainwave
