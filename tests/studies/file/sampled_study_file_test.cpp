// Study files of sweeps, tolerances and sensitivities: what is read, and the words for what is wrong.

#include "strainwave/studies/sweep/sweep.hpp"
#include "strainwave/studies/tolerances/monte_carlo.hpp"
#include "strainwave/studies/tolerances/sensitivity.hpp"
#include "tests/studies/studies.hpp"

#include <vector>

namespace strainwave {
namespace {

const std::string good_sweep = R"(kind = "sweep"
gear = "seed.toml"
[[load_case]]
torque_nm = 7.0
[[variable]]
path = "flexspline.cup_length_mm"
values = [10.0, 12.5]
[[variable]]
path = "wave_generator.max_radial_deformation_mm"
lower = 0.2
upper = 0.3
count = 3
link = { path = "wave_generator.eccentricity_mm", ratio = 3.0 }
[[variable]]
path = "load_case[0].torque_nm"
values = [1, 7]
[sweep]
mode = "factorial"
outputs = ["peak_force_n", "wind_up_rad"]
[reduced]
"variable[1].count" = 2
)";

const std::string good_monte_carlo = R"(kind = "monte_carlo"
gear = "seed.toml"
[[source]]
name = "pitch"
kind = "adjacent_pitch"
distribution = { normal = { mean = 0.0, std = 2.0 } }
[[source]]
name = "tooth thickness"
kind = "tooth_thickness"
member = "circular_spline"
distribution = { truncated_normal = { mean = 0, std = 3, lower = -6, upper = 6 } }
[[source]]
name = "second harmonic"
kind = "cumulative_pitch"
harmonic = 2
distribution = { triangular = { lower = 0, mode = 1, upper = 4 } }
[[source]]
name = "u0"
kind = "gear_key"
path = "wave_generator.max_radial_deformation_mm"
distribution = { table = { value = [0.19, 0.2, 0.22], cumulative = [0, 0.5, 1] } }
[[correlation]]
first = "u0"
second = "tooth thickness"
rank = -0.5
[sampling]
design = "random"
samples = 4096
positions = 3
outputs = ["peak_force_n"]
quantiles = [0.5, 0.99]
stop = { output = "peak_force_n", quantile = 0.99, half_width = 0.5 }
[[exceedance]]
output = "peak_force_n"
limit = 45.0
[reduced]
"sampling.samples" = 64
)";

const std::string good_sensitivity = R"(kind = "sensitivity"
gear = "seed.toml"
[[source]]
name = "run-out"
kind = "run_out"
distribution = { lognormal = { mean = 4, std = 1 } }
[[source]]
name = "x2"
kind = "gear_key"
path = "circular_spline.profile_shift"
distribution = { uniform = { lower = 2.2, upper = 2.3 } }
[sensitivity]
method = "morris"
samples = 10
levels = 6
)";

TEST(SampledStudyFile, SweepArrives) {
  const StudyFolder folder;
  const StudyFile study = folder.read(good_sweep);
  EXPECT_EQ(study.kind, &sweep_kind());
  ASSERT_EQ(study.part<SweepPart>().variables.size(), 3u);
  EXPECT_EQ(sweep_values(study.part<SweepPart>().variables[0]), (std::vector{10.0, 12.5}));
  EXPECT_EQ(sweep_values(study.part<SweepPart>().variables[1]), (std::vector{0.2, 0.25, 0.3}));
  EXPECT_EQ(study.part<SweepPart>().variables[1].link->ratio, 3.0);
  EXPECT_EQ(study.part<SweepPart>().sweep.outputs, (std::vector<std::string>{"peak_force_n", "wind_up_rad"}));
  EXPECT_EQ(sweep_values(folder.read(good_sweep, true).part<SweepPart>().variables[1]),
            (std::vector{0.2, 0.3}));
}

TEST(SampledStudyFile, MonteCarloArrives) {
  const StudyFolder folder;
  const StudyFile study = folder.read(good_monte_carlo);
  ASSERT_EQ(study.part<UncertainPart>().sources.size(), 4u);
  EXPECT_EQ(std::get<Normal>(study.part<UncertainPart>().sources[0].distribution).std, 2.0);
  EXPECT_EQ(study.part<UncertainPart>().sources[1].member, SourceMember::circular_spline);
  EXPECT_EQ(std::get<TruncatedNormal>(study.part<UncertainPart>().sources[1].distribution).upper, 6.0);
  EXPECT_EQ(study.part<UncertainPart>().sources[2].harmonic, 2);
  EXPECT_EQ(std::get<Triangular>(study.part<UncertainPart>().sources[2].distribution).mode, 1.0);
  EXPECT_EQ(study.part<UncertainPart>().sources[3].kind, SourceKind::gear_key);
  EXPECT_EQ(std::get<Tabulated>(study.part<UncertainPart>().sources[3].distribution).value,
            (std::vector{0.19, 0.2, 0.22}));
  EXPECT_EQ(study.part<UncertainPart>().correlations.at(0).rank, -0.5);
  EXPECT_EQ(study.part<MonteCarloPart>().sampling.design, SamplingDesign::random);
  EXPECT_EQ(study.part<MonteCarloPart>().sampling.positions, 3);
  ASSERT_TRUE(study.part<MonteCarloPart>().sampling.stop);
  EXPECT_EQ(study.part<MonteCarloPart>().sampling.stop->quantile, 0.99);
  EXPECT_EQ(study.part<MonteCarloPart>().exceedances.at(0).limit, 45.0);
  EXPECT_EQ(folder.read(good_monte_carlo, true).part<MonteCarloPart>().sampling.samples, 64);
}

TEST(SampledStudyFile, SensitivityArrives) {
  const StudyFolder folder;
  const StudyFile study = folder.read(good_sensitivity);
  EXPECT_EQ(study.part<SensitivityPart>().sensitivity.method, SensitivityMethod::morris);
  EXPECT_EQ(study.part<SensitivityPart>().sensitivity.levels, 6);
  EXPECT_EQ(std::get<Uniform>(study.part<UncertainPart>().sources[1].distribution).upper, 2.3);
}

TEST(SampledStudyFile, ReadsBackToTheSameStudy) {
  const StudyFolder folder;
  for (const std::string& good : {good_sweep, good_monte_carlo, good_sensitivity}) {
    const std::string text = write_study(folder.read(good));
    EXPECT_EQ(write_study(folder.read(text)), text);
  }
}

struct SampledGolden {
  const std::string& study;
  std::string before, after, message;
};

TEST(SampledStudyFile, MessagesAreExactlyThese) {
  const StudyFolder folder;
  const std::vector<SampledGolden> goldens{
      {good_sweep, "[sweep]", "[sampling]",
       "study.toml:17:2: sampling: is of no use in a study of kind \"sweep\""},
      {good_sweep, "values = [10.0, 12.5]\n", "",
       "study.toml:5:1: variable[0]: has no values; give values, or lower, upper and count"},
      {good_sweep, "count = 3\n", "values = [1.0]\ncount = 3\n",
       "study.toml:8:1: variable[1]: has both values and evenly spaced ones; give values, or lower, upper "
       "and count"},
      {good_sweep, "values = [10.0, 12.5]", "values = [10.0, -1.0]",
       "study.toml:7:10: variable[0].values: flexspline.cup_length_mm must be above 0 and at most 2000 mm, "
       "is -1"},
      {good_sweep, "flexspline.cup_length_mm", "flexspline.teeth",
       "study.toml:7:10: variable[0].values: flexspline.teeth is a whole number; 12.5 is none"},
      {good_sweep, "load_case[0].torque_nm", "load_case[0].rotation_rad",
       "study.toml:15:8: variable[2].path: load case 0 is given by its torque_nm"},
      {good_sweep, "load_case[0].torque_nm", "load.torque_nm[0]",
       "study.toml:15:8: variable[2].path: the loads of a study are its load cases; write "
       "load_case[0].torque_nm, for example"},
      {good_sweep, "load_case[0].torque_nm", "load_case[1].torque_nm",
       "study.toml:15:8: variable[2].path: there are only 1 load cases, counted from 0"},
      {good_sweep, "\"factorial\"", "\"list\"",
       "study.toml:8:1: variable[1]: has 3 values, the first variable has 2; in mode \"list\" all have "
       "equally many"},
      {good_sweep, "outputs = [\"peak_force_n\", ", "outputs = [7, ",
       "study.toml:19:12: sweep.outputs[0]: expected a text, got the number 7"},
      {good_monte_carlo, "\"adjacent_pitch\"", "\"adjacent_pich\"",
       "study.toml:5:8: source[0].kind: must be adjacent_pitch, cumulative_pitch, run_out, tooth_thickness, "
       "centre_offset, ovality, backlash_noise, profile_slope, profile_form, wear or gear_key, is "
       "\"adjacent_pich\"; did you mean \"adjacent_pitch\"?"},
      {good_monte_carlo, "normal = { mean", "gaussian = { mean",
       "study.toml:6:18: source[0].distribution.gaussian: no such distribution; the nearest legal one is "
       "normal"},
      {good_monte_carlo, "std = 2.0", "std = -2.0",
       "study.toml:6:47: source[0].distribution.normal.std: must be above 0 and at most 1000000000000, is "
       "-2"},
      {good_monte_carlo, "distribution = { normal = { mean = 0.0, std = 2.0 } }\n", "",
       "study.toml:3:1: source[0]: has no distribution; give, for example, distribution = { normal = { mean "
       "= "
       "0.0, std = 1.0 } }"},
      {good_monte_carlo, "path = \"wave_generator.max_radial_deformation_mm\"\n", "",
       "study.toml:17:1: source[3]: has no path; kind \"gear_key\" wants the number of the gear that it "
       "means"},
      {good_monte_carlo, "\"wave_generator.max_radial_deformation_mm\"", "\"load.torque_nm[0]\"",
       "study.toml:20:8: source[3].path: the loads of a study are its load cases; write "
       "load_case[0].torque_nm, for example"},
      {good_monte_carlo, "\"wave_generator.max_radial_deformation_mm\"", "\"load_case[3].torque_nm\"",
       "study.toml:20:8: source[3].path: there are only 3 load cases, counted from 0"},
      {good_monte_carlo, "\"wave_generator.max_radial_deformation_mm\"", "\"load_case[0].torque_nm\"",
       "no error"},
      {good_sensitivity, "circular_spline.profile_shift", "load.torque_nm[0]",
       "study.toml:10:8: source[1].path: the loads of a study are its load cases; write "
       "load_case[0].torque_nm, for example"},
      {good_monte_carlo, "harmonic = 2", "harmonic = 0",
       "study.toml:15:12: source[2].harmonic: must be at least 1 and at most 1000, is 0"},
      {good_monte_carlo, "second = \"tooth thickness\"", "second = \"pitch\"",
       "study.toml:24:10: correlation[0].second: \"pitch\" (adjacent_pitch) is several numbers of one gear; "
       "only "
       "sources that are one number can be correlated: tooth_thickness, profile_slope, profile_form, wear "
       "and "
       "gear_key"},
      {good_monte_carlo, "second = \"tooth thickness\"", "second = \"tooth thicknes\"",
       "study.toml:24:10: correlation[0].second: there is no source \"tooth thicknes\"; did you mean \"tooth "
       "thickness\"?"},
      {good_monte_carlo, "design = \"random\"\nsamples = 4096",
       "design = \"latin_hypercube\"\nsamples = 4096",
       "study.toml:32:8: sampling.stop: needs design = \"random\": the intervals of other designs need all "
       "their samples"},
      {good_monte_carlo, "output = \"peak_force_n\"\nlimit", "output = \"take_up_rad\"\nlimit",
       "study.toml:34:10: exceedance[0].output: take_up_rad is not among sampling.outputs"},
      {good_monte_carlo, "output = \"peak_force_n\"\nlimit", "output = \"engaged_count\"\nlimit",
       "study.toml:34:10: exceedance[0].output: studies of this kind have no output \"engaged_count\"; they "
       "have "
       "\"engaged_count_all\": teeth of both lobes that carry load"},
      {good_sensitivity, "method = \"morris\"", "method = \"sobol\"",
       "study.toml:14:11: sensitivity.samples: must be a power of two, at least 8, is 10"},
      {good_sensitivity, "levels = 6", "levels = 5",
       "study.toml:15:10: sensitivity.levels: must be even, is 5"},
  };
  for (const SampledGolden& golden : goldens)
    EXPECT_EQ(folder.complaint(edited(golden.study, golden.before, golden.after)), golden.message);
}

TEST(SampledStudyFile, DamagedFilesNeverCrash) {
  const StudyFolder folder;
  for (const std::string& good : {good_sweep, good_monte_carlo, good_sensitivity})
    for (std::size_t byte = 0; byte < good.size(); byte += 20) {
      (void)folder.complaint(good.substr(0, byte));
      for (const char other : {'"', '[', ']', '=', '\n', '{', '9', '\xff'}) {
        std::string text = good;
        text[byte] = other;
        (void)folder.complaint(text); // any other exception fails the test
      }
    }
}

} // namespace
} // namespace strainwave
