#pragma once
// What the analyses of a ForwardModel share: the values of stages by the content of their inputs. Any number
// of threads; who asks first computes, the others wait for that value alone (memo.hpp).

#include "strainwave/common/threads/memo.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/forward/stages.hpp"

#include <mutex>

namespace strainwave {

/// A stage's value, or why there is none.
template <class T>
struct Shared {
  Outcome<std::shared_ptr<const T>> value;
  bool reused = false; ///< from memory, or from disk
};

class SharedStages {
public:
  explicit SharedStages(ForwardOptions options) : options_(options) {}

  Shared<NeutralCurve> curve(const StageInput& input);
  /// Reads and writes the store on disk as the options say; its warnings go to who computes.
  Shared<UnitResponses> responses(const StageInput& input, std::vector<std::string>& warnings);
  std::shared_ptr<const Ring> ring(const StageInput& input, std::shared_ptr<const UnitResponses> responses,
                                   bool fold);
  Shared<AssembledState> assembly(const StageInput& input, const RingCompliance& ring,
                                  const NeutralCurve& curve, double disc_shift_mm, MeshingPhase phase);

private:
  ForwardOptions options_;
  std::mutex one_cup_; ///< the finite elements use all threads by themselves, and much memory
  Memo<ContentKey, Outcome<NeutralCurve>> curves_{64};
  Memo<ContentKey, Outcome<UnitResponses>> responses_{8};
  Memo<ContentKey, Ring> rings_{8};
  Memo<ContentKey, Outcome<AssembledState>> assemblies_{64};
};

} // namespace strainwave
