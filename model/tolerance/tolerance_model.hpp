#pragma once
// Backlash and contact radius of every tooth of both lobes, with the errors of one sample.
//
// The nominal geometry is solved once; c_i and R_i then follow the small motions of error_motion.hpp and the
// shapes of flank_shape.hpp by their first derivatives (central differences of the direct geometry). What is
// left out is of second order: with errors of 10 µm on every source of the seed gear it stays below 0.05 µm
// where the place of contact does not change. Errors of single teeth and centre offsets are not alike in both
// lobes, so the ring is unfolded: all teeth, material angles in (−90°, 270°], each lobe with its own.
//
// A sample is one position of the wave generator. Position q: it has moved on by q teeth, so that tooth i + q
// and space i + q stand where tooth and space i stood; q = 0 … lcm(z1, z2) − 1 are all different.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"
#include "strainwave/model/tolerance/error_motion.hpp"
#include "strainwave/model/tooth/backlash.hpp"

#include <optional>
#include <vector>

namespace strainwave {

/// A tooth that may carry load. Angles relative to its lobe.
struct MeshedTooth {
  double phi_rad = 0.0; ///< material angle of the ring, (−90°, 270°]
  int tooth = 0;        ///< 2π · tooth/z1 = phi
  Pose pose;
};

/// What one sample makes of a tooth.
struct ToothErrors {
  ToothMotion motion;             ///< of the tooth against its space
  double backlash_mm = 0.0;       ///< change of the drive backlash beside the motion: errors of shape, noise
  double radius_mm = 0.0;         ///< the same of the contact radius
  double coast_backlash_mm = 0.0; ///< the same of the coast backlash (thickness: all of its part)
};

class ToleranceModel {
public:
  /// Failures: those of backlash() and shape_pair(); contradiction when z2 − z1 is odd (a tooth of the second
  /// lobe then meets no space).
  static Outcome<ToleranceModel> make(const Gear&, const NeutralCurve&, const std::vector<ToleranceSource>&);
  /// The same for chosen teeth with poses of their own (an assembled cup); those without overlap are left
  /// out.
  static Outcome<ToleranceModel> make(const Gear&, const NeutralCurve&, const std::vector<MeshedTooth>&,
                                      const std::vector<ToleranceSource>&);

  std::size_t dimensions() const { return dimensions_; }
  std::size_t sources() const { return sources_.size(); }
  std::size_t first_dimension(std::size_t source) const { return sources_[source].first; }

  /// Teeth whose flanks overlap those of their space, ascending material angle.
  std::size_t teeth() const { return slots_.size(); }
  double phi_rad(std::size_t i) const { return slots_[i].phi_rad; }
  const ToothBacklash& nominal(std::size_t i) const { return slots_[i].nominal; }
  /// Infinite where the coast flanks do not overlap.
  double nominal_coast_mm(std::size_t i) const { return slots_[i].coast_mm; }
  MeshPlace place(std::size_t i, int position = 0) const;

  /// Drive backlash [mm] and contact radius [mm] of every tooth for one sample. Allocates nothing.
  void backlash(std::span<const double> values, int position, std::span<double> backlash_mm,
                std::span<double> contact_radius_mm) const;
  /// The same with the coast backlash.
  void backlash(std::span<const double> values, int position, std::span<double> backlash_mm,
                std::span<double> contact_radius_mm, std::span<double> coast_mm) const;

  /// The errors themselves, for who has a geometry of his own to put them into.
  void errors(std::span<const double> values, int position, std::span<ToothErrors> errors) const;
  /// First-order changes of a tooth by a small motion.
  double backlash_by(std::size_t i, const ToothMotion& motion) const;
  double radius_by(std::size_t i, const ToothMotion& motion) const;
  double coast_by(std::size_t i, const ToothMotion& motion) const;

private:
  struct Slot {
    double phi_rad = 0.0;
    int flexspline_tooth = 0, space = 0; ///< at position 0
    MeshPlace place;                     ///< without the teeth's numbers
    ToothBacklash nominal;
    double coast_mm = 0.0;
    ToothMotion backlash_by, radius_by, coast_by; ///< derivatives by the motion's components
  };
  /// Change for ErrorAtTooth (1, 0) and (0, 1).
  struct Pair {
    double first = 0.0, second = 0.0;
  };
  struct Source {
    ToleranceSource source;
    std::size_t first = 0;                              ///< its dimensions in a sample
    double zero = 0.0;                                  ///< value of no error: of a gear key the gear's own
    std::vector<double> cosine, sine;                   ///< of m theta_k for every tooth of its member
    std::vector<Pair> backlash, radius, coast;          ///< by slot
    std::vector<ToothErrors> error_first, error_second; ///< the same before the geometry
  };
  static Outcome<ToleranceModel> of_teeth(const Gear&, const NeutralCurve&, const std::vector<MeshedTooth>&);
  std::optional<Failure> add_source(const Gear& gear, ToleranceSource);
  std::optional<Failure> add_shape(const Gear& gear, Source& source);
  void add_motion(Source& source);
  template <class Add>
  void each(std::span<const double> values, int position, Add&& add) const;

  MeshNumbers mesh_;
  std::size_t dimensions_ = 0;
  std::vector<Source> sources_;
  std::vector<Slot> slots_;
};

/// The pose after a small motion.
Pose moved(const Pose&, const ToothMotion&);

} // namespace strainwave
