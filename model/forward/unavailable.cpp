#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/forward/forward.hpp"

#include <fmt/format.h>

namespace strainwave {

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
