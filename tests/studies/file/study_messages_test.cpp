// The exact words for every kind of fault of a study file.

#include "tests/studies/studies.hpp"

#include <vector>

namespace strainwave {
namespace {

struct Golden {
  const char* title;
  std::string before;
  std::string after;
  std::string message;
};

const std::vector<Golden>& goldens() {
  static const std::vector<Golden> all{
      {"misspelt kind", "\"optimize\"", "\"optimise\"",
       "study.toml:1:8: kind: must be optimize, pareto, sweep, monte_carlo, sensitivity or convergence, is "
       "\"optimise\"; "
       "did you mean "
       "\"optimize\"?"},
      {"no kind", "kind = \"optimize\"", "",
       "study.toml:1:1: kind: missing; expected one of the texts optimize, pareto, sweep, monte_carlo, "
       "sensitivity "
       "or convergence: what "
       "kind of study this is"},
      {"gear that is not there", "\"seed.toml\"", "\"sed.toml\"",
       "study.toml:2:8: gear: sed.toml: no such gear file; did you mean seed.toml?"},
      {"negative seed", "seed = 7", "seed = -7",
       "study.toml:3:8: seed: must be at least 0 and at most 2147483647, is -7"},
      {"misspelt table", "[[variable]]", "[[varable]]",
       "study.toml:14:3: varable: no such key or table; did you mean variable?"},
      {"single brackets",
       "[[constraint]]\noutput = \"rotation_rad\"\nmax_ratio_to_baseline = 1.05\n[[constraint]]",
       "[constraint]",
       "study.toml:31:2: constraint: there may be several of these, so each is opened by [[constraint]]"},
      {"table of another kind", "[limits]", "[sampling]\nsamples = 3\n[limits]",
       "study.toml:42:2: sampling: is of no use in a study of kind \"optimize\""},
      {"misspelt key", "budget = 150", "bugdet = 150",
       "study.toml:39:1: method.bugdet: no such key; did you mean budget?"},
      {"missing key", "upper = 15.0", "",
       "study.toml:14:1: variable[0].upper: missing; expected a number: upper bound"},
      {"nothing wanted", "[objective]\noutput = \"peak_force_n\"", "",
       "study.toml:1:1: objective: the table [objective] is missing; it has to give output"},
      {"misspelt override", "wave_generator.shape", "wave_generator.shpe",
       "study.toml:5:1: wave_generator.shpe: no such key; did you mean shape?"},
      {"override out of range", "rated_torque_nm = 8", "rated_torque_nm = 0",
       "study.toml:6:24: load.rated_torque_nm: must be above 0 and at most 1000000 N·m, is 0"},
      {"load case without load", "torque_nm = 7.0\n", "",
       "study.toml:8:1: load_case[0]: needs torque_nm or rotation_rad"},
      {"load case with two loads", "torque_nm = 7.0", "torque_nm = 7.0\nrotation_rad = 1e-3",
       "study.toml:8:1: load_case[0]: has both torque_nm and rotation_rad; a load case has one of them"},
      {"variable that does not exist", "tip_relief_um\"", "tip_releif_um\"",
       "study.toml:15:8: variable[0].path: flank_modification.flexspline.tip_releif_um: no such key; did you "
       "mean "
       "tip_relief_um?"},
      {"variable that is no number", "flank_modification.flexspline.tip_relief_um\"", "contact.fidelity\"",
       "study.toml:15:8: variable[0].path: contact.fidelity: is not a number; it is one of the texts "
       "unilateral, linear or "
       "nonlinear"},
      {"variable that is a whole number", "flank_modification.flexspline.tip_relief_um\"",
       "flexspline.teeth\"",
       "study.toml:15:8: variable[0].path: flexspline.teeth is a whole number; only continuous numbers can "
       "vary here"},
      {"list item that the gear lacks", "spline_um[3]", "spline_um[4]",
       "study.toml:26:8: variable[2].path: flank_modification.flexspline.spline_um[4]: this gear's list "
       "holds only 4 "
       "numbers, counted from 0"},
      {"variable that is a load", "flank_modification.flexspline.tip_relief_um\"", "load_case[0].torque_nm\"",
       "study.toml:15:8: variable[0].path: a load cannot vary in a search: every design bears the same load "
       "cases"},
      {"variable that is a load by another name", "flank_modification.flexspline.tip_relief_um\"",
       "load.torque_nm[0]\"",
       "study.toml:15:8: variable[0].path: the loads of a study are its load cases; write "
       "load_case[0].torque_nm, for example"},
      {"link that is a load", "\"wave_generator.eccentricity_mm\"", "\"load_case[0].torque_nm\"",
       "study.toml:24:17: variable[1].link.path: is a load, which cannot vary here"},
      {"variable twice", "flank_modification.flexspline.spline_um[3]",
       "flank_modification.flexspline.tip_relief_um",
       "study.toml:26:8: variable[2].path: flank_modification.flexspline.tip_relief_um varies already (line "
       "15)"},
      {"bounds the wrong way round", "lower = 0.19", "lower = 0.3",
       "study.toml:23:9: variable[1].upper: must be above lower = 0.3, is 0.21"},
      {"bound out of the key's range", "lower = 0.0\n", "lower = -1.0\n",
       "study.toml:16:9: variable[0].lower: flank_modification.flexspline.tip_relief_um must be at least 0 "
       "and at most 1000 "
       "µm, is -1"},
      {"start out of bounds", "start = 5.0", "start = 50.0",
       "study.toml:18:9: variable[0].start: must lie between lower = 0 and upper = 15, is 50"},
      {"scale of nothing", "scale = 10.0", "scale = 0",
       "study.toml:19:9: variable[0].scale: must be above 0 and at most 1000000000, is 0"},
      {"link out of range", "ratio = 3.0", "ratio = -3.0",
       "study.toml:24:59: variable[1].link.ratio: wave_generator.eccentricity_mm must be above 0 and at most "
       "100 mm, is "
       "-0.5700000000000001"},
      {"link without ratio", ", ratio = 3.0", "",
       "study.toml:24:8: variable[1].link.ratio: missing; expected a number: that number over the variable"},
      {"constraint that limits nothing", "max_ratio_to_baseline = 1.05\n", "",
       "study.toml:31:1: constraint[0]: limits nothing; give min, max, min_ratio_to_baseline or "
       "max_ratio_to_baseline"},
      {"constraint the wrong way round", "min = 3000", "min = 3000\nmax = 2000",
       "study.toml:37:7: constraint[1].max: must not be below min = 3000, is 2000"},
      {"reduced key that does not exist", "\"method.budget\" = 10", "\"methd.budget\" = 10",
       "study.toml:45:1: reduced.methd.budget: no such key of a study or of a gear; expected, for example, "
       "\"method.budget\", \"load_case[0].phases\" or \"mesh.per_pitch\""},
      {"reduced load case that does not exist", "load_case[0].phases", "load_case[2].phases",
       "study.toml:46:1: reduced.load_case[2].phases: there are only 2 [[load_case]], counted from 0"},
      {"reduced gear key out of range", "mesh.per_pitch = 3", "mesh.per_pitch = 0",
       "study.toml:47:18: mesh.per_pitch: must be at least 3 and at most 64, is 0"},
      {"key given twice", "lower = 0.0\n", "lower = 0.0\nlower = 1.0\n",
       "study.toml:17:1: variable.lower: the key is given twice (first in line 16); keep one of the two"},
  };
  return all;
}

TEST(StudyFileMessages, AreExactlyThese) {
  const StudyFolder folder;
  for (const Golden& golden : goldens())
    EXPECT_EQ(folder.complaint(edited(good_study, golden.before, golden.after)), golden.message)
        << golden.title;
}

TEST(StudyFileMessages, NamesOfOutputsAndMethodsAreChecked) {
  const StudyFolder folder;
  EXPECT_EQ(folder.complaint(good_study), "no error");
  std::string text = edited(good_study, "\"peak_force_n\"", "\"peak_force\"");
  text = edited(text, "\"cobyla\"", "\"newton\"");
  EXPECT_EQ(
      folder.complaint(text),
      "study.toml:30:10: objective.output: there is no output \"peak_force\"; did you mean "
      "\"peak_force_n\"?\n"
      "study.toml:38:8: method.name: there is no method \"newton\"; the nearest legal one is \"cobyla\"");
}

TEST(StudyFileMessages, AWrongGearFileSpeaksForItself) {
  const StudyFolder folder;
  folder.write("seed.toml", edited(file_text(seed_path), "module_mm = 0.2", "module_mm = -0.2"));
  EXPECT_EQ(folder.complaint(good_study),
            "seed.toml:13:13: flexspline.module_mm: must be above 0 and at most 100 mm, is -0.2");
}

TEST(StudyFileMessages, DamagedFilesNeverCrash) {
  const StudyFolder folder;
  for (std::size_t byte = 0; byte < good_study.size(); byte += 10) {
    (void)folder.complaint(good_study.substr(0, byte));
    for (const char other : {'"', '[', ']', '=', '.', '\n', '{', '9', '\0', '\xff'}) {
      std::string text = good_study;
      text[byte] = other;
      (void)folder.complaint(text); // any other exception fails the test
    }
  }
}

} // namespace
} // namespace strainwave
