#pragma once
// results.h5 of a search, in the same form as that of every other study (journal/results_table.hpp): one row
// for every point that was evaluated.

#include "strainwave/studies/results/result_folder.hpp"
#include "strainwave/studies/search/optimisation.hpp"

namespace strainwave {

/// Nothing is written without any point. Throws std::system_error (full disk, permissions); a file that was
/// there then stays as it was.
void write_results_file(const OptimisationReport& report, const std::filesystem::path& path);

/// results.h5, result.json and best.toml. False, and nothing written, when the run was stopped early and the
/// folder already has a finished result.
bool write_search_results(const ResultFolder& folder, const OptimisationReport& report);

/// What a point of a search depends on beside its plan: the version of the forward model's numbers.
std::uint64_t search_model_hash();

} // namespace strainwave
