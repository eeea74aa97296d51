#pragma once
// Backlash and contact radius of every tooth of both lobes, with the errors of one sample.
//
// The nominal geometry is solved once; c_i and R_i then follow the small motions of error_motion.hpp by their
// first derivatives (central differences of the direct geometry). What is left out is of second order: with
// errors of 10 µm on every source of the seed gear it stays below 0.05 µm where the place of contact does not
// change. Errors of single teeth and centre offsets are not alike in both lobes, so the ring is unfolded: all
// teeth, material angles in (−90°, 270°], each lobe with its own.
//
// A sample is one position of the wave generator. Position q: it has moved on by q teeth, so that tooth i + q
// and space i + q stand where tooth and space i stood; q = 0 … lcm(z1, z2) − 1 are all different.

#include "model/gear/gear.hpp"
#include "model/gear/outcome.hpp"
#include "model/tooth/backlash.hpp"
#include "studies/tolerance/error_motion.hpp"

#include <vector>

namespace strainwave {

class ToleranceModel {
public:
  /// Failures: those of backlash(); contradiction when z2 − z1 is odd (a tooth of the second lobe then meets
  /// no space).
  static Outcome<ToleranceModel> make(const Gear&, const NeutralCurve&, const std::vector<ToleranceSource>&);

  std::size_t dimensions() const { return dimensions_; }
  std::size_t first_dimension(std::size_t source) const { return sources_[source].first; }

  /// Teeth whose flanks overlap those of their space, ascending material angle.
  std::size_t teeth() const { return slots_.size(); }
  double phi_rad(std::size_t i) const { return slots_[i].phi_rad; }
  const ToothBacklash& nominal(std::size_t i) const { return slots_[i].nominal; }
  MeshPlace place(std::size_t i, int position = 0) const;

  /// Drive backlash [mm] and contact radius [mm] of every tooth for one sample. Allocates nothing.
  void backlash(std::span<const double> values, int position, std::span<double> backlash_mm,
                std::span<double> contact_radius_mm) const;

private:
  struct Slot {
    double phi_rad = 0.0;
    int flexspline_tooth = 0, space = 0; ///< at position 0
    MeshPlace place;                     ///< without the teeth's numbers
    ToothBacklash nominal;
  };
  /// Change of a tooth's backlash and radius for ErrorAtTooth (1, 0) and (0, 1).
  struct Change {
    double backlash_first = 0.0, backlash_second = 0.0;
    double radius_first = 0.0, radius_second = 0.0;
  };
  struct Source {
    ToleranceSource source;
    std::size_t first = 0;            ///< its dimensions in a sample
    std::vector<double> cosine, sine; ///< of m theta_k for every tooth of its member
    std::vector<Change> by_slot;
  };
  void add_source(ToleranceSource, const std::vector<ToothMotion>& backlash_by,
                  const std::vector<ToothMotion>& radius_by);
  MeshNumbers mesh_;
  std::size_t dimensions_ = 0;
  std::vector<Source> sources_;
  std::vector<Slot> slots_;
};

/// The pose after a small motion.
Pose moved(const Pose&, const ToothMotion&);

} // namespace strainwave
