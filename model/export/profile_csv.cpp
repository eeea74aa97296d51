#include "strainwave/model/export/profile_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

namespace strainwave {

std::string profile_csv(const std::vector<Outline>& outlines) {
  std::string text = "outline,tooth,phi_deg,part,flank_coordinate,radius_mm,x_mm,y_mm,removal_um\n";
  const auto out = std::back_inserter(text);
  for (const Outline& outline : outlines) {
    std::string name = layer_name(outline.kind);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const OutlinePoint& p : outline.points) {
      const bool flank = p.part == OutlinePart::coast_flank || p.part == OutlinePart::drive_flank;
      fmt::format_to(out, "{},{},{:.6f},{},{},{:.9f},{:.9f},{:.9f},{}\n", name, outline.tooth,
                     outline.phi_deg, part_name(p.part),
                     flank ? fmt::format("{:.6f}", p.flank_coordinate) : "", p.radius_mm(), p.x_mm, p.y_mm,
                     flank ? fmt::format("{:.6f}", p.removal_um) : "");
    }
  }
  return text;
}

} // namespace strainwave
