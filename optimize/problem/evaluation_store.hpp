#pragma once
// Every point once. A method that asks again for a point it has had (objective and constraints separately, a
// restart, two searches that meet) is served from memory; the key is the exact bits of the inputs, with −0 as
// 0. Two threads that ask for the same point at the same time get one evaluation.
//
// What is known from an earlier run (know()) is answered like what this run has found; what is new is handed
// to a listener, which keeps it (studies/search/journal.hpp). So a search that is run again from its start
// goes on where it was stopped.

#include "strainwave/optimize/problem/evaluator.hpp"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace strainwave {

struct EvaluationCounts {
  std::size_t done = 0;   ///< evaluations made, failed ones included
  std::size_t reused = 0; ///< answers out of the store
  std::size_t failed = 0; ///< of all points, known ones included
  std::size_t known = 0;  ///< points of an earlier run
};

struct StoredPoint {
  std::vector<double> x;
  std::shared_ptr<const Evaluation> evaluation;
  double seconds = 0.0;
};

/// Something new about a point; what is null is not new.
struct PointNews {
  std::span<const double> x;
  const Evaluation* evaluation = nullptr;
  const std::vector<double>* gradient = nullptr;
  const std::vector<double>* piece_gradient = nullptr;
  double seconds = 0.0; ///< of the evaluation
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
  /// Computed once for each point, like values.
  std::vector<double> piece_gradient(std::span<const double> x) override;
  std::vector<double> gradient(std::span<const double> x) override;

  /// Before any search: from an earlier run, as its listener has been told.
  void know(const PointNews& news);
  /// `listener` is called by the threads that evaluate, before anybody is served the answer; what it throws
  /// reaches them.
  void listen(std::function<void(const PointNews&)> listener) { listener_ = std::move(listener); }

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
    std::optional<std::vector<double>> gradient, piece_gradient;
  };

  static std::string key_of(std::span<const double> x);
  std::vector<double> slopes(std::span<const double> x, std::optional<std::vector<double>> Entry::*kept,
                             const std::vector<double>* PointNews::*told,
                             std::vector<double> (Evaluator::*compute)(std::span<const double>));

  Evaluator& inner_;
  std::function<void(const PointNews&)> listener_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::unordered_map<std::string, std::shared_ptr<Entry>> entries_;
  std::vector<std::shared_ptr<Entry>> order_;
  EvaluationCounts counts_;
};

} // namespace strainwave
