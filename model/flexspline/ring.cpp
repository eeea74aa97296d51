#include "strainwave/model/flexspline/ring.hpp"

#include <algorithm>

namespace strainwave {

RingPart::RingPart(const SectorMesh& sector_mesh, int sectors)
    : sector(sector_mesh), count(sectors > 0 ? std::min(sectors, sector_mesh.sectors) : sector_mesh.sectors) {
  left_place.assign(sector.nodes.size(), -1);
  for (std::size_t b = 0; b < sector.right.size(); ++b)
    left_place[static_cast<std::size_t>(sector.right[b])] = static_cast<int>(b);
}

int RingPart::nodes() const {
  return sector.owned() * count + (closed() ? 0 : static_cast<int>(sector.right.size()));
}

int RingPart::node(int i, int j) const {
  const auto at = static_cast<std::size_t>(i);
  if (sector.ring_index[at] >= 0)
    return j * sector.owned() + sector.ring_index[at];
  if (j + 1 < count || closed())
    return node(sector.left_twin[at], (j + 1) % count);
  return count * sector.owned() + left_place[at];
}

std::vector<CartesianPoint> RingPart::points() const {
  std::vector<CartesianPoint> result(static_cast<std::size_t>(nodes()));
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < static_cast<int>(sector.nodes.size()); ++i)
      if (sector.ring_index[static_cast<std::size_t>(i)] >= 0 || (j + 1 == count && !closed()))
        result[static_cast<std::size_t>(node(i, j))] = sector.node(i, j);
  return result;
}

std::vector<double> RingPart::angles() const {
  std::vector<double> result(static_cast<std::size_t>(nodes()));
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < static_cast<int>(sector.nodes.size()); ++i)
      if (sector.ring_index[static_cast<std::size_t>(i)] >= 0 || (j + 1 == count && !closed()))
        result[static_cast<std::size_t>(node(i, j))] = sector.angle(i, j);
  return result;
}

std::vector<int> RingPart::fixed() const {
  std::vector<int> result;
  for (int j = 0; j < count; ++j)
    for (const int dof : sector.fixed)
      result.push_back(3 * node(dof / 3, j) + dof % 3);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void RingPart::add_load(const Functional& functional, int j, double factor,
                        Eigen::Ref<Eigen::VectorXd> force) const {
  for (const auto& [weights, at] :
       {std::pair{&functional.here, j}, std::pair{&functional.next, (j + 1) % count}})
    for (std::size_t n = 0; n < weights->dof.size(); ++n)
      force[3 * node(weights->dof[n] / 3, at) + weights->dof[n] % 3] += factor * weights->weight[n];
}

double RingPart::measure(const Functional& functional, int j,
                         const Eigen::Ref<const Eigen::VectorXd>& displacement) const {
  double sum = 0.0;
  for (const auto& [weights, at] :
       {std::pair{&functional.here, j}, std::pair{&functional.next, (j + 1) % count}})
    for (std::size_t n = 0; n < weights->dof.size(); ++n)
      sum += weights->weight[n] * displacement[3 * node(weights->dof[n] / 3, at) + weights->dof[n] % 3];
  return sum;
}

} // namespace strainwave
