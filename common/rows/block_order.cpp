#include "strainwave/common/rows/block_order.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace strainwave {

BlockOrder::BlockOrder(const EnginePlan& plan, const EngineOptions& options, const RowModel& model,
                       RowTable& table)
    : plan_(plan), options_(options), model_(model), table_(table), next_block_(plan.shard),
      guard_done_(options.all_fail_guard == 0), end_rows_(plan.rows) {}

bool BlockOrder::advance() {
  while (!ended_ && next_block_ < table_.blocks() && table_.has_block(next_block_)) {
    const std::uint64_t block = next_block_;
    next_block_ += plan_.shards;
    const std::uint64_t first = block * table_.block_rows();
    const std::uint64_t rows = first + table_.rows_of_block(block);
    for (std::uint64_t row = first; row < rows && !guard_done_; ++row) {
      first_rows_.push_back(row);
      guard_done_ = table_.status()[row] == row_ok;
      if (!guard_done_ && first_rows_.size() == options_.all_fail_guard) {
        ended_ = guard_done_ = true;
        end_ = RunEnd::all_failed;
        end_rows_ = rows;
        sentence_ = common_reason();
      }
    }
    if (!ended_ && options_.enough && options_.enough(table_, rows)) {
      ended_ = true;
      end_ = RunEnd::enough;
      end_rows_ = rows;
    }
  }
  if (!ended_ && next_block_ >= table_.blocks())
    ended_ = true;
  return ended_;
}

std::string BlockOrder::common_reason() const {
  std::array<int, 256> count{};
  for (std::uint64_t row : first_rows_)
    ++count[table_.status()[row]];
  const auto most = static_cast<std::uint8_t>(std::ranges::max_element(count) - count.begin());
  std::string example;
  for (std::uint64_t row : first_rows_)
    if (table_.status()[row] == most) {
      if (const auto message = table_.messages().find(row); message != table_.messages().end())
        example = fmt::format("; row {}: {}", row, message->second);
      break;
    }
  return fmt::format("the first {} rows all failed, {} of them with status {}{}", first_rows_.size(),
                     count[most], model_.status_name(most), example);
}

} // namespace strainwave
