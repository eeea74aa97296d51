#pragma once
// Unit responses of the free cup: what the finite elements hand to contact, and all that contact ever sees of
// them.
//
// The undeformed cup is cyclically symmetric, so the response of *functional* a of sector i to a unit load of
// functional b of sector j depends on (i − j) mod sectors alone. A functional is load and measurement at once
// (work-conjugate): the load is a traction of unit resultant with the functional's weight, the measurement is
// the same weight's mean displacement. Hence response(k, a, b) == response(−k, b, a) (Maxwell–Betti), and the
// whole matrix is symmetric positive definite.
//
//                    drive flank (y > 0)
//                  ______/                      sector k: material angles 2π(k ± ½)/sectors, tooth centre at
//                  2πk/sectors
//     ____________|  tooth |____________        flank functionals: hats over the flank's height (radius) on
//     the drive
//    |       rim  .        .            |       flank, × hats across the face (constant with one slice)
//    |______wall stations: hats in angle|       wall functionals: inner surface, at station offsets ∈ [0, 1)
//    of a pitch
//          from the tooth centre, at fixed rows z (a narrow hat along z)
//
// Signs: circumferential positive towards larger φ, radial positive outwards, also for loads. Units: mm/N.
// Coast functionals (only when asked for): the same hats on the coast flank (y < 0), in the same directions
// of the frame; the cup is its own mirror image, so what is new in them is how the two flanks of one and of
// different teeth answer each other. They stand last, so that all other places are the same with and without
// them. Section functionals (displacement of the neutral surface under the tooth centre) only measure and
// load by a point of the neutral surface: radial, circumferential [mm], rotation about the axis and meridian
// tilt [rad], loads N and N·mm.

#include <cstddef>
#include <vector>

namespace strainwave {

/// Flank of a flexspline tooth: drive at larger φ, coast at smaller φ.
enum class FlankSide { drive, coast };

struct UnitResponses {
  int sectors = 0; ///< = flexspline teeth (any number for a smooth cup)

  std::vector<double>
      flank_radius_mm; ///< heights of the flank hats, ascending, root … tip; empty for a smooth cup
  std::vector<double>
      flank_centre_mm; ///< lever arm of each hat's circumferential unit load: moment about the axis over 1 N
  std::vector<double> flank_z_mm;  ///< slices across the face; one entry (mid face): constant across the face
  std::vector<double> wall_offset; ///< stations, fraction of a pitch from the tooth centre, e.g. {0, 0.5}
  std::vector<double> wall_z_mm;   ///< rows along the axis, ascending
  std::vector<double> section_z_mm; ///< rows of the section functionals, ascending; may be empty
  bool both_flanks = false;         ///< the coast flank's hats are there too

  enum FlankDirection { circumferential = 0, radial = 1 }; ///< also of the wall functionals
  enum SectionQuantity {
    section_radial = 0,
    section_circumferential = 1,
    section_rotation = 2,
    section_tilt = 3
  };

  int flank_count() const { return 2 * static_cast<int>(flank_radius_mm.size() * flank_z_mm.size()); }
  int wall_count() const { return 2 * static_cast<int>(wall_offset.size() * wall_z_mm.size()); }
  int section_count() const { return 4 * static_cast<int>(section_z_mm.size()); }
  int coast_count() const { return both_flanks ? flank_count() : 0; }
  /// Functionals of one sector: drive flank, then wall, then section, then coast flank.
  int count() const { return flank_count() + wall_count() + section_count() + coast_count(); }

  int flank(int height, int slice, int direction) const {
    return 2 * (height * static_cast<int>(flank_z_mm.size()) + slice) + direction;
  }
  int coast(int height, int slice, int direction) const {
    return flank_count() + wall_count() + section_count() + flank(height, slice, direction);
  }
  int wall(int station, int row, int direction) const {
    return flank_count() + 2 * (station * static_cast<int>(wall_z_mm.size()) + row) + direction;
  }
  int section(int row, int quantity) const { return flank_count() + wall_count() + 4 * row + quantity; }

  /// [offset k = 0 … sectors − 1][response a][load b], mm/N.
  std::vector<double> data;

  /// Response of functional a, k sectors further (towards larger φ), to a unit load of functional b. k may be
  /// any integer.
  double operator()(int k, int a, int b) const {
    const int n = count();
    int wrapped = k % sectors;
    if (wrapped < 0)
      wrapped += sectors;
    return data[(static_cast<std::size_t>(wrapped) * static_cast<std::size_t>(n) +
                 static_cast<std::size_t>(a)) *
                    static_cast<std::size_t>(n) +
                static_cast<std::size_t>(b)];
  }

  double reciprocity_error = 0.0; ///< max |G(k,a,b) − G(−k,b,a)| / max |G|
  double discretisation_estimate =
      0.0; ///< relative, of the largest flank-to-flank response; 0 when not estimated
};

} // namespace strainwave
