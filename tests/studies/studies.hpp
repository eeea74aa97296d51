#pragma once
// A folder with the seed gear and a good study of it.

#include "strainwave/studies/commands/kinds.hpp"
#include "tests/model/gear_file/files.hpp"

namespace strainwave {

inline const std::string good_study = R"(kind = "optimize"
gear = "seed.toml"
seed = 7
[override]
"wave_generator.shape" = "two_disc"
load.rated_torque_nm = 8
"flank_modification.flexspline.spline_um" = [0, 0, 0, 1]
[[load_case]]
torque_nm = 7.0
phases = 4
[[load_case]]
rotation_rad = 3e-3
direction = "both"
[[variable]]
path = "flank_modification.flexspline.tip_relief_um"
lower = 0.0
upper = 15.0
start = 5.0
scale = 10.0
[[variable]]
path = "wave_generator.max_radial_deformation_mm"
lower = 0.19
upper = 0.21
link = { path = "wave_generator.eccentricity_mm", ratio = 3.0 }
[[variable]]
path = "flank_modification.flexspline.spline_um[3]"
lower = 0
upper = 10
[objective]
output = "peak_force_n"
[[constraint]]
output = "rotation_rad"
max_ratio_to_baseline = 1.05
[[constraint]]
output = "secant_nm_per_rad"
min = 3000
[method]
name = "cobyla"
budget = 150
tolerance = 1e-5
starts = 2
[limits]
failure_share = 0.02
[reduced]
"method.budget" = 10
"load_case[0].phases" = 1
mesh.per_pitch = 3
)";

class StudyFolder {
public:
  StudyFolder() { folder_.write("seed.toml", file_text(seed_path)); }
  std::string write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  StudyFile read(const std::string& text, bool reduced = false) const {
    return parse_study(text, path("study.toml"), study_kinds(), reduced);
  }

  /// What is said about a text, without the folder; "no error" if it is a study.
  std::string complaint(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const FileError& error) {
      std::string words = error.what();
      const std::string folder = (folder_ / "").string();
      for (std::size_t place; (place = words.find(folder)) != std::string::npos;)
        words.erase(place, folder.size());
      return words;
    }
    return "no error";
  }

private:
  TemporaryFolder folder_;
};

} // namespace strainwave
