#include "app/version.hpp"

namespace strainwave::app {

std::string_view program_version() {
  return STRAINWAVE_VERSION;
}

} // namespace strainwave::app
