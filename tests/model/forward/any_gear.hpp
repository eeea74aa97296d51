#pragma once
// Gears for tests that must end well for every legal file: a quick one, fields at the ends of their ranges,
// and random ones counted by an index, so that any of them can be made again alone.

#include "strainwave/model/gear/fields.hpp"
#include "tests/support/coarse_seed.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace strainwave::testing_support {

/// splitmix64 (Steele, Lea, Flood 2014) of a counter: number `n` of stream `stream`.
class Counted {
public:
  explicit Counted(std::uint64_t stream) : state_(stream * 0x9e3779b97f4a7c15u) {
    state_ = bits();
  } // far apart
  std::uint64_t bits() {
    std::uint64_t h = state_ += 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; } ///< [0, 1)
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }

private:
  std::uint64_t state_;
};

/// The seed gear on the coarsest mesh: one analysis takes some 10 ms.
inline Gear quick_gear() {
  Gear gear = testing_support::coarse_seed_gear(testing_support::coarsest_mesh);
  gear.load.torque_nm = {7.0};
  return gear;
}

/// Counts that only cost time and memory stay small here.
inline double small_upper(const Field& field) {
  if (field.table() == "mesh")
    return field.range.lower + 2.0;
  if (field.path == "load.phases")
    return 3.0;
  if (field.path == "contact.flank_points" || field.path == "contact.face_slices")
    return 3.0;
  return std::isfinite(field.range.upper) ? field.range.upper : 1e300;
}

inline double lower_end(const Field& field) {
  if (!std::isfinite(field.range.lower))
    return -1e300;
  return field.range.lower_open ? std::nextafter(field.range.lower, 1e300) : field.range.lower;
}
inline double upper_end(const Field& field) {
  const double upper = small_upper(field);
  return field.range.upper_open && upper == field.range.upper ? std::nextafter(upper, -1e300) : upper;
}

/// Values at and near both ends, all choices, absence, short and long lists. Texts keep their value.
inline std::vector<FieldValue> ends_of(const Field& field) {
  std::vector<FieldValue> values;
  if (field.may_be_absent)
    values.emplace_back();
  const double lower = lower_end(field), upper = upper_end(field);
  switch (field.kind) {
  case FieldKind::number:
    values.insert(values.end(), {lower, upper});
    if (field.range.lower_open)
      values.insert(values.end(), {field.range.lower + 1e-9 * (upper - field.range.lower), 1e-6, 1e-3});
    if (field.range.upper_open)
      values.emplace_back(upper - 1e-9 * (upper - lower));
    break;
  case FieldKind::integer:
    values.insert(values.end(), {static_cast<int>(lower), static_cast<int>(upper)});
    break;
  case FieldKind::choice:
    for (const std::string_view choice : field.choices)
      values.emplace_back(std::string(choice));
    break;
  case FieldKind::number_list:
    values.emplace_back(std::vector<double>{});
    if (field.list_length == 2) {
      values.insert(values.end(), {std::vector<double>{lower, upper},
                                   std::vector<double>{lower, std::nextafter(lower, upper)},
                                   std::vector<double>{upper - 1e-9, upper}});
    } else {
      for (const double x : {lower, upper}) {
        values.emplace_back(std::vector<double>{x});
        values.emplace_back(std::vector<double>{x, 0.0});
        values.emplace_back(std::vector<double>{0.0, x, 0.0, x, x});
      }
      values.emplace_back(std::vector<double>{1e-300, 1e-12});
    }
    break;
  case FieldKind::text:
    break;
  }
  return values;
}

/// A legal value somewhere: near what the gear has, spread over many powers of ten, or at an end.
inline FieldValue random_value(const Field& field, const Gear& gear, Counted& random) {
  const std::vector<FieldValue> ends = ends_of(field);
  const auto number = [&](double now) {
    const double lower = lower_end(field), upper = upper_end(field);
    double x = now;
    const std::size_t way = random.below(4);
    if (way < 2)
      x = now * (0.8 + 0.4 * random.unit());
    else if (way == 2)
      x = (now == 0.0 ? 1.0 : now) * std::pow(10.0, 6.0 * random.unit() - 3.0);
    else
      x = lower + (upper - lower) * random.unit();
    return std::min(std::max(x, lower), upper);
  };
  if (ends.empty())
    return field.read(gear);
  const FieldValue now = field.read(gear);
  if (random.below(8) == 0 || field.kind == FieldKind::choice)
    return ends[random.below(ends.size())];
  if (field.kind == FieldKind::integer) {
    const int near = std::get<int>(now) + static_cast<int>(random.below(5)) - 2;
    return static_cast<int>(std::min(std::max<double>(near, lower_end(field)), upper_end(field)));
  }
  if (field.kind == FieldKind::number)
    return number(std::holds_alternative<double>(now) ? std::get<double>(now) : 1.0);
  if (field.kind == FieldKind::number_list && field.list_length == 0) {
    std::vector<double> list(random.below(6));
    for (double& x : list)
      x = number(1.0);
    return list;
  }
  return ends[random.below(ends.size())];
}

/// Gear number `index`: some fields of the quick gear changed at random.
inline Gear random_gear(std::uint64_t index) {
  Counted random(index + 1);
  Gear gear = quick_gear();
  const auto fields = gear_fields();
  const std::size_t changes = 1 + random.below(index % 3 == 0 ? 12 : 4);
  for (std::size_t k = 0; k < changes; ++k) {
    const Field& field = fields[random.below(fields.size())];
    field.write(gear, random_value(field, gear, random));
  }
  // Numbers that have to fit together follow, mostly: the rim's outer surface, the second tooth number.
  if (random.below(8) != 0) {
    gear.flexspline.root_radius_mm =
        gear.flexspline.neutral_radius_mm + 0.5 * gear.flexspline.rim_thickness_mm;
    gear.circular_spline.teeth = gear.flexspline.teeth + 2;
  }
  const WaveGeneratorShape shape = gear.wave_generator.shape;
  const bool discs = shape == WaveGeneratorShape::two_disc || shape == WaveGeneratorShape::two_disc_exact;
  if (!discs && random.below(4) != 0) {
    gear.wave_generator.eccentricity_mm.reset();
    if (shape == WaveGeneratorShape::four_force) {
      gear.wave_generator.force_angle_deg = 20.0 + 20.0 * random.unit();
      gear.contact.fidelity = Fidelity::linear;
    }
  }
  return gear;
}

} // namespace strainwave::testing_support
