#pragma once
// The program in a folder of its own: exit codes, stdout, stderr; and a small sweep to run.

#include "tests/model/gear_file/files.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

namespace strainwave {

inline const std::string gallery = STRAINWAVE_SOURCE "/studies/gallery/";

class StudyShell : public testing::Test {
protected:
  struct End {
    int code;
    std::string out, err;
    nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
  };

  /// A shell line in which PROGRAM stands for the program, in a folder of its own.
  End shell(std::string line) {
    for (std::size_t place; (place = line.find("PROGRAM")) != std::string::npos;)
      line.replace(place, 7, STRAINWAVE_PROGRAM);
    const int status = std::system(
        fmt::format("cd '{}' && ( {} ) > out.txt 2> err.txt < /dev/null", (folder / "").string(), line)
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_text((folder / "out.txt").string()),
            file_text((folder / "err.txt").string())};
  }

  /// Are the results of two folders the same, bit for bit?
  bool identical(const std::string& first, const std::string& second) {
    const End end = shell(fmt::format("PROGRAM study compare {} {} --exact --json", first, second));
    return end.code == 0 && end.json()["identical"] == true;
  }

  /// 4 flanks × 16 torques on one coarse cup: some milliseconds a row.
  void write_sweep(const std::string& more = "") {
    folder.write("seed.toml", file_text(gallery + "seed.toml"));
    folder.write("sweep.toml", R"(kind = "sweep"
gear = "seed.toml"
[override]
mesh.per_pitch = 3
mesh.along_face = 2
mesh.along_wall = 4
mesh.diaphragm = 3
mesh.tooth_height = 1
[[load_case]]
torque_nm = 7.0
[[variable]]
path = "load_case[0].torque_nm"
lower = 0.5
upper = 8.0
count = 16
[[variable]]
path = "flank_modification.flexspline.tip_relief_um"
values = [0, 2, 4, 8]
[sweep]
outputs = ["peak_force_n", "rotation_rad", "min_backlash_um"]
)" + more);
  }

  TemporaryFolder folder;
};

} // namespace strainwave
