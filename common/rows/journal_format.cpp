#include "strainwave/common/rows/journal_format.hpp"

#include "strainwave/common/files/content_hash.hpp"

#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <zlib.h>

namespace strainwave {

static_assert(std::endian::native == std::endian::little, "journals are little-endian");

namespace {

constexpr char magic[8] = {'s', 'w', 'j', 'o', 'u', 'r', 'n', 'l'};
constexpr std::uint32_t version = 1;
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::uint32_t record_mark = 0x64726f63; // "cord"

struct RawHeader {
  char magic[8];
  std::uint32_t version, byte_order;
  std::uint64_t plan_hash, model_hash, rows;
  std::uint32_t shard, shards, block_rows, outputs;
  char origin[64];
  std::uint32_t reserved, crc;
};
static_assert(sizeof(RawHeader) == header_bytes);

std::uint32_t crc_of(const void* bytes, std::size_t size, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, static_cast<const unsigned char*>(bytes), size));
}

} // namespace

std::array<std::byte, header_bytes> encode_header(const JournalHeader& header) {
  RawHeader raw{};
  std::memcpy(raw.magic, magic, sizeof magic);
  raw.version = version;
  raw.byte_order = byte_order;
  raw.plan_hash = header.plan_hash;
  raw.model_hash = header.model_hash;
  raw.rows = header.rows;
  raw.shard = header.shard;
  raw.shards = header.shards;
  raw.block_rows = header.block_rows;
  raw.outputs = header.outputs;
  std::memcpy(raw.origin, header.origin.data(), std::min(header.origin.size(), sizeof raw.origin - 1));
  raw.crc = crc_of(&raw, offsetof(RawHeader, crc));
  return std::bit_cast<std::array<std::byte, header_bytes>>(raw);
}

JournalHeader decode_header(std::span<const std::byte, header_bytes> bytes, const std::string& path) {
  RawHeader raw;
  std::memcpy(&raw, bytes.data(), sizeof raw);
  if (std::memcmp(raw.magic, magic, sizeof magic) != 0)
    throw JournalError(JournalFault::not_a_journal, path + " is no journal of a study; it is left as it is");
  if (crc_of(&raw, offsetof(RawHeader, crc)) != raw.crc)
    throw JournalError(JournalFault::damaged,
                       path + ": the header is damaged; move the file away and run its shard again");
  if (raw.version != version)
    throw JournalError(JournalFault::not_a_journal,
                       fmt::format("{} is a journal of version {}, this program reads version {}", path,
                                   raw.version, version));
  JournalHeader header{raw.plan_hash, raw.model_hash, raw.rows,    raw.shard,
                       raw.shards,    raw.block_rows, raw.outputs, {}};
  header.origin = raw.origin;
  return header;
}

bool starts_header(std::span<const std::byte> bytes) {
  return bytes.size() < header_bytes &&
         std::memcmp(bytes.data(), magic, std::min(bytes.size(), sizeof magic)) == 0;
}

RecordFrame frame_of(RecordKind kind, std::span<const std::byte> payload) {
  RecordFrame frame{static_cast<std::uint32_t>(payload.size()), static_cast<std::uint32_t>(kind), 0,
                    record_mark};
  frame.crc = crc_of(payload.data(), payload.size(), crc_of(&frame, 8));
  return frame;
}

bool plausible(const RecordFrame& frame) {
  return frame.mark == record_mark && frame.length <= largest_payload;
}

bool matches(const RecordFrame& frame, std::span<const std::byte> payload) {
  return frame.length == payload.size() &&
         frame.crc == crc_of(payload.data(), payload.size(), crc_of(&frame, 8));
}

void demand_same_study(const JournalHeader& found, const JournalHeader& wanted, const std::string& path,
                       bool any_shard) {
  if (found.plan_hash != wanted.plan_hash)
    throw JournalError(JournalFault::other_plan,
                       fmt::format("{} belongs to another plan ({}, this study has {}); take another folder",
                                   path, hash_text(found.plan_hash), hash_text(wanted.plan_hash)));
  if (found.model_hash != wanted.model_hash)
    throw JournalError(
        JournalFault::other_model,
        fmt::format("{} was made by another model ({}, this program has {}); its rows cannot be mixed with "
                    "new ones",
                    path, hash_text(found.model_hash), hash_text(wanted.model_hash)));
  const bool same_shard = found.shard == wanted.shard && found.shards == wanted.shards;
  if (found.rows != wanted.rows || found.outputs != wanted.outputs || found.block_rows != wanted.block_rows ||
      !(any_shard || same_shard))
    throw JournalError(
        JournalFault::other_shape,
        fmt::format(
            "{} holds shard {} of {} with {} rows of {} outputs in blocks of {}; expected shard {} of "
            "{} with {} rows of {} outputs in blocks of {}",
            path, found.shard, found.shards, found.rows, found.outputs, found.block_rows, wanted.shard,
            wanted.shards, wanted.rows, wanted.outputs, wanted.block_rows));
}

} // namespace strainwave
