#pragma once
// Outlines as a DXF drawing, ASCII, release 12 (AC1009): closed POLYLINEs, one layer for each kind of
// outline. DXF has no units in release 12; $INSUNITS = 4 (mm) is written all the same, because later programs
// read it. Source: Autodesk, DXF Reference (R12), groups of HEADER, TABLES, POLYLINE.

#include "strainwave/model/export/profile.hpp"

#include <string>

namespace strainwave {

std::string profile_dxf(const std::vector<Outline>& outlines);

} // namespace strainwave
