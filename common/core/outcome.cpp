#include "strainwave/common/core/outcome.hpp"

namespace strainwave {

std::string_view status_name(Status status) {
  switch (status) {
  case Status::ok:
    return "ok";
  case Status::contradiction:
    return "contradiction";
  case Status::no_wrap:
    return "no_wrap";
  case Status::singular_wave_generator:
    return "singular_wave_generator";
  case Status::flank_outside_tooth:
    return "flank_outside_tooth";
  case Status::no_overlap:
    return "no_overlap";
  case Status::no_contact:
    return "no_contact";
  case Status::not_available:
    return "not_available";
  case Status::ill_conditioned:
    return "ill_conditioned";
  case Status::not_converged:
    return "not_converged";
  case Status::certificate_failed:
    return "certificate_failed";
  }
  return "unknown";
}

} // namespace strainwave
