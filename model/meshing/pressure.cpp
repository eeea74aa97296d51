#include "strainwave/model/meshing/pressure.hpp"

#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/tooth/flank_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace strainwave {

LineContact line_contact(double line_load_n_per_mm, double relative_curvature_per_mm,
                         double contact_modulus_mpa, double share_mm) {
  if (!(line_load_n_per_mm > 0.0))
    return {};
  const double mean = line_load_n_per_mm / share_mm;
  if (!(relative_curvature_per_mm > 0.0))
    return {0.5 * share_mm, mean};
  const double b = std::sqrt(4.0 * line_load_n_per_mm /
                             (std::numbers::pi * contact_modulus_mpa * relative_curvature_per_mm));
  return {std::min(b, 0.5 * share_mm), std::max(2.0 * line_load_n_per_mm / (std::numbers::pi * b), mean)};
}

double contact_modulus_mpa(const Material& material) {
  return material.youngs_modulus_mpa / (2.0 * (1.0 - material.poisson_ratio * material.poisson_ratio));
}

const FlankPair& FlankPressure::flanks_at(double z_mm) {
  auto found = flanks_.find(z_mm);
  if (found == flanks_.end()) {
    // the same flanks have been made for the gaps, so this cannot fail
    found =
        flanks_.emplace(z_mm, FlankPair::make(gear_, face_coordinate(gear_.flexspline, z_mm)).value()).first;
  }
  return found->second;
}

std::vector<LineContact> FlankPressure::of(const std::vector<LoadedPoint>& points,
                                           const std::vector<double>& force_n) {
  const Flexspline& fs = gear_.flexspline;
  const double circular_base = 0.5 * fs.module_mm * gear_.circular_spline.teeth *
                               std::cos(fs.pressure_angle_deg * std::numbers::pi / 180.0);
  const double modulus = contact_modulus_mpa(gear_.material);
  const int slices = gear_.contact.face_slices;
  std::map<std::tuple<int, int>, std::vector<std::size_t>>
      lines; // the points over each other of (tooth, slice)
  for (std::size_t i = 0; i < points.size(); ++i)
    lines[{points[i].tooth, points[i].slice}].push_back(i);

  std::vector<LineContact> result(points.size());
  for (auto& [line, index] : lines) {
    if (std::none_of(index.begin(), index.end(), [&](std::size_t i) { return force_n[i] > 0.0; }))
      continue;
    const auto [tooth, slice] = line;
    const FlankPair& pair = flanks_at(points[index.front()].z_mm);
    const auto height = [&](std::size_t k) {
      return flank_length_mm(pair, points[index[k]].flank_radius_mm);
    };
    std::sort(index.begin(), index.end(), [&](std::size_t a, std::size_t b) {
      return points[a].flank_radius_mm < points[b].flank_radius_mm;
    });
    double face = fs.face_width_mm;
    if (slice >= 0 && slices > 1)
      face *= (slice == 0 || slice == slices - 1 ? 0.5 : 1.0) / (slices - 1);
    for (std::size_t k = 0; k < index.size(); ++k) {
      const LoadedPoint& point = points[index[k]];
      double force = force_n[index[k]];
      if (!(force > 0.0))
        continue;
      if (gear_.contact.direction_of_force() == ForceDirection::circumferential)
        force *= point.contact_radius_mm / std::min(circular_base, point.contact_radius_mm);
      const double share =
          index.size() > 1
              ? 0.5 * (height(std::min(k + 1, index.size() - 1)) - height(k > 0 ? k - 1 : 0))
              : flank_length_mm(pair, fs.tip_radius_mm) - flank_length_mm(pair, fs.root_radius_mm);
      const double curvature = flexspline_curvature(pair, point.flank_radius_mm) -
                               circular_spline_curvature(pair, point.contact_radius_mm);
      result[index[k]] = line_contact(force / face, curvature, modulus, share);
    }
  }
  return result;
}

} // namespace strainwave
