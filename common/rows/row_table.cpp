#include "strainwave/common/rows/row_table.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace strainwave {

RowTable::RowTable(std::uint64_t rows, std::uint32_t outputs, std::uint32_t block_rows)
    : outputs_(outputs), block_rows_(block_rows), status_(rows, row_missing), values_(rows * outputs, 0.0),
      seconds_((rows + block_rows - 1) / block_rows, 0.0) {}

std::uint32_t RowTable::rows_of_block(std::uint64_t block) const {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(block_rows_, rows() - block * block_rows_));
}

std::optional<std::uint64_t> RowTable::insert(const RowBlock& block) {
  const std::uint64_t number = block.first / block_rows_;
  if (block.first % block_rows_ != 0 || block.first >= rows() || block.rows != rows_of_block(number) ||
      block.outputs != outputs_ || std::ranges::find(block.status, row_missing) != block.status.end())
    throw JournalError(JournalFault::damaged,
                       fmt::format("a record of rows {} to {} with {} outputs does not fit the study",
                                   block.first, block.first + block.rows, block.outputs));
  if (has_block(number))
    return contradiction(block);
  std::ranges::copy(block.status, status_.begin() + static_cast<std::ptrdiff_t>(block.first));
  std::ranges::copy(block.values, values_.begin() + static_cast<std::ptrdiff_t>(block.first * outputs_));
  for (const RowMessage& message : block.messages)
    messages_[block.first + message.row] = message.text;
  seconds_[number] = block.seconds;
  return std::nullopt;
}

std::optional<std::uint64_t> RowTable::contradiction(const RowBlock& block) const {
  for (std::uint32_t i = 0; i < block.rows; ++i) {
    const std::uint64_t row = block.first + i;
    if (status_[row] != block.status[i] ||
        std::memcmp(&values_[row * outputs_], &block.values[std::size_t{i} * outputs_], 8 * outputs_) != 0)
      return row;
  }
  for (const RowMessage& message : block.messages) {
    const auto known = messages_.find(block.first + message.row);
    if (known == messages_.end() || known->second != message.text)
      return block.first + message.row;
  }
  return std::nullopt;
}

void RowTable::keep_first(std::uint64_t rows) {
  status_.resize(rows);
  values_.resize(rows * outputs_);
  seconds_.resize((rows + block_rows_ - 1) / block_rows_);
  messages_.erase(messages_.lower_bound(rows), messages_.end());
}

std::uint64_t RowTable::done() const {
  return rows() - static_cast<std::uint64_t>(std::ranges::count(status_, row_missing));
}

std::uint64_t RowTable::failed() const {
  return done() - static_cast<std::uint64_t>(std::ranges::count(status_, row_ok));
}

std::vector<double> RowTable::column(std::uint32_t output) const {
  std::vector<double> column;
  column.reserve(rows());
  for (std::uint64_t row = 0; row < rows(); ++row)
    if (status_[row] == row_ok)
      column.push_back(value(row, output));
  return column;
}

} // namespace strainwave
