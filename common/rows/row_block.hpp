#pragma once
// The record of a block of evaluated rows: RecordKind::rows.
//
//     first row | rows | outputs | seconds | failures | 0 | status of every row (bytes) | outputs, row by row
//     | for each failure with a sentence: row within the block, length, text
//
// Blocks make a record cost nothing per row. Outputs of failed rows are stored as zero and mean nothing.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

inline constexpr std::uint8_t row_ok = 0; ///< other values: the model's own reasons
inline constexpr std::uint8_t row_missing = 255;

struct RowMessage {
  std::uint32_t row = 0; ///< within the block
  std::string text;
};

struct RowBlock {
  std::uint64_t first = 0;
  std::uint32_t rows = 0;
  std::uint32_t outputs = 0;
  double seconds = 0.0; ///< of the evaluation, one thread
  std::vector<std::uint8_t> status = {};
  std::vector<double> values = {}; ///< rows × outputs
  std::vector<RowMessage> messages = {};
};

/// Replaces `bytes`.
void encode_block(const RowBlock&, std::vector<std::byte>& bytes);
/// Into `block`, whose memory is used again. Throws JournalError (damaged) if lengths contradict each other.
void decode_block(std::span<const std::byte>, RowBlock& block);

} // namespace strainwave
