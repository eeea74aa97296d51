// The rows of the table. Ranges are those of single numbers; limits without a physical reason are round
// numbers far outside of any gear, so that a slip of units (metres, pascals) is caught.

#include "strainwave/model/gear/fields.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace strainwave {

namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 6> shape_names{"two_disc", "two_disc_exact", "four_force",
                                                      "ellipse",  "cosine",         "table"};
constexpr std::array<std::string_view, 3> fidelity_names{"unilateral", "linear", "nonlinear"};
constexpr std::array<std::string_view, 2> assembly_names{"small_displacement", "nonlinear"};
constexpr std::array<std::string_view, 2> method_names{"direct", "stepping"};
constexpr std::array<FormerChoice, 1> former_method_names{
    {{"event_path", "direct",
      "every load is solved directly at its torque or rotation; `analyze --path` gives the path from event "
      "to "
      "event"}}};
constexpr std::array<std::string_view, 2> force_direction_names{"circumferential", "flank_normal"};
constexpr std::array<std::string_view, 2> disc_gap_names{"exact", "linearised"};
constexpr std::array<std::string_view, 2> gaps_names{"kinematic", "assembled"};
constexpr std::array<std::string_view, 3> direction_names{"drive", "coast", "both"};

template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};

template <class Member>
constexpr FieldKind kind_of() {
  if constexpr (is_optional<Member>::value)
    return kind_of<typename Member::value_type>();
  else if constexpr (std::is_enum_v<Member>)
    return FieldKind::choice;
  else if constexpr (std::is_same_v<Member, int>)
    return FieldKind::integer;
  else if constexpr (std::is_same_v<Member, std::string>)
    return FieldKind::text;
  else if constexpr (std::is_same_v<Member, std::vector<double>>)
    return FieldKind::number_list;
  else
    return FieldKind::number;
}

/// A value as a field holds it: choices by their name.
template <class Value>
FieldValue held(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return std::string(choice_name(value));
  else
    return value;
}
template <class Value>
Value taken(const FieldValue& value) {
  if constexpr (std::is_enum_v<Value>) {
    const Names names = choice_names(Value{});
    const auto found = std::find(names.begin(), names.end(), std::get<std::string>(value));
    return static_cast<Value>(found - names.begin());
  } else {
    return std::get<Value>(value);
  }
}

/// Members is the way from the gear to the member: &Gear::flexspline, &Flexspline::teeth.
template <auto... Members>
FieldValue read_member(const Gear& gear) {
  const auto& member = (gear.*....*Members);
  using Member = std::decay_t<decltype(member)>;
  if constexpr (is_optional<Member>::value)
    return member ? held(*member) : FieldValue();
  else
    return held(member);
}

template <auto... Members>
void write_member(Gear& gear, const FieldValue& value) {
  auto& member = (gear.*....*Members);
  using Member = std::decay_t<decltype(member)>;
  if constexpr (is_optional<Member>::value) {
    if (std::holds_alternative<std::monostate>(value))
      member.reset();
    else
      member = taken<typename Member::value_type>(value);
  } else {
    member = taken<Member>(value);
  }
}

template <auto... Members>
Field field(std::string_view path, std::string_view unit, Range range, std::string_view sentence) {
  using Member = std::decay_t<decltype((std::declval<Gear&>().*....*Members))>;
  Field row;
  row.path = path;
  row.kind = kind_of<Member>();
  row.unit = unit;
  row.may_be_absent = is_optional<Member>::value;
  row.range = range;
  if constexpr (std::is_enum_v<Member>)
    row.choices = choice_names(Member{});
  else if constexpr (is_optional<Member>::value) {
    if constexpr (std::is_enum_v<typename Member::value_type>)
      row.choices = choice_names(typename Member::value_type{});
  }
  row.sentence = sentence;
  row.read = read_member<Members...>;
  row.write = write_member<Members...>;
  return row;
}

Field required(Field row) {
  row.required = true;
  return row;
}

Field formerly(Field row, std::span<const FormerChoice> names) {
  row.former_choices = names;
  return row;
}

Field pair_of(Field row) {
  row.list_length = 2;
  return row;
}

constexpr Range any{};
constexpr Range above_zero(double upper) {
  return {.lower = 0.0, .upper = upper, .lower_open = true};
}
constexpr Range from_zero(double upper) {
  return {.lower = 0.0, .upper = upper};
}
constexpr Range within(double lower, double upper) {
  return {.lower = lower, .upper = upper};
}
constexpr Range up_to_below(double lower, double upper) {
  return {.lower = lower, .upper = upper, .upper_open = true};
}
constexpr Range between(double lower, double upper) {
  return {.lower = lower, .upper = upper, .lower_open = true, .upper_open = true};
}

void add_wheels(std::vector<Field>& rows) {
  constexpr auto M = &Gear::material;
  rows.push_back(field<M, &Material::youngs_modulus_mpa>("material.youngs_modulus_mpa", "MPa",
                                                         within(1.0, 2e6),
                                                         "Young's modulus of the flexspline; steel: 206000"));
  rows.push_back(field<M, &Material::poisson_ratio>("material.poisson_ratio", "", up_to_below(0.0, 0.5),
                                                    "Poisson's ratio of the flexspline; steel: 0.3"));
  constexpr auto F = &Gear::flexspline;
  using Flex = Flexspline;
  const auto flex = [&rows](Field row) { rows.push_back(required(row)); };
  flex(field<F, &Flex::module_mm>("flexspline.module_mm", "mm", above_zero(100.0), "module of both members"));
  rows.push_back(
      field<F, &Flex::pressure_angle_deg>("flexspline.pressure_angle_deg", "degrees", between(0.0, 45.0),
                                          "pressure angle of the generating rack, for both members"));
  flex(field<F, &Flex::teeth>("flexspline.teeth", "", within(8, 2000), "number of teeth z1"));
  flex(field<F, &Flex::profile_shift>("flexspline.profile_shift", "", within(-20.0, 20.0),
                                      "profile shift coefficient x1, in modules"));
  flex(field<F, &Flex::tip_radius_mm>("flexspline.tip_radius_mm", "mm", above_zero(1000.0),
                                      "radius of the tip circle"));
  flex(field<F, &Flex::root_radius_mm>("flexspline.root_radius_mm", "mm", above_zero(1000.0),
                                       "radius of the root circle, also the outer surface of the rim"));
  flex(field<F, &Flex::neutral_radius_mm>("flexspline.neutral_radius_mm", "mm", above_zero(1000.0),
                                          "radius of the neutral line of the undeformed rim"));
  flex(field<F, &Flex::rim_thickness_mm>(
      "flexspline.rim_thickness_mm", "mm", above_zero(100.0),
      "thickness of the rim under the teeth; its inner surface lies half of it "
      "inside the neutral line"));
  flex(field<F, &Flex::wall_thickness_mm>(
      "flexspline.wall_thickness_mm", "mm", above_zero(100.0),
      "thickness of the cup wall behind the teeth; inner surface flush with the rim"));
  flex(field<F, &Flex::cup_length_mm>("flexspline.cup_length_mm", "mm", above_zero(2000.0),
                                      "from the mid-plane of the diaphragm to the open end"));
  flex(field<F, &Flex::face_width_mm>("flexspline.face_width_mm", "mm", above_zero(1000.0),
                                      "length of the teeth along the axis"));
  flex(field<F, &Flex::front_clearance_mm>("flexspline.front_clearance_mm", "mm", from_zero(1000.0),
                                           "plain rim between the teeth and the open end"));
  flex(field<F, &Flex::diaphragm_thickness_mm>("flexspline.diaphragm_thickness_mm", "mm", above_zero(100.0),
                                               "thickness of the flat diaphragm"));
  flex(field<F, &Flex::boss_radius_mm>("flexspline.boss_radius_mm", "mm", above_zero(1000.0),
                                       "radius of the boss; the diaphragm is held there"));
  constexpr auto C = &Gear::circular_spline;
  flex(field<C, &CircularSpline::teeth>("circular_spline.teeth", "", within(8, 2100), "number of teeth z2"));
  flex(field<C, &CircularSpline::profile_shift>(
      "circular_spline.profile_shift", "", within(-20.0, 20.0),
      "profile shift coefficient x2, in modules; it sets the clearance"));
  flex(field<C, &CircularSpline::tip_radius_mm>("circular_spline.tip_radius_mm", "mm", above_zero(1000.0),
                                                "radius of the tip circle (the inner one)"));
  flex(field<C, &CircularSpline::root_radius_mm>("circular_spline.root_radius_mm", "mm", above_zero(1000.0),
                                                 "radius of the root circle (the outer one)"));
}

void add_wave_generator(std::vector<Field>& rows) {
  constexpr auto W = &Gear::wave_generator;
  using Wave = WaveGenerator;
  rows.push_back(
      field<W, &Wave::shape>("wave_generator.shape", "", any,
                             "shape of the deformed neutral line; two_disc is the first-order curve, "
                             "two_disc_exact the elastica on two discs"));
  rows.push_back(required(field<W, &Wave::max_radial_deformation_mm>(
      "wave_generator.max_radial_deformation_mm", "mm", above_zero(50.0),
      "radial deformation u0 at the major axis")));
  rows.push_back(
      field<W, &Wave::eccentricity_mm>("wave_generator.eccentricity_mm", "mm", above_zero(100.0),
                                       "eccentricity e of each disc; the two-disc shapes need it or "
                                       "wrap_angle_deg"));
  rows.push_back(
      field<W, &Wave::wrap_angle_deg>("wave_generator.wrap_angle_deg", "degrees", between(0.0, 90.0),
                                      "angle up to which the flexspline lies on a disc; instead of "
                                      "eccentricity_mm, or agreeing with it"));
  rows.push_back(
      required(field<W, &Wave::contact_width_mm>("wave_generator.contact_width_mm", "mm", above_zero(1000.0),
                                                 "width of the discs, centred on the face")));
  rows.push_back(
      field<W, &Wave::disc_taper_um>("wave_generator.disc_taper_um", "µm", within(-1000.0, 1000.0),
                                     "cone of the discs: change of their radius over contact_width_mm"));
  rows.push_back(
      field<W, &Wave::force_angle_deg>("wave_generator.force_angle_deg", "degrees", up_to_below(0.0, 90.0),
                                       "angle of the four forces from the major axis; four_force needs it"));
  rows.push_back(
      field<W, &Wave::table_file>("wave_generator.table_file", "", any,
                                  "file with two columns, angle in degrees and radial deformation in mm; "
                                  "table needs it; relative to the gear file"));
}

template <auto Member>
void add_modification(std::vector<Field>& rows, std::array<std::string_view, 12> paths) {
  constexpr auto G = &Gear::flank_modification;
  using Flank = FlankModification;
  rows.push_back(field<G, Member, &Flank::tip_relief_um>(paths[0], "µm", from_zero(1000.0),
                                                         "tip relief: removal at the tip circle"));
  rows.push_back(
      field<G, Member, &Flank::tip_relief_start>(paths[1], "", up_to_below(0.0, 1.0),
                                                 "where tip relief begins, as a share of the active flank "
                                                 "counted from the root"));
  rows.push_back(field<G, Member, &Flank::tip_relief_power>(paths[2], "", within(1.0, 10.0),
                                                            "how tip relief grows: 1 straight, 2 parabola"));
  rows.push_back(field<G, Member, &Flank::root_relief_um>(
      paths[3], "µm", from_zero(1000.0), "root relief: removal at the root circle, straight"));
  rows.push_back(field<G, Member, &Flank::root_relief_start>(
      paths[4], "", Range{.lower = 0.0, .upper = 1.0, .lower_open = true},
      "where root relief begins, as a share of the active flank counted from the root"));
  rows.push_back(field<G, Member, &Flank::crowning_um>(
      paths[5], "µm", from_zero(1000.0), "profile crowning: removal at both ends of the flank, parabola"));
  rows.push_back(
      field<G, Member, &Flank::slope_um>(paths[6], "µm", within(-1000.0, 1000.0),
                                         "profile slope: above 0 removes towards flank coordinate 1, "
                                         "below 0 towards 0"));
  rows.push_back(
      field<G, Member, &Flank::spline_um>(paths[7], "µm", within(-1000.0, 1000.0),
                                          "free form: removal at equidistant points of the flank, from "
                                          "coordinate 0 to 1, joined by a spline"));
  rows.push_back(field<G, Member, &Flank::lead_crowning_um>(
      paths[8], "µm", from_zero(1000.0), "lead crowning: removal at both ends of the face, parabola"));
  rows.push_back(
      field<G, Member, &Flank::lead_taper_um>(paths[9], "µm", within(-1000.0, 1000.0),
                                              "lead taper: above 0 removes towards the open end of the cup, "
                                              "below 0 towards the diaphragm"));
  rows.push_back(field<G, Member, &Flank::end_relief_um>(paths[10], "µm", from_zero(1000.0),
                                                         "end relief: removal at both ends of the face"));
  rows.push_back(field<G, Member, &Flank::end_relief_length_mm>(paths[11], "mm", from_zero(1000.0),
                                                                "length of the end relief along the face"));
}

void add_calculation(std::vector<Field>& rows) {
  constexpr auto C = &Gear::contact;
  using Con = Contact;
  rows.push_back(
      field<C, &Con::fidelity>("contact.fidelity", "", any,
                               "unilateral: the wall may lift off the discs; linear: it may not; nonlinear: "
                               "large deformation"));
  rows.push_back(
      field<C, &Con::assembly>("contact.assembly", "", any, "how the assembly on the discs is solved"));
  rows.push_back(formerly(
      field<C, &Con::method>("contact.method", "", any,
                             "direct: every load solved exactly, at its torque or rotation; stepping: "
                             "the rotation marched with step halving"),
      former_method_names));
  rows.push_back(field<C, &Con::force_direction>("contact.force_direction", "", any,
                                                 "direction of the force on a flank; flank_normal adds its "
                                                 "radial part; absent: circumferential with one contact "
                                                 "point per tooth, flank_normal with more"));
  rows.push_back(
      pair_of(field<C, &Con::window_deg>("contact.window_deg", "degrees", within(-90.0, 90.0),
                                         "material angles [from, to] of the teeth that may touch, ends "
                                         "included; empty: every tooth")));
  rows.push_back(field<C, &Con::lobes>("contact.lobes", "", within(1, 2), "how many lobes carry load"));
  rows.push_back(
      field<C, &Con::disc_gap>("contact.disc_gap", "", any, "how the gap between wall and disc is measured"));
  rows.push_back(
      field<C, &Con::flank_points>("contact.flank_points", "", within(1, 64),
                                   "contact points per tooth along the flank; 1: the one of least backlash"));
  rows.push_back(field<C, &Con::face_slices>("contact.face_slices", "", within(1, 64),
                                             "slices per tooth across the face"));
  rows.push_back(field<C, &Con::gaps>(
      "contact.gaps", "", any, "backlash from the kinematic curve, or from the assembled shape of the cup"));
  rows.push_back(field<C, &Con::reference_section_mm>(
      "contact.reference_section_mm", "mm", from_zero(2000.0),
      "distance from the diaphragm at which u0 is met, with assembled gaps; absent: discs as given"));
  constexpr auto M = &Gear::mesh;
  rows.push_back(
      field<M, &Mesh::per_pitch>("mesh.per_pitch", "", within(3, 64), "elements around one tooth pitch"));
  rows.push_back(
      field<M, &Mesh::along_face>("mesh.along_face", "", within(2, 200), "elements along the face"));
  rows.push_back(field<M, &Mesh::along_wall>("mesh.along_wall", "", within(1, 200),
                                             "elements along the wall behind the teeth"));
  rows.push_back(
      field<M, &Mesh::diaphragm>("mesh.diaphragm", "", within(1, 200), "elements from the boss to the wall"));
  rows.push_back(field<M, &Mesh::tooth_height>("mesh.tooth_height", "", within(1, 64),
                                               "elements over the tooth height"));
  rows.push_back(field<M, &Mesh::through_thickness>("mesh.through_thickness", "", within(1, 16),
                                                    "elements through rim, wall and diaphragm"));
  constexpr auto L = &Gear::load;
  rows.push_back(field<L, &Load::torque_nm>("load.torque_nm", "N·m", from_zero(1e6),
                                            "torques on the circular spline to solve for, in this order"));
  rows.push_back(
      field<L, &Load::rotation_rad>("load.rotation_rad", "rad", from_zero(1.0),
                                    "rotations of the circular spline to solve for, after the torques"));
  rows.push_back(field<L, &Load::rated_torque_nm>("load.rated_torque_nm", "N·m", above_zero(1e6),
                                                  "rated torque; stiffness and lost motion refer to it"));
  rows.push_back(field<L, &Load::direction>("load.direction", "", any, "which flanks carry the load"));
  rows.push_back(field<L, &Load::phases>("load.phases", "", within(1, 1000),
                                         "meshing positions over one pitch that are solved"));
}

std::vector<Field> make_fields() {
  std::vector<Field> rows;
  rows.push_back(field<&Gear::name>("name", "", any, "a name for reports; no result depends on it"));
  add_wheels(rows);
  add_wave_generator(rows);
  // Paths are string views into literals, so each member spells its own.
#define STRAINWAVE_MODIFICATION_PATHS(member)                                                                \
  {"flank_modification." member ".tip_relief_um",     "flank_modification." member ".tip_relief_start",      \
   "flank_modification." member ".tip_relief_power",  "flank_modification." member ".root_relief_um",        \
   "flank_modification." member ".root_relief_start", "flank_modification." member ".crowning_um",           \
   "flank_modification." member ".slope_um",          "flank_modification." member ".spline_um",             \
   "flank_modification." member ".lead_crowning_um",  "flank_modification." member ".lead_taper_um",         \
   "flank_modification." member ".end_relief_um",     "flank_modification." member ".end_relief_length_mm"}
  add_modification<&FlankModifications::flexspline>(rows, STRAINWAVE_MODIFICATION_PATHS("flexspline"));
  add_modification<&FlankModifications::circular_spline>(rows,
                                                         STRAINWAVE_MODIFICATION_PATHS("circular_spline"));
#undef STRAINWAVE_MODIFICATION_PATHS
  add_calculation(rows);
  return rows;
}

constexpr std::array<FieldTable, 10> tables{{
    {"material", "elastic constants of the flexspline"},
    {"flexspline", "the toothed cup; its axis runs from the diaphragm (0) to the open end"},
    {"circular_spline", "the rigid internal gear; module and pressure angle are the flexspline's"},
    {"wave_generator", "what deforms the flexspline"},
    {"flank_modification", "material removed along the normal of both flanks of every tooth"},
    {"flank_modification.flexspline", "flank coordinate 0 at the root circle, 1 at the tip circle"},
    {"flank_modification.circular_spline", "flank coordinate 0 at the tip circle, 1 at the root circle"},
    {"contact", "how teeth and wave generator touch, and how that is solved"},
    {"mesh", "element counts of the flexspline's finite-element sector (one tooth pitch)"},
    {"load", "what is applied to the circular spline; the wave generator stands still"},
}};

} // namespace

Names choice_names(WaveGeneratorShape) {
  return shape_names;
}
Names choice_names(Fidelity) {
  return fidelity_names;
}
Names choice_names(AssemblyModel) {
  return assembly_names;
}
Names choice_names(LoadMethod) {
  return method_names;
}
Names choice_names(ForceDirection) {
  return force_direction_names;
}
Names choice_names(DiscGap) {
  return disc_gap_names;
}
Names choice_names(GapModel) {
  return gaps_names;
}
Names choice_names(Direction) {
  return direction_names;
}

std::span<const Field> gear_fields() {
  static const std::vector<Field> rows = make_fields();
  return rows;
}

std::span<const FieldTable> gear_tables() {
  return tables;
}

} // namespace strainwave
