#pragma once
// The methods of NLopt that studies may name, and what each of them can do by itself.

#include <nlopt.h>

#include <span>
#include <string_view>

namespace strainwave {

struct NloptMethod {
  std::string_view name; ///< in study files
  nlopt_algorithm algorithm;
  bool global = false;       ///< looks over the whole box; ends by its budget
  bool slopes = false;       ///< asks for first derivatives
  bool takes_limits = false; ///< else wrapped in an augmented Lagrangian (Birgin and Martínez, 2008)
  bool needs_local = false;  ///< starts BOBYQA from its own points
  std::string_view source;
};

std::span<const NloptMethod> nlopt_method_table();
/// Null if there is none of this name.
const NloptMethod* find_nlopt_method(std::string_view name);

} // namespace strainwave
