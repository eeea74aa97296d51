#pragma once
// Initial backlash: how far the circular spline may turn before it touches each tooth.
//
// A flexspline tooth of material angle phi stands in the pose that NeutralCurve gives; its circular-spline
// space stands at phi z1/z2 (second lobe: pi + (phi - pi) z1/z2). The drive flank is the one on the side of
// larger angle; the circular spline turns towards smaller angles and closes its gap. At every radius where
// both flanks exist the gap is the arc between them; the backlash is its least value over the flank: ends,
// edges (flexspline tip, circular-spline tip) and kinks of a modification included. Negative backlash is
// interference and is reported, never clipped. The coast flank is the mirror image phi -> -phi. Seed gear,
// first-order discs: least backlash over continuous phi 3.8904 um at 5.2231 degrees (exact discs: 3.8470
// um, 5.2189).
//
// Lengths in mm, angles in rad. Face coordinate zeta: -1 diaphragm end, 0 mid face, +1 open end (it matters
// for lead modifications only).

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace strainwave {

/// What limits the gap at its least value.
enum class ContactPlace {
  flank,                ///< both flanks tangent in the inside
  flexspline_tip,       ///< the flexspline's tip edge
  flexspline_root,      ///< the lower end of the flexspline's flank
  circular_spline_tip,  ///< the circular spline's tip edge
  circular_spline_root, ///< the outer end of the circular spline's flank
  flexspline_kink,      ///< a point where the flexspline's modification has a break
  circular_spline_kink  ///< the same on the circular spline
};

struct ToothBacklash {
  bool overlap = false;           ///< false: the flanks share no radius; the other numbers then mean nothing
  double backlash_mm = 0.0;       ///< arc at the contact radius; negative: interference
  double contact_radius_mm = 0.0; ///< distance of the contact point from the gear's axis
  double flank_height = 0.0;      ///< flank coordinate on the flexspline: 0 root circle, 1 tip
  ContactPlace place = ContactPlace::flank;
  int kink = 0;      ///< which break of the modification, for the two kinks
  double roll = 0.0; ///< involute roll angle of the contact point on the flexspline
};

/// The flanks of one gear at one section, prepared for many poses (also poses from an assembled
/// finite-element state).
class FlankPair {
public:
  /// Failures: contradiction, flank_outside_tooth.
  static Outcome<FlankPair> make(const Gear&, double zeta = 0.0);
  /// The pose is relative to the tooth's own lobe (subtract pi from phi1 on the second), as is the space's
  /// angle.
  ToothBacklash drive(const Pose&, double space_angle_rad) const;
  /// The mirror image; same arguments.
  ToothBacklash coast(const Pose&, double space_angle_rad) const;

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

private:
  std::shared_ptr<const Prepared> prepared_;
};

/// One entry for each tooth, ascending material angle.
struct Backlash {
  std::vector<int> tooth; ///< i of phi = 2 pi (i + phase)/z1; negative below the major axis
  std::vector<int> lobe;  ///< 0, or 1 for the second lobe (odd number of teeth only)
  std::vector<double>
      phi_rad; ///< material angle; (-pi/2, pi/2] on the first lobe, (pi/2, 3 pi/2] on the second
  std::vector<ToothBacklash> drive;
  std::vector<ToothBacklash> coast;
  double phase = 0.0;
  double zeta = 0.0;
  bool interference() const; ///< any drive or coast backlash below zero
};

/// Backlash of every tooth in (-90, 90] degrees, or in contact.window_deg with its ends (there phi counts
/// from the tooth's own lobe). With an even number of teeth both lobes are alike and the first is given; with
/// an odd one all teeth of the ring. Coast direction: the mirrored problem has phase -phase and tooth -i; its
/// drive entries are these coast entries. Failures: contradiction, flank_outside_tooth, no_overlap (no
/// tooth's flanks share a radius).
Outcome<Backlash> backlash(const Gear&, const NeutralCurve&, double phase = 0.0, double zeta = 0.0);

/// The teeth alone that backlash() would answer for: drive and coast stay empty.
Backlash teeth_of_window(const Gear&, double phase);

struct LeastBacklash {
  double backlash_mm = 0.0;
  double phi_rad = 0.0;
  double contact_radius_mm = 0.0;
};

/// Least drive backlash over continuous material angle within (-90, 90] degrees or contact.window_deg, at the
/// root of its derivative (or at a kink or an end of the window). Same failures.
Outcome<LeastBacklash> least_backlash(const Gear&, const NeutralCurve&, double zeta = 0.0);

} // namespace strainwave
