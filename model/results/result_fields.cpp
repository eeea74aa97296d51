#include "strainwave/model/results/result_fields.hpp"

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/version.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace strainwave {

namespace {

template <class T>
struct Field {
  FieldText text;
  ResultValue (*read)(const T&);
};

template <class T>
struct Block {
  std::string_view path;
  std::string_view sentence;
  std::vector<Field<T>> fields;
};

template <class T>
struct MemberOf;
template <class T, class Value>
struct MemberOf<Value T::*> {
  using Owner = T;
};

/// A member as it is; one number that is none becomes Null.
template <auto Member>
ResultValue as_is(const typename MemberOf<decltype(Member)>::Owner& from) {
  if constexpr (std::is_same_v<std::remove_cvref_t<decltype(from.*Member)>, double>) {
    if (!std::isfinite(from.*Member))
      return Null{};
  }
  return from.*Member;
}

const Block<ForwardResult> whole{
    "",
    "",
    {{{"gear", "", "name of the gear", "", ""}, as_is<&ForwardResult::gear>},
     {{"fidelity", "", "how the wall meets the wave generator", "", ""},
      [](const ForwardResult& r) { return ResultValue(std::string(choice_name(r.fidelity))); }},
     {{"version", "", "of the program", "", ""},
      [](const ForwardResult&) { return ResultValue(std::string(library_version)); }},
     {{"status", "", "\"ok\" or a name of errors.md", "", ""},
      [](const ForwardResult& r) { return ResultValue(std::string(status_name(r.status))); }},
     {{"message", "", "one sentence when there is something to say; also beside \"ok\"", "", ""},
      as_is<&ForwardResult::message>}}};

const Block<WaveGeneratorResult> wave_generator{
    "wave_generator",
    "",
    {{{"shape", "", "of the wave generator", "", ""}, as_is<&WaveGeneratorResult::shape>},
     {{"wrap_angle_deg", "°", "two_disc: γ; two_disc_exact: polar angle of lift-off; 0 for cams", "", ""},
      as_is<&WaveGeneratorResult::wrap_angle_deg>},
     {{"disc_radius_mm", "mm", "to the neutral line; 0 for cams", "", ""},
      as_is<&WaveGeneratorResult::disc_radius_mm>},
     {{"eccentricity_mm", "mm", "of the discs", "", ""}, as_is<&WaveGeneratorResult::eccentricity_mm>},
     {{"u90_mm", "mm", "radial displacement of the neutral line at the minor axis", "", ""},
      as_is<&WaveGeneratorResult::u90_mm>},
     {{"rim_strain", "", "largest bending strain of the rim's surface, of the bent neutral line", "", ""},
      as_is<&WaveGeneratorResult::rim_strain>}}};

const Block<BacklashResult> backlash{
    "backlash",
    "before any load",
    {{{"tooth", "", "number; 0 on the major axis at phase 0", "", ""}, as_is<&BacklashResult::tooth>},
     {{"phi_deg", "°", "where it stands, from the major axis", "", ""}, as_is<&BacklashResult::phi_deg>},
     {{"backlash_um", "µm", "of the drive flank, as an arc; negative: interference", "phi_deg", ""},
      as_is<&BacklashResult::backlash_um>},
     {{"coast_backlash_um", "µm", "of the coast flank", "phi_deg", ""},
      as_is<&BacklashResult::coast_backlash_um>},
     {{"contact_radius_mm", "mm", "where the flanks are nearest, from the gear's axis", "phi_deg", ""},
      as_is<&BacklashResult::contact_radius_mm>},
     {{"min_um", "µm", "least of the drive flank over continuous φ", "", ""}, as_is<&BacklashResult::min_um>},
     {{"min_phi_deg", "°", "where", "", ""}, as_is<&BacklashResult::min_phi_deg>},
     {{"interference", "", "whether flanks overlap, of the gaps in use", "", ""},
      [](const BacklashResult& b) {
        return ResultValue(b.assembled ? b.assembled->interference : b.interference);
      }}}};

const Block<AssembledBacklash> assembled{
    "backlash.assembled",
    "with `gaps = \"assembled\"`: drive flank of the assembled cup over the face, both ends included",
    {{{"z_mm", "mm", "along the axis", "", ""}, as_is<&AssembledBacklash::z_mm>},
     {{"phi_deg", "°", "of the teeth", "", ""}, as_is<&AssembledBacklash::phi_deg>},
     {{"backlash_um", "µm", "a row for each z; negative: interference", "z_mm", "phi_deg"},
      as_is<&AssembledBacklash::backlash_um>},
     {{"min_um", "µm", "least over continuous φ and these z", "", ""}, as_is<&AssembledBacklash::min_um>},
     {{"min_phi_deg", "°", "where", "", ""}, as_is<&AssembledBacklash::min_phi_deg>},
     {{"min_z_mm", "mm", "where", "", ""}, as_is<&AssembledBacklash::min_z_mm>}}};

const Block<AssemblyResult> assembly{
    "assembly",
    "the cup on its wave generator, no load",
    {{{"contact_force_n", "N", "of one disc on the wall, along the major axis", "", ""},
      as_is<&AssemblyResult::contact_force_n>},
     {{"contact_phi_deg", "°", "where the wall touches: from, to", "", ""},
      [](const AssemblyResult& a) {
        return ResultValue(std::vector{a.contact_lo_deg, a.contact_hi_deg});
      }},
     {{"radial_deformation_mm", "mm", "of the inner wall at the major axis, mid face", "", ""},
      as_is<&AssemblyResult::radial_deformation_mm>},
     {{"disc_shift_mm", "mm", "of each disc outwards, so that u0 is met at `reference_section_mm`", "", ""},
      as_is<&AssemblyResult::disc_shift_mm>},
     {{"newton_steps", "", "of the exact gap to the discs", "", ""}, as_is<&AssemblyResult::newton_steps>}}};

const Block<ComplianceResult> compliance{
    "compliance",
    "wall contact frozen as assembled, every lobe loaded, each tooth at its own contact height",
    {{{"tooth", "", "number", "", ""}, as_is<&ComplianceResult::tooth>},
     {{"matrix_um_per_n", "µm/N", "displacement of the row's tooth under a force on the column's", "tooth",
       "tooth"},
      as_is<&ComplianceResult::matrix_um_per_n>},
     {{"reciprocity_error", "", "columns found again from unit forces, against the rows; relative", "", ""},
      as_is<&ComplianceResult::reciprocity_error>}}};

const Block<LoadResult> load{
    "load[]",
    "one for each torque or rotation that was asked for; with several `phases` the arrays are of the phase "
    "with the largest tooth force",
    {{{"direction", "", "flank that drives", "", ""},
      [](const LoadResult& l) { return ResultValue(std::string(choice_name(l.direction))); }},
     {{"rotation_rad", "rad", "of the circular spline, take-up included", "", ""},
      as_is<&LoadResult::rotation_rad>},
     {{"torque_nm", "N·m", "of all lobes", "", ""}, as_is<&LoadResult::torque_nm>},
     {{"tooth", "", "number", "", ""}, as_is<&LoadResult::tooth>},
     {{"phi_deg", "°", "where it stands, from the major axis", "", ""}, as_is<&LoadResult::phi_deg>},
     {{"force_n", "N", "meshing force of the tooth", "phi_deg", ""}, as_is<&LoadResult::force_n>},
     {{"loaded_backlash_um", "µm", "gap left under the load; 0 where the tooth carries", "phi_deg", ""},
      as_is<&LoadResult::loaded_backlash_um>},
     {{"pressure_mpa", "MPa", "largest contact pressure of the tooth", "phi_deg", ""},
      as_is<&LoadResult::pressure_mpa>},
     {{"engaged_count", "", "teeth that carry: of one lobe; of both where the lobes differ", "", ""},
      as_is<&LoadResult::engaged_count>},
     {{"engaged_phi_deg", "°", "first and last of them", "", ""},
      [](const LoadResult& l) {
        return l.engaged_count > 0 ? ResultValue(std::vector{l.engaged_lo_deg, l.engaged_hi_deg}) : Null{};
      }},
     {{"peak_force_n", "N", "largest meshing force over teeth and phases", "", ""},
      as_is<&LoadResult::peak_force_n>},
     {{"peak_phi_deg", "°", "where", "", ""},
      [](const LoadResult& l) { return l.engaged_count > 0 ? ResultValue(l.peak_phi_deg) : Null{}; }},
     {{"peak_phase", "", "when, as a share of one pitch", "", ""}, as_is<&LoadResult::peak_phase>},
     {{"peak_pressure_mpa", "MPa", "largest contact pressure over teeth, points and phases", "", ""},
      [](const LoadResult& l) { return ResultValue(l.peak_pressure.mpa); }},
     {{"peak_flank_pressure_mpa", "MPa", "the same where flank touches flank, edges left out", "", ""},
      [](const LoadResult& l) { return ResultValue(l.peak_flank_pressure.mpa); }},
     {{"tangent_stiffness_nm_per_rad", "N·m/rad", "at this load", "", ""},
      as_is<&LoadResult::tangent_stiffness_nm_per_rad>},
     {{"disc_force_n", "N", "of one disc along the major axis under this load; 0 for `linear`", "", ""},
      as_is<&LoadResult::disc_force_n>},
     {{"transmission_error_arcsec", "″", "peak to peak over the phases of one pitch; with several phases", "",
       ""},
      [](const LoadResult& l) {
        return l.transmission_error_arcsec ? ResultValue(*l.transmission_error_arcsec) : Absent{};
      }}}};

const Block<PressurePeak> pressure_peak{
    "load[].peak_pressure_at",
    "where the largest contact pressure is; null without contact",
    {{{"tooth", "", "number", "", ""}, as_is<&PressurePeak::tooth>},
     {{"phi_deg", "°", "of the tooth", "", ""}, as_is<&PressurePeak::phi_deg>},
     {{"height_mm", "mm", "radius on the undeformed flexspline", "", ""},
      as_is<&PressurePeak::flank_radius_mm>},
     {{"z_mm", "mm", "along the axis", "", ""}, as_is<&PressurePeak::z_mm>},
     {{"phase", "", "as a share of one pitch", "", ""}, as_is<&PressurePeak::phase>},
     {{"edge", "", "whether a tip edge touches there: the pressure is then a lower bound", "", ""},
      as_is<&PressurePeak::edge>}}};

const Block<LoadResult> gap_correction{"load[].gap_correction",
                                       "exact gap to the discs against the linearised one",
                                       {{{"rotation_rad", "rad", "change of the rotation", "", ""},
                                         as_is<&LoadResult::gap_correction_rotation_rad>},
                                        {{"force_n", "N", "largest change of a meshing force", "", ""},
                                         as_is<&LoadResult::gap_correction_force_n>}}};

std::vector<Field<PointResults>> point_fields() {
  return {
      {{"tooth", "", "number", "", ""}, as_is<&PointResults::tooth>},
      {{"height_mm", "mm", "radius on the undeformed flexspline", "", ""},
       as_is<&PointResults::flank_radius_mm>},
      {{"z_mm", "mm", "along the axis", "", ""}, as_is<&PointResults::z_mm>},
      {{"contact_radius_mm", "mm", "from the gear's axis", "", ""}, as_is<&PointResults::contact_radius_mm>},
      {{"force_n", "N", "at the point", "", ""}, as_is<&PointResults::force_n>},
      {{"gap_um", "µm", "under the load; 0 where closed", "", ""}, as_is<&PointResults::gap_um>},
      {{"half_width_um", "µm", "of the contact along the flank; 0 without force", "", ""},
       as_is<&PointResults::half_width_um>},
      {{"pressure_mpa", "MPa", "largest over that width (flank-contact.md)", "", ""},
       as_is<&PointResults::pressure_mpa>},
      {{"edge", "", "1: a tip edge touches, the pressure is a lower bound", "", ""},
       as_is<&PointResults::edge>}};
}

const Block<PointResults> points{"load[].points", "with several points a tooth; one row for each point",
                                 point_fields()};

const Block<CoastResults> coast{
    "load[].coast",
    "with force on coast flanks; both sides are in balance with the torque",
    {{{"tooth", "", "number", "", ""}, as_is<&CoastResults::tooth>},
     {{"phi_deg", "°", "where it stands", "", ""}, as_is<&CoastResults::phi_deg>},
     {{"force_n", "N", "meshing force on its coast flank", "phi_deg", ""}, as_is<&CoastResults::force_n>},
     {{"peak_force_n", "N", "largest of them", "", ""}, as_is<&CoastResults::peak_force_n>}}};

const Block<PointResults> coast_points{"load[].coast.points", "as load[].points, of the coast flanks",
                                       point_fields()};

const Block<WedgeResult> wedge{
    "wedge",
    "null for a gear that some rotation leaves without force, at every phase looked at; else its rest at no "
    "torque, of the phase with the largest force",
    {{{"phase", "", "as a share of one pitch", "", ""}, as_is<&WedgeResult::phase>},
     {{"rotation_rad", "rad", "at rest", "", ""}, as_is<&WedgeResult::rotation_rad>},
     {{"overlap_um", "µm", "of rigid flanks, both sides, along the arc at the tip radius", "", ""},
      as_is<&WedgeResult::overlap_um>},
     {{"peak_force_n", "N", "largest on one flank of a tooth", "", ""}, as_is<&WedgeResult::peak_force_n>},
     {{"sum_force_n", "N", "of all flanks of a lobe", "", ""}, as_is<&WedgeResult::sum_force_n>},
     {{"drive_count", "", "teeth that carry on the drive flank", "", ""}, as_is<&WedgeResult::drive_count>},
     {{"coast_count", "", "teeth that carry on the coast flank", "", ""}, as_is<&WedgeResult::coast_count>}}};

const Block<StiffnessResult> stiffness{
    "stiffness",
    "at `rated_torque_nm`, phase 0",
    {{{"secant_nm_per_rad", "N·m/rad", "rated torque over wind-up", "", ""},
      as_is<&StiffnessResult::secant_nm_per_rad>},
     {{"lost_motion_arcmin", "′", "between the two directions, at 4 % of the rated torque", "", ""},
      as_is<&StiffnessResult::lost_motion_arcmin>},
     {{"take_up_rad", "rad", "rotation until the first tooth touches", "", ""},
      as_is<&StiffnessResult::take_up_rad>},
     {{"wind_up_rad", "rad", "rotation from there to the rated torque", "", ""},
      as_is<&StiffnessResult::wind_up_rad>}}};

const Block<Certificate> certificate{
    "certificate",
    "residuals that prove the result (certificate.md)",
    {{{"holds", "", "whether all are within their limits", "", ""},
      [](const Certificate& c) { return ResultValue(c.holds()); }},
     {{"complementarity", "", "force times gap, relative, worst of all solves", "", ""},
      as_is<&Certificate::complementarity>},
     {{"min_gap_um", "µm", "least loaded gap", "", ""}, as_is<&Certificate::min_gap_um>},
     {{"min_force_n", "N", "least force", "", ""}, as_is<&Certificate::min_force_n>},
     {{"reciprocity", "", "of the unit responses, relative", "", ""}, as_is<&Certificate::reciprocity>},
     {{"equilibrium", "", "displacements from the forces against the solver's gaps, relative", "", ""},
      as_is<&Certificate::equilibrium>},
     {{"exact_gap_residual_um", "µm", "gap to the discs after its Newton correction", "", ""},
      as_is<&Certificate::exact_gap_residual_um>},
     {{"rounding_um", "µm", "what double precision can tell apart in a gap of this gear", "", ""},
      as_is<&Certificate::rounding_um>},
     {{"discretisation_estimate", "", "error of the largest tooth compliance by the mesh, relative", "", ""},
      as_is<&Certificate::discretisation_estimate>}}};

std::string_view stage_status(StageStatus status) {
  switch (status) {
  case StageStatus::computed:
    return "computed";
  case StageStatus::reused:
    return "reused";
  case StageStatus::skipped:
    return "skipped";
  }
  return "unknown";
}

const Block<Stage> stage{
    "stages[]",
    "what was done for this result",
    {{{"name", "", "of the stage", "", ""}, as_is<&Stage::name>},
     {{"seconds", "s", "that it took; of what was reused: that it took when it was computed", "", ""},
      as_is<&Stage::seconds>},
     {{"status", "", "computed, reused or skipped", "", ""},
      [](const Stage& s) { return ResultValue(std::string(stage_status(s.status))); }}}};

std::string_view last_name(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('.') + 1);
  return name.ends_with("[]") ? name.substr(0, name.size() - 2) : name;
}

template <class T>
void put_fields(const Block<T>& block, const T& from, ResultWriter& to) {
  for (const Field<T>& field : block.fields)
    to.put(field.text, field.read(from));
}

template <class T>
std::unique_ptr<ResultWriter> put_block(const Block<T>& block, const T& from, ResultWriter& parent) {
  auto inside = parent.block(last_name(block.path));
  put_fields(block, from, *inside);
  return inside;
}

template <class T>
BlockText text_of(const Block<T>& block) {
  BlockText text{block.path, block.sentence, {}};
  for (const Field<T>& field : block.fields)
    text.fields.push_back(field.text);
  return text;
}

void put_load(const LoadResult& from, ResultWriter& to) {
  put_fields(load, from, to);
  if (from.peak_pressure.mpa > 0.0)
    put_block(pressure_peak, from.peak_pressure, to);
  else
    to.no_block(last_name(pressure_peak.path));
  put_block(gap_correction, from, to);
  if (!from.points.tooth.empty())
    put_block(points, from.points, to);
  if (!from.coast.tooth.empty()) {
    const auto side = put_block(coast, from.coast, to);
    if (!from.coast.points.tooth.empty())
      put_block(coast_points, from.coast.points, *side);
  }
}

struct UnitNames {
  std::string_view unit, suffix, ascii;
};
constexpr std::array units{UnitNames{"N·m/rad", "_nm_per_rad", "N.m/rad"},
                           UnitNames{"µm/N", "_um_per_n", "um/N"},
                           UnitNames{"N·m", "_nm", "N.m"},
                           UnitNames{"N", "_n", "N"},
                           UnitNames{"MPa", "_mpa", "MPa"},
                           UnitNames{"µm", "_um", "um"},
                           UnitNames{"mm", "_mm", "mm"},
                           UnitNames{"°", "_deg", "deg"},
                           UnitNames{"′", "_arcmin", "arcmin"},
                           UnitNames{"″", "_arcsec", "arcsec"},
                           UnitNames{"rad", "_rad", "rad"},
                           UnitNames{"s", "", "s"}};

} // namespace

const std::vector<BlockText>& result_blocks() {
  static const std::vector<BlockText> all{
      text_of(whole),    text_of(wave_generator), text_of(backlash),       text_of(assembled),
      text_of(assembly), text_of(compliance),     text_of(load),           text_of(pressure_peak),
      text_of(points),   text_of(coast),          text_of(gap_correction), text_of(coast_points),
      text_of(wedge),    text_of(stiffness),      text_of(certificate),    text_of(stage)};
  return all;
}

void write_result(const ForwardResult& result, ResultWriter& root) {
  put_fields(whole, result, root);
  if (result.wave_generator)
    put_block(wave_generator, *result.wave_generator, root);
  if (result.backlash) {
    const auto inside = put_block(backlash, *result.backlash, root);
    if (result.backlash->assembled)
      put_block(assembled, *result.backlash->assembled, *inside);
  }
  if (result.assembly)
    put_block(assembly, *result.assembly, root);
  if (result.compliance)
    put_block(compliance, *result.compliance, root);
  for (std::size_t i = 0; i < result.load.size(); ++i)
    put_load(result.load[i], *root.element(last_name(load.path), i));
  if (result.wedge)
    put_block(wedge, *result.wedge, root);
  else if (!result.load.empty())
    root.no_block(last_name(wedge.path));
  if (result.stiffness)
    put_block(stiffness, *result.stiffness, root);
  if (result.certificate)
    put_block(certificate, *result.certificate, root);
  for (std::size_t i = 0; i < result.stages.size(); ++i)
    put_fields(stage, result.stages[i], *root.element(last_name(stage.path), i));
}

std::string_view name_without_unit(const FieldText& field) {
  for (const UnitNames& names : units) {
    if (names.unit == field.unit && field.name.ends_with(names.suffix))
      return field.name.substr(0, field.name.size() - names.suffix.size());
  }
  return field.name;
}

std::string_view ascii_unit(std::string_view unit) {
  const auto at =
      std::find_if(units.begin(), units.end(), [&](const UnitNames& u) { return u.unit == unit; });
  return at != units.end() ? at->ascii : "1";
}

std::string results_reference() {
  std::string page;
  for (const BlockText& block : result_blocks()) {
    page += "### ";
    page += block.path.empty() ? std::string("The result") : '`' + std::string(block.path) + '`';
    page += "\n\n";
    if (!block.sentence.empty())
      page.append(block.sentence).append("\n\n");
    page += "| key | unit | what |\n|---|---|---|\n";
    for (const FieldText& field : block.fields) {
      page.append("| `").append(field.name).append("` | ").append(field.unit.empty() ? "–" : field.unit);
      page.append(" | ").append(field.sentence);
      if (!field.columns.empty())
        page.append("; rows: `").append(field.rows).append("`, columns: `").append(field.columns).append("`");
      page += " |\n";
    }
    page += '\n';
  }
  page.pop_back();
  return page;
}

} // namespace strainwave
