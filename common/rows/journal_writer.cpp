#include "strainwave/common/rows/journal_writer.hpp"

#include "strainwave/common/files/whole_file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace strainwave {

namespace {

constexpr int lock_tries = 40;
constexpr std::chrono::milliseconds lock_pause{50};
constexpr std::size_t write_at = 1 << 18; ///< bytes collected before a write in between

[[noreturn]] void throw_errno(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

} // namespace

JournalWriter::JournalWriter(std::string path, const JournalHeader& header, const RecordVisitor& replay,
                             std::chrono::milliseconds sync_every)
    : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw_errno("cannot write " + path_);
  try {
    open_and_replay(header, replay);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
  syncer_ =
      std::jthread([this, sync_every](const std::stop_token& stop) { sync_in_turns(stop, sync_every); });
}

JournalWriter::~JournalWriter() {
  syncer_.request_stop();
  syncer_.join();
  try {
    sync();
  } catch (...) { // the caller who cares has called sync()
  }
  ::close(descriptor_);
}

void JournalWriter::open_and_replay(const JournalHeader& header, const RecordVisitor& replay) {
  // a writer that was killed keeps its lock until the system has put it away
  int tries = 0;
  while (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR || (errno == EWOULDBLOCK && ++tries < lock_tries)) {
      std::this_thread::sleep_for(lock_pause);
      continue;
    }
    if (errno == EWOULDBLOCK)
      throw JournalError(JournalFault::locked,
                         path_ + " is being written by another process; wait for it or stop it");
    throw_errno("cannot lock " + path_);
  }
  found_ = scan_journal(descriptor_, path_, replay,
                        [&](const JournalHeader& found) { demand_same_study(found, header, path_, false); });
  if (::ftruncate(descriptor_, static_cast<off_t>(found_.good_bytes)) != 0 ||
      ::lseek(descriptor_, static_cast<off_t>(found_.good_bytes), SEEK_SET) < 0)
    throw_errno("cannot continue " + path_);
  written_ = found_.good_bytes;
  if (!found_.header) {
    const auto bytes = encode_header(header);
    pending_.assign(bytes.begin(), bytes.end());
    sync();
    sync_folder_of(path_);
  }
}

void JournalWriter::append(RecordKind kind, std::span<const std::byte> payload) {
  const RecordFrame frame = frame_of(kind, payload);
  const auto head = std::as_bytes(std::span(&frame, 1));
  const std::lock_guard lock(mutex_);
  rethrow();
  pending_.insert(pending_.end(), head.begin(), head.end());
  pending_.insert(pending_.end(), payload.begin(), payload.end());
  if (pending_.size() >= write_at) {
    write_pending();
    rethrow();
  }
}

void JournalWriter::sync() {
  {
    const std::lock_guard lock(mutex_);
    write_pending();
  }
  sync_descriptor();
  const std::lock_guard lock(mutex_);
  rethrow();
}

/// Under the lock. A write that fails in the middle is taken back.
void JournalWriter::write_pending() {
  if (error_ || pending_.empty())
    return;
  if (!write_all(descriptor_, pending_)) {
    const int error = errno;
    (void)!::ftruncate(descriptor_, static_cast<off_t>(written_));
    (void)::lseek(descriptor_, static_cast<off_t>(written_), SEEK_SET);
    fail(error, "cannot write ");
    return;
  }
  written_ += pending_.size();
  pending_.clear();
}

/// Without the lock: writers need not wait for the disk.
void JournalWriter::sync_descriptor() {
  if (::fdatasync(descriptor_) != 0) {
    const int error = errno;
    const std::lock_guard lock(mutex_);
    fail(error, "cannot sync ");
  }
}

void JournalWriter::fail(int error, const char* what) {
  if (!error_)
    error_ = std::make_exception_ptr(std::system_error(error, std::generic_category(), what + path_));
}

void JournalWriter::rethrow() const {
  if (error_)
    std::rethrow_exception(error_);
}

void JournalWriter::sync_in_turns(const std::stop_token& stop, std::chrono::milliseconds every) {
  std::unique_lock lock(mutex_);
  std::uint64_t synced = written_;
  while (!stop.stop_requested()) {
    wake_.wait_for(lock, stop, every, [] { return false; });
    write_pending();
    if (written_ == synced || error_)
      continue;
    const std::uint64_t now = written_;
    lock.unlock();
    sync_descriptor();
    lock.lock();
    synced = now;
  }
}

} // namespace strainwave
