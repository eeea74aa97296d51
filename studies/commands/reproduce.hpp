#pragma once
// One evaluation of a study, made again from its folder alone.

#include "strainwave/studies/tables/run.hpp"

#include <filesystem>

namespace strainwave {

struct NamedValue {
  std::string name, unit;
  double value = 0.0;
};

struct ReproducedRow {
  std::uint64_t row = 0, rows = 0;
  std::string status = "ok", message;
  std::vector<NamedValue> inputs, outputs; ///< no outputs where it failed
  std::optional<Gear> gear;                ///< where the row is one: to be written and analysed
  std::string details;                     ///< a JSON object with more; may be empty
  std::optional<bool> same_bits;           ///< as recorded; nothing where it is not recorded (yet)
};

/// Row `index` of DIR/results.h5, of any kind of study. Throws FileError without a plan, std::out_of_range
/// with one sentence for an index that there is not.
Outcome<ReproducedRow> reproduce_row(const std::filesystem::path& folder, std::uint64_t index,
                                     const RunContext& context);

} // namespace strainwave
