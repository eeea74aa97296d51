#pragma once
// Memory of a computation by its input, for any number of threads: whoever asks first computes, all others
// wait for that one value and nothing else. The lock is held for looking up, never while computing, so
// different keys are computed at once.
//
//     Memo<ContentKey, NeutralCurve> curves(64);
//     const auto [curve, reused] = curves.get(key, [&] { return neutral_curve(input); });
//
// What cannot be computed is a value (Outcome) and remembered like one. An exception goes to everybody who
// waits for this key and is not remembered: full disks and short memory pass.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace strainwave {

/// The last `capacity` values, least recently asked for first out; those being computed stay. A value lives
/// as long as anybody holds it. Key: ordered by <.
template <class Key, class Value>
class Memo {
public:
  struct Found {
    std::shared_ptr<const Value> value;
    bool reused = false; ///< known, or computed by somebody else
  };

  explicit Memo(std::size_t capacity) : capacity_(capacity) {}

  /// `compute` gives a Value; it may ask other memories, or this one for keys that do not lead back here.
  template <class Compute>
  Found get(const Key& key, Compute&& compute) {
    std::promise<std::shared_ptr<const Value>> mine;
    {
      std::unique_lock lock(mutex_);
      if (const auto found = entries_.find(key); found != entries_.end()) {
        found->second.asked = ++asked_;
        const auto value = found->second.value;
        lock.unlock();
        return {value.get(), true};
      }
      entries_.emplace(key, Entry{mine.get_future().share(), ++asked_});
      drop_oldest();
    }
    try {
      auto value = std::make_shared<const Value>(std::forward<Compute>(compute)());
      mine.set_value(value);
      return {std::move(value), false};
    } catch (...) {
      {
        const std::lock_guard lock(mutex_);
        entries_.erase(key); // nobody drops an entry that is being computed: it is this one
      }
      mine.set_exception(std::current_exception());
      throw;
    }
  }

private:
  struct Entry {
    std::shared_future<std::shared_ptr<const Value>> value;
    std::uint64_t asked = 0;
  };

  void drop_oldest() {
    while (entries_.size() > capacity_) {
      auto oldest = entries_.end();
      for (auto i = entries_.begin(); i != entries_.end(); ++i) {
        const bool ready = i->second.value.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        if (ready && (oldest == entries_.end() || i->second.asked < oldest->second.asked))
          oldest = i;
      }
      if (oldest == entries_.end())
        return;
      entries_.erase(oldest);
    }
  }

  std::size_t capacity_;
  std::mutex mutex_;
  std::uint64_t asked_ = 0;
  std::map<Key, Entry> entries_;
};

} // namespace strainwave
