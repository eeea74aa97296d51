#include "strainwave/common/rows/block_worker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace strainwave {

BlockWorker::BlockWorker(const RowInputs& inputs, const RowModel& model, std::size_t slice_rows,
                         const std::atomic<bool>& halt)
    : inputs_(inputs), model_(model), slice_rows_(slice_rows), halt_(halt), worker_(model.worker()) {}

bool BlockWorker::evaluate(std::uint64_t first, std::uint32_t rows) {
  const auto begin = std::chrono::steady_clock::now();
  const std::size_t outputs = model_.outputs();
  block_.first = first;
  block_.rows = rows;
  block_.outputs = static_cast<std::uint32_t>(outputs);
  block_.status.assign(rows, row_ok);
  block_.values.assign(rows * outputs, 0.0);
  block_.messages.clear();
  for (std::uint32_t at = 0; at < rows;) {
    if (halt_.load(std::memory_order_relaxed))
      return false;
    const std::size_t count = std::min<std::size_t>(slice_rows_, rows - at);
    input_rows_.resize(count * model_.inputs());
    if (!input_rows_.empty())
      inputs_(first + at, count, input_rows_);
    RowSlice slice{first + at,
                   count,
                   input_rows_,
                   std::span(block_.values).subspan(at * outputs, count * outputs),
                   std::span(block_.status).subspan(at, count),
                   &block_.messages,
                   at};
    worker_->evaluate(slice);
    refuse_not_finite(slice);
    at += static_cast<std::uint32_t>(count);
  }
  block_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return true;
}

/// A failed row keeps no numbers, and a row with numbers has finite ones.
void BlockWorker::refuse_not_finite(const RowSlice& slice) {
  const std::size_t outputs = model_.outputs();
  for (std::size_t i = 0; i < slice.rows; ++i) {
    const auto row = slice.outputs.subspan(i * outputs, outputs);
    if (slice.status[i] == row_ok && !std::ranges::all_of(row, [](double x) { return std::isfinite(x); }))
      slice.fail(i, row_not_finite, "the model gave a number that is not finite");
    if (slice.status[i] != row_ok)
      std::ranges::fill(row, 0.0);
  }
}

std::span<const std::byte> BlockWorker::record() {
  encode_block(block_, bytes_);
  return bytes_;
}

} // namespace strainwave
