#pragma once
// What FlankPair keeps: flanks and their breaks, known before any pose. Internal to this room.

#include "strainwave/model/tooth/flank_gap.hpp"

#include <vector>

namespace strainwave {

struct FlankPair::Prepared {
  ToothPair<double> pair;
  double neutral_radius = 0.0;
  double teeth_ratio = 0.0; ///< z1/z2
  double zeta = 0.0;
  double inner_radius = 0.0,
         outer_radius = 0.0; ///< circular-spline flank's end points, modification included
  /// Where the modification is not smooth: at = roll angle on the flexspline, radius on the circular spline.
  struct BreakAt {
    double at;
    bool sharp;
  };
  std::vector<BreakAt> flexspline_breaks, circular_spline_breaks;
};

/// A point of the flexspline flank that ends a smooth stretch of gap(t).
struct Mark {
  double t;
  ContactPlace place;
  int kink = 0;
  bool sharp = false; ///< the slope of the gap jumps here
};

/// Where both flanks exist, in roll angles of the flexspline.
struct Stretch {
  Mark lo, hi;
  double root_radius, tip_radius; ///< distances of the flexspline flank's ends from the gear's axis
};
std::optional<Stretch> shared_stretch(const FlankPair::Prepared&, const Placement<double>&);

/// Roll angle of the flexspline flank point at this distance from the gear's axis.
double roll_at(const FlankPair::Prepared&, const Placement<double>&, double root_radius, double tip_radius,
               double radius);

/// The backlash of one placed tooth.
ToothBacklash least_gap(const FlankPair::Prepared&, const Placement<double>&);

/// The teeth a gear's window selects, for one phase: index, folded material angle, lobe; ascending on each
/// lobe.
struct SelectedTooth {
  int tooth, lobe;
  double folded_rad;
};
std::vector<SelectedTooth> selected_teeth(const Gear&, double phase);

/// contact.window_deg in rad, or (-90, 90] degrees.
struct Window {
  double lo, hi;
};
Window window_of(const Gear&);

/// Gap and contact radius at the minimiser `found`, carried to dual numbers: the place where the gap is least
/// moves with the parameters (an edge with its edge, an inner minimum so that its slope stays zero). N
/// parameters, and one more slot inside.
template <int N>
struct ContactDerivatives {
  Eigen::Matrix<double, N, 1> backlash, radius;
};

/// Roll angle of the flexspline's flank at a contact's place, in dual numbers: it moves with the parameters
/// as its edge or kink does; at an inner least gap the last slot counts its own change.
template <int M>
Dual<M> contact_roll(const ToothPair<Dual<M>>& pair, const Placement<Dual<M>>& place, ContactPlace at,
                     int kink, double roll) {
  using T = Dual<M>;
  const Flank<T>& tooth = pair.flexspline;
  const Flank<T>& space = pair.circular_spline;
  const auto meet = [&](const T& t2) {
    return roll_at_world_radius(tooth, place, circular_spline_radius(space, t2), roll);
  };
  const auto k = static_cast<std::size_t>(kink);
  switch (at) {
  case ContactPlace::flank:
    break;
  case ContactPlace::flexspline_tip:
    return tooth.t_outer;
  case ContactPlace::flexspline_root:
    return tooth.t_inner;
  case ContactPlace::circular_spline_tip:
    return meet(space.t_inner);
  case ContactPlace::circular_spline_root:
    return meet(space.t_outer);
  case ContactPlace::flexspline_kink:
    return tooth.roll_at_height(tooth.removal.breaks()[k].height);
  case ContactPlace::circular_spline_kink:
    return meet(space.roll_at_height(space.removal.breaks()[k].height));
  }
  return T(roll, M, M - 1);
}

template <int M>
ContactDerivatives<M - 1> contact_derivatives(const ToothPair<Dual<M>>& pair, const Placement<Dual<M>>& place,
                                              const ToothBacklash& found) {
  using T = Dual<M>;
  const T t = contact_roll(pair, place, found.place, found.kink, found.roll);
  const Gap<T> at = flank_gap(pair, place, t);
  ContactDerivatives<M - 1> result;
  result.backlash = at.gap.derivatives().template head<M - 1>();
  result.radius = at.radius.derivatives().template head<M - 1>();
  if (found.place == ContactPlace::flank) {
    // d(slope) = 0 along the minimiser; the gap itself does not feel dt (envelope theorem).
    const double curvature = at.slope.derivatives()[M - 1];
    const Eigen::Matrix<double, M - 1, 1> dt =
        at.slope.derivatives().template head<M - 1>() * (-1.0 / curvature);
    result.radius += at.radius.derivatives()[M - 1] * dt;
  }
  return result;
}

} // namespace strainwave
