#pragma once
// One thread's way through a block: inputs, model, checks, record bytes. Nothing is allocated once its
// buffers have grown.

#include "strainwave/common/rows/row_model.hpp"

#include <atomic>

namespace strainwave {

class BlockWorker {
public:
  /// slice_rows: rows between two looks at `halt`.
  BlockWorker(const RowInputs&, const RowModel&, std::size_t slice_rows, const std::atomic<bool>& halt);

  /// False: dropped, because `halt` was set.
  bool evaluate(std::uint64_t first, std::uint32_t rows);
  const RowBlock& block() const { return block_; }
  std::span<const std::byte> record(); ///< of the last block

private:
  void refuse_not_finite(const RowSlice&);
  const RowInputs& inputs_;
  const RowModel& model_;
  std::size_t slice_rows_;
  const std::atomic<bool>& halt_;
  std::unique_ptr<RowWorker> worker_;
  RowBlock block_;
  std::vector<double> input_rows_;
  std::vector<std::byte> bytes_;
};

} // namespace strainwave
