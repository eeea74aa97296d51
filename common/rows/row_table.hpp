#pragma once
// All rows of a study in memory, in index order: what statistics and results.h5 are made from.

#include "strainwave/common/rows/journal_format.hpp"
#include "strainwave/common/rows/row_block.hpp"

#include <map>
#include <optional>

namespace strainwave {

class RowTable {
public:
  RowTable(std::uint64_t rows, std::uint32_t outputs, std::uint32_t block_rows);

  std::uint64_t rows() const { return status_.size(); }
  std::uint32_t outputs() const { return outputs_; }
  std::uint32_t block_rows() const { return block_rows_; }
  std::uint64_t blocks() const { return seconds_.size(); }
  std::uint32_t rows_of_block(std::uint64_t block) const;
  bool has_block(std::uint64_t block) const { return status_[block * block_rows_] != row_missing; }

  /// The first row that was known with other content (status, bits of the outputs, sentence), if any: then
  /// nothing is stored. Throws JournalError (damaged) for a block that cannot be one of this table.
  std::optional<std::uint64_t> insert(const RowBlock&);

  /// Forgets rows past `rows`: where a stop rule ended the study. `rows` must end a block or the table.
  void keep_first(std::uint64_t rows);

  std::span<const std::uint8_t> status() const { return status_; }
  std::span<const double> values() const { return values_; } ///< rows × outputs
  double value(std::uint64_t row, std::uint32_t output) const { return values_[row * outputs_ + output]; }
  const std::map<std::uint64_t, std::string>& messages() const { return messages_; }
  std::span<const double> block_seconds() const { return seconds_; }

  std::uint64_t done() const; ///< rows that are there, failed ones included
  std::uint64_t failed() const;
  /// Values of one output over the rows that are ok, in index order.
  std::vector<double> column(std::uint32_t output) const;

private:
  std::optional<std::uint64_t> contradiction(const RowBlock&) const;
  std::uint32_t outputs_, block_rows_;
  std::vector<std::uint8_t> status_;
  std::vector<double> values_;
  std::vector<double> seconds_;
  std::map<std::uint64_t, std::string> messages_;
};

} // namespace strainwave
