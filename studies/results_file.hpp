#pragma once
// results.h5 of a study: one row per evaluation. Derived, never opened for update; h5py reads it in ten
// lines.
//
//   /inputs   rows × variables, attributes "names" and "units" (one line each, in the order of the columns)
//   /outputs  rows × responses, the same; NaN for a failed evaluation
//   /status   text per row: "ok" or what went wrong;  /messages  the sentence;  /timing  seconds
//   /config   the resolved study and the gear file;  /version

#include "studies/optimisation.hpp"

#include <filesystem>

namespace strainwave {

/// Throws std::system_error with the cause when the file cannot be written.
void write_results_file(const OptimisationReport& report, const std::filesystem::path& path);

} // namespace strainwave
