#include "strainwave/common/rows/journal_reader.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace strainwave {

namespace {

/// Bytes of a file in order, with a look ahead of any length.
class ByteStream {
public:
  ByteStream(int descriptor, const std::string& path)
      : descriptor_(descriptor), path_(path), buffer_(1 << 20) {}

  /// The next n bytes, or fewer at the end of the file. Valid until the next call.
  std::span<const std::byte> peek(std::size_t n) {
    if (filled_ - start_ < n)
      fill(n);
    return {buffer_.data() + start_, std::min(n, filled_ - start_)};
  }
  void skip(std::size_t n) {
    start_ += n;
    offset_ += n;
  }
  std::uint64_t offset() const { return offset_; }
  std::uint64_t read_so_far() const { return offset_ + (filled_ - start_); }

private:
  void fill(std::size_t n) {
    std::memmove(buffer_.data(), buffer_.data() + start_, filled_ - start_);
    filled_ -= start_;
    start_ = 0;
    if (buffer_.size() < n)
      buffer_.resize(n);
    while (filled_ < n) {
      const ssize_t got = ::read(descriptor_, buffer_.data() + filled_, buffer_.size() - filled_);
      if (got < 0 && errno == EINTR)
        continue;
      if (got < 0)
        throw std::system_error(errno, std::generic_category(), "cannot read " + path_);
      if (got == 0)
        return;
      filled_ += static_cast<std::size_t>(got);
    }
  }

  int descriptor_;
  const std::string& path_;
  std::vector<std::byte> buffer_;
  std::size_t start_ = 0, filled_ = 0;
  std::uint64_t offset_ = 0;
};

/// Frame and payload as they stand next; a sentence if they are not whole.
std::string next_record(ByteStream& stream, RecordFrame& frame, std::span<const std::byte>& payload) {
  const auto head = stream.peek(frame_bytes);
  if (head.size() < frame_bytes)
    return "the last record is torn";
  std::memcpy(&frame, head.data(), frame_bytes);
  if (!plausible(frame))
    return "what follows is no record";
  const auto whole = stream.peek(frame_bytes + frame.length);
  if (whole.size() < frame_bytes + frame.length)
    return "the last record is torn";
  payload = whole.subspan(frame_bytes);
  return matches(frame, payload) ? std::string{} : "a record fails its checksum";
}

} // namespace

JournalScan scan_journal(int descriptor, const std::string& path, const RecordVisitor& visit,
                         const HeaderVisitor& on_header) {
  ByteStream stream(descriptor, path);
  JournalScan scan;
  const auto head = stream.peek(header_bytes);
  if (head.size() < header_bytes) {
    if (!starts_header(head))
      throw JournalError(JournalFault::not_a_journal,
                         path + " is no journal of a study; it is left as it is");
    scan.file_bytes = head.size();
    if (!head.empty())
      scan.damage = fmt::format("{}: only {} bytes of a header; nothing was recorded yet", path, head.size());
    return scan;
  }
  scan.header = decode_header(head.first<header_bytes>(), path);
  if (on_header)
    on_header(*scan.header);
  stream.skip(header_bytes);
  std::string fault;
  while (!stream.peek(1).empty()) {
    RecordFrame frame;
    std::span<const std::byte> payload;
    fault = next_record(stream, frame, payload);
    if (!fault.empty())
      break;
    visit(static_cast<RecordKind>(frame.kind), payload);
    ++scan.records;
    stream.skip(frame_bytes + frame.length);
  }
  scan.good_bytes = stream.offset();
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  scan.file_bytes = end < 0 ? stream.read_so_far() : static_cast<std::uint64_t>(end);
  if (!fault.empty())
    scan.damage = fmt::format("{}: {} after {} records; {} bytes from byte {} on do not count", path, fault,
                              scan.records, scan.file_bytes - scan.good_bytes, scan.good_bytes);
  return scan;
}

JournalScan scan_journal(const std::string& path, const RecordVisitor& visit,
                         const HeaderVisitor& on_header) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    throw std::system_error(errno, std::generic_category(), "cannot read " + path);
  try {
    JournalScan scan = scan_journal(descriptor, path, visit, on_header);
    ::close(descriptor);
    return scan;
  } catch (...) {
    ::close(descriptor);
    throw;
  }
}

} // namespace strainwave
