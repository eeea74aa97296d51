#include "strainwave/model/export/cup_deck.hpp"

#include "strainwave/model/flexspline/calculix.hpp"
#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/responses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace strainwave {

namespace {

/// Mesh and functionals of a request, as the unit responses use them.
struct Cup {
  SectorMesh mesh;
  ResponseFunctionals plan;
};

Outcome<Cup> cup_of(const ResponseRequest& request) {
  auto mesh = sector_mesh(request.flexspline, request.mesh, {request.teeth, request.sectors});
  if (!mesh)
    return mesh.failure();
  Cup cup{std::move(mesh).value(), {}};
  cup.plan = response_functionals(request, cup.mesh);
  return cup;
}

std::string comment(const Gear& gear, const Cup& cup, const std::string& loads) {
  return fmt::format(
      "Cup of the strain wave gear \"{}\", written by strainwave\n"
      "** {} sectors, {} nodes, {} elements C3D20R; bore of radius {:g} mm fixed\n"
      "** E = {:g} MPa, Poisson's ratio {:g}; linear statics\n"
      "** Tooth 0 stands on the x axis, tooth k at 360 k/{} degrees; drive flank: larger angle\n"
      "{}** Run: ccx NAME (without .inp); displacements go to NAME.dat, fields to NAME.frd",
      gear.name, cup.mesh.sectors, cup.mesh.ring_nodes(), cup.mesh.ring_elements(),
      gear.flexspline.boss_radius_mm, gear.material.youngs_modulus_mpa, gear.material.poisson_ratio,
      cup.mesh.sectors, loads);
}

std::string deck_text(const Gear& gear, const Cup& cup, const std::vector<std::vector<DeckLoad>>& cases,
                      const std::string& loads) {
  std::ostringstream out;
  write_calculix_deck(out, RingPart(cup.mesh), gear.material, cases, comment(gear, cup, loads));
  return std::move(out).str();
}

} // namespace

Outcome<std::string> calculix_deck(const Gear& gear, const UnitToothLoad& load) {
  const auto cup = cup_of(response_request(gear));
  if (!cup)
    return cup.failure();
  const UnitResponses& layout = cup->plan.layout;
  const int teeth = cup->mesh.sectors, sector = (load.tooth % teeth + teeth) % teeth;
  const int heights = static_cast<int>(layout.flank_radius_mm.size());
  const int slices = static_cast<int>(layout.flank_z_mm.size());
  const double place = load.flank_height * (heights - 1);
  const int below = std::clamp(static_cast<int>(std::floor(place)), 0, heights - 2);
  std::vector<DeckLoad> loads;
  for (const auto& [height, weight] :
       {std::pair{below, below + 1 - place}, std::pair{below + 1, place - below}}) {
    for (int slice = 0; slice < slices && weight != 0.0; ++slice)
      loads.push_back(
          {cup->plan.functionals[static_cast<std::size_t>(layout.flank(
               height, slice, load.radial ? UnitResponses::radial : UnitResponses::circumferential))],
           sector, weight / slices}); // evenly, as contact does without points across the face
  }
  return deck_text(
      gear, *cup, {loads},
      fmt::format("** Load: 1 N {} on the drive flank of tooth {}, flank coordinate {:g} (0 root, 1 tip),\n"
                  "** spread over the face by a hat over the flank's height\n",
                  load.radial ? "outwards" : "towards larger angles", load.tooth, load.flank_height));
}

Outcome<std::string> calculix_deck(const Gear& gear, const ContactStates& states) {
  const auto cup = cup_of(states.request);
  if (!cup)
    return cup.failure();
  std::vector<std::vector<DeckLoad>> cases;
  std::string loads =
      "** Loads: the contact forces of strainwave's analysis on wall and flanks, both lobes\n";
  for (const ContactForces& state : states.states) {
    cases.emplace_back();
    for (const FunctionalForce& force : state.forces)
      cases.back().push_back(
          {cup->plan.functionals[static_cast<std::size_t>(force.functional)], force.sector, force.force_n});
    loads += fmt::format("** Step {}: {}\n", cases.size(), state.name);
  }
  return deck_text(gear, *cup, cases, loads);
}

} // namespace strainwave
