#include "strainwave/model/gear/gear.hpp"

namespace strainwave {

Gear seed_gear() {
  Gear gear;
  gear.name = "seed 140/142";
  gear.material = {.youngs_modulus_mpa = 206000.0, .poisson_ratio = 0.3};
  gear.flexspline = {.module_mm = 0.2,
                     .pressure_angle_deg = 20.0,
                     .teeth = 140,
                     .profile_shift = 2.13,
                     .tip_radius_mm = 14.584,
                     .root_radius_mm = 14.156,
                     .neutral_radius_mm = 14.006,
                     .rim_thickness_mm = 0.3,
                     .wall_thickness_mm = 0.3,
                     .cup_length_mm = 28.0,
                     .face_width_mm = 6.0,
                     .front_clearance_mm = 0.5,
                     .diaphragm_thickness_mm = 0.3,
                     .boss_radius_mm = 5.0};
  gear.circular_spline = {
      .teeth = 142, .profile_shift = 2.19, .tip_radius_mm = 14.5, .root_radius_mm = 14.86};
  gear.wave_generator.max_radial_deformation_mm = 0.2;
  gear.wave_generator.eccentricity_mm = 0.6;
  gear.wave_generator.contact_width_mm = 4.0;
  gear.contact.force_direction = ForceDirection::circumferential; // as the source text has it
  gear.load.torque_nm = {1.0, 7.0, 11.5};
  return gear;
}

} // namespace strainwave
