#include "strainwave/studies/commands/status.hpp"

#include "strainwave/common/files/content_hash.hpp"
#include "strainwave/common/rows/merge.hpp"
#include "strainwave/studies/commands/kinds.hpp"
#include "strainwave/studies/search/journal.hpp"
#include "strainwave/studies/tables/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace strainwave {

namespace {

/// A writer holds the lock as long as it lives.
bool is_locked(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    return false;
  const bool locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;
  ::close(descriptor);
  return locked;
}

class StatusReader {
public:
  StatusReader(const std::filesystem::path& folder, StudyStatus& status) : folder_(folder), status_(status) {}

  void read() {
    if (!std::filesystem::exists(folder_ / "shards"))
      return;
    for (const auto& path : shard_journals(folder_))
      read_journal(path);
    if (!table_)
      return;
    status_.rows = table_->rows();
    status_.done = table_->done();
    status_.failed = table_->failed();
    status_.missing = missing_sentence(*table_, shards_);
  }

private:
  void read_journal(const std::filesystem::path& path) {
    JournalStatus journal;
    journal.file = path.filename().string();
    journal.running = is_locked(path);
    const std::uint64_t plan = plan_hash(status_.study);
    RowBlock block;
    SearchJournalCounts points;
    try {
      const JournalScan scan = scan_journal(
          path.string(),
          [&](RecordKind kind, std::span<const std::byte> payload) {
            if (kind == RecordKind::point)
              return count_point(payload, points);
            decode_block(payload, block);
            journal.done += block.rows;
            for (const std::uint8_t s : block.status)
              journal.failed += s != row_ok ? 1 : 0;
            if (table_->insert(block))
              throw JournalError(JournalFault::contradiction,
                                 "holds rows that another journal answers differently");
          },
          [&](const JournalHeader& header) {
            if (header.plan_hash != plan)
              throw JournalError(JournalFault::other_plan, "is the journal of another plan");
            journal.shard = header.shard;
            journal.shards = header.shards;
            shards_ = std::max(shards_, header.shards);
            if (header.rows == 0)
              return;
            if (!table_)
              table_.emplace(header.rows, header.outputs, header.block_rows);
            const std::uint64_t blocks = table_->blocks();
            for (std::uint64_t b = header.shard; b < blocks; b += header.shards)
              journal.rows += table_->rows_of_block(b);
          });
      if (!journal.running)
        journal.note = scan.damage;
    } catch (const JournalError& error) {
      journal.note = error.what();
    }
    journal.done += points.points;
    journal.failed += points.failed;
    status_.done += points.points;
    status_.failed += points.failed;
    status_.journals.push_back(std::move(journal));
  }

  const std::filesystem::path& folder_;
  StudyStatus& status_;
  std::optional<RowTable> table_;
  std::uint32_t shards_ = 1;
};

} // namespace

StudyStatus study_status(const std::filesystem::path& folder) {
  StudyStatus status;
  status.study = read_plan(folder, study_kinds());
  StatusReader(folder, status).read();
  status.has_results = std::filesystem::exists(folder / "results.h5");
  if (!row_kind(status.study) && status.has_results)
    status.verdict = known_verdict(folder);
  return status;
}

} // namespace strainwave
