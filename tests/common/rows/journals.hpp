#pragma once
// Journals to test with: rows whose content is a function of their index, and the folder they are in.

#include "strainwave/common/rows/journal_writer.hpp"
#include "strainwave/common/rows/row_block.hpp"
#include "strainwave/common/rows/row_table.hpp"
#include "tests/support/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <string>

namespace strainwave {

using testing_support::TemporaryFolder;

inline JournalHeader test_header() {
  return {.plan_hash = 0x1234,
          .model_hash = 0x5678,
          .rows = 1000,
          .shard = 0,
          .shards = 1,
          .block_rows = 10,
          .outputs = 2,
          .origin = "test"};
}

/// Rows 10 b … 10 b + 9; every seventh row has failed with a sentence.
inline RowBlock test_block(std::uint64_t b, std::uint32_t rows = 10, std::uint32_t outputs = 2) {
  RowBlock block{.first = b * rows, .rows = rows, .outputs = outputs, .seconds = 0.5};
  for (std::uint32_t i = 0; i < rows; ++i) {
    const std::uint64_t row = block.first + i;
    const bool bad = row % 7 == 3;
    block.status.push_back(bad ? 2 : 0);
    for (std::uint32_t j = 0; j < outputs; ++j)
      block.values.push_back(bad ? 0.0 : static_cast<double>(row) / (j + 3.0));
    if (bad)
      block.messages.push_back({i, "row " + std::to_string(row) + " has no wrap angle"});
  }
  return block;
}

inline void append_block(JournalWriter& journal, const RowBlock& block) {
  std::vector<std::byte> bytes;
  encode_block(block, bytes);
  journal.append(RecordKind::rows, bytes);
}

inline RecordVisitor ignore_records() {
  return [](RecordKind, std::span<const std::byte>) {};
}

inline void write_journal(const std::string& path, const JournalHeader& header, std::uint64_t from,
                          std::uint64_t to) {
  JournalWriter journal(path, header, ignore_records());
  for (std::uint64_t b = from; b < to; ++b)
    if (b % header.shards == header.shard)
      append_block(journal, test_block(b));
  journal.sync();
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// What a call throws as JournalError; fails the test if it throws nothing.
template <class Call>
std::pair<JournalFault, std::string> refusal(Call&& call) {
  try {
    call();
  } catch (const JournalError& error) {
    return {error.fault, error.what()};
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

} // namespace strainwave
