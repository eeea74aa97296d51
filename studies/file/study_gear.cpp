#include "strainwave/studies/file/study_gear.hpp"

#include <algorithm>

namespace strainwave {

Gear gear_with_loads(const StudyFile& study) {
  Gear gear = study.gear;
  gear.load.torque_nm.clear();
  gear.load.rotation_rad.clear();
  gear.load.phases = 1;
  gear.load.direction = study.load_cases.front().direction;
  for (const LoadCase& load : study.load_cases) {
    if (load.torque_nm)
      gear.load.torque_nm.push_back(*load.torque_nm);
    if (load.rotation_rad)
      gear.load.rotation_rad.push_back(*load.rotation_rad);
    gear.load.phases = std::max(gear.load.phases, load.phases);
    if (load.direction != gear.load.direction)
      gear.load.direction = Direction::both;
  }
  return gear;
}

std::vector<Load> study_loads(const StudyFile& study) {
  std::vector<Load> loads;
  for (const LoadCase& c : study.load_cases) {
    auto load = std::find_if(loads.begin(), loads.end(), [&](const Load& known) {
      return known.phases == c.phases && known.direction == c.direction;
    });
    if (load == loads.end()) {
      loads.push_back({.torque_nm = {},
                       .rotation_rad = {},
                       .rated_torque_nm = study.gear.load.rated_torque_nm,
                       .direction = c.direction,
                       .phases = c.phases});
      load = loads.end() - 1;
    }
    if (c.torque_nm)
      load->torque_nm.push_back(*c.torque_nm);
    if (c.rotation_rad)
      load->rotation_rad.push_back(*c.rotation_rad);
  }
  return loads;
}

} // namespace strainwave
