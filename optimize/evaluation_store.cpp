#include "optimize/evaluation_store.hpp"

#include "model/forward/stage_memory.hpp"

#include <chrono>

namespace strainwave {

Evaluation EvaluationStore::evaluate(std::span<const double> x) {
  ContentKey key;
  for (const double value : x)
    key.add(value);
  std::unique_lock lock(mutex_);
  while (true) {
    const auto found = entries_.find(key.bits());
    if (found == entries_.end())
      break;
    if (const auto result = found->second->result) {
      ++counts_.reused;
      return *result;
    }
    arrived_.wait(lock);
  }
  const auto entry = std::make_shared<Entry>();
  entry->x.assign(x.begin(), x.end());
  entries_.emplace(key.bits(), entry);
  order_.push_back(entry);
  lock.unlock();
  std::shared_ptr<const Evaluation> result;
  const auto start = std::chrono::steady_clock::now();
  try {
    result = std::make_shared<const Evaluation>(inner_.evaluate(x));
  } catch (...) {
    lock.lock();
    entries_.erase(key.bits());
    std::erase(order_, entry);
    arrived_.notify_all();
    throw;
  }
  lock.lock();
  entry->result = result;
  entry->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++counts_.done;
  if (!result->ok)
    ++counts_.failed;
  arrived_.notify_all();
  return *result;
}

EvaluationCounts EvaluationStore::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

Certificate EvaluationStore::worst_certificate() const {
  Certificate worst;
  for (const StoredPoint& point : points()) {
    if (point.evaluation->ok)
      take_worse(worst, point.evaluation->certificate);
  }
  return worst;
}

std::vector<StoredPoint> EvaluationStore::points() const {
  const std::lock_guard lock(mutex_);
  std::vector<StoredPoint> all;
  for (const auto& entry : order_) {
    if (entry->result)
      all.push_back({entry->x, entry->result, entry->seconds});
  }
  return all;
}

} // namespace strainwave
