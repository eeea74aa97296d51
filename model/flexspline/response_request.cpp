#include "strainwave/model/flexspline/response_request.hpp"

#include <algorithm>

namespace strainwave {

ResponseRequest response_request(const Gear& gear) {
  ResponseRequest request;
  request.flexspline = gear.flexspline;
  request.material = gear.material;
  request.mesh = gear.mesh;
  request.face_slices = gear.contact.face_slices;
  request.both_flanks = true;
  if (gear.contact.flank_points > 1) {
    request.flank_heights = gear.contact.flank_points;
    // as many nodes along the flank and the face as hats, or the hats could not be told apart
    request.mesh.tooth_height = std::max(gear.mesh.tooth_height, gear.contact.flank_points / 2);
  } else {
    request.flank_heights = std::min(request.flank_heights, 2 * gear.mesh.tooth_height + 1); // rows of nodes
  }
  // whole multiples, so that disc edges that stood on a row of nodes still do: between rows the wall is held
  // softer there
  const int rows = gear.mesh.along_face;
  request.mesh.along_face = rows * std::max(1, (gear.contact.face_slices / 2 + rows - 1) / rows);
  return request;
}

double row_spacing_mm(const Gear& gear) {
  return gear.flexspline.face_width_mm / response_request(gear).mesh.along_face;
}

} // namespace strainwave
