#include "optimize/evaluation_store.hpp"

#include "model/forward/stage_memory.hpp"

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
  visit([&](std::span<const double>, const Evaluation& evaluation) {
    if (evaluation.ok)
      take_worse(worst, evaluation.certificate);
  });
  return worst;
}

void EvaluationStore::visit(
    const std::function<void(std::span<const double> x, const Evaluation&)>& visit) const {
  const std::lock_guard lock(mutex_);
  for (const auto& entry : order_) {
    if (entry->result)
      visit(entry->x, *entry->result);
  }
}

} // namespace strainwave
