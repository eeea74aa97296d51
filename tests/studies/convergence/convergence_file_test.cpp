// Files of the kind "convergence": what is read, the words for what is wrong; and the order of a sequence.

#include "strainwave/studies/convergence/convergence.hpp"

#include "strainwave/studies/convergence/order.hpp"
#include "tests/studies/studies.hpp"

#include <cmath>
#include <vector>

namespace strainwave {
namespace {

const std::string good_convergence = R"(kind = "convergence"
gear = "seed.toml"
[[load_case]]
torque_nm = 7.0
[[refine]]
path = "mesh.per_pitch"
values = [3, 4, 6]
[[refine]]
path = "mesh.along_face"
values = [3, 4, 6]
[convergence]
outputs = ["peak_force_n"]
)";

TEST(ConvergenceFile, ArrivesAndReadsBack) {
  const StudyFolder folder;
  const StudyFile study = folder.read(good_convergence);
  EXPECT_EQ(study.kind, &convergence_kind());
  const auto& part = study.part<ConvergencePart>();
  ASSERT_EQ(part.refinements.size(), 2u);
  EXPECT_EQ(part.refinements[1].path, "mesh.along_face");
  EXPECT_EQ(part.refinements[1].values, (std::vector{3.0, 4.0, 6.0}));
  EXPECT_EQ(part.convergence.outputs, (std::vector<std::string>{"peak_force_n"}));
  const std::string text = write_study(study);
  EXPECT_EQ(write_study(folder.read(text)), text);
}

TEST(ConvergenceFile, SizesFollowTheCounts) {
  const StudyFolder folder;
  const auto sizes = element_sizes(folder
                                       .read(edited(good_convergence, "along_face\"\nvalues = [3, 4, 6]",
                                                    "along_face\"\nvalues = [3, 3, 6]"))
                                       .part<ConvergencePart>());
  ASSERT_EQ(sizes.size(), 3u);
  EXPECT_EQ(sizes[0], 1.0);
  EXPECT_DOUBLE_EQ(sizes[1], std::sqrt(0.75));
  EXPECT_DOUBLE_EQ(sizes[2], 0.5);
  const auto one = element_sizes( // a count that stays says nothing about the size
      folder
          .read(edited(good_convergence, "along_face\"\nvalues = [3, 4, 6]",
                       "along_face\"\nvalues = [3, 3, 3]"))
          .part<ConvergencePart>());
  EXPECT_EQ(one, (std::vector{1.0, 0.75, 0.5}));
}

TEST(ConvergenceFile, MessagesAreExactlyThese) {
  struct Case {
    std::string before, after, message;
  };
  const StudyFolder folder;
  for (const Case& c : std::vector<Case>{
           {"mesh.per_pitch", "mesh.per_pich",
            "study.toml:6:8: refine[0].path: mesh.per_pich: no such key; did you mean per_pitch?"},
           {"mesh.per_pitch", "flexspline.cup_length_mm",
            "study.toml:6:8: refine[0].path: flexspline.cup_length_mm is no count of elements; expected a "
            "key of "
            "mesh, for example mesh.per_pitch. Other keys can be swept"},
           {"values = [3, 4, 6]", "values = [3, 4.5, 6]",
            "study.toml:7:10: refine[0].values: mesh.per_pitch is a whole number; 4.5 is none"},
           {"values = [3, 4, 6]", "values = [2, 4, 6]",
            "study.toml:7:10: refine[0].values: mesh.per_pitch must be at least 3 and at most 64, is 2"},
           {"values = [3, 4, 6]", "values = [6, 4, 3]",
            "study.toml:7:10: refine[0].values: have to run from coarse to fine; 4 follows 6"},
           {"along_face\"\nvalues = [3, 4, 6]", "along_face\"\nvalues = [3, 4]",
            "study.toml:10:10: refine[1].values: has 2 levels, the first [[refine]] has 3; all have equally "
            "many"},
           {"[\"peak_force_n\"]", "[\"peak_force\"]",
            "study.toml:12:12: convergence.outputs[0]: there is no output \"peak_force\"; did you mean "
            "\"peak_force_n\"?"},
           {"[[refine]]\npath = \"mesh.per_pitch\"", "[[variable]]\npath = \"mesh.per_pitch\"",
            "study.toml:5:3: variable: is of no use in a study of kind \"convergence\""}})
    EXPECT_EQ(folder.complaint(edited(good_convergence, c.before, c.after)), c.message);
}

TEST(ObservedOrder, IsThatOfAPower) {
  for (const double p : {0.7, 1.0, 2.0, 3.5}) {
    const std::vector<double> size{1.0, 0.75, 0.4};
    std::vector<double> value;
    for (const double h : size)
      value.push_back(5.0 - 3.0 * std::pow(h, p));
    const auto order = observed_order(size, value);
    ASSERT_TRUE(order) << p;
    EXPECT_NEAR(order->order, p, 1e-10);
    EXPECT_NEAR(order->limit, 5.0, 1e-10);
  }
}

TEST(ObservedOrder, IsNoneWhereNumbersDoNotDrawTogether) {
  const std::vector<double> size{1.0, 0.5, 0.25};
  EXPECT_FALSE(observed_order(size, std::vector{1.0, 2.0, 1.5})); // swing
  EXPECT_FALSE(observed_order(size, std::vector{1.0, 2.0, 4.0})); // run away
  EXPECT_FALSE(observed_order(size, std::vector{1.0, 2.0, 2.0})); // stand still
  EXPECT_FALSE(observed_order(std::vector{1.0, 0.5}, std::vector{1.0, 2.0}));
}

} // namespace
} // namespace strainwave
