// Every legal gear ends with a proved result or with a sentence that an engineer can use.

#include "tests/model/forward/any_gear.hpp"

#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/forward/forward.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <regex>

namespace strainwave::testing_support {
namespace {

ForwardModel& model() {
  static ForwardModel shared({.disk_cache = false, .threads = 1});
  return shared;
}

/// What a number in JSON may not be: null stands for NaN there. Only gaps between flanks that do not overlap
/// have one, the zone of a load without contact, and the wedge of a free gear.
void expect_numbers(const nlohmann::ordered_json& json, const std::string& path) {
  if (json.is_null()) {
    const bool may_be_missing = path.find("/backlash/") != std::string::npos ||
                                path.ends_with("/engaged_phi_deg") || path.ends_with("/peak_phi_deg") ||
                                path.ends_with("/peak_pressure_at") || path == "/wedge";
    EXPECT_TRUE(may_be_missing) << path;
  }
  if (json.is_object())
    for (const auto& [key, value] : json.items())
      expect_numbers(value, path + "/" + key);
  if (json.is_array())
    for (const auto& value : json)
      expect_numbers(value, path);
}

void expect_ends_well(const Gear& gear, const std::string& title) {
  SCOPED_TRACE(title);
  ForwardResult result;
  try {
    result = model().analyze(gear);
  } catch (const std::bad_alloc&) {
    return; // memory: exit 74 with a sentence
  } catch (const FieldError& error) {
    EXPECT_EQ(error.path, "wave_generator.table_file") << error.what();
    return;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "exception: " << error.what();
    return;
  }
  static const std::regex undefined("\\b(nan|inf)\\b", std::regex::icase);
  EXPECT_FALSE(std::regex_search(result.message, undefined)) << result.message;
  if (result.status == Status::ok) {
    ASSERT_TRUE(result.certificate.has_value());
    EXPECT_TRUE(result.certificate->holds()) << *result.certificate->find_flaw();
    expect_numbers(result_json(result), "");
    for (const LoadResult& load : result.load)
      for (const double force : load.force_n)
        EXPECT_TRUE(force >= 0.0) << force;
  } else {
    EXPECT_GE(result.message.size(), 20U) << status_name(result.status);
    // a choice that this version lacks is named, all else is said in numbers
    if (result.status != Status::not_available) {
      EXPECT_TRUE(std::regex_search(result.message, std::regex("[0-9]"))) << result.message;
    }
    EXPECT_NE(result.status, Status::certificate_failed) << result.message;
  }
  if (std::getenv("STRAINWAVE_SHOW") != nullptr)
    std::printf("%s: %s %s\n", title.c_str(), std::string(status_name(result.status)).c_str(),
                result.message.c_str());
}

std::string words(const FieldValue& value) {
  struct Words {
    std::string operator()(std::monostate) const { return "absent"; }
    std::string operator()(double x) const { return shortest(x); }
    std::string operator()(int x) const { return std::to_string(x); }
    std::string operator()(const std::string& x) const { return x; }
    std::string operator()(const std::vector<double>& list) const {
      std::string text = "[";
      for (const double x : list)
        text += shortest(x) + " ";
      return text + "]";
    }
  };
  return std::visit(Words{}, value);
}

void walk_ends(std::size_t step) {
  std::size_t count = 0;
  for (const Field& field : gear_fields()) {
    for (const FieldValue& value : ends_of(field)) {
      if (count++ % step != 0)
        continue;
      ASSERT_FALSE(find_complaint(field, value)) << field.path << " = " << words(value);
      Gear gear = quick_gear();
      field.write(gear, value);
      expect_ends_well(gear, std::string(field.path) + " = " + words(value));
    }
  }
}

void walk_random(std::uint64_t first, std::uint64_t last) {
  for (std::uint64_t index = first; index < last; ++index) {
    expect_ends_well(random_gear(index), "random gear " + std::to_string(index));
  }
}

TEST(AnyGear, FieldsAtTheEndsOfTheirRangesEndWell) {
  walk_ends(5);
}
TEST(AnyGear, RandomGearsEndWell) {
  walk_random(0, 60);
}
TEST(AnyGearNightly, EveryFieldAtBothEndsOfItsRangeEndsWell) {
  walk_ends(1);
}
TEST(AnyGearNightly, ManyRandomGearsEndWell) {
  walk_random(60, 800);
}

} // namespace
} // namespace strainwave::testing_support
