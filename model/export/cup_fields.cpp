#include "strainwave/model/export/cup_fields.hpp"

#include "strainwave/model/export/cup_grid.hpp"
#include "strainwave/model/flexspline/cyclic_stress.hpp"
#include "strainwave/model/flexspline/functionals.hpp"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

double measured(const SectorMesh& mesh, const Functional& functional, int sector,
                const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  double sum = 0.0;
  const auto add = [&](const SectorWeights& weights, int at) {
    for (std::size_t n = 0; n < weights.dof.size(); ++n)
      sum +=
          weights.weight[n] * displacement[3 * mesh.ring_node(weights.dof[n] / 3, at) + weights.dof[n] % 3];
  };
  add(functional.here, sector);
  add(functional.next, sector + 1);
  return sum;
}

double largest_difference(const ContactForces& state, const SectorMesh& mesh,
                          const std::vector<Functional>& functionals,
                          const Eigen::Ref<const Eigen::VectorXd>& displacement) {
  double worst = 0.0;
  for (const WallContact& wall : state.wall) {
    double radial = -wall.radial_mm, circumferential = -wall.circumferential_mm;
    for (const FunctionalForce& part : wall.average) {
      const auto at = static_cast<std::size_t>(part.functional);
      circumferential += part.force_n * measured(mesh, functionals[at], part.sector, displacement);
      radial += part.force_n * measured(mesh, functionals[at + 1], part.sector, displacement);
    }
    worst = std::max({worst, std::fabs(radial), std::fabs(circumferential)});
  }
  return worst;
}

} // namespace

Outcome<CupFields> cup_fields(const ContactStates& states) {
  const ResponseRequest& request = states.request;
  auto mesh = sector_mesh(request.flexspline, request.mesh, {request.teeth, request.sectors});
  if (!mesh)
    return mesh.failure();
  CupFields result;
  result.mesh = std::move(mesh).value();
  const std::vector<Functional> functionals = response_functionals(request, result.mesh).functionals;
  std::vector<std::vector<FieldLoad>> cases;
  for (const ContactForces& state : states.states) {
    result.names.push_back(state.name);
    cases.emplace_back();
    for (const FunctionalForce& force : state.forces)
      cases.back().push_back(
          {&functionals[static_cast<std::size_t>(force.functional)], force.sector, force.force_n});
  }
  result.field = ring_field(result.mesh, request.material, cases);
  result.von_mises_mpa = largest_von_mises(result.mesh, request.material, result.field.displacement);
  for (std::size_t c = 0; c < states.states.size(); ++c)
    result.contact_difference_mm =
        std::max(result.contact_difference_mm,
                 largest_difference(states.states[c], result.mesh, functionals,
                                    result.field.displacement.col(static_cast<Eigen::Index>(c))));
  return result;
}

UnstructuredGrid field_grid(const CupFields& fields) {
  UnstructuredGrid grid = ring_grid(fields.mesh);
  for (std::size_t c = 0; c < fields.names.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    const std::string& name = fields.names[c];
    grid.point_data.push_back(
        {name + "_displacement_mm", "mm", 3, cartesian(fields.mesh, fields.field.displacement.col(column))});
    grid.point_data.push_back(
        {name + "_contact_force_n", "N", 3, cartesian(fields.mesh, fields.field.force.col(column))});
    const Eigen::VectorXd stress = fields.von_mises_mpa.col(column);
    grid.cell_data.push_back(
        {name + "_von_mises_mpa", "MPa", 1, std::vector<double>(stress.begin(), stress.end())});
  }
  return grid;
}

} // namespace strainwave
