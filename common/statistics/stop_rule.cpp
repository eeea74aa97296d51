#include "strainwave/common/statistics/stop_rule.hpp"

#include "strainwave/common/statistics/summary.hpp"

namespace strainwave {

bool looks_at(const StopRule& rule, std::uint64_t rows) {
  if (rule.first_look == 0 || rows < rule.first_look || rows % rule.first_look != 0)
    return false;
  const std::uint64_t times = rows / rule.first_look;
  return (times & (times - 1)) == 0;
}

std::optional<Estimate> watched(const StopRule& rule, std::span<const double> values) {
  if (values.size() < 4)
    return std::nullopt;
  SummaryRequest request{.quantiles = {}, .limits = {}, .bins = 1};
  if (rule.of == StopRule::Of::quantile)
    request.quantiles = {rule.argument};
  if (rule.of == StopRule::Of::exceedance)
    request.limits = {rule.argument};
  const Summary summary = summarise(values, request);
  switch (rule.of) {
  case StopRule::Of::quantile:
    return summary.quantiles[0].estimate;
  case StopRule::Of::exceedance:
    return summary.exceedances[0].probability;
  case StopRule::Of::mean:
    break;
  }
  return summary.mean;
}

bool reached(const StopRule& rule, std::span<const double> values) {
  const auto estimate = watched(rule, values);
  return estimate && estimate->ci95.half_width() <= rule.half_width;
}

} // namespace strainwave
