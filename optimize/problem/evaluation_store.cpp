#include "strainwave/optimize/problem/evaluation_store.hpp"

#include "strainwave/common/threads/content_key.hpp"

#include <chrono>

namespace strainwave {

std::string EvaluationStore::key_of(std::span<const double> x) {
  ContentKey key;
  for (const double value : x)
    key.add(value);
  return key.bits();
}

void EvaluationStore::know(const PointNews& news) {
  const std::lock_guard lock(mutex_);
  auto& entry = entries_[key_of(news.x)];
  if (!entry) {
    entry = std::make_shared<Entry>();
    entry->x.assign(news.x.begin(), news.x.end());
  }
  if (news.evaluation && !entry->result) {
    entry->result = std::make_shared<const Evaluation>(*news.evaluation);
    entry->seconds = news.seconds;
    order_.push_back(entry);
    ++counts_.known;
    if (!news.evaluation->ok)
      ++counts_.failed;
  }
  if (news.gradient)
    entry->gradient = *news.gradient;
  if (news.piece_gradient)
    entry->piece_gradient = *news.piece_gradient;
}

std::vector<double> EvaluationStore::gradient(std::span<const double> x) {
  return slopes(x, &Entry::gradient, &PointNews::gradient, &Evaluator::gradient);
}

std::vector<double> EvaluationStore::piece_gradient(std::span<const double> x) {
  return slopes(x, &Entry::piece_gradient, &PointNews::piece_gradient, &Evaluator::piece_gradient);
}

/// Two threads may compute the same slopes at once: the bits are the same. Empty ones are not kept: there is
/// no gradient.
std::vector<double>
EvaluationStore::slopes(std::span<const double> x, std::optional<std::vector<double>> Entry::*kept,
                        const std::vector<double>* PointNews::*told,
                        std::vector<double> (Evaluator::*compute)(std::span<const double>)) {
  const std::string key = key_of(x);
  {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(key);
    if (found != entries_.end() && (*found->second).*kept)
      return *((*found->second).*kept);
  }
  std::vector<double> found = (inner_.*compute)(x);
  if (found.empty())
    return found;
  if (listener_) {
    PointNews news{.x = x};
    news.*told = &found;
    listener_(news);
  }
  const std::lock_guard lock(mutex_);
  if (const auto entry = entries_.find(key); entry != entries_.end())
    (*entry->second).*kept = found;
  return found;
}

Evaluation EvaluationStore::evaluate(std::span<const double> x) {
  const std::string key = key_of(x);
  std::unique_lock lock(mutex_);
  while (true) {
    const auto found = entries_.find(key);
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
  entries_.emplace(key, entry);
  order_.push_back(entry);
  lock.unlock();
  std::shared_ptr<const Evaluation> result;
  double seconds = 0.0;
  const auto start = std::chrono::steady_clock::now();
  try {
    result = std::make_shared<const Evaluation>(inner_.evaluate(x));
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (listener_)
      listener_({.x = x, .evaluation = result.get(), .seconds = seconds});
  } catch (...) {
    lock.lock();
    entries_.erase(key);
    std::erase(order_, entry);
    arrived_.notify_all();
    throw;
  }
  lock.lock();
  entry->result = result;
  entry->seconds = seconds;
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
