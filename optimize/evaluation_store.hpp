#pragma once
// Every point once. A method that asks again for a point it has had (objective and constraints separately, a
// restart, two searches that meet) is served from memory; the key is the exact bits of the inputs, with −0 as
// 0. Two threads that ask for the same point at the same time get one evaluation.

#include "optimize/evaluator.hpp"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace strainwave {

struct EvaluationCounts {
  std::size_t done = 0;   ///< evaluations made, failed ones included
  std::size_t reused = 0; ///< answers out of the store
  std::size_t failed = 0; ///< of those made
};

struct StoredPoint {
  std::vector<double> x;
  std::shared_ptr<const Evaluation> evaluation;
  double seconds = 0.0;
};

class EvaluationStore : public Evaluator {
public:
  /// `inner` is called from the threads that call evaluate() and has to outlive the store.
  explicit EvaluationStore(Evaluator& inner) : inner_(inner) {}

  std::span<const Response> responses() const override { return inner_.responses(); }
  /// An exception of the inner evaluator reaches the thread that made the evaluation; others that wait try
  /// again.
  Evaluation evaluate(std::span<const double> x) override;
  std::optional<std::size_t> pieces_of() const override { return inner_.pieces_of(); }
  std::vector<double> piece_gradient(std::span<const double> x) override { return inner_.piece_gradient(x); }
  std::vector<double> gradient(std::span<const double> x) override { return inner_.gradient(x); }

  EvaluationCounts counts() const;
  /// The largest residuals of all evaluations that did not fail.
  Certificate worst_certificate() const;
  /// Every point that was evaluated, in the order in which the evaluations began.
  std::vector<StoredPoint> points() const;

private:
  struct Entry {
    std::vector<double> x;
    std::shared_ptr<const Evaluation> result; ///< null while it is under way
    double seconds = 0.0;
  };

  Evaluator& inner_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::unordered_map<std::string, std::shared_ptr<Entry>> entries_;
  std::vector<std::shared_ptr<Entry>> order_;
  EvaluationCounts counts_;
};

} // namespace strainwave
