#pragma once
// The one writer of a journal.
//
// Opening takes the file's lock (released by the system when the process ends, however it ends), replays what
// is there, cuts a torn or corrupted tail and continues behind the last whole record. Records are collected
// and written and synced to the disk once a second by a thread of its own, so a SIGKILL or power cut loses at
// most that second. After an error (disk full, device gone) the file is cut back to its last whole record,
// and every later call throws the same error: nothing is lost but what was not yet synced.
//
//     JournalWriter journal(path, header, [&](RecordKind, auto payload) { … known rows … });
//     journal.append(RecordKind::rows, bytes);      // from any thread
//     journal.sync();                               // returns when everything is on the disk

#include "strainwave/common/rows/journal_reader.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace strainwave {

class JournalWriter {
public:
  /// Creates the file where there is none. Throws JournalError (locked, not_a_journal, damaged, other_…),
  /// std::system_error. A journal that is refused is not touched.
  JournalWriter(std::string path, const JournalHeader&, const RecordVisitor& replay,
                std::chrono::milliseconds sync_every = std::chrono::milliseconds(1000));
  /// Writes what is left; an error here is lost, so call sync() first where it matters.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// What was found on opening; `damage` names a tail that was cut.
  const JournalScan& found() const { return found_; }

  void append(RecordKind, std::span<const std::byte> payload); ///< throws std::system_error
  void sync();                                                 ///< throws std::system_error

private:
  void open_and_replay(const JournalHeader&, const RecordVisitor&);
  void write_pending();
  void sync_descriptor();
  void fail(int error, const char* what);
  void rethrow() const;
  void sync_in_turns(const std::stop_token&, std::chrono::milliseconds);

  std::string path_;
  JournalScan found_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::vector<std::byte> pending_;
  std::uint64_t written_ = 0; ///< bytes of whole records in the file
  std::exception_ptr error_;
  std::condition_variable_any wake_;
  std::jthread syncer_; // last: it uses all of the above
};

} // namespace strainwave
