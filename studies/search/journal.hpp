#pragma once
// The lasting store of a search: every evaluation and every gradient in a journal, answered again when the
// search is run again from its start. A key is the exact bits of the inputs together with the hash of the
// plan and of the model.
//
// A record (RecordKind::point) is: what it holds, x, seconds, then an evaluation or a list of slopes. Records
// of one point complete each other: its value is served wherever it was written with or without slopes.

#include "strainwave/common/rows/journal_writer.hpp"
#include "strainwave/optimize/problem/evaluation_store.hpp"

#include <filesystem>

namespace strainwave {

void encode_point(const PointNews& news, std::vector<std::byte>& bytes);
/// Throws JournalError (damaged) if lengths contradict each other.
void decode_point(std::span<const std::byte> bytes, const std::function<void(const PointNews&)>& use);

class SearchJournal {
public:
  /// Fills `store` with what is known and listens to it from then on; it has to live as long as the store is
  /// asked. Throws JournalError, std::system_error.
  SearchJournal(const std::filesystem::path& path, std::uint64_t plan_hash, std::uint64_t model_hash,
                EvaluationStore& store);
  ~SearchJournal();
  SearchJournal(const SearchJournal&) = delete;
  SearchJournal& operator=(const SearchJournal&) = delete;

  const std::string& damage() const { return writer_.found().damage; } ///< a tail that was cut; empty: none
  void sync() { writer_.sync(); }                                      ///< throws std::system_error

private:
  EvaluationStore& store_;
  JournalWriter writer_;
};

/// Points of a search's journal: for `study status`.
struct SearchJournalCounts {
  std::uint64_t points = 0, failed = 0;
};
void count_point(std::span<const std::byte> bytes, SearchJournalCounts& counts);

} // namespace strainwave
