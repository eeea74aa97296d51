#include "strainwave/studies/search/journal.hpp"

#include <cstring>
#include <type_traits>

namespace strainwave {

namespace {

enum class Holds : std::uint32_t { evaluation = 1, gradient = 2, piece_gradient = 3 };

static_assert(std::is_trivially_copyable_v<Certificate>, "it is kept as its bytes");

class Putter {
public:
  explicit Putter(std::vector<std::byte>& bytes) : bytes_(bytes) { bytes_.clear(); }
  void put(const void* from, std::size_t size) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + size);
    if (size > 0)
      std::memcpy(bytes_.data() + at, from, size);
  }
  void put(std::uint32_t number) { put(&number, sizeof number); }
  void put(std::span<const double> numbers) {
    put(static_cast<std::uint32_t>(numbers.size()));
    put(numbers.data(), numbers.size_bytes());
  }
  void put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size()));
    put(text.data(), text.size());
  }

private:
  std::vector<std::byte>& bytes_;
};

class Taker {
public:
  explicit Taker(std::span<const std::byte> bytes) : rest_(bytes) {}
  void take(void* to, std::size_t size) {
    if (size > rest_.size())
      throw JournalError(JournalFault::damaged, "a record of a point is shorter than its own numbers say");
    if (size > 0)
      std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::uint32_t number() {
    std::uint32_t n = 0;
    take(&n, sizeof n);
    return n;
  }
  std::vector<double> numbers() {
    const std::uint32_t n = number();
    if (std::size_t{n} * sizeof(double) > rest_.size())
      throw JournalError(JournalFault::damaged, "a record of a point is shorter than its own numbers say");
    std::vector<double> all(n);
    take(all.data(), n * sizeof(double));
    return all;
  }
  std::string text() {
    const std::uint32_t n = number();
    if (n > rest_.size())
      throw JournalError(JournalFault::damaged, "a record of a point is shorter than its own numbers say");
    std::string all(n, '\0');
    take(all.data(), n);
    return all;
  }

private:
  std::span<const std::byte> rest_;
};

JournalHeader header_of(std::uint64_t plan_hash, std::uint64_t model_hash, std::size_t outputs) {
  JournalHeader header;
  header.plan_hash = plan_hash;
  header.model_hash = model_hash;
  header.outputs = static_cast<std::uint32_t>(outputs);
  header.block_rows = 1;
  return header;
}

} // namespace

void encode_point(const PointNews& news, std::vector<std::byte>& bytes) {
  Putter to(bytes);
  const Holds holds = news.evaluation ? Holds::evaluation
                      : news.gradient ? Holds::gradient
                                      : Holds::piece_gradient;
  to.put(static_cast<std::uint32_t>(holds));
  to.put(news.x);
  to.put(&news.seconds, sizeof news.seconds);
  if (news.evaluation) {
    const Evaluation& e = *news.evaluation;
    to.put(static_cast<std::uint32_t>(e.ok));
    to.put(e.status);
    to.put(e.message);
    to.put(std::span(e.values));
    to.put(std::span(e.pieces));
    to.put(&e.certificate, sizeof e.certificate);
  } else {
    to.put(std::span(news.gradient ? *news.gradient : *news.piece_gradient));
  }
}

void decode_point(std::span<const std::byte> bytes, const std::function<void(const PointNews&)>& use) {
  Taker from(bytes);
  const auto holds = static_cast<Holds>(from.number());
  const std::vector<double> x = from.numbers();
  PointNews news{.x = x};
  from.take(&news.seconds, sizeof news.seconds);
  Evaluation e;
  std::vector<double> slopes;
  switch (holds) {
  case Holds::evaluation:
    e.ok = from.number() != 0;
    e.status = from.text();
    e.message = from.text();
    e.values = from.numbers();
    e.pieces = from.numbers();
    from.take(&e.certificate, sizeof e.certificate);
    news.evaluation = &e;
    break;
  case Holds::gradient:
    slopes = from.numbers();
    news.gradient = &slopes;
    break;
  case Holds::piece_gradient:
    slopes = from.numbers();
    news.piece_gradient = &slopes;
    break;
  default:
    return; // of a later version
  }
  use(news);
}

SearchJournal::SearchJournal(const std::filesystem::path& path, std::uint64_t plan_hash,
                             std::uint64_t model_hash, EvaluationStore& store)
    : store_(store), writer_(path.string(), header_of(plan_hash, model_hash, store.responses().size()),
                             [&](RecordKind kind, std::span<const std::byte> payload) {
                               if (kind == RecordKind::point)
                                 decode_point(payload, [&](const PointNews& news) { store.know(news); });
                             }) {
  store_.listen([this](const PointNews& news) {
    std::vector<std::byte> bytes;
    encode_point(news, bytes);
    writer_.append(RecordKind::point, bytes);
  });
}

SearchJournal::~SearchJournal() {
  store_.listen({});
}

void count_point(std::span<const std::byte> bytes, SearchJournalCounts& counts) {
  decode_point(bytes, [&](const PointNews& news) {
    counts.points += news.evaluation ? 1 : 0;
    counts.failed += news.evaluation && !news.evaluation->ok ? 1 : 0;
  });
}

} // namespace strainwave
