#pragma once
// Memory of a stage by the content of its input: the exact bits that the stage reads, and nothing else, are
// the key. So a stage cannot run again for a change that it does not see, and cannot be reused for one that
// it does.

#include <cstring>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace strainwave {

/// Exact bits of numbers and texts, in order; −0 counts as 0.
class ContentKey {
public:
  ContentKey& add(double value) {
    if (value == 0.0)
      value = 0.0;
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    bits_.append(bytes, sizeof value);
    return *this;
  }
  ContentKey& add(std::string_view text) {
    add(static_cast<double>(text.size()));
    bits_.append(text);
    return *this;
  }
  const std::string& bits() const { return bits_; }

private:
  std::string bits_;
};

/// The last `capacity` values, least recently used first out. get() runs `compute` under the memory's lock,
/// so that two threads never compute one value twice.
template <class Value>
class StageMemory {
public:
  explicit StageMemory(std::size_t capacity) : capacity_(capacity) {}

  template <class Compute>
  std::pair<std::shared_ptr<const Value>, bool> get(const ContentKey& key, Compute&& compute) {
    const std::lock_guard lock(mutex_);
    if (const auto found = index_.find(key.bits()); found != index_.end()) {
      order_.splice(order_.begin(), order_, found->second);
      return {found->second->second, true};
    }
    std::shared_ptr<const Value> value = std::forward<Compute>(compute)();
    order_.emplace_front(key.bits(), value);
    index_[key.bits()] = order_.begin();
    if (order_.size() > capacity_) {
      index_.erase(order_.back().first);
      order_.pop_back();
    }
    return {std::move(value), false};
  }

private:
  using Entry = std::pair<std::string, std::shared_ptr<const Value>>;
  std::size_t capacity_;
  std::mutex mutex_;
  std::list<Entry> order_;
  std::unordered_map<std::string, typename std::list<Entry>::iterator> index_;
};

} // namespace strainwave
