#include "strainwave/model/export/profile_dxf.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace strainwave {

namespace {

constexpr std::array<OutlineKind, 5> kinds = {OutlineKind::tooth, OutlineKind::space,
                                              OutlineKind::assembled_tooth, OutlineKind::assembled_space,
                                              OutlineKind::neutral_line};
/// AutoCAD's colour numbers: blue, red, blue, red, grey.
constexpr std::array<int, 5> colour = {5, 1, 5, 1, 8};

/// DXF text: a group code on one line, its value on the next.
class Groups {
public:
  void add(int code, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "{:>3}\n{}\n", code, value);
  }
  void add(int code, int value) { add(code, std::to_string(value)); }
  void add(int code, double value) { add(code, fmt::format("{:.9f}", value)); }
  std::string text;
};

void header(Groups& groups) {
  groups.add(999, "strainwave: tooth and space profiles, all lengths in mm, x along the major axis");
  groups.add(0, "SECTION");
  groups.add(2, "HEADER");
  groups.add(9, "$ACADVER");
  groups.add(1, "AC1009");
  groups.add(9, "$INSUNITS");
  groups.add(70, 4);
  groups.add(0, "ENDSEC");
}

void tables(Groups& groups) {
  groups.add(0, "SECTION");
  groups.add(2, "TABLES");
  groups.add(0, "TABLE");
  groups.add(2, "LTYPE");
  groups.add(70, 1);
  groups.add(0, "LTYPE");
  groups.add(2, "CONTINUOUS");
  groups.add(70, 0);
  groups.add(3, "Solid line");
  groups.add(72, 65);
  groups.add(73, 0);
  groups.add(40, 0.0);
  groups.add(0, "ENDTAB");
  groups.add(0, "TABLE");
  groups.add(2, "LAYER");
  groups.add(70, static_cast<int>(kinds.size()));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    groups.add(0, "LAYER");
    groups.add(2, layer_name(kinds[k]));
    groups.add(70, 0);
    groups.add(62, colour[k]);
    groups.add(6, "CONTINUOUS");
  }
  groups.add(0, "ENDTAB");
  groups.add(0, "ENDSEC");
}

void polyline(Groups& groups, const Outline& outline) {
  const char* layer = layer_name(outline.kind);
  groups.add(0, "POLYLINE");
  groups.add(8, layer);
  groups.add(66, 1); // vertices follow
  groups.add(10, 0.0);
  groups.add(20, 0.0);
  groups.add(30, 0.0);
  groups.add(70, 1); // closed
  for (const OutlinePoint& p : outline.points) {
    groups.add(0, "VERTEX");
    groups.add(8, layer);
    groups.add(10, p.x_mm);
    groups.add(20, p.y_mm);
    groups.add(30, 0.0);
  }
  groups.add(0, "SEQEND");
  groups.add(8, layer);
}

} // namespace

std::string profile_dxf(const std::vector<Outline>& outlines) {
  Groups groups;
  header(groups);
  tables(groups);
  groups.add(0, "SECTION");
  groups.add(2, "ENTITIES");
  for (const Outline& outline : outlines)
    polyline(groups, outline);
  groups.add(0, "ENDSEC");
  groups.add(0, "EOF");
  return std::move(groups.text);
}

} // namespace strainwave
