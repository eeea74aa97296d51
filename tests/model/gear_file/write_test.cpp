// write_gear(): complete, and reads back bit for bit.

#include "strainwave/model/gear/fields.hpp"
#include "tests/model/gear_file/files.hpp"

#include <cmath>

namespace strainwave {
namespace {

TEST(GearFileWrite, SeedGearReadsBackBitForBit) {
  const Gear gear = parse_gear(write_gear(seed_gear()), "gear.toml").gear;
  EXPECT_EQ(canonical_bits(gear), canonical_bits(seed_gear()));
  EXPECT_EQ(gear.name, seed_gear().name);
}

TEST(GearFileWrite, AwkwardNumbersReadBackBitForBit) {
  Gear gear = seed_gear();
  gear.flexspline.module_mm = 0.1 + 0.2;
  gear.flexspline.cup_length_mm = std::nextafter(28.0, 29.0);
  gear.wave_generator.wrap_angle_deg = 5e-324;
  gear.flank_modification.circular_spline.spline_um = {-0.0, 1.0 / 3.0, 1e-17, 999.9999999999999};
  gear.load.torque_nm = {1e6, 123456.0, 1e-7};
  const Gear back = parse_gear(write_gear(gear), "gear.toml").gear;
  EXPECT_EQ(canonical_bits(back), canonical_bits(gear));
  EXPECT_TRUE(std::signbit(back.flank_modification.circular_spline.spline_um[0]));
}

TEST(GearFileWrite, EveryFieldAtItsBoundsReadsBackBitForBit) {
  for (const bool upper : {false, true}) {
    Gear gear = seed_gear();
    for (const Field& field : gear_fields()) {
      const Range& range = field.range;
      const double bound = upper ? (range.upper_open ? std::nextafter(range.upper, 0.0) : range.upper)
                                 : (range.lower_open ? std::nextafter(range.lower, 1e9) : range.lower);
      if (field.kind == FieldKind::number)
        set_value(gear, field.path, bound);
      if (field.kind == FieldKind::integer)
        set_value(gear, field.path, static_cast<int>(bound));
      if (field.kind == FieldKind::choice)
        set_value(gear, field.path, std::string(upper ? field.choices.back() : field.choices.front()));
    }
    gear.wave_generator.table_file = STRAINWAVE_SOURCE "/CMakeLists.txt"; // any file that exists
    EXPECT_EQ(canonical_bits(parse_gear(write_gear(gear), "gear.toml").gear), canonical_bits(gear));
  }
}

TEST(GearFileWrite, AwkwardTextsReadBack) {
  Gear gear = seed_gear();
  gear.name = "quotes \" backslash \\ tab \t line \n bell \a rubout \x7f µm 谐波";
  EXPECT_EQ(parse_gear(write_gear(gear), "gear.toml").gear.name, gear.name);
}

TEST(GearFileWrite, EveryKeyStandsOnALineWithItsSentence) {
  const std::string text = write_gear(seed_gear());
  for (const Field& field : gear_fields()) {
    const std::size_t key = text.find(std::string(field.key()) + " =");
    ASSERT_NE(key, std::string::npos) << field.path;
    EXPECT_NE(text.find(std::string(field.sentence) + "\n", key), std::string::npos) << field.path;
  }
}

} // namespace
} // namespace strainwave
