#pragma once
// Everything a user can say about a strain wave gear, as plain structs. Units are in the names; angles end in
// _deg. The table of these fields (paths, units, defaults, ranges, sentences) is fields.hpp; nothing here
// knows a file format.

#include <optional>
#include <string>
#include <vector>

namespace strainwave {

struct Material {
  double youngs_modulus_mpa = 206000.0;
  double poisson_ratio = 0.3;
};

/// The cup. Axial coordinate z: 0 at the diaphragm's mid-plane, cup_length_mm at the open end.
/// The rim (and the wall) has its inner surface at neutral_radius − rim_thickness/2 and the toothed face lies
/// at z ∈ [cup_length − front_clearance − face_width, cup_length − front_clearance].
struct Flexspline {
  double module_mm = 0.0;
  double pressure_angle_deg = 20.0;
  int teeth = 0;
  double profile_shift = 0.0;
  double tip_radius_mm = 0.0;
  double root_radius_mm = 0.0; ///< also the rim's outer surface
  double neutral_radius_mm = 0.0;
  double rim_thickness_mm = 0.0;
  double wall_thickness_mm = 0.0; ///< behind the face; inner surface flush with the rim's
  double cup_length_mm = 0.0;
  double face_width_mm = 0.0;
  double front_clearance_mm = 0.0;
  double diaphragm_thickness_mm = 0.0;
  double boss_radius_mm = 0.0; ///< the diaphragm's bore there is fixed
};

struct CircularSpline {
  int teeth = 0;
  double profile_shift = 0.0;
  double tip_radius_mm = 0.0;
  double root_radius_mm = 0.0;
};

enum class WaveGeneratorShape { two_disc, two_disc_exact, four_force, ellipse, cosine, table };

struct WaveGenerator {
  WaveGeneratorShape shape = WaveGeneratorShape::two_disc_exact;
  double max_radial_deformation_mm = 0.0; ///< u0
  std::optional<double> eccentricity_mm;  ///< e of each disc (two_disc, two_disc_exact)
  std::optional<double> wrap_angle_deg;   ///< instead of e, or agreeing with it
  double contact_width_mm = 0.0;          ///< along the axis, centred on the face
  double disc_taper_um = 0.0;             ///< cone of the discs over contact_width_mm
  std::optional<double> force_angle_deg;  ///< β of four_force
  std::string table_file; ///< table: two columns, angle in degrees, u in mm; absolute when loaded
};

/// Material removed from both flanks of every tooth of one member, along the flank normal. Flank coordinate
/// h: 0 at the flexspline's root circle, 1 at its tip circle (circular spline: 0 at its tip circle, 1 at its
/// root), linear in radius.
struct FlankModification {
  double tip_relief_um = 0.0;
  double tip_relief_start = 0.5;
  double tip_relief_power = 2.0;
  double root_relief_um = 0.0;
  double root_relief_start = 0.5;
  double crowning_um = 0.0;
  double slope_um = 0.0;
  std::vector<double> spline_um; ///< values at equidistant knots from h = 0 to 1
  double lead_crowning_um = 0.0;
  double lead_taper_um = 0.0;
  double end_relief_um = 0.0;
  double end_relief_length_mm = 0.0;
};

struct FlankModifications {
  FlankModification flexspline;
  FlankModification circular_spline;
};

enum class Fidelity { unilateral, linear, nonlinear };
enum class AssemblyModel { small_displacement, nonlinear };
enum class LoadMethod { direct, stepping };
enum class ForceDirection { circumferential, flank_normal };
enum class DiscGap { exact, linearised };
enum class GapModel { kinematic, assembled };

struct Contact {
  Fidelity fidelity = Fidelity::unilateral;
  AssemblyModel assembly = AssemblyModel::small_displacement;
  LoadMethod method = LoadMethod::direct;
  std::optional<ForceDirection> force_direction; ///< absent: direction_of_force() decides
  std::vector<double> window_deg; ///< material angles [lo, hi], ends included; empty: every tooth
  int lobes = 2;
  DiscGap disc_gap = DiscGap::exact;
  int flank_points = 1;
  int face_slices = 1;
  GapModel gaps = GapModel::kinematic;
  std::optional<double> reference_section_mm;

  /// The force's direction where the file says nothing: circumferential for the source text's single point of
  /// a tooth, along the flank normal over the whole flank.
  ForceDirection direction_of_force() const {
    return force_direction.value_or(flank_points == 1 && face_slices == 1 ? ForceDirection::circumferential
                                                                          : ForceDirection::flank_normal);
  }
};

/// Element counts of the flexspline's sector mesh (one tooth pitch).
struct Mesh {
  int per_pitch = 4;
  int along_face = 6;
  int along_wall = 14;
  int diaphragm = 8;
  int tooth_height = 2;
  int through_thickness = 1;
};

enum class Direction { drive, coast, both };

struct Load {
  std::vector<double> torque_nm = {};
  std::vector<double> rotation_rad = {};
  double rated_torque_nm = 7.0;
  Direction direction = Direction::drive;
  int phases = 1;
};

struct Gear {
  std::string name;
  Material material;
  Flexspline flexspline;
  CircularSpline circular_spline;
  WaveGenerator wave_generator;
  FlankModifications flank_modification;
  Contact contact;
  Mesh mesh;
  Load load;
};

/// The seed gear of the project (module 0.2 mm, 140/142 teeth, two discs): what `strainwave example` prints,
/// for tests and benches. The assumed values are named in studies/gallery/seed.toml.
Gear seed_gear();

} // namespace strainwave
