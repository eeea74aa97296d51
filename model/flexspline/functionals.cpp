#include "strainwave/model/flexspline/functionals.hpp"

#include "strainwave/model/flexspline/element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

namespace strainwave {

namespace {

constexpr std::array<double, 4> gauss_place = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                               0.8611363115940526};
constexpr std::array<double, 4> gauss_weight = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                                0.3478548451374538};

/// A side as a surface of two of the element's local coordinates, the third held.
struct SideFrame {
  int u, v, held;
  double at;
};
SideFrame side_frame(int side) {
  switch (side) {
  case 1:
    return {0, 1, 2, -1.0};
  case 2:
    return {0, 1, 2, 1.0};
  case 3:
    return {0, 2, 1, -1.0};
  case 4:
    return {1, 2, 0, 1.0};
  case 5:
    return {0, 2, 1, 1.0};
  default:
    return {1, 2, 0, -1.0};
  }
}

Eigen::Vector3d local_of(const SideFrame& frame, double u, double v) {
  Eigen::Vector3d local;
  local[frame.u] = u;
  local[frame.v] = v;
  local[frame.held] = frame.at;
  return local;
}

Eigen::Vector3d position(const ElementPoints& points, const Eigen::Vector3d& local) {
  return points.transpose() * hexahedron_shape(local);
}

/// The places in [−1, 1] where a monotone coordinate passes the kinks, with both ends.
template <class Coordinate>
std::vector<double> pieces(const Coordinate& coordinate, const Hat& hat) {
  std::vector<double> ends = {-1.0, 1.0};
  if (hat.constant)
    return ends;
  const double first = coordinate(-1.0), last = coordinate(1.0);
  const double sign = last > first ? 1.0 : -1.0;
  for (const double kink : {hat.lower, hat.peak, hat.upper}) {
    if (sign * (kink - first) <= 0.0 || sign * (last - kink) <= 0.0)
      continue;
    double low = -1.0, high = 1.0;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (sign * (coordinate(middle) - kink) < 0.0 ? low : high) = middle;
    }
    ends.push_back(0.5 * (low + high));
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < 1e-12; }),
             ends.end());
  return ends;
}

/// Sums of a surface hat: forces by degree of freedom for both directions, and ∫ w dA.
struct HatIntegral {
  std::map<int, double> circumferential, radial;
  double resultant = 0.0;
};

/// Adds one side. The hats see coordinate_u(point), coordinate_v(point); each must vary along u, v alone.
template <class CoordinateU, class CoordinateV>
void integrate_side(const SectorMesh& mesh, const ElementFace& face, const CoordinateU& coordinate_u,
                    const Hat& hat_u, const CoordinateV& coordinate_v, const Hat& hat_v, HatIntegral& sum) {
  const SideFrame frame = side_frame(face.side);
  const ElementPoints points = element_points(mesh, face.element);
  const auto& nodes = mesh.elements[static_cast<std::size_t>(face.element)];
  const auto along_u = [&](double u) { return coordinate_u(position(points, local_of(frame, u, 0.0))); };
  const auto along_v = [&](double v) { return coordinate_v(position(points, local_of(frame, 0.0, v))); };
  const auto misses = [](double a, double b, const Hat& hat) {
    return !hat.constant && (std::fmax(a, b) <= hat.lower || std::fmin(a, b) >= hat.upper);
  };
  if (misses(along_u(-1.0), along_u(1.0), hat_u) || misses(along_v(-1.0), along_v(1.0), hat_v))
    return;
  const std::vector<double> ends_u = pieces(along_u, hat_u), ends_v = pieces(along_v, hat_v);
  for (std::size_t pu = 0; pu + 1 < ends_u.size(); ++pu)
    for (std::size_t pv = 0; pv + 1 < ends_v.size(); ++pv)
      for (std::size_t gu = 0; gu < 4; ++gu)
        for (std::size_t gv = 0; gv < 4; ++gv) {
          const double half_u = 0.5 * (ends_u[pu + 1] - ends_u[pu]),
                       half_v = 0.5 * (ends_v[pv + 1] - ends_v[pv]);
          const Eigen::Vector3d local = local_of(frame, ends_u[pu] + half_u * (1.0 + gauss_place[gu]),
                                                 ends_v[pv] + half_v * (1.0 + gauss_place[gv]));
          const Eigen::Vector3d x = position(points, local);
          const double w = hat_u(coordinate_u(x)) * hat_v(coordinate_v(x));
          if (w == 0.0)
            continue;
          const Eigen::Matrix3d tangents = hexahedron_shape_gradient(local).transpose() * points;
          const double area = tangents.row(frame.u).cross(tangents.row(frame.v)).norm() * half_u * half_v *
                              gauss_weight[gu] * gauss_weight[gv];
          const Eigen::Matrix<double, 20, 1> shape = hexahedron_shape(local);
          const double phi = std::atan2(x.y(), x.x());
          sum.resultant += w * area;
          for (std::size_t a = 0; a < 20; ++a) {
            const double part = w * area * shape[static_cast<Eigen::Index>(a)];
            if (part == 0.0)
              continue;
            const double turn = phi - mesh.nodes[static_cast<std::size_t>(nodes[a])].angle;
            sum.circumferential[3 * nodes[a]] -= part * std::sin(turn);
            sum.circumferential[3 * nodes[a] + 1] += part * std::cos(turn);
            sum.radial[3 * nodes[a]] += part * std::cos(turn);
            sum.radial[3 * nodes[a] + 1] += part * std::sin(turn);
          }
        }
}

SectorWeights scaled(const std::map<int, double>& forces, double factor) {
  SectorWeights weights;
  for (const auto& [dof, force] : forces)
    weights.add(dof, force * factor);
  return weights;
}

double radius_of(const Eigen::Vector3d& x) {
  return std::hypot(x.x(), x.y());
}
double angle_of(const Eigen::Vector3d& x) {
  return std::atan2(x.y(), x.x());
}
double z_of(const Eigen::Vector3d& x) {
  return x.z();
}

} // namespace

double Hat::operator()(double x) const {
  if (constant)
    return 1.0;
  if (x < peak)
    return lower < peak ? std::fmax(0.0, (x - lower) / (peak - lower)) : 1.0;
  return peak < upper ? std::fmax(0.0, (upper - x) / (upper - peak)) : 1.0;
}

Hat equidistant_hat(double begin, double end, int count, int index) {
  const auto knot = [&](int n) { return begin + (end - begin) * n / (count - 1); };
  return {knot(std::max(index - 1, 0)), knot(index), knot(std::min(index + 1, count - 1))};
}

DirectionPair flank_hat(const SectorMesh& mesh, const Hat& radius, const Hat& z, FlankSide side) {
  HatIntegral sum;
  for (const ElementFace& face : side == FlankSide::drive ? mesh.drive_flank : mesh.coast_flank)
    integrate_side(mesh, face, radius_of, radius, z_of, z, sum);
  if (!(sum.resultant > 0.0))
    throw std::logic_error("a flank hat without support on the flank");
  return {{scaled(sum.circumferential, 1.0 / sum.resultant), {}},
          {scaled(sum.radial, 1.0 / sum.resultant), {}}};
}

DirectionPair wall_hat(const SectorMesh& mesh, double offset, const Hat& z) {
  const double pitch = mesh.pitch_rad();
  std::array<HatIntegral, 2> parts;
  for (int sector = 0; sector < 2; ++sector) {
    const double centre = (offset - sector) * pitch;
    const Hat angle = {centre - pitch / 2.0, centre, centre + pitch / 2.0};
    // Seen from sector 0 a full hat about the tooth centre ends on the boundaries; beyond them it belongs to
    // `next`.
    for (const ElementFace& face : mesh.inner_wall)
      integrate_side(mesh, face, angle_of, angle, z_of, z, parts[static_cast<std::size_t>(sector)]);
  }
  const double resultant = parts[0].resultant + parts[1].resultant;
  if (!(resultant > 0.0))
    throw std::logic_error("a wall hat without support on the inner wall");
  const double factor = 1.0 / resultant;
  return {{scaled(parts[0].circumferential, factor), scaled(parts[1].circumferential, factor)},
          {scaled(parts[0].radial, factor), scaled(parts[1].radial, factor)}};
}

double moment_about_axis(const SectorMesh& mesh, const Functional& functional) {
  double moment = 0.0;
  for (const auto* part : {&functional.here, &functional.next})
    for (std::size_t n = 0; n < part->dof.size(); ++n)
      if (part->dof[n] % 3 == 1)
        moment += part->weight[n] * mesh.nodes[static_cast<std::size_t>(part->dof[n] / 3)].radius;
  return moment;
}

PointFunctionals point_functionals(const SectorMesh& mesh, const CylinderPoint& point) {
  const Eigen::Vector3d target(point.radius * std::cos(point.angle), point.radius * std::sin(point.angle),
                               point.z);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementPoints points = element_points(mesh, static_cast<int>(e));
    const Eigen::Vector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
    const double slack = 0.05 * (high - low).maxCoeff();
    if (((target - low).array() < -slack).any() || ((high - target).array() < -slack).any())
      continue;
    Eigen::Vector3d local = Eigen::Vector3d::Zero();
    for (int step = 0; step < 30; ++step) {
      const Eigen::Matrix3d jacobian = (hexahedron_shape_gradient(local).transpose() * points).transpose();
      const Eigen::Vector3d correction = jacobian.inverse() * (target - position(points, local));
      local += correction;
      if (correction.norm() < 1e-14 || local.norm() > 10.0)
        break;
    }
    // Curved sides are parabolas: a point on a boundary may lie outside by the sagitta's cubic remainder.
    if (!(local.cwiseAbs().maxCoeff() <= 1.0 + 1e-6))
      continue;
    const Eigen::Matrix<double, 20, 1> shape = hexahedron_shape(local);
    std::map<int, double> radial, circumferential, axial;
    for (std::size_t a = 0; a < 20; ++a) {
      const int node = mesh.elements[e][a];
      const double n = shape[static_cast<Eigen::Index>(a)];
      const double turn = point.angle - mesh.nodes[static_cast<std::size_t>(node)].angle;
      radial[3 * node] += n * std::cos(turn);
      radial[3 * node + 1] += n * std::sin(turn);
      circumferential[3 * node] -= n * std::sin(turn);
      circumferential[3 * node + 1] += n * std::cos(turn);
      axial[3 * node + 2] += n;
    }
    return {scaled(radial, 1.0), scaled(circumferential, 1.0), scaled(axial, 1.0)};
  }
  throw std::logic_error(
      fmt::format("the point r = {} mm, φ = {} rad, z = {} mm lies outside the flexspline's mesh",
                  point.radius, point.angle, point.z));
}

SectorWeights combine(const SectorWeights& a, double first, const SectorWeights& b, double second) {
  std::map<int, double> sum;
  for (std::size_t n = 0; n < a.dof.size(); ++n)
    sum[a.dof[n]] += first * a.weight[n];
  for (std::size_t n = 0; n < b.dof.size(); ++n)
    sum[b.dof[n]] += second * b.weight[n];
  return scaled(sum, 1.0);
}

} // namespace strainwave
