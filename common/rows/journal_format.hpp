#pragma once
// Bytes of a journal: a header of 128 bytes, then records.
//
//     header   "swjournl" | version | byte order | plan hash | model hash | rows | shard | shards
//              | block rows | outputs | origin (who wrote it, 64 bytes of text) | CRC32 of all before it
//     record   length of the payload | kind | CRC32 of (length, kind, payload) | mark | payload
//
// Everything is little-endian. A record counts only as a whole: the first one that is cut short or fails its
// checksum ends the journal. CRC32 is zlib's (IEEE 802.3).

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace strainwave {

struct JournalHeader {
  std::uint64_t plan_hash = 0;
  std::uint64_t model_hash = 0;
  std::uint64_t rows = 0;  ///< of the whole study; 0: not known beforehand (searches)
  std::uint32_t shard = 0; ///< 0 … shards − 1; owns blocks b with b % shards == shard
  std::uint32_t shards = 1;
  std::uint32_t block_rows = 0; ///< rows are evaluated and recorded in blocks of this many
  std::uint32_t outputs = 0;
  std::string origin; ///< binary and processor, at most 63 bytes; no reason to refuse, but merge names it

  bool operator==(const JournalHeader&) const = default;
};

enum class RecordKind : std::uint32_t {
  rows = 1, ///< a block of evaluated rows (row_block.hpp)
  point = 2 ///< one evaluation of a search: its own bytes
};

/// Why a journal is refused.
enum class JournalFault {
  locked,        ///< another process writes it
  not_a_journal, ///< the file is something else; it is left alone
  damaged,       ///< the header fails its checksum, or a whole record contradicts the header
  other_plan,
  other_model,
  other_shape,  ///< same plan and model, but another shard, block size or number of outputs
  gaps,         ///< rows are missing (merge)
  contradiction ///< the same row twice with different content (merge)
};

struct JournalError : std::runtime_error {
  JournalError(JournalFault f, const std::string& sentence) : std::runtime_error(sentence), fault(f) {}
  JournalFault fault;
};

inline constexpr std::size_t header_bytes = 128;
inline constexpr std::size_t frame_bytes = 16;
inline constexpr std::uint32_t largest_payload = 1U << 30;

std::array<std::byte, header_bytes> encode_header(const JournalHeader&);
/// Throws JournalError (not_a_journal, damaged); `path` is for the message.
JournalHeader decode_header(std::span<const std::byte, header_bytes>, const std::string& path);
/// Are these the first bytes of some header? True for none at all: a writer was killed before it had written
/// one.
bool starts_header(std::span<const std::byte>);

struct RecordFrame {
  std::uint32_t length, kind, crc, mark;
};
RecordFrame frame_of(RecordKind, std::span<const std::byte> payload);
/// Could these 16 bytes start a record?
bool plausible(const RecordFrame&);
bool matches(const RecordFrame&, std::span<const std::byte> payload);

/// Throws JournalError naming the first difference that matters; shards may differ where `any_shard`.
void demand_same_study(const JournalHeader& found, const JournalHeader& wanted, const std::string& path,
                       bool any_shard);

} // namespace strainwave
