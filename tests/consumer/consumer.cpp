// Uses the installed library: the least backlash of a gear file.

#include <strainwave/model/forward/forward.hpp>
#include <strainwave/model/gear_file/gear_file.hpp>
#include <strainwave/version.hpp>

#include <cstdio>

int main(int, char** argv) {
  strainwave::ForwardModel model({.disk_cache = false});
  const auto result = model.analyze(strainwave::load_gear(argv[1]).gear);
  if (result.status != strainwave::Status::ok)
    return 3;
  std::printf("strainwave %s: least backlash %.2f um, largest force %.1f N\n", strainwave::library_version,
              result.backlash->min_um, result.load.at(1).peak_force_n);
}
