#include "strainwave/model/export/result_json.hpp"

#include "strainwave/model/gear/fields.hpp"
#include "strainwave/version.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace strainwave {

using Json = nlohmann::ordered_json;

std::string_view name(StageStatus status) {
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

namespace {

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values)
    array.push_back(number(value));
  return array;
}

Json points_json(const PointResults& points) {
  return {{"tooth", points.tooth},
          {"height_mm", numbers(points.flank_radius_mm)},
          {"z_mm", numbers(points.z_mm)},
          {"contact_radius_mm", numbers(points.contact_radius_mm)},
          {"force_n", numbers(points.force_n)},
          {"gap_um", numbers(points.gap_um)},
          {"half_width_um", numbers(points.half_width_um)},
          {"pressure_mpa", numbers(points.pressure_mpa)},
          {"edge", points.edge}};
}

Json load_json(const LoadResult& load) {
  Json json;
  json["direction"] = choice_name(load.direction);
  json["rotation_rad"] = load.rotation_rad;
  json["torque_nm"] = load.torque_nm;
  json["tooth"] = load.tooth;
  json["phi_deg"] = numbers(load.phi_deg);
  json["force_n"] = numbers(load.force_n);
  json["loaded_backlash_um"] = numbers(load.loaded_backlash_um);
  json["pressure_mpa"] = numbers(load.pressure_mpa);
  json["engaged_count"] = load.engaged_count;
  json["engaged_phi_deg"] =
      load.engaged_count > 0 ? Json::array({load.engaged_lo_deg, load.engaged_hi_deg}) : Json(nullptr);
  json["peak_force_n"] = load.peak_force_n;
  json["peak_phi_deg"] = load.engaged_count > 0 ? Json(load.peak_phi_deg) : Json(nullptr);
  json["peak_phase"] = load.peak_phase;
  json["peak_pressure_mpa"] = load.peak_pressure.mpa;
  if (load.peak_pressure.mpa > 0.0) {
    const PressurePeak& at = load.peak_pressure;
    json["peak_pressure_at"] = {
        {"tooth", at.tooth}, {"phi_deg", at.phi_deg}, {"height_mm", at.flank_radius_mm},
        {"z_mm", at.z_mm},   {"phase", at.phase},     {"edge", at.edge}};
  } else {
    json["peak_pressure_at"] = nullptr;
  }
  json["peak_flank_pressure_mpa"] = load.peak_flank_pressure.mpa;
  json["tangent_stiffness_nm_per_rad"] = load.tangent_stiffness_nm_per_rad;
  json["disc_force_n"] = number(load.disc_force_n);
  if (load.transmission_error_arcsec)
    json["transmission_error_arcsec"] = *load.transmission_error_arcsec;
  json["gap_correction"] = {{"rotation_rad", load.gap_correction_rotation_rad},
                            {"force_n", load.gap_correction_force_n}};
  if (!load.points.tooth.empty())
    json["points"] = points_json(load.points);
  if (const CoastResults& coast = load.coast; !coast.tooth.empty()) {
    json["coast"] = {{"tooth", coast.tooth},
                     {"phi_deg", numbers(coast.phi_deg)},
                     {"force_n", numbers(coast.force_n)},
                     {"peak_force_n", coast.peak_force_n}};
    if (!coast.points.tooth.empty())
      json["coast"]["points"] = points_json(coast.points);
  }
  return json;
}

Json path_point_json(const PathPoint& point) {
  return {{"tooth", point.tooth},
          {"phi_deg", point.phi_deg},
          {"flank", point.coast ? "coast" : "drive"},
          {"height_mm", point.flank_radius_mm},
          {"z_mm", point.z_mm}};
}

Json path_json(const LoadPath& path) {
  Json json = {{"phase", path.phase}};
  json["start"] = {{"rotation_rad", path.start_rotation_rad},
                   {"torque_nm", path.start_torque_nm},
                   {"stiffness_nm_per_rad", path.start_stiffness_nm_per_rad},
                   {"carries", Json::array()}};
  for (const PathPoint& point : path.carries_at_start)
    json["start"]["carries"].push_back(path_point_json(point));
  json["events"] = Json::array();
  for (const LoadPathEvent& event : path.events) {
    Json changes = Json::array();
    for (const LoadPathChange& change : event.changes) {
      Json one = path_point_json(change.point);
      one["change"] = change.joins ? "joins" : "leaves";
      one["whole_tooth"] = change.whole_tooth;
      changes.push_back(std::move(one));
    }
    json["events"].push_back({{"rotation_rad", event.rotation_rad},
                              {"torque_nm", event.torque_nm},
                              {"stiffness_nm_per_rad", event.stiffness_nm_per_rad},
                              {"changes", std::move(changes)},
                              {"wall_joins", event.wall_joins},
                              {"wall_leaves", event.wall_leaves}});
  }
  json["end"] = {{"rotation_rad", path.end_rotation_rad}, {"torque_nm", path.end_torque_nm}};
  json["loads"] = Json::array();
  for (const LoadOnPath& load : path.loads) {
    Json one = {{"torque_nm", load.torque_nm},
                {"rotation_rad", load.rotation_rad},
                {"direct_difference", load.direct_difference}};
    if (load.exact_minus_path_rad)
      one["exact_minus_path_rad"] = *load.exact_minus_path_rad;
    if (load.exact_minus_path_nm)
      one["exact_minus_path_nm"] = *load.exact_minus_path_nm;
    json["loads"].push_back(std::move(one));
  }
  return json;
}

} // namespace

Json result_json(const ForwardResult& result, const LoadPath* path) {
  Json json;
  json["gear"] = result.gear;
  json["fidelity"] = choice_name(result.fidelity);
  json["version"] = library_version;
  json["status"] = status_name(result.status);
  json["message"] = result.message;
  if (const auto& wg = result.wave_generator) {
    json["wave_generator"] = {{"shape", wg->shape},
                              {"wrap_angle_deg", number(wg->wrap_angle_deg)},
                              {"disc_radius_mm", number(wg->disc_radius_mm)},
                              {"eccentricity_mm", number(wg->eccentricity_mm)},
                              {"u90_mm", number(wg->u90_mm)},
                              {"rim_strain", number(wg->rim_strain)}};
  }
  if (const auto& b = result.backlash) {
    json["backlash"] = {{"tooth", b->tooth},
                        {"phi_deg", numbers(b->phi_deg)},
                        {"backlash_um", numbers(b->backlash_um)},
                        {"coast_backlash_um", numbers(b->coast_backlash_um)},
                        {"contact_radius_mm", numbers(b->contact_radius_mm)},
                        {"min_um", number(b->min_um)},
                        {"min_phi_deg", number(b->min_phi_deg)},
                        {"interference", b->assembled ? b->assembled->interference : b->interference}};
    if (const auto& a = b->assembled) {
      Json rows = Json::array();
      for (const auto& row : a->backlash_um)
        rows.push_back(numbers(row));
      json["backlash"]["assembled"] = {{"z_mm", numbers(a->z_mm)},
                                       {"phi_deg", numbers(a->phi_deg)},
                                       {"backlash_um", std::move(rows)},
                                       {"min_um", number(a->min_um)},
                                       {"min_phi_deg", number(a->min_phi_deg)},
                                       {"min_z_mm", number(a->min_z_mm)}};
    }
  }
  if (const auto& a = result.assembly) {
    json["assembly"] = {{"contact_force_n", a->contact_force_n},
                        {"contact_phi_deg", {a->contact_lo_deg, a->contact_hi_deg}},
                        {"radial_deformation_mm", a->radial_deformation_mm},
                        {"disc_shift_mm", a->disc_shift_mm},
                        {"newton_steps", a->newton_steps}};
  }
  if (const auto& c = result.compliance) {
    json["compliance"] = {{"tooth", c->tooth},
                          {"matrix_um_per_n", c->matrix_um_per_n},
                          {"reciprocity_error", c->reciprocity_error}};
  }
  if (!result.load.empty()) {
    json["load"] = Json::array();
    for (const LoadResult& load : result.load)
      json["load"].push_back(load_json(load));
  }
  if (path)
    json["path"] = path_json(*path);
  if (const auto& w = result.wedge) {
    json["wedge"] = {{"phase", w->phase},
                     {"rotation_rad", w->rotation_rad},
                     {"overlap_um", w->overlap_um},
                     {"peak_force_n", w->peak_force_n},
                     {"sum_force_n", w->sum_force_n},
                     {"drive_count", w->drive_count},
                     {"coast_count", w->coast_count}};
  } else if (!result.load.empty()) {
    json["wedge"] = nullptr;
  }
  if (const auto& s = result.stiffness) {
    json["stiffness"] = {{"secant_nm_per_rad", number(s->secant_nm_per_rad)},
                         {"lost_motion_arcmin", number(s->lost_motion_arcmin)},
                         {"take_up_rad", number(s->take_up_rad)},
                         {"wind_up_rad", number(s->wind_up_rad)}};
  }
  if (const auto& c = result.certificate) {
    json["certificate"] = {{"holds", c->holds()},
                           {"complementarity", c->complementarity},
                           {"min_gap_um", c->min_gap_um},
                           {"min_force_n", c->min_force_n},
                           {"reciprocity", c->reciprocity},
                           {"equilibrium", c->equilibrium},
                           {"exact_gap_residual_um", c->exact_gap_residual_um},
                           {"rounding_um", c->rounding_um},
                           {"discretisation_estimate", number(c->discretisation_estimate)}};
  }
  json["stages"] = Json::array();
  for (const Stage& stage : result.stages) {
    json["stages"].push_back(
        {{"name", stage.name}, {"seconds", stage.seconds}, {"status", name(stage.status)}});
  }
  return json;
}

std::string result_json_text(const ForwardResult& result, const LoadPath* path) {
  return result_json(result, path).dump(2);
}

} // namespace strainwave
