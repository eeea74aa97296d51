#pragma once
// Errors of the two gears that act on single teeth or not alike on both lobes. Lengths in mm, angles in rad.
//
//     adjacent_pitch     delta_k for each tooth of a member: tooth (space) k turned by delta_k/r in its gear
//     cumulative_pitch   A, psi: the same with delta_k = A cos(n theta_k - psi)
//     run_out            e, psi: the toothing moved by e towards psi against its axis
//     tooth_thickness    ds: each flank of every tooth moved by ds/2 at the pitch circle
//     centre_offset      x, y: the circular spline moved; x points to its space 0
//     ovality            A, psi: the circular spline bent to r + A cos 2(theta - psi)
//     backlash_noise     dc for each flexspline tooth: added to its backlash
//     profile_slope      f: material added along the flank's normal, from -f/2 at h = 0 to f/2 at h = 1
//     profile_form       f: material added along the flank's normal, (f/2) cos(2 pi h)
//     wear               w: depth lost along the normal of the drive flank, alike over the flank
//     gear_key           any number of the gear that shapes a flank: circular_spline.*, flank_modification.*
//
// r = m z/2 is the member's pitch circle, theta_k = 2 pi k/z its tooth's own angle, n the harmonic. delta > 0
// is towards larger angles; ds > 0 is a thicker tooth (flexspline), a wider space (circular spline). h is the
// flank coordinate of flank_modification.hpp: 0 to 1 outwards. Profile errors are those of the tool: alike
// for all teeth of a member and both flanks.
//
// Where they come from. Pitch and run-out: ISO 1328-1:2013; delta is the index deviation, the single pitch
// deviation is delta_k - delta_(k-1), so independent delta of spread sigma make it sqrt(2) sigma. Thickness:
// ds is a profile shift of ds/(2 m tan alpha) with all radii kept (ISO 21771). Ovality: inextensional bending
// of a ring, w = A cos 2t, v = -(A/2) sin 2t, turn (v - w')/r = (3 A/2 r) sin 2t (Timoshenko, "Strength of
// materials" 2, art. 79). Profile slope and form: ISO 1328-1:2013 (f_H alpha and f_f alpha, over the whole
// flank). Wear alike over the flank turns an involute by w/r_b.

#include "strainwave/model/tooth/flank_modification.hpp"

#include <cstddef>
#include <string>

namespace strainwave {

enum class ToleranceKind {
  adjacent_pitch,
  cumulative_pitch,
  run_out,
  tooth_thickness,
  centre_offset,
  ovality,
  backlash_noise,
  profile_slope,
  profile_form,
  wear,
  gear_key
};

struct ToleranceSource {
  ToleranceKind kind = ToleranceKind::adjacent_pitch;
  Member member = Member::flexspline; ///< centre_offset, ovality: circular spline whatever is said
  int harmonic = 1;                   ///< of cumulative_pitch
  double unit_mm = 1.0;  ///< lengths of a sample are counted in this; 1e-3: µm. Not for gear_key
  std::string path = {}; ///< of gear_key; a sample is the key's value, in its own unit
};

/// Numbers that one sample of this source has.
std::size_t tolerance_dimensions(const ToleranceSource&, int flexspline_teeth, int circular_spline_teeth);

} // namespace strainwave
