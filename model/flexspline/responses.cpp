#include "strainwave/model/flexspline/responses.hpp"

#include "strainwave/common/core/memory.hpp"
#include "strainwave/common/threads/parallel.hpp"
#include "strainwave/model/flexspline/cyclic.hpp"
#include "strainwave/model/flexspline/request_checks.hpp"
#include "strainwave/model/flexspline/sparse.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

namespace strainwave {

namespace {

std::atomic<std::uint64_t> cups_begun = 0;

struct FaceRange {
  double rear, front;
};
FaceRange face_range(const Flexspline& f) {
  const double front = f.cup_length_mm - f.front_clearance_mm;
  return {front - f.face_width_mm, front};
}

std::vector<double> equidistant(double begin, double end, int count) {
  std::vector<double> values;
  for (int n = 0; n < count; ++n)
    values.push_back(n == count - 1 ? end : begin + (end - begin) * n / (count - 1));
  return values;
}

/// Half width of the wall hats in z.
Hat row_hat(const ResponseRequest& r, double z) {
  const double half = r.flexspline.rim_thickness_mm;
  return {z - half, z, z + half};
}

void add_sections(const ResponseRequest& r, const SectorMesh& mesh, ResponseFunctionals& result) {
  const Flexspline& f = r.flexspline;
  const double inner = f.neutral_radius_mm - f.rim_thickness_mm / 2.0;
  for (const double z : result.layout.section_z_mm) {
    // Behind the face the wall; in the step between them (mesh.hpp) whichever is thinner.
    const double rear = face_range(f).rear, wall = f.wall_thickness_mm;
    const double rim = r.teeth ? f.root_radius_mm - inner : wall, step = std::fabs(rim - wall);
    const double thickness = z >= rear ? rim : z > rear - step ? std::min(rim, wall) : wall;
    const double neutral = r.teeth && z >= rear ? f.neutral_radius_mm : inner + thickness / 2.0;
    const PointFunctionals at_neutral = point_functionals(mesh, {neutral, 0.0, z});
    const PointFunctionals at_inner = point_functionals(mesh, {inner, 0.0, z});
    const PointFunctionals at_outer = point_functionals(mesh, {inner + thickness, 0.0, z});
    const double by = 1.0 / thickness;
    result.functionals.push_back({at_neutral.radial, {}});
    result.functionals.push_back({at_neutral.circumferential, {}});
    result.functionals.push_back({combine(at_outer.circumferential, by, at_inner.circumferential, -by), {}});
    result.functionals.push_back({combine(at_outer.axial, by, at_inner.axial, -by), {}});
  }
}

/// The mean of both sides of Maxwell and Betti's theorem for each pair: contact takes its displacements and
/// its matrix from either side, and they must be the same numbers.
void make_reciprocal(UnitResponses& u) {
  const auto n = static_cast<std::size_t>(u.count());
  const auto at = [&](int k, std::size_t a, std::size_t b) -> double& {
    return u.data[(static_cast<std::size_t>(k) * n + a) * n + b];
  };
  for (int k = 0; k <= u.sectors / 2; ++k)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        double &here = at(k, a, b), &there = at((u.sectors - k) % u.sectors, b, a);
        here = there = 0.5 * (here + there);
      }
}

double largest_reciprocity_error(const UnitResponses& u) {
  double error = 0.0, scale = 0.0;
  const int n = u.count();
  for (int k = 0; k <= u.sectors / 2; ++k)
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        error = std::max(error, std::fabs(u(k, a, b) - u(-k, b, a)));
        scale = std::max({scale, std::fabs(u(k, a, b)), std::fabs(u(-k, b, a))});
      }
  return scale > 0.0 ? error / scale : 0.0;
}

double flank_difference(const UnitResponses& fine, const UnitResponses& coarse) {
  double difference = 0.0, scale = 0.0;
  for (int k = 0; k < fine.sectors; ++k)
    for (int a = 0; a < fine.flank_count(); ++a)
      for (int b = 0; b < fine.flank_count(); ++b) {
        difference = std::max(difference, std::fabs(fine(k, a, b) - coarse(k, a, b)));
        scale = std::max(scale, std::fabs(fine(k, a, b)));
      }
  return scale > 0.0 ? difference / scale : 0.0;
}

} // namespace

ResponseFunctionals response_functionals(const ResponseRequest& r, const SectorMesh& mesh) {
  ResponseFunctionals result;
  UnitResponses& layout = result.layout;
  const FaceRange face = face_range(r.flexspline);
  layout.sectors = mesh.sectors;
  layout.wall_offset = r.wall_offset;
  layout.wall_z_mm =
      r.wall_z_mm.empty() ? equidistant(face.rear, face.front, r.mesh.along_face + 1) : r.wall_z_mm;
  if (r.sections)
    layout.section_z_mm = r.section_z_mm.empty() ? layout.wall_z_mm : r.section_z_mm;
  const auto add = [&](DirectionPair&& pair) {
    result.functionals.push_back(std::move(pair.circumferential));
    result.functionals.push_back(std::move(pair.radial));
  };
  if (r.teeth) {
    const double root = r.flexspline.root_radius_mm, tip = r.flexspline.tip_radius_mm;
    layout.flank_radius_mm = equidistant(root, tip, r.flank_heights);
    layout.flank_z_mm = r.face_slices == 1 ? std::vector<double>{0.5 * (face.rear + face.front)}
                                           : equidistant(face.rear, face.front, r.face_slices);
    layout.both_flanks = r.both_flanks;
  }
  const auto hats = [&](FlankSide side, auto&& each) {
    for (int height = 0; height < r.flank_heights; ++height)
      for (int slice = 0; slice < r.face_slices; ++slice) {
        const Hat across = r.face_slices == 1 ? Hat{.constant = true}
                                              : equidistant_hat(face.rear, face.front, r.face_slices, slice);
        each(slice, flank_hat(mesh,
                              equidistant_hat(r.flexspline.root_radius_mm, r.flexspline.tip_radius_mm,
                                              r.flank_heights, height),
                              across, side));
      }
  };
  if (r.teeth) {
    hats(FlankSide::drive, [&](int slice, DirectionPair hat) {
      if (slice == 0)
        layout.flank_centre_mm.push_back(moment_about_axis(mesh, hat.circumferential));
      add(std::move(hat));
    });
  }
  for (const double offset : layout.wall_offset)
    for (const double z : layout.wall_z_mm)
      add(wall_hat(mesh, offset, row_hat(r, z)));
  add_sections(r, mesh, result);
  if (layout.both_flanks)
    hats(FlankSide::coast, [&](int, DirectionPair hat) { add(std::move(hat)); });
  return result;
}

std::uint64_t cups_solved() {
  return cups_begun;
}

Outcome<UnitResponses> unit_responses(const ResponseRequest& request, int threads) {
  if (const auto failure = find_flaw(request))
    return *failure;
  ++cups_begun;
  require_memory(response_memory_bytes(request, usable_threads(threads)),
                 fmt::format("the finite elements of the flexspline ({:.0f} a tooth pitch, {} pitches)",
                             mesh_size(request.flexspline, request.mesh, request.teeth).elements,
                             request.sectors > 0 ? request.sectors : request.flexspline.teeth),
                 "take smaller counts in [mesh]");
  const auto solve = [&](const Mesh& counts) -> Outcome<UnitResponses> {
    const Outcome<SectorMesh> mesh =
        sector_mesh(request.flexspline, counts, {request.teeth, request.sectors});
    if (!mesh)
      return mesh.failure();
    ResponseFunctionals plan = response_functionals(request, *mesh);
    try {
      plan.layout.data = cyclic_responses(*mesh, request.material, plan.functionals, threads);
    } catch (const NotPositiveStiffness&) {
      return ill_conditioned_cup(request);
    }
    if (!std::all_of(plan.layout.data.begin(), plan.layout.data.end(),
                     [](double g) { return std::isfinite(g); }))
      return ill_conditioned_cup(request);
    return std::move(plan.layout);
  };
  Outcome<UnitResponses> fine = solve(request.mesh);
  if (!fine)
    return fine;
  UnitResponses result = std::move(fine).value();
  result.reciprocity_error = largest_reciprocity_error(result);
  make_reciprocal(result);
  if (request.estimate && request.teeth) {
    const Outcome<UnitResponses> coarse = solve(coarser(request.mesh, request.teeth));
    if (!coarse)
      return coarse.failure();
    result.discretisation_estimate = flank_difference(result, *coarse) / (std::exp2(response_order) - 1.0);
  }
  return result;
}

} // namespace strainwave
