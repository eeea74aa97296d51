#include "strainwave/model/meshing/gear_surface.hpp"

#include "strainwave/model/flexspline/response_request.hpp"

namespace strainwave {

std::vector<double> contact_rows(const Gear& gear) {
  const Flexspline& fs = gear.flexspline;
  const WaveGenerator& wg = gear.wave_generator;
  const double middle = fs.cup_length_mm - fs.front_clearance_mm - 0.5 * fs.face_width_mm;
  if (wg.contact_width_mm < 0.1 * row_spacing_mm(gear))
    return {middle};
  return {middle - 0.5 * wg.contact_width_mm, middle, middle + 0.5 * wg.contact_width_mm};
}

WaveGeneratorSurface discs_of(const Gear& gear, double eccentricity_mm, double neutral_disc_radius_mm) {
  const Flexspline& fs = gear.flexspline;
  const double half = 0.5 * fs.rim_thickness_mm;
  return {WaveGeneratorSurface::Discs{
              .eccentricity_mm = eccentricity_mm,
              .neutral_disc_radius_mm = neutral_disc_radius_mm,
              .linearised = gear.contact.disc_gap == DiscGap::linearised,
              .taper_per_mm = 1e-3 * gear.wave_generator.disc_taper_um / gear.wave_generator.contact_width_mm,
              .middle_z_mm = fs.cup_length_mm - fs.front_clearance_mm - 0.5 * fs.face_width_mm},
          fs.neutral_radius_mm - half, half};
}

WaveGeneratorSurface surface_of(const Gear& gear, const NeutralCurve& curve, double disc_shift_mm) {
  const Flexspline& fs = gear.flexspline;
  const double half = 0.5 * fs.rim_thickness_mm;
  const CurveSummary& summary = curve.summary();
  if (summary.disc_radius_mm)
    return discs_of(gear, *summary.eccentricity_mm + disc_shift_mm, *summary.disc_radius_mm);
  return {[curve](double x, double y) {
            const CurveFoot foot = curve.foot(x, y);
            return WaveGeneratorSurface::Foot{foot.distance_mm, foot.normal_angle_rad};
          },
          fs.neutral_radius_mm - half, half};
}

} // namespace strainwave
