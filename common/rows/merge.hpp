#pragma once
// Joining the journals of a study's shards. Shards may overlap (the number of shards was changed midway) as
// long as they agree bit by bit.

#include "strainwave/common/rows/journal_reader.hpp"
#include "strainwave/common/rows/row_table.hpp"

#include <filesystem>

namespace strainwave {

struct Merged {
  JournalHeader header; ///< of the first journal
  RowTable table;
  std::uint64_t missing_rows = 0;
  std::vector<std::string> notes; ///< torn tails, different binaries: worth a line, no reason to refuse
};

/// Throws JournalError: other_plan, other_model, other_shape, contradiction (names row and both files), gaps
/// (names rows and the shard to run again; not where `allow_missing`), damaged; std::invalid_argument without
/// any journal; std::system_error.
Merged merge_journals(const std::vector<std::filesystem::path>& journals, bool allow_missing = false);

/// DIR/shards/*.journal in the order of their names.
std::vector<std::filesystem::path> shard_journals(const std::filesystem::path& study_folder);
/// DIR/shards/IIII-of-NNNN.journal
std::filesystem::path shard_journal(const std::filesystem::path& study_folder, std::uint32_t shard,
                                    std::uint32_t shards);

/// Blocks that are not there, as one sentence that names shards to run again; empty if nothing is missing.
std::string missing_sentence(const RowTable&, std::uint32_t shards);

} // namespace strainwave
