#include "strainwave/model/flexspline/request_checks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace strainwave {

std::optional<Failure> find_flaw(const ResponseRequest& r) {
  const auto no = [](std::string message) { return Failure{Status::contradiction, std::move(message)}; };
  if (r.teeth && r.flank_heights < 2)
    return no(fmt::format("flank_heights = {}: at least 2 hats cover a flank", r.flank_heights));
  if (r.teeth && r.flank_heights > 2 * r.mesh.tooth_height + 1)
    return no(
        fmt::format("{} hats on a flank need mesh.tooth_height = {} at least (there are {} rows of nodes)",
                    r.flank_heights, (r.flank_heights) / 2, 2 * r.mesh.tooth_height + 1));
  if (r.teeth && r.face_slices > 2 * r.mesh.along_face + 1)
    return no(fmt::format("{} hats across the face need mesh.along_face = {} at least", r.face_slices,
                          r.face_slices / 2));
  if (r.teeth && r.face_slices < 1)
    return no(fmt::format("face_slices = {}: at least 1", r.face_slices));
  if (!(r.material.youngs_modulus_mpa > 0.0) ||
      !(r.material.poisson_ratio > -1.0 && r.material.poisson_ratio < 0.5))
    return no(fmt::format("E = {} MPa and ν = {} are no elastic material", r.material.youngs_modulus_mpa,
                          r.material.poisson_ratio));
  for (const double offset : r.wall_offset)
    if (!(offset >= 0.0 && offset < 1.0))
      return no(fmt::format("wall station {} is not in [0, 1) pitches", offset));
  const double bottom = r.flexspline.diaphragm_thickness_mm / 2.0, top = r.flexspline.cup_length_mm;
  for (const auto* rows : {&r.wall_z_mm, &r.section_z_mm})
    for (std::size_t n = 0; n < rows->size(); ++n) {
      if (!((*rows)[n] >= bottom && (*rows)[n] <= top))
        return no(
            fmt::format("row z = {} mm does not lie on the wall ({} … {} mm)", (*rows)[n], bottom, top));
      if (n > 0 && !((*rows)[n] > (*rows)[n - 1]))
        return no("rows along the axis must ascend");
    }
  return {};
}

Failure ill_conditioned_cup(const ResponseRequest& r) {
  const Flexspline& f = r.flexspline;
  struct Suspect {
    const char* name;
    double value, spread;
  };
  const double radius = f.neutral_radius_mm;
  const auto thin = [&](double length) { return std::pow(radius / length, 3); };
  const Suspect suspects[] = {
      {"material.poisson_ratio", r.material.poisson_ratio, 1.0 / (1.0 - 2.0 * r.material.poisson_ratio)},
      {"flexspline.rim_thickness_mm", f.rim_thickness_mm, thin(f.rim_thickness_mm)},
      {"flexspline.wall_thickness_mm", f.wall_thickness_mm, thin(f.wall_thickness_mm)},
      {"flexspline.diaphragm_thickness_mm", f.diaphragm_thickness_mm, thin(f.diaphragm_thickness_mm)},
      {"flexspline.boss_radius_mm", f.boss_radius_mm, thin(f.boss_radius_mm)},
      {"flexspline.face_width_mm", f.face_width_mm, thin(f.face_width_mm)},
      {"flexspline.front_clearance_mm", f.front_clearance_mm,
       f.front_clearance_mm > 0.0 ? thin(f.front_clearance_mm) : 0.0},
      {"flexspline.cup_length_mm", f.cup_length_mm, std::pow(f.cup_length_mm / radius, 3)}};
  const Suspect& worst =
      *std::max_element(std::begin(suspects), std::end(suspects),
                        [](const Suspect& a, const Suspect& b) { return a.spread < b.spread; });
  return {
      Status::ill_conditioned,
      fmt::format("the flexspline's finite elements cannot be solved in double precision: the stiffness is "
                  "not positive "
                  "definite to rounding; most likely {} {} is too extreme for a cup of neutral_radius_mm {}",
                  worst.name, worst.value, radius)};
}

double response_memory_bytes(const ResponseRequest& r, int threads) {
  const MeshSize size = mesh_size(r.flexspline, r.mesh, r.teeth);
  const double rows = r.wall_z_mm.empty() ? r.mesh.along_face + 1.0 : static_cast<double>(r.wall_z_mm.size());
  const double flank = r.teeth ? (r.both_flanks ? 4.0 : 2.0) * r.flank_heights * r.face_slices : 0.0;
  const double functionals =
      flank + 2.0 * rows * static_cast<double>(r.wall_offset.size()) + (r.sections ? 4.0 * rows : 0.0);
  const double sectors = r.sectors > 0 ? r.sectors : r.flexspline.teeth;
  const double side = size.side_unknowns, square = functionals * functionals;
  const double triplets = 60.0 * 61.0 / 2.0 * size.elements * 16.0;
  const double sector = 16.0 * side * side * 8.0;
  const double harmonic = (side * side + 6.0 * functionals * side + 8.0 * square) * 8.0;
  const double responses = 3.0 * square * sectors * 8.0; // spectrum, responses, a copy
  return 2.5 * triplets + sector + threads * harmonic + responses;
}

} // namespace strainwave
