#pragma once
// Outlines as comma-separated values, one point a line; the units stand in the header:
//   outline,tooth,phi_deg,part,flank_coordinate,radius_mm,x_mm,y_mm,removal_um
// flank_coordinate and removal_um are empty where there is no flank.

#include "strainwave/model/export/profile.hpp"

#include <string>

namespace strainwave {

std::string profile_csv(const std::vector<Outline>& outlines);

} // namespace strainwave
