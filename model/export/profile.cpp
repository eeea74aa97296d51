#include "strainwave/model/export/profile.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/kinematics/neutral_curve.hpp"
#include "strainwave/model/tooth/consistency.hpp"
#include "strainwave/model/tooth/profile.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace strainwave {

namespace {

using units::pi;
constexpr int arc_pieces = 8;
constexpr int curve_points = 720;

class Drawing {
public:
  Drawing(const Gear& gear_in, const FlankPair& flanks, const NeutralCurve& neutral,
          const ProfileOptions& wanted)
      : gear(gear_in), pair(flanks), curve(neutral), options(wanted) {}

  Outline design(OutlineKind kind) const {
    const bool tooth = kind == OutlineKind::tooth;
    const Member member = tooth ? Member::flexspline : Member::circular_spline;
    const std::vector<PolarPoint> drive = flank_profile(pair, member, options.flank_points);
    Outline outline{kind, 0, 0.0, {}};
    const auto flank = [&](OutlinePart part, double side, std::size_t k) {
      const double h = static_cast<double>(k) / static_cast<double>(drive.size() - 1);
      add(outline, drive[k].radius_mm, side * drive[k].angle_rad, part, h, removal(member, h));
    };
    for (std::size_t k = 0; k < drive.size(); ++k)
      flank(OutlinePart::coast_flank, -1.0, k);
    arc(outline, drive.back(), -1.0, OutlinePart::outer_arc);
    for (std::size_t k = drive.size(); k-- > 0;)
      flank(OutlinePart::drive_flank, 1.0, k);
    arc(outline, drive.front(), 1.0, OutlinePart::inner_arc);
    return outline;
  }

  /// The tooth's neutral point goes to the pose, its centre line to polar angle φ1 + θ_n.
  Outline assembled_tooth(int tooth) const {
    Outline outline = design(OutlineKind::tooth);
    const Pose pose = curve.pose(angle_of(tooth));
    const double turn = pose.phi1_rad + pose.normal_rotation_rad;
    const double c = std::cos(turn), s = std::sin(turn);
    for (OutlinePoint& p : outline.points) {
      const double along = p.x_mm - curve.neutral_radius_mm(), across = p.y_mm;
      p.x_mm = pose.rho_mm * std::cos(pose.phi1_rad) + c * along - s * across;
      p.y_mm = pose.rho_mm * std::sin(pose.phi1_rad) + s * along + c * across;
    }
    return named(std::move(outline), OutlineKind::assembled_tooth, tooth);
  }

  Outline assembled_space(int tooth) const {
    Outline outline = design(OutlineKind::space);
    const double turn = angle_of(tooth) * gear.flexspline.teeth / gear.circular_spline.teeth;
    const double c = std::cos(turn), s = std::sin(turn);
    for (OutlinePoint& p : outline.points) {
      const double x = p.x_mm, y = p.y_mm;
      p.x_mm = c * x - s * y;
      p.y_mm = s * x + c * y;
    }
    return named(std::move(outline), OutlineKind::assembled_space, tooth);
  }

  Outline neutral_line() const {
    Outline outline{OutlineKind::neutral_line, 0, 0.0, {}};
    for (int k = 0; k < curve_points; ++k) {
      const double polar = 2.0 * pi * k / curve_points;
      add(outline, curve.neutral_radius_mm() + curve.displacement(polar).u_mm, polar, OutlinePart::curve,
          std::numeric_limits<double>::quiet_NaN(), 0.0);
    }
    return outline;
  }

  double angle_of(int tooth) const { return 2.0 * pi * tooth / gear.flexspline.teeth; }

private:
  static void add(Outline& outline, double radius, double angle, OutlinePart part, double h, double removed) {
    outline.points.push_back({radius * std::cos(angle), radius * std::sin(angle), part, h, removed});
  }
  /// Inner points of the arc from one flank's end to its mirror image; `from` is the side it starts on.
  static void arc(Outline& outline, const PolarPoint& end, double from, OutlinePart part) {
    for (int k = 1; k < arc_pieces; ++k)
      add(outline, end.radius_mm, from * end.angle_rad * (1.0 - 2.0 * k / arc_pieces), part,
          std::numeric_limits<double>::quiet_NaN(), 0.0);
  }
  double removal(Member member, double h) const {
    const FlankModifications& m = gear.flank_modification;
    return 1e3 * removal_mm(member == Member::flexspline ? m.flexspline : m.circular_spline, member, h,
                            options.zeta, gear.flexspline.face_width_mm);
  }
  Outline named(Outline outline, OutlineKind kind, int tooth) const {
    outline.kind = kind;
    outline.tooth = tooth;
    outline.phi_deg = angle_of(tooth) * 180.0 / pi;
    return outline;
  }

  const Gear& gear;
  const FlankPair& pair;
  const NeutralCurve& curve;
  const ProfileOptions& options;
};

} // namespace

Outcome<std::vector<Outline>> profile_outlines(const Gear& gear, const ProfileOptions& options) {
  if (const auto failure = find_contradiction(gear))
    return *failure;
  const auto pair = FlankPair::make(gear, options.zeta);
  if (!pair)
    return pair.failure();
  const auto curve = NeutralCurve::make(gear.wave_generator, gear.flexspline);
  if (!curve)
    return curve.failure();
  const Drawing drawing(gear, *pair, *curve, options);
  std::vector<int> teeth = options.teeth;
  const int quarter = gear.flexspline.teeth / 4;
  for (const int tooth : teeth)
    if (std::abs(tooth) > quarter)
      return Failure{
          Status::contradiction,
          fmt::format("tooth {} stands at {:.1f}°, outside the first lobe: teeth from {} to {} can be drawn",
                      tooth, drawing.angle_of(tooth) * 180.0 / pi, -quarter, quarter)};
  for (int tooth = -quarter; options.teeth.empty() && tooth <= quarter; ++tooth)
    if (const double phi = drawing.angle_of(tooth) * 180.0 / pi; phi >= -10.0 && phi <= 20.0)
      teeth.push_back(tooth);

  std::vector<Outline> outlines = {drawing.design(OutlineKind::tooth), drawing.design(OutlineKind::space)};
  for (const int tooth : teeth) {
    outlines.push_back(drawing.assembled_tooth(tooth));
    outlines.push_back(drawing.assembled_space(tooth));
  }
  outlines.push_back(drawing.neutral_line());
  return outlines;
}

const char* layer_name(OutlineKind kind) {
  switch (kind) {
  case OutlineKind::tooth:
    return "FLEXSPLINE_TOOTH";
  case OutlineKind::space:
    return "CIRCULAR_SPLINE_SPACE";
  case OutlineKind::assembled_tooth:
    return "FLEXSPLINE_ASSEMBLED";
  case OutlineKind::assembled_space:
    return "CIRCULAR_SPLINE_ASSEMBLED";
  default:
    return "NEUTRAL_LINE";
  }
}

const char* part_name(OutlinePart part) {
  switch (part) {
  case OutlinePart::coast_flank:
    return "coast_flank";
  case OutlinePart::outer_arc:
    return "outer_arc";
  case OutlinePart::drive_flank:
    return "drive_flank";
  case OutlinePart::inner_arc:
    return "inner_arc";
  default:
    return "curve";
  }
}

} // namespace strainwave
