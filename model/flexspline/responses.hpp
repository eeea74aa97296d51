#pragma once
// From a flexspline to its unit responses: mesh, functionals, cyclic solve, and the checks that go with them.
//
// Functionals of one sector (signs, units and order: unit_responses.hpp):
//   flank    hats in radius between `flank_heights` equidistant levels root … tip, constant across the face
//            (one slice) or hats between `face_slices` places rear … front; circumferential and radial;
//            with `both_flanks` also on the coast flank
//   wall     hats in angle between the stations, half width half a pitch, times a hat in z of half width
//            rim_thickness about the row (cut only at the open end); circumferential and radial
//   section  a point of the neutral surface under the tooth centre: radial, circumferential; rotation about
//            the axis (u_φ(outer) − u_φ(inner))/t; meridian tilt (u_z(outer) − u_z(inner))/t of the normal
//
// Rows are fixed by the cup and its mesh, never by the wave generator: along_face + 1 equidistant ones over
// the face.
//
// Discretisation estimate: the same functionals on a mesh of about half the counts (mesh.hpp, coarser). With
// errors that shrink like (mesh size)^p the finer solution is off by |difference|/(2^p − 1). Measured on the
// seed cup (docs/flexspline.md): p = 2.15 for one loaded lobe, 1.17 for the pair sums, which feel the sharp
// foot of the tooth; p = 1 is used. Given is the largest such difference of the flank-to-flank responses over
// their largest. A single layer through the thickness cannot be halved, so the estimate does not see that
// part.

#include "strainwave/common/core/outcome.hpp"
#include "strainwave/model/flexspline/functionals.hpp"
#include "strainwave/model/flexspline/mesh.hpp"
#include "strainwave/model/flexspline/unit_responses.hpp"
#include "strainwave/model/gear/gear.hpp"

#include <cstdint>
#include <vector>

namespace strainwave {

struct ResponseRequest {
  Flexspline flexspline;
  Material material;
  Mesh mesh;
  bool teeth = true;
  int sectors = 0;                              ///< smooth cup: number of sectors; 0: as many as teeth
  int flank_heights = 5;                        ///< ≥ 2
  int face_slices = 1;                          ///< 1: constant across the face
  std::vector<double> wall_offset = {0.0, 0.5}; ///< stations in pitches from the tooth centre, each in [0, 1)
  std::vector<double> wall_z_mm;    ///< rows; empty: along_face + 1 equidistant ones over the face
  bool both_flanks = false;         ///< the hats of the coast flank too
  bool sections = true;             ///< section functionals at all
  std::vector<double> section_z_mm; ///< rows; empty: those of the wall
  bool estimate = true; ///< discretisation estimate (a second, coarser solve); cups with teeth only
};

/// Order of convergence that the estimate supposes.
inline constexpr double response_order = 1.0;

/// The functionals of a request on a mesh; data and checks stay empty.
struct ResponseFunctionals {
  UnitResponses layout;
  std::vector<Functional> functionals;
};
ResponseFunctionals response_functionals(const ResponseRequest& request, const SectorMesh& mesh);

/// The unit responses of the free cup, or the sentence that says why there are none. threads 0: as many as
/// cores; the bits of the result do not depend on it.
Outcome<UnitResponses> unit_responses(const ResponseRequest& request, int threads = 0);

/// How many cups this process has begun to solve: for those who must not solve one twice.
std::uint64_t cups_solved();

} // namespace strainwave
