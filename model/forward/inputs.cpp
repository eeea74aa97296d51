#include "model/forward/inputs.hpp"

#include "model/forward/forward.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace strainwave {

ContentKey curve_key(const WaveGenerator& wg, const Flexspline& fs) {
  ContentKey key;
  key.add(static_cast<double>(wg.shape)).add(fs.neutral_radius_mm).add(fs.rim_thickness_mm);
  key.add(wg.max_radial_deformation_mm);
  for (const auto& number : {wg.eccentricity_mm, wg.wrap_angle_deg, wg.force_angle_deg}) {
    key.add(number ? 1.0 : 0.0).add(number.value_or(0.0));
  }
  if (wg.shape == WaveGeneratorShape::table) {
    std::ifstream file(wg.table_file);
    key.add(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  return key;
}

ResponseRequest response_request(const Gear& gear) {
  ResponseRequest request;
  request.flexspline = gear.flexspline;
  request.material = gear.material;
  request.mesh = gear.mesh;
  request.face_slices = gear.contact.face_slices;
  if (gear.contact.flank_points > 1) {
    request.flank_heights = gear.contact.flank_points;
    // as many nodes along the flank and the face as hats, or the hats could not be told apart
    request.mesh.tooth_height = std::max(gear.mesh.tooth_height, gear.contact.flank_points / 2);
  } else {
    request.flank_heights = std::min(request.flank_heights, 2 * gear.mesh.tooth_height + 1); // rows of nodes
  }
  request.mesh.along_face = std::max(gear.mesh.along_face, gear.contact.face_slices / 2);
  return request;
}

namespace {

/// Rows of the mesh on which the wall's responses are known stand this far apart.
double row_spacing(const Gear& gear) {
  return gear.flexspline.face_width_mm / response_request(gear).mesh.along_face;
}

} // namespace

std::optional<Failure> find_unavailable(const Gear& gear) {
  const auto refuse = [](std::string sentence) {
    return Failure{Status::not_available, std::move(sentence)};
  };
  const Contact& c = gear.contact;
  if (c.fidelity == Fidelity::nonlinear || c.assembly == AssemblyModel::nonlinear) {
    return refuse("the nonlinear finite-element check is not in this version; use contact.fidelity = "
                  "\"unilateral\" and "
                  "contact.assembly = \"small_displacement\"");
  }
  if (c.reference_section_mm && !(gear.wave_generator.shape == WaveGeneratorShape::two_disc ||
                                  gear.wave_generator.shape == WaveGeneratorShape::two_disc_exact)) {
    return refuse("contact.reference_section_mm shifts the two discs; this wave generator has none");
  }
  if (gear.wave_generator.disc_taper_um != 0.0 && gear.wave_generator.shape != WaveGeneratorShape::two_disc &&
      gear.wave_generator.shape != WaveGeneratorShape::two_disc_exact) {
    return refuse(fmt::format(
        "wave_generator.disc_taper_um {} µm is a cone of the two discs; this wave generator has none",
        gear.wave_generator.disc_taper_um));
  }
  if (gear.wave_generator.shape == WaveGeneratorShape::four_force && c.fidelity != Fidelity::linear) {
    return refuse(
        "a four_force wave generator has no surface to lift off from; use contact.fidelity = \"linear\"");
  }
  const double overhang = 0.5 * (gear.wave_generator.contact_width_mm - gear.flexspline.face_width_mm);
  if (overhang > row_spacing(gear)) {
    return refuse(fmt::format(
        "wave_generator.contact_width_mm {} reaches {} mm past both ends of face_width_mm {}; the wall's "
        "compliance is known under the teeth and {} mm (one element) beyond",
        gear.wave_generator.contact_width_mm, overhang, gear.flexspline.face_width_mm, row_spacing(gear)));
  }
  return std::nullopt;
}

std::vector<double> contact_rows(const Gear& gear) {
  const Flexspline& fs = gear.flexspline;
  const WaveGenerator& wg = gear.wave_generator;
  const double middle = fs.cup_length_mm - fs.front_clearance_mm - 0.5 * fs.face_width_mm;
  if (wg.contact_width_mm < 0.1 * row_spacing(gear))
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
