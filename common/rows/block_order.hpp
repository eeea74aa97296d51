#pragma once
// The part of a run that looks at blocks in index order: where does the study end, and why? Not thread-safe.

#include "strainwave/common/rows/run_rows.hpp"

namespace strainwave {

class BlockOrder {
public:
  BlockOrder(const EnginePlan&, const EngineOptions&, const RowModel&, RowTable&);

  /// Goes on over all blocks of the shard that are there; true once the study has ended (all done, enough,
  /// all failed).
  bool advance();
  bool ended() const { return ended_; }
  RunEnd end() const { return end_; }
  const std::string& sentence() const { return sentence_; }
  std::uint64_t end_of_rows() const { return end_rows_; } ///< rows of the study that count

private:
  std::string common_reason() const;
  const EnginePlan& plan_;
  const EngineOptions& options_;
  const RowModel& model_;
  RowTable& table_;
  std::uint64_t next_block_;
  std::vector<std::uint64_t> first_rows_; ///< until the guard has spoken
  bool guard_done_;
  bool ended_ = false;
  RunEnd end_ = RunEnd::complete;
  std::string sentence_;
  std::uint64_t end_rows_;
};

} // namespace strainwave
