#pragma once
// What a forward analysis returns, in the units of the surface: N, N·m, µm, mm, degrees, radians where named
// so. Arrays run over teeth in ascending φ. Angles of teeth lie in (−90°, 90°] of the first lobe when both
// lobes are alike (coast: mirrored, [−90°, 90°)), and in (−90°, 270°] when they differ (odd number of teeth):
// both lobes are listed then, engaged_count counts both, and the engaged zone is given as seen from each
// tooth's own lobe.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <optional>
#include <string>
#include <vector>

namespace strainwave {

/// What of a gear is wanted; whatever is not needed for it is skipped.
enum class Want { backlash, compliance, load };

struct WaveGeneratorResult {
  double wrap_angle_deg = 0.0; ///< γ (two_disc), polar lift-off angle (two_disc_exact), 0 for cams
  double disc_radius_mm = 0.0; ///< to the neutral line; 0 for cams
  double eccentricity_mm = 0.0;
  double u90_mm = 0.0;
  double rim_strain =
      0.0; ///< largest bending strain of the rim's surface: t/2 |κ − 1/r_m| along the neutral line
  std::string shape;
};

/// Over the face of the assembled cup (contact.gaps = "assembled"; assembled_backlash.hpp). Drive flank.
struct AssembledBacklash {
  std::vector<double> z_mm;
  std::vector<double> phi_deg;
  std::vector<std::vector<double>> backlash_um; ///< [z][phi]; NaN where flanks do not overlap
  double min_um = 0.0;                          ///< over continuous φ and the places z
  double min_phi_deg = 0.0;
  double min_z_mm = 0.0;
  bool interference = false;
};

struct BacklashResult {
  std::vector<int> tooth;
  std::vector<double> phi_deg;
  std::vector<double> backlash_um; ///< drive flank; negative: interference; NaN where flanks do not overlap
  std::vector<double> coast_backlash_um;
  std::vector<double> contact_radius_mm; ///< NaN where flanks do not overlap
  double min_um = 0.0;                   ///< over continuous φ
  double min_phi_deg = 0.0;
  bool interference = false; ///< of these kinematic gaps
  std::optional<AssembledBacklash> assembled;
};

struct AssemblyResult {
  double contact_force_n = 0.0; ///< resultant of one disc along the major axis
  double contact_lo_deg = 0.0;
  double contact_hi_deg = 0.0;
  double radial_deformation_mm = 0.0; ///< inner wall at the major axis, mid face
  double disc_shift_mm = 0.0; ///< of each disc outwards, so that u0 is met at contact.reference_section_mm
  int newton_steps = 0;
};

struct ComplianceResult {
  std::vector<int> tooth;
  std::vector<std::vector<double>>
      matrix_um_per_n; ///< contact frozen as assembled, all lobes of the gear's [contact] loaded
  double reciprocity_error = 0.0;
};

/// Loads and gaps over flank and face, with more than one point a tooth. Both lobes alike.
struct PointResults {
  std::vector<int> tooth;
  std::vector<double> flank_radius_mm; ///< on the undeformed flexspline
  std::vector<double> z_mm;
  std::vector<double> contact_radius_mm; ///< distance of the point from the gear's axis
  std::vector<double> force_n;
  std::vector<double> gap_um;        ///< loaded; 0 where closed
  std::vector<double> half_width_um; ///< of the contact along the flank (pressure.hpp); 0 without force
  std::vector<double> pressure_mpa;  ///< peak over that width
  std::vector<int> edge;             ///< 1: a tip edge touches; the pressure is a lower bound there
};

/// The largest pressure of a load and where it is, over teeth, points and phases; 0 without contact.
struct PressurePeak {
  double mpa = 0.0;
  int tooth = 0;
  double phi_deg = 0.0;
  double flank_radius_mm = 0.0; ///< on the undeformed flexspline
  double z_mm = 0.0;
  double phase = 0.0;
  bool edge = false;
};

/// Forces on the coast flanks, with those of the drive flanks in balance with the torque. Empty when none
/// carries.
struct CoastResults {
  std::vector<int> tooth; ///< every tooth whose coast flank is a candidate, ascending φ (window mirrored)
  std::vector<double> phi_deg;
  std::vector<double> force_n;
  double peak_force_n = 0.0;
  PointResults points; ///< empty with one point a tooth
};

/// Tooth forces at one meshing phase, every tooth that can carry load.
struct PhaseForces {
  double phase = 0.0;
  double rotation_rad = 0.0;
  std::vector<int> tooth;
  std::vector<double> force_n;
};

struct LoadResult {
  Direction direction = Direction::drive;
  double rotation_rad = 0.0; ///< of the phase with the largest tooth force
  double torque_nm = 0.0;
  std::vector<int> tooth;
  std::vector<double> phi_deg;
  std::vector<double> force_n;
  std::vector<double> loaded_backlash_um;
  std::vector<double> pressure_mpa; ///< largest of the tooth's points
  PressurePeak peak_pressure;
  PressurePeak peak_flank_pressure; ///< the same where flank touches flank, edges left out
  int engaged_count = 0;
  double engaged_lo_deg = 0.0;
  double engaged_hi_deg = 0.0;
  double peak_force_n = 0.0; ///< worst over teeth and phases
  double peak_phi_deg = 0.0;
  double peak_phase = 0.0;
  double tangent_stiffness_nm_per_rad = 0.0;
  double disc_force_n = 0.0; ///< resultant on one disc along the major axis under this load; 0 for linear
  std::optional<double>
      transmission_error_arcsec;            ///< peak to peak over the phases of one pitch, at constant torque
  double gap_correction_rotation_rad = 0.0; ///< exact disc gap against the linearised one
  double gap_correction_force_n = 0.0;
  std::vector<PhaseForces> phases; ///< all of them, the one of the arrays above included
  PointResults points;             ///< empty with one point a tooth
  CoastResults coast;
};

/// A gear whose drive and coast flanks overlap at every rotation: its rest, at no torque. Of the phase with
/// the largest force on one flank; forces of one lobe when both are alike.
struct WedgeResult {
  double phase = 0.0;
  double rotation_rad = 0.0; ///< at rest
  double overlap_um =
      0.0; ///< of rigid flanks, both sides together, along the arc at the flexspline's tip radius
  double peak_force_n = 0.0; ///< largest sum on one flank of a tooth
  double sum_force_n = 0.0;  ///< of all flanks
  int drive_count = 0;       ///< teeth that carry on the drive flank
  int coast_count = 0;
};

struct StiffnessResult {
  double secant_nm_per_rad = 0.0; ///< T_rated / wind-up(T_rated)
  double lost_motion_arcmin = 0.0;
  double take_up_rad = 0.0;
  double wind_up_rad = 0.0;
};

/// Residuals that prove the result; see docs/certificate.md for their limits.
struct Certificate {
  double complementarity = 0.0; ///< relative, worst of all solves
  double min_gap_um = 0.0;
  double min_force_n = 0.0;
  double reciprocity = 0.0; ///< of the unit responses, relative
  double equilibrium = 0.0; ///< displacements recomputed from the forces against the solver's gaps, relative
  double discretisation_estimate = 0.0; ///< relative, of the largest tooth compliance
  double exact_gap_residual_um = 0.0;   ///< disc gap after the Newton correction
  double rounding_um = 0.0; ///< what double precision can tell apart in a gap of this gear under its loads
  bool holds() const { return !find_flaw(); }
  /// "equilibrium is off by …, at most … is allowed".
  std::optional<std::string> find_flaw() const;
};

enum class StageStatus { computed, reused, skipped };

struct Stage {
  std::string name;
  double seconds = 0.0;
  StageStatus status = StageStatus::skipped;
};

struct ForwardResult {
  std::string gear;
  Fidelity fidelity = Fidelity::unilateral;
  Status status = Status::ok;
  std::string message;               ///< one sentence when there is something to say; also with status ok
  std::vector<std::string> warnings; ///< for stderr: a damaged cache file and the like
  std::optional<WaveGeneratorResult> wave_generator;
  std::optional<BacklashResult> backlash;
  std::optional<AssemblyResult> assembly;
  std::optional<ComplianceResult> compliance;
  std::vector<LoadResult> load;
  std::optional<WedgeResult> wedge; ///< absent: free at some rotation, at every phase looked at
  std::optional<StiffnessResult> stiffness;
  std::optional<Certificate> certificate;
  std::vector<Stage> stages;
};

} // namespace strainwave
