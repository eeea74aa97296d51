// Keys of stages against the whole table of a gear's fields: whatever key of a file changes, either the
// stage's key changes, or its value does not.

#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/response_store.hpp"
#include "strainwave/model/forward/shared_stages.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"
#include "tests/support/coarse_seed.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace strainwave {
namespace {

Gear base_gear() {
  return testing_support::coarse_seed_gear(testing_support::coarsest_mesh);
}

/// The gear with another value of one field, legal or not.
Gear changed(const Gear& gear, const Field& field) {
  Gear other = gear;
  const FieldValue value = field.read(gear);
  switch (field.kind) {
  case FieldKind::number:
    field.write(other, std::holds_alternative<double>(value) ? 1.001 * std::get<double>(value) + 1e-3 : 1.0);
    break;
  case FieldKind::integer:
    field.write(other, std::get<int>(value) + 1);
    break;
  case FieldKind::text:
    field.write(other, std::get<std::string>(value) + "x");
    break;
  case FieldKind::choice: {
    const bool known = std::holds_alternative<std::string>(value);
    const bool first = !known || std::get<std::string>(value) != field.choices[0];
    field.write(other, std::string(field.choices[first ? 0 : 1]));
    break;
  }
  case FieldKind::number_list:
    field.write(other, std::vector<double>{-30.0, 31.0});
    break;
  }
  EXPECT_NE(canonical_bits(other), canonical_bits(gear)) << field.path;
  return other;
}

/// All fields but the name, changed one at a time.
template <class Check>
void for_every_change(const Gear& gear, const Check& check) {
  for (const Field& field : gear_fields())
    if (field.path != "name")
      check(field.path, changed(gear, field));
}

TEST(StageInputs, WhatLeavesTheKeyOfTheCurveLeavesTheCurve) {
  const Gear gear = base_gear();
  const NeutralCurve curve = NeutralCurve::make(gear.wave_generator, gear.flexspline).value();
  int same = 0, other = 0;
  for_every_change(gear, [&](std::string_view path, const Gear& now) {
    if (curve_input(now).key != curve_input(gear).key) {
      ++other;
      return;
    }
    ++same;
    const NeutralCurve again =
        NeutralCurve::make(now.wave_generator, now.flexspline).value(); // the whole gear
    for (const double phi : {0.0, 0.3, 0.7, 1.5}) {
      EXPECT_EQ(again.displacement(phi).u_mm, curve.displacement(phi).u_mm) << path;
      EXPECT_EQ(again.pose(phi).normal_rotation_rad, curve.pose(phi).normal_rotation_rad) << path;
    }
  });
  EXPECT_EQ(other, 8); // one for each key that it names
  EXPECT_GT(same, 60);
}

TEST(StageInputs, ATableCountsByWhatItSays) {
  const testing_support::TemporaryFolder folder;
  Gear gear = base_gear();
  gear.wave_generator.shape = WaveGeneratorShape::table;
  gear.wave_generator.table_file = (folder / "table.txt").string();
  std::ofstream(gear.wave_generator.table_file) << "0 0.2\n90 -0.2\n";
  const ContentKey before = curve_input(gear).key;
  EXPECT_EQ(curve_input(gear).key, before);
  std::ofstream(gear.wave_generator.table_file) << "0 0.2\n90 -0.19\n";
  EXPECT_NE(curve_input(gear).key, before);
}

TEST(StageInputs, WhatLeavesTheKeyOfTheCupAsksForTheSameFiniteElements) {
  const Gear gear = base_gear();
  for_every_change(gear, [&](std::string_view path, const Gear& now) {
    if (response_input(now).key == response_input(gear).key) {
      EXPECT_EQ(response_key(response_request(now)), response_key(response_request(gear))) << path;
    }
  });
  // what the stage is handed is as good as the whole gear
  EXPECT_EQ(response_key(response_request(response_input(gear).part)), response_key(response_request(gear)));
}

TEST(StageInputs, EveryKeyOfCupMaterialAndMeshIsAKeyOfTheStore) {
  // the store's key names its numbers by hand; here the table of fields asks for each of them
  const Gear gear = base_gear();
  for_every_change(gear, [&](std::string_view path, const Gear& now) {
    if (path.starts_with("flexspline.") || path.starts_with("material.") || path.starts_with("mesh.")) {
      EXPECT_NE(response_key(response_request(now)), response_key(response_request(gear))) << path;
    }
  });
}

TEST(StageInputs, WhatLeavesTheKeyOfTheAssemblyLeavesItsBits) {
  const Gear gear = base_gear();
  SharedStages stages({.disk_cache = false});
  std::vector<std::string> warnings;
  const auto responses = stages.responses(response_input(gear), warnings).value.value();
  const bool fold = lobes_alike(gear);
  const auto input = [&](const Gear& of) {
    return assembly_input(of, curve_input(of), ring_input(of, fold));
  };
  const Ring ring = ring_of(ring_input(gear, fold), responses, fold);
  const auto assembled = [&](const Gear& whole) {
    const RingCompliance compliance(*responses, contact_rows(whole), fold);
    const NeutralCurve curve = NeutralCurve::make(whole.wave_generator, whole.flexspline).value();
    return assembled_cup(whole, compliance, curve, 0.0, MeshingPhase{1, 3}).value();
  };
  const AssembledState nominal = assembled(gear);
  int same = 0;
  for_every_change(gear, [&](std::string_view path, const Gear& now) {
    if (input(now).key != input(gear).key)
      return;
    ++same;
    const AssembledState again = assembled(now); // of the whole gear
    EXPECT_EQ(again.force_n, nominal.force_n) << path;
    EXPECT_EQ(again.displacement, nominal.displacement) << path;
    EXPECT_EQ(again.gap_mm, nominal.gap_mm) << path;
  });
  EXPECT_GT(same, 30);
  // of the part alone
  const NeutralCurve curve = neutral_curve(curve_input(gear)).value();
  const AssembledState part =
      assembled_cup(input(gear).part, ring.compliance, curve, 0.0, MeshingPhase{1, 3}).value();
  EXPECT_EQ(part.force_n, nominal.force_n);
  EXPECT_EQ(part.gap_mm, nominal.gap_mm);
}

TEST(MeshingPhase, IsAPlaceNotAPairOfNumbers) {
  EXPECT_EQ((MeshingPhase{1, 2}), (MeshingPhase{2, 4}));
  EXPECT_LT((MeshingPhase{1, 3}), (MeshingPhase{1, 2}));
  EXPECT_EQ((MeshingPhase{1, 3}).mirrored(), (MeshingPhase{2, 3}));
  EXPECT_EQ((MeshingPhase{0, 3}).mirrored(), MeshingPhase{});
  for (int count = 1; count <= 64; ++count) // mirroring twice comes back to the same bits; 1 − s would not
    for (int j = 0; j < count; ++j)
      EXPECT_EQ((MeshingPhase{j, count}).mirrored().mirrored().value(), static_cast<double>(j) / count);
}

} // namespace
} // namespace strainwave
