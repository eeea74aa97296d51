// Gear files that are right: what is read is what stands there.

#include "model/gear/fields.hpp"
#include "model/gear_file/gear_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace strainwave {
namespace {

const std::string seed_path = STRAINWAVE_SOURCE "/studies/gallery/seed.toml";

TEST(GearFileLoad, SeedFileIsTheSeedGearBitForBit) {
  const GearDocument document = load_gear(seed_path);
  EXPECT_EQ(document.gear.name, seed_gear().name);
  EXPECT_EQ(canonical_bits(document.gear), canonical_bits(seed_gear()));
}

} // namespace
} // namespace strainwave
