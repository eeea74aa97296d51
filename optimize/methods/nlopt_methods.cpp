#include "strainwave/optimize/methods/nlopt_methods.hpp"

#include <array>

namespace strainwave {

namespace {

constexpr bool yes = true;

constexpr std::array table{
    NloptMethod{.name = "cobyla",
                .algorithm = NLOPT_LN_COBYLA,
                .takes_limits = yes,
                .source = "Powell 1994: linear models over a simplex"},
    NloptMethod{.name = "bobyqa",
                .algorithm = NLOPT_LN_BOBYQA,
                .source = "Powell 2009: quadratic models, smooth functions"},
    NloptMethod{.name = "sbplx", .algorithm = NLOPT_LN_SBPLX, .source = "Rowan 1990: simplices in subspaces"},
    NloptMethod{.name = "mma",
                .algorithm = NLOPT_LD_MMA,
                .slopes = yes,
                .takes_limits = yes,
                .source = "Svanberg 2002: moving asymptotes"},
    NloptMethod{.name = "ccsaq",
                .algorithm = NLOPT_LD_CCSAQ,
                .slopes = yes,
                .takes_limits = yes,
                .source = "Svanberg 2002: conservative quadratic models"},
    NloptMethod{.name = "slsqp",
                .algorithm = NLOPT_LD_SLSQP,
                .slopes = yes,
                .takes_limits = yes,
                .source = "Kraft 1994: sequential quadratic programming"},
    NloptMethod{.name = "direct_l",
                .algorithm = NLOPT_GN_DIRECT_L,
                .global = yes,
                .source = "Gablonsky and Kelley 2001: dividing rectangles"},
    NloptMethod{.name = "crs2",
                .algorithm = NLOPT_GN_CRS2_LM,
                .global = yes,
                .source = "Kaelo and Ali 2006: controlled random search"},
    NloptMethod{.name = "isres",
                .algorithm = NLOPT_GN_ISRES,
                .global = yes,
                .takes_limits = yes,
                .source = "Runarsson and Yao 2005: evolution strategy"},
    NloptMethod{.name = "mlsl",
                .algorithm = NLOPT_G_MLSL_LDS,
                .global = yes,
                .needs_local = yes,
                .source = "Kucherenko and Sytsko 2005: many local searches"},
};

} // namespace

std::span<const NloptMethod> nlopt_method_table() {
  return table;
}

const NloptMethod* find_nlopt_method(std::string_view name) {
  for (const NloptMethod& method : table) {
    if (method.name == name)
      return &method;
  }
  return nullptr;
}

} // namespace strainwave
