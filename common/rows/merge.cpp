#include "strainwave/common/rows/merge.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>

namespace strainwave {

namespace {

class Merger {
public:
  explicit Merger(const std::vector<std::filesystem::path>& journals) : journals_(journals) {}

  void add(std::uint32_t number) {
    const std::string path = journals_[number].string();
    const JournalScan scan = scan_journal(
        path,
        [&](RecordKind kind, std::span<const std::byte> payload) {
          if (kind == RecordKind::rows)
            add_block(payload, number);
        },
        [&](const JournalHeader& header) { add_header(header, path); });
    if (!scan.damage.empty())
      notes_.push_back(scan.damage);
  }

  Merged finish(bool allow_missing) && {
    if (!merged_)
      throw std::invalid_argument("none of the journals has a header yet; run the study first");
    merged_->notes = std::move(notes_);
    merged_->missing_rows = merged_->table.rows() - merged_->table.done();
    if (merged_->missing_rows > 0 && !allow_missing)
      throw JournalError(JournalFault::gaps, missing_sentence(merged_->table, shards_));
    return std::move(*merged_);
  }

private:
  void add_header(const JournalHeader& header, const std::string& path) {
    shards_ = std::max(shards_, header.shards);
    if (!merged_) {
      merged_.emplace(Merged{header, RowTable(header.rows, header.outputs, header.block_rows), 0, {}});
      origin_.resize(merged_->table.blocks());
      first_path_ = path;
      return;
    }
    demand_same_study(header, merged_->header, path, true);
    if (header.origin != merged_->header.origin)
      notes_.push_back(fmt::format("{} was written by \"{}\", {} by \"{}\": equal bits are not promised",
                                   path, header.origin, first_path_, merged_->header.origin));
  }

  void add_block(std::span<const std::byte> payload, std::uint32_t number) {
    RowTable& table = merged_->table;
    decode_block(payload, block_);
    const std::uint64_t at = block_.first / table.block_rows();
    const bool known = at < table.blocks() && table.has_block(at);
    if (const auto row = table.insert(block_))
      throw JournalError(
          JournalFault::contradiction,
          fmt::format("row {} differs between {} and {}: they were not made by one binary on one kind of "
                      "processor; run one of them again",
                      *row, journals_[origin_[at]].string(), journals_[number].string()));
    if (!known)
      origin_[at] = number;
  }

  const std::vector<std::filesystem::path>& journals_;
  std::optional<Merged> merged_;
  std::vector<std::uint32_t> origin_; ///< journal that a block came from
  std::vector<std::string> notes_;
  std::string first_path_;
  std::uint32_t shards_ = 1;
  RowBlock block_;
};

} // namespace

Merged merge_journals(const std::vector<std::filesystem::path>& journals, bool allow_missing) {
  Merger merger(journals);
  for (std::uint32_t i = 0; i < journals.size(); ++i)
    merger.add(i);
  return std::move(merger).finish(allow_missing);
}

std::vector<std::filesystem::path> shard_journals(const std::filesystem::path& study_folder) {
  std::vector<std::filesystem::path> journals;
  for (const auto& entry : std::filesystem::directory_iterator(study_folder / "shards"))
    if (entry.path().extension() == ".journal")
      journals.push_back(entry.path());
  std::ranges::sort(journals);
  return journals;
}

std::filesystem::path shard_journal(const std::filesystem::path& study_folder, std::uint32_t shard,
                                    std::uint32_t shards) {
  return study_folder / "shards" / fmt::format("{:04}-of-{:04}.journal", shard, shards);
}

std::string missing_sentence(const RowTable& table, std::uint32_t shards) {
  std::vector<std::uint64_t> of_shard(shards, 0);
  std::optional<std::uint64_t> first;
  for (std::uint64_t b = 0; b < table.blocks(); ++b)
    if (!table.has_block(b)) {
      of_shard[b % shards] += table.rows_of_block(b);
      if (!first)
        first = b * table.block_rows();
    }
  if (!first)
    return {};
  std::string sentence =
      fmt::format("{} of {} rows are missing, the first is row {}; run again:", table.rows() - table.done(),
                  table.rows(), *first);
  int named = 0;
  for (std::uint32_t s = 0; s < shards; ++s)
    if (of_shard[s] > 0 && ++named <= 8)
      sentence += fmt::format("{} --shard {}/{} ({} rows)", named > 1 ? "," : "", s, shards, of_shard[s]);
  if (named > 8)
    sentence += fmt::format(" and {} more", named - 8);
  return sentence;
}

} // namespace strainwave
