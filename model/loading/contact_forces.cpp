#include "strainwave/model/loading/contact_forces.hpp"

#include <map>

namespace strainwave {

namespace {

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Sums forces by sector and functional over the whole ring; a folded load acts on both lobes.
class RingForces {
public:
  explicit RingForces(const RingCompliance& ring) : ring_(ring) {}
  void add(int sector, int functional, double force) {
    if (force == 0.0)
      return;
    const int n = ring_.sectors();
    for (int lobe = 0; lobe < n / ring_.period(); ++lobe) {
      sum_[{((sector + lobe * ring_.period()) % n + n) % n, functional}] += force;
    }
  }
  std::vector<FunctionalForce> list() const {
    std::vector<FunctionalForce> result;
    for (const auto& [at, force] : sum_)
      result.push_back({at.first, at.second, force});
    return result;
  }

private:
  const RingCompliance& ring_;
  std::map<std::pair<int, int>, double> sum_;
};

} // namespace

ContactForces contact_forces(std::string name, const RingCompliance& ring, const AssembledState& assembled,
                             const Eigen::MatrixX2d& wall_force, const std::vector<LoadedPoint>& teeth,
                             const std::vector<double>& tooth_force) {
  ContactForces result;
  result.name = std::move(name);
  RingForces forces(ring);
  const std::vector<ToothFunctional> functionals = tooth_functionals(ring, teeth);
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    result.teeth.push_back({teeth[i], tooth_force[i]});
    // A tooth force pushes towards smaller φ, its functional towards larger φ.
    for (const auto& [functional, weight] : functionals[i].weights) {
      forces.add(functionals[i].sector, functional, -weight * tooth_force[i]);
    }
  }
  const Eigen::MatrixX2d displacement = ring.wall_displacement(
      assembled.stations, assembled.stations, wall_force, functionals, -vector_of(tooth_force));
  const UnitResponses& responses = ring.responses();
  for (std::size_t i = 0; i < assembled.stations.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const WallStation& station = assembled.stations[i];
    WallContact contact{.station = station,
                        .average = {},
                        .radial_n = wall_force(at, 0),
                        .circumferential_n = wall_force(at, 1),
                        .radial_mm = displacement(at, 0),
                        .circumferential_mm = displacement(at, 1)};
    for (const auto& [row, weight] : lagrange_weights(responses.wall_z_mm, station.z_mm)) {
      const int functional = responses.wall(station.station, row, UnitResponses::circumferential);
      const int sector = (station.sector % ring.sectors() + ring.sectors()) % ring.sectors();
      contact.average.push_back({sector, functional, weight});
      forces.add(sector, functional, weight * contact.circumferential_n);
      forces.add(sector, functional + 1, weight * contact.radial_n);
    }
    result.wall.push_back(std::move(contact));
  }
  result.forces = forces.list();
  return result;
}

} // namespace strainwave
