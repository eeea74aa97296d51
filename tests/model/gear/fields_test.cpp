// Walks the whole table of fields.

#include "strainwave/model/gear/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace strainwave {
namespace {

bool is_number(const Field& field) {
  return field.kind == FieldKind::number || field.kind == FieldKind::integer;
}

/// A value of the field's kind from a number.
FieldValue value_of(const Field& field, double number) {
  if (field.kind == FieldKind::integer)
    return static_cast<int>(number);
  if (field.kind == FieldKind::number_list)
    return field.list_length == 2 ? std::vector<double>{field.range.lower, number}
                                  : std::vector<double>{number};
  return number;
}

/// A value that differs from the default and is allowed.
FieldValue another_value(const Field& field) {
  const FieldValue standard = field.read(Gear{});
  if (field.kind == FieldKind::text)
    return std::string("another");
  if (field.kind == FieldKind::choice) {
    for (const std::string_view choice : field.choices)
      if (FieldValue(std::string(choice)) != standard)
        return std::string(choice);
  }
  const double middle = 0.5 * (field.range.lower + field.range.upper);
  const FieldValue value = value_of(field, field.kind == FieldKind::integer ? std::ceil(middle) : middle);
  return value == standard ? value_of(field, field.kind == FieldKind::integer ? field.range.lower
                                                                              : 0.25 * field.range.upper)
                           : value;
}

TEST(Fields, PathsAreUniqueAndStandInKnownTables) {
  std::set<std::string_view> paths;
  for (const Field& field : gear_fields()) {
    EXPECT_TRUE(paths.insert(field.path).second) << field.path;
    EXPECT_TRUE(field.table().empty() || find_table(field.table())) << field.path;
    EXPECT_EQ(find_field(field.path), &field);
  }
  EXPECT_EQ(find_field("flexspline"), nullptr);
}

TEST(Fields, KeysOfOneTableStandTogether) {
  std::set<std::string_view> closed;
  std::string_view open;
  for (const Field& field : gear_fields()) {
    if (field.table() == open)
      continue;
    EXPECT_TRUE(closed.insert(field.table()).second) << field.path;
    open = field.table();
  }
}

TEST(Fields, EveryKeyHasASentenceAndItsNameCarriesItsUnit) {
  for (const Field& field : gear_fields()) {
    EXPECT_FALSE(field.sentence.empty()) << field.path;
    EXPECT_FALSE(field.sentence.ends_with('.')) << field.path;
    const auto ends = [&field](std::string_view ending) { return field.path.ends_with(ending); };
    EXPECT_EQ(field.unit == "mm", ends("_mm")) << field.path;
    EXPECT_EQ(field.unit == "µm", ends("_um")) << field.path;
    EXPECT_EQ(field.unit == "degrees", ends("_deg")) << field.path;
    EXPECT_EQ(field.unit == "N·m", ends("_nm")) << field.path;
    EXPECT_EQ(field.unit == "rad", ends("_rad")) << field.path;
    EXPECT_EQ(field.unit == "MPa", ends("_mpa")) << field.path;
  }
}

TEST(Fields, DefaultsAreAllowedAndRequiredKeysHaveNone) {
  for (const Field& field : gear_fields()) {
    const auto complaint = find_complaint(field, field.read(Gear{}));
    if (!field.required) {
      EXPECT_FALSE(complaint) << field.path << ": " << complaint->sentence;
    }
    if (field.required) {
      EXPECT_FALSE(field.may_be_absent) << field.path;
    }
  }
}

TEST(Fields, SeedGearIsAllowed) {
  for (const Field& field : gear_fields()) {
    const auto complaint = find_complaint(field, field.read(seed_gear()));
    EXPECT_FALSE(complaint) << field.path << ": " << complaint->sentence;
  }
}

TEST(Fields, WhatIsSetIsReadBackAndNothingElseChanges) {
  for (const Field& field : gear_fields()) {
    Gear gear = seed_gear();
    const FieldValue value = another_value(field);
    set_value(gear, field.path, value);
    for (const Field& other : gear_fields())
      EXPECT_EQ(other.read(gear), &other == &field ? value : other.read(seed_gear()))
          << field.path << other.path;
  }
}

TEST(Fields, AbsentKeysCanBeSetAndTakenAway) {
  int absent_keys = 0;
  for (const Field& field : gear_fields()) {
    if (!field.may_be_absent)
      continue;
    ++absent_keys;
    Gear gear;
    set_value(gear, field.path, another_value(field));
    set_value(gear, field.path, std::monostate{});
    EXPECT_EQ(field.read(gear), FieldValue()) << field.path;
  }
  EXPECT_EQ(absent_keys, 5); // eccentricity, wrap angle, force angle, force direction, reference section
}

TEST(Fields, ForceDirectionIsTheNormalUnlessAToothHasOnePointOnly) {
  Contact contact;
  EXPECT_EQ(contact.direction_of_force(), ForceDirection::circumferential);
  contact.flank_points = 2;
  EXPECT_EQ(contact.direction_of_force(), ForceDirection::flank_normal);
  contact.flank_points = 1;
  contact.face_slices = 2;
  EXPECT_EQ(contact.direction_of_force(), ForceDirection::flank_normal);
  contact.force_direction = ForceDirection::circumferential;
  EXPECT_EQ(contact.direction_of_force(), ForceDirection::circumferential);
}

TEST(Fields, ClosedEndsAreAllowedOpenEndsAreNot) {
  for (const Field& field : gear_fields()) {
    if (!is_number(field))
      continue;
    ASSERT_TRUE(std::isfinite(field.range.lower) && std::isfinite(field.range.upper)) << field.path;
    EXPECT_EQ(find_complaint(field, value_of(field, field.range.lower)).has_value(), field.range.lower_open)
        << field.path;
    EXPECT_EQ(find_complaint(field, value_of(field, field.range.upper)).has_value(), field.range.upper_open)
        << field.path;
  }
}

TEST(Fields, ValuesOutOfRangeAreRefusedAndLeaveTheGearAlone) {
  for (const Field& field : gear_fields()) {
    if (field.kind == FieldKind::text || field.kind == FieldKind::choice)
      continue;
    for (const double bad : {field.range.lower - 1.0, field.range.upper + 1.0}) {
      Gear gear = seed_gear();
      EXPECT_THROW(set_value(gear, field.path, value_of(field, bad)), FieldError) << field.path;
      EXPECT_EQ(field.read(gear), field.read(seed_gear()));
    }
  }
}

TEST(Fields, NotANumberIsRefusedEverywhere) {
  for (const Field& field : gear_fields()) {
    if (field.kind == FieldKind::number) {
      EXPECT_TRUE(find_complaint(field, std::nan(""))) << field.path;
    }
    if (field.kind == FieldKind::number_list) {
      EXPECT_TRUE(find_complaint(field, std::vector<double>{std::nan("")}));
    }
  }
}

TEST(Fields, ValuesOfAnotherKindAreRefused) {
  for (const Field& field : gear_fields()) {
    Gear gear;
    const bool text = field.kind == FieldKind::text || field.kind == FieldKind::choice;
    const FieldValue wrong = text ? FieldValue(1.0) : FieldValue(std::string("1"));
    EXPECT_THROW(set_value(gear, field.path, wrong), FieldError) << field.path;
  }
}

TEST(Fields, ChoicesFollowTheEnumerators) {
  EXPECT_EQ(choice_name(WaveGeneratorShape::two_disc), "two_disc");
  EXPECT_EQ(choice_name(WaveGeneratorShape::table), "table");
  EXPECT_EQ(choice_name(Fidelity::nonlinear), "nonlinear");
  EXPECT_EQ(choice_name(AssemblyModel::nonlinear), "nonlinear");
  EXPECT_EQ(choice_name(LoadMethod::stepping), "stepping");
  EXPECT_EQ(choice_name(ForceDirection::flank_normal), "flank_normal");
  EXPECT_EQ(choice_name(DiscGap::linearised), "linearised");
  EXPECT_EQ(choice_name(GapModel::assembled), "assembled");
  EXPECT_EQ(choice_name(Direction::both), "both");
}

TEST(Fields, FormerChoicesAreTakenForThePresentOnes) {
  int count = 0;
  for (const Field& field : gear_fields())
    for (const FormerChoice& former : field.former_choices) {
      ++count;
      EXPECT_EQ(std::find(field.choices.begin(), field.choices.end(), former.name), field.choices.end());
      Gear gear;
      set_value(gear, field.path, std::string(former.name));
      EXPECT_EQ(field.read(gear), FieldValue(std::string(former.now)));
    }
  EXPECT_EQ(count, 1);
  Gear gear;
  EXPECT_THROW(set_value(gear, "contact.fidelity", std::string("event_path")),
               FieldError); // of one key alone
}

TEST(Fields, UnknownPathNamesTheNearest) {
  Gear gear;
  try {
    set_value(gear, "flexspline.modul_mm", 0.2);
    FAIL();
  } catch (const FieldError& error) {
    EXPECT_STREQ(error.what(), "flexspline.modul_mm: no such key; did you mean module_mm?");
  }
}

TEST(Shortest, ReadsBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, 2.13, 14.584, 1e-300, 1e300, 206000.0, 123456789012345.0})
    EXPECT_EQ(std::stod(shortest(value)), value) << shortest(value);
  EXPECT_EQ(shortest(0.2), "0.2");
  EXPECT_EQ(shortest(100000.0), "100000");
}

} // namespace
} // namespace strainwave
