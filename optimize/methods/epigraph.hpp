#pragma once
// The smooth rows behind a search with kinks: the pieces of the objective (or the objective itself, as one
// piece) and the limits, all scaled, with their slopes.

#include "strainwave/optimize/problem/problem.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace strainwave {

struct Rows {
  std::vector<double> value;
  std::vector<double> slope; ///< row by row, coordinates inside: [r · n + i]
};

class Epigraph {
public:
  explicit Epigraph(const Problem& problem) : problem_(problem) {}

  /// The objective is the largest of several pieces; else it is one piece.
  bool has_pieces() const;
  /// Pieces, then limits; nothing if the evaluation failed or a number is none.
  std::optional<std::vector<double>> values(const Evaluation& evaluation) const;
  /// By exact gradients or central differences of all rows at once; nothing where neighbours fail on both
  /// sides.
  std::optional<std::vector<double>>
  slopes(std::span<const double> y, const std::vector<double>& values,
         const std::function<Evaluation(std::span<const double>)>& ask) const;

private:
  std::optional<std::vector<double>> exact_slopes(std::span<const double> y, std::size_t rows) const;

  const Problem& problem_;
};

} // namespace strainwave
