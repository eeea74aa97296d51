#include "strainwave/common/rows/row_block.hpp"

#include "strainwave/common/rows/journal_format.hpp"

#include <cstring>

namespace strainwave {

namespace {

struct Head {
  std::uint64_t first;
  std::uint32_t rows, outputs;
  double seconds;
  std::uint32_t messages, reserved;
};
static_assert(sizeof(Head) == 32);

class Putter {
public:
  explicit Putter(std::vector<std::byte>& bytes) : to_(bytes.data()) {}
  void put(const void* from, std::size_t size) {
    if (size > 0)
      std::memcpy(to_, from, size);
    to_ += size;
  }

private:
  std::byte* to_;
};

class Taker {
public:
  explicit Taker(std::span<const std::byte> bytes) : rest_(bytes) {}
  void take(void* to, std::size_t size) {
    if (rest_.size() < size)
      throw JournalError(JournalFault::damaged, "a record of rows is shorter than its own numbers say");
    if (size > 0)
      std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  bool empty() const { return rest_.empty(); }
  std::size_t left() const { return rest_.size(); }

private:
  std::span<const std::byte> rest_;
};

} // namespace

void encode_block(const RowBlock& block, std::vector<std::byte>& bytes) {
  const Head head{block.first,
                  block.rows,
                  block.outputs,
                  block.seconds,
                  static_cast<std::uint32_t>(block.messages.size()),
                  0};
  std::size_t size = sizeof head + block.status.size() + 8 * block.values.size();
  for (const RowMessage& message : block.messages)
    size += 8 + message.text.size();
  bytes.resize(size);
  Putter putter(bytes);
  putter.put(&head, sizeof head);
  putter.put(block.status.data(), block.status.size());
  putter.put(block.values.data(), 8 * block.values.size());
  for (const RowMessage& message : block.messages) {
    const std::uint32_t numbers[2] = {message.row, static_cast<std::uint32_t>(message.text.size())};
    putter.put(numbers, sizeof numbers);
    putter.put(message.text.data(), message.text.size());
  }
}

void decode_block(std::span<const std::byte> bytes, RowBlock& block) {
  Taker taker(bytes);
  Head head;
  taker.take(&head, sizeof head);
  const std::uint64_t values = std::uint64_t{head.rows} * head.outputs;
  if (head.rows + 8 * values > taker.left())
    throw JournalError(JournalFault::damaged, "a record of rows is shorter than its own numbers say");
  block.first = head.first;
  block.rows = head.rows;
  block.outputs = head.outputs;
  block.seconds = head.seconds;
  block.status.resize(head.rows);
  taker.take(block.status.data(), head.rows);
  block.values.resize(values);
  taker.take(block.values.data(), 8 * values);
  block.messages.clear();
  for (std::uint32_t i = 0; i < head.messages; ++i) {
    std::uint32_t numbers[2];
    taker.take(numbers, sizeof numbers);
    if (numbers[1] > taker.left())
      throw JournalError(JournalFault::damaged, "a record of rows is shorter than its own numbers say");
    std::string text(numbers[1], '\0');
    taker.take(text.data(), text.size());
    block.messages.push_back({numbers[0], std::move(text)});
  }
  if (!taker.empty())
    throw JournalError(JournalFault::damaged, "a record of rows is longer than its own numbers say");
}

} // namespace strainwave
