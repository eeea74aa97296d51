// Every field of the table, wrong in a file: the message stands at the value.

#include "strainwave/model/gear/fields.hpp"
#include "tests/model/gear_file/files.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {
namespace {

/// The complete seed gear as a file in which one key has another value, and where that value stands.
struct Spoiled {
  std::string text;
  Place value;
};

Spoiled with_value(const Field& field, const std::string& value) {
  Spoiled spoiled;
  std::istringstream lines(write_gear(seed_gear()));
  std::string table;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("["))
      table = line.substr(1, line.find(']') - 1);
    const std::string key(field.key());
    if (table == field.table() && (line.starts_with(key + " =") || line.starts_with("# " + key + " ="))) {
      spoiled.value = {number, static_cast<int>(key.size()) + 4};
      line = key + " = " + value;
    }
    spoiled.text += line + "\n";
  }
  EXPECT_GT(spoiled.value.line, 0) << field.path;
  return spoiled;
}

void expect_one_fault(const Field& field, const std::string& value, int column_offset,
                      const std::string& sentence) {
  const Spoiled spoiled = with_value(field, value);
  EXPECT_EQ(complaint_about(spoiled.text),
            fmt::format("gear.toml:{}:{}: {}: {}", spoiled.value.line, spoiled.value.column + column_offset,
                        field.path, sentence));
}

TEST(GearFileWalk, NumbersOutOfRangeStandWithTheirPlace) {
  for (const Field& field : gear_fields()) {
    if (field.kind != FieldKind::number && field.kind != FieldKind::integer)
      continue;
    for (const double bad : {field.range.lower - 1.0, field.range.upper + 1.0}) {
      const FieldValue value =
          field.kind == FieldKind::integer ? FieldValue(static_cast<int>(bad)) : FieldValue(bad);
      expect_one_fault(field, shortest(bad), 0, find_complaint(field, value)->sentence);
    }
  }
}

TEST(GearFileWalk, ListItemsOutOfRangeStandWithTheirOwnPlace) {
  for (const Field& field : gear_fields()) {
    if (field.kind != FieldKind::number_list)
      continue;
    const double good = field.range.lower, bad = field.range.upper + 1.0;
    const std::string before = fmt::format("[{}, ", shortest(good));
    expect_one_fault(field, before + shortest(bad) + "]", static_cast<int>(before.size()),
                     find_complaint(field, std::vector<double>{good, bad})->sentence);
  }
}

TEST(GearFileWalk, UnknownChoicesStandWithTheirPlace) {
  for (const Field& field : gear_fields()) {
    if (field.kind != FieldKind::choice)
      continue;
    expect_one_fault(field, "\"no such\"", 0, find_complaint(field, std::string("no such"))->sentence);
  }
}

TEST(GearFileWalk, WrongTypesStandWithTheirPlace) {
  for (const Field& field : gear_fields())
    expect_one_fault(field, "true", 0, fmt::format("expected {}, got true", expectation(field)));
}

TEST(GearFileWalk, RequiredKeysAreMissedAndNoOthers) {
  for (const Field& field : gear_fields()) {
    if (field.table().empty() || field.may_be_absent)
      continue;
    std::string text = write_gear(seed_gear());
    const std::size_t table = text.find(fmt::format("\n[{}]", field.table()));
    const std::size_t key = text.find(fmt::format("\n{} = ", field.key()), table) + 1;
    text.insert(key, "# ");
    const bool missed =
        complaint_about(text).find(fmt::format("{}: missing", field.path)) != std::string::npos;
    EXPECT_EQ(missed, field.required) << field.path;
  }
}

} // namespace
} // namespace strainwave
