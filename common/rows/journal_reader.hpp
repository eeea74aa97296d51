#pragma once
// Reading a journal from its beginning: every whole record in turn, and what is wrong with the end, if
// anything. Reading never changes the file; a journal that is being written may be read, its last record is
// then simply not there yet.

#include "strainwave/common/rows/journal_format.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace strainwave {

struct JournalScan {
  std::optional<JournalHeader> header; ///< nothing: a writer was killed before it had written one
  std::uint64_t records = 0;
  std::uint64_t good_bytes = 0; ///< up to the end of the last whole record
  std::uint64_t file_bytes = 0;
  std::string damage; ///< one sentence about the bytes after good_bytes; empty if there are none
};

using RecordVisitor = std::function<void(RecordKind, std::span<const std::byte> payload)>;

using HeaderVisitor = std::function<void(const JournalHeader&)>;

/// `on_header` sees the header before any record, and may throw to refuse the journal. Throws JournalError
/// (not_a_journal, damaged header), std::system_error.
JournalScan scan_journal(const std::string& path, const RecordVisitor&, const HeaderVisitor& on_header = {});

/// The same on an open file; its offset moves.
JournalScan scan_journal(int descriptor, const std::string& path, const RecordVisitor&,
                         const HeaderVisitor& on_header = {});

} // namespace strainwave
