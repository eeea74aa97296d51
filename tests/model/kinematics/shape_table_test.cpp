// Wave-generator shapes from a file: spline, place of an error.

#include "strainwave/model/gear/fields.hpp"
#include "tests/model/kinematics/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace strainwave::testing_support {
namespace {

class ShapeTableTest : public ::testing::Test {
protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() /
            (std::string("strainwave_table_") +
             ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".txt");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  void write(const std::string& text) { std::ofstream(file_) << text; }
  Outcome<NeutralCurve> curve() {
    Gear gear = seed_with(WaveGeneratorShape::table);
    gear.wave_generator.table_file = file_.string();
    return NeutralCurve::make(gear.wave_generator, gear.flexspline);
  }
  std::string complaint() {
    try {
      (void)curve();
    } catch (const FieldError& error) {
      EXPECT_EQ(error.path, "wave_generator.table_file");
      return error.sentence;
    }
    return "no complaint";
  }
  /// "file:line: " must stand at the front.
  void expect_complaint(const std::string& text, int line, const std::string& part) {
    write(text);
    const std::string message = complaint();
    EXPECT_EQ(message.rfind(file_.string() + ":" + std::to_string(line) + ": ", 0), 0u) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  std::filesystem::path file_;
};

TEST_F(ShapeTableTest, FineTableOfTheCosineGivesTheCosine) {
  std::string text = "# angle u\n";
  char line[80];
  for (int i = 0; i <= 90; ++i) {
    std::snprintf(line, sizeof line, "%d %.17g # row\n\n", i, 0.2 * std::cos(2.0 * i * degree));
    text += line;
  }
  write(text);
  const auto table = curve();
  ASSERT_TRUE(table.ok());
  const NeutralCurve cosine = curve_of(seed_with(WaveGeneratorShape::cosine));
  // Interpolation error of a cubic spline: 5/384 h^4 max|u''''| = 5/384 (1 degree)^4 16 * 0.2 = 3.9e-9 mm.
  for (double phi = -1.5; phi < 1.5; phi += 0.07) {
    EXPECT_NEAR(table->displacement(phi).u_mm, cosine.displacement(phi).u_mm, 4e-9);
    EXPECT_NEAR(table->pose(phi).rho_mm, cosine.pose(phi).rho_mm, 1e-8);
    EXPECT_NEAR(table->pose(phi).phi1_rad, cosine.pose(phi).phi1_rad, 1e-9);
  }
}

TEST_F(ShapeTableTest, SplineIsSmoothAcrossRowsAndAxes) {
  write("0 0.3\n20 0.25\n50 -0.05\n70 -0.2\n90 -0.22\n");
  const auto table = curve();
  ASSERT_TRUE(table.ok());
  EXPECT_NEAR(table->summary().u0_mm, 0.3, 1e-15);
  for (const double row : {0.0, 20.0, 50.0, 70.0, 90.0}) {
    const RadialDisplacement below = table->displacement(row * degree - 1e-12),
                             above = table->displacement(row * degree + 1e-12);
    EXPECT_NEAR(below.u_mm, above.u_mm, 1e-11);
    EXPECT_NEAR(below.first_mm, above.first_mm, 1e-11);
    EXPECT_NEAR(below.second_mm, above.second_mm, 1e-10);
  }
}

TEST_F(ShapeTableTest, CurveShorterThanTheCircleRunsOnPastTheMinorAxis) {
  write("0 0.1\n45 -0.1\n90 -0.3\n");
  const auto table = curve();
  ASSERT_TRUE(table.ok());
  EXPECT_LT(table->summary().perimeter_excess_mm, 0.0);
  EXPECT_GT(table->pose(90.0 * degree).phi1_rad, 90.0 * degree);
  const PoseDerivatives at = table->pose_derivatives(90.0 * degree);
  EXPECT_NEAR(std::hypot(at.rho[by_material_angle], at.value.rho_mm * at.phi1[by_material_angle]), 14.006,
              1e-11);
}

TEST_F(ShapeTableTest, ErrorsNameFileAndLine) {
  expect_complaint("0 0.2\n10\n90 -0.2\n", 2, "two columns");
  expect_complaint("0 0.2\n10 0.1 7\n90 -0.2\n", 2, "third");
  expect_complaint("0 0.2\n\n# x\n10 abc\n90 -0.2\n", 4, "'abc' is not a finite number");
  expect_complaint("0 0.2\n10 nan\n90 -0.2\n", 2, "not a finite number");
  expect_complaint("1 0.2\n90 -0.2\n", 1, "first angle must be 0");
  expect_complaint("0 0.2\n40 0.1\n40 0.0\n90 -0.2\n", 3, "ascend");
  expect_complaint("0 0.2\n40 0.1\n", 2, "last angle must be 90");
  expect_complaint("0 0.2\n95 0.1\n", 2, "last angle must be 90");
  expect_complaint("# nothing\n", 1, "no rows");
}

TEST_F(ShapeTableTest, MissingFileIsNamed) {
  const std::string message = complaint();
  EXPECT_NE(message.find(file_.string()), std::string::npos);
  EXPECT_NE(message.find("there is no such file"), std::string::npos);
}

TEST_F(ShapeTableTest, FolderIsNoTable) {
  std::filesystem::create_directory(file_);
  EXPECT_EQ(complaint(), file_.string() + ": is a folder, not a table of the wave generator's shape");
}

TEST_F(ShapeTableTest, BytesThatAreNoTextAreNotEchoed) {
  write(std::string("\x7f\x45LF\x02\x1b[31m\xff ") + std::string(500, 'x'));
  const std::string message = complaint();
  EXPECT_EQ(message, file_.string() + ":1: '?ELF??[31m?' is not a finite number");
}

TEST_F(ShapeTableTest, AbsurdDisplacementIsAContradiction) {
  write("0 5\n90 -5\n");
  const auto table = curve();
  ASSERT_FALSE(table.ok());
  EXPECT_EQ(table.failure().status, Status::contradiction);
}

} // namespace
} // namespace strainwave::testing_support
