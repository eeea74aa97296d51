#pragma once
// Design in, all responses out: the only thing that searches and studies know of a gear. One evaluation gives
// every response at a point at once, however many of them a method asks for, and in whatever order.
//
// An evaluation that fails is an answer, not an exception: status and sentence say why, and there are no
// values. What is thrown is no property of the design (memory, disk, our own bug) and ends the study.

#include "strainwave/model/results/response.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace strainwave {

struct Evaluation {
  bool ok = false;
  std::string status;         ///< "ok", or the name of what went wrong
  std::string message;        ///< one sentence; empty when ok
  std::vector<double> values; ///< by response; NaN for what the loads do not give; empty unless ok
  std::vector<double> pieces; ///< of one response, which is the largest of them; see Evaluator::pieces_of()
  Certificate certificate;    ///< of the forward model; all zero for evaluators without one
};

/// Residual by residual, the worse one.
void take_worse(Certificate& all, const Certificate& one);

class Evaluator {
public:
  virtual ~Evaluator() = default;
  virtual std::span<const Response> responses() const = 0;
  /// x in the units of the design's keys. Thread-safe; the same bits for the same x, whatever was asked
  /// before.
  virtual Evaluation evaluate(std::span<const double> x) = 0;
  /// ∂value/∂x, response by response, variables inside: [r · n + i]. Empty where no exact gradient is known;
  /// the caller then takes differences.
  virtual std::vector<double> gradient(std::span<const double> x) {
    (void)x;
    return {};
  }
  /// The response that is the largest of smooth pieces (tooth forces), whose kinks are therefore known. The
  /// pieces of all evaluations stand in the same order.
  virtual std::optional<std::size_t> pieces_of() const { return std::nullopt; }
  /// ∂piece/∂x, piece by piece, like gradient().
  virtual std::vector<double> piece_gradient(std::span<const double> x) {
    (void)x;
    return {};
  }
};

} // namespace strainwave
