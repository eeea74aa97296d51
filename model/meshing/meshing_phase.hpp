#pragma once
// Where in one pitch the teeth stand: position `index` of `count` equidistant ones.

#include <compare>

namespace strainwave {

struct MeshingPhase {
  int index = 0; ///< 0 … count − 1
  int count = 1;

  /// s = index / count ∈ [0, 1), in pitches.
  double value() const { return static_cast<double>(index) / count; }
  bool at_zero() const { return index == 0; }
  /// The phase 1 − s of the other side's mirror image φ → −φ; that of 0 is 0.
  MeshingPhase mirrored() const { return {index == 0 ? 0 : count - index, count}; }

  /// By place: 1 of 2 is 2 of 4.
  friend std::weak_ordering operator<=>(const MeshingPhase& a, const MeshingPhase& b) {
    return static_cast<long long>(a.index) * b.count <=> static_cast<long long>(b.index) * a.count;
  }
  friend bool operator==(const MeshingPhase& a, const MeshingPhase& b) { return (a <=> b) == 0; }
};

} // namespace strainwave
