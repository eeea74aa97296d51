#include "strainwave/model/meshing/flank_points.hpp"

#include "strainwave/model/contact/ring_compliance.hpp"
#include "strainwave/model/meshing/pressure_angle.hpp"
#include "strainwave/model/tooth/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strainwave {

AssembledPoses::AssembledPoses(const RingCompliance& ring, const AssembledState& assembled,
                               double neutral_radius_mm, double phase, std::vector<double> z_mm)
    : period_(ring.period()), pitch_(2.0 * std::numbers::pi / ring.sectors()), phase_(phase),
      neutral_radius_(neutral_radius_mm) {
  std::vector<int> sectors;
  first_sector_ = -period_ / 2 - 2;
  for (int k = first_sector_; k <= period_ / 2 + 2; ++k)
    sectors.push_back(k);
  for (const double z : z_mm) {
    const Eigen::MatrixX4d section =
        ring.section(sectors, z, assembled.stations, assembled.force_components(), {}, Eigen::VectorXd());
    std::vector<Displacement> slice;
    for (Eigen::Index i = 0; i < section.rows(); ++i) {
      slice.push_back({section(i, UnitResponses::section_radial),
                       section(i, UnitResponses::section_circumferential),
                       section(i, UnitResponses::section_rotation)});
    }
    at_.push_back(std::move(slice));
  }
}

Pose AssembledPoses::standing(double phi_rad, const Displacement& d) const {
  const double across = neutral_radius_ + d.u;
  const double turn = std::atan2(d.v, across);
  return {.rho_mm = std::hypot(across, d.v),
          .phi1_rad = phi_rad + turn,
          .normal_rotation_rad = d.rotation - turn};
}

AssembledPoses::Displacement AssembledPoses::interpolated(double phi_rad, int slice) const {
  const auto& at = at_[static_cast<std::size_t>(slice)];
  std::vector<double> angle;
  for (std::size_t i = 0; i < at.size(); ++i)
    angle.push_back(pitch_ * (first_sector_ + static_cast<int>(i) + phase_));
  Displacement d;
  for (const auto& [i, weight] : lagrange_weights(angle, phi_rad)) {
    const Displacement& from = at[static_cast<std::size_t>(i)];
    d.u += weight * from.u;
    d.v += weight * from.v;
    d.rotation += weight * from.rotation;
  }
  return d;
}

Pose AssembledPoses::pose(int sector, double phi_rad, int slice) const {
  const int size = static_cast<int>(at_.front().size());
  int i = sector - first_sector_;
  if (i < 0 || i >= size) { // the second lobe, or a sector counted the other way round
    i = ((sector - first_sector_) % period_ + period_) % period_;
  }
  return standing(phi_rad, at_[static_cast<std::size_t>(slice)][static_cast<std::size_t>(i)]);
}

Pose AssembledPoses::between(double phi_rad, int slice) const {
  return standing(phi_rad, interpolated(phi_rad, slice));
}

double AssembledPoses::radial(double phi_rad, int slice) const {
  return interpolated(phi_rad, slice).u;
}

std::vector<double> slice_places(const UnitResponses& responses) {
  std::vector<double> z = responses.flank_z_mm;
  if (z.size() >
      1) { // a half hat at either end of the face: its mean is that of a point a third of the step inside
    const double third = (z[1] - z[0]) / 3.0;
    z.front() += third;
    z.back() -= third;
  }
  return z;
}

double gap_height(int level, int levels) {
  const double step = 1.0 / (levels - 1.0);
  return level + 1 == levels ? 1.0 - step / 3.0 : level * step;
}

double face_coordinate(const Flexspline& fs, double z_mm) {
  const double middle = fs.cup_length_mm - fs.front_clearance_mm - 0.5 * fs.face_width_mm;
  return (z_mm - middle) / (0.5 * fs.face_width_mm);
}

std::vector<LoadedPoint> flank_points(const Gear& gear, const UnitResponses& responses, const Backlash& teeth,
                                      const std::vector<FlankPair>& flanks, const PoseSource& pose_source) {
  const Flexspline& fs = gear.flexspline;
  const double ratio = static_cast<double>(fs.teeth) / gear.circular_spline.teeth;
  const double height = fs.tip_radius_mm - fs.root_radius_mm;
  const double step = 1.0 / (static_cast<double>(responses.flank_radius_mm.size()) - 1.0);
  const bool normal = gear.contact.direction_of_force() == ForceDirection::flank_normal;
  const std::vector<double> places = slice_places(responses);
  std::vector<LoadedPoint> points;
  for (std::size_t i = 0; i < teeth.tooth.size(); ++i) {
    const bool second = teeth.lobe[i] != 0;
    const double own_lobe = teeth.phi_rad[i] - (second ? std::numbers::pi : 0.0);
    for (std::size_t slice = 0; slice < flanks.size(); ++slice) {
      const FlankPair& pair = flanks[slice];
      const Pose pose = pose_source(teeth.tooth[i], own_lobe, static_cast<int>(slice));
      const double space = own_lobe * ratio;
      const auto add_contact = [&](const ToothBacklash& contact, double flank_height, int level) {
        points.push_back({.tooth = teeth.tooth[i],
                          .phi_rad = teeth.phi_rad[i],
                          .backlash_mm = contact.backlash_mm,
                          .contact_radius_mm = contact.contact_radius_mm,
                          .flank_radius_mm = fs.root_radius_mm + flank_height * height,
                          .pressure_angle_rad = normal ? contact_pressure_angle(gear, pose, contact) : 0.0,
                          .slice = flanks.size() > 1 ? static_cast<int>(slice) : -1,
                          .z_mm = places[slice],
                          .level = level,
                          .edge = contact.place == ContactPlace::flexspline_tip ||
                                  contact.place == ContactPlace::circular_spline_tip});
      };
      if (gear.contact.flank_points == 1) { // the source text's model: the point of least gap
        const ToothBacklash contact = pair.drive(pose, space);
        if (contact.overlap)
          add_contact(contact, contact.flank_height, 0);
        continue;
      }
      const std::vector<GapPoint> ends = gap_profile(pair, pose, space, 2);
      if (ends.empty())
        continue;
      const auto add = [&](const GapPoint& at, ContactPlace place, int level) {
        const double of_load = place == ContactPlace::flexspline_tip ? 1.0 : at.flank_height;
        add_contact({.overlap = true,
                     .backlash_mm = at.gap_mm,
                     .contact_radius_mm = at.radius_mm,
                     .flank_height = at.flank_height,
                     .place = place},
                    of_load, level);
      };
      const double edge =
          ends.front().flank_height; // the circular spline's tip edge, or the flexspline's root
      add(ends.front(), edge > 1e-12 ? ContactPlace::circular_spline_tip : ContactPlace::flexspline_root, -1);
      for (std::size_t level = 0; level < responses.flank_radius_mm.size(); ++level) {
        const bool last = level + 1 == responses.flank_radius_mm.size();
        const double h =
            gap_height(static_cast<int>(level), static_cast<int>(responses.flank_radius_mm.size()));
        if (h < edge + 0.5 * step)
          continue;
        if (const auto at = gap_at_height(pair, pose, space, h)) {
          add(*at, last ? ContactPlace::flexspline_tip : ContactPlace::flank, static_cast<int>(level));
        }
      }
    }
  }
  return points;
}

} // namespace strainwave
