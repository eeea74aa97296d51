#include "strainwave/model/forward/inputs.hpp"

#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/forward/forward.hpp"

#include <fmt/format.h>

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
  if (overhang > row_spacing_mm(gear)) {
    return refuse(fmt::format(
        "wave_generator.contact_width_mm {} reaches {} mm past both ends of face_width_mm {}; the wall's "
        "compliance is known under the teeth and {} mm (one element) beyond",
        gear.wave_generator.contact_width_mm, overhang, gear.flexspline.face_width_mm, row_spacing_mm(gear)));
  }
  return std::nullopt;
}

} // namespace strainwave
