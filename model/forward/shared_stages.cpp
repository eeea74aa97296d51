#include "strainwave/model/forward/shared_stages.hpp"

#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/response_store.hpp"

namespace strainwave {

namespace {

/// The value inside what is remembered, which it keeps alive.
template <class T>
Shared<T> shared_value(const typename Memo<ContentKey, Outcome<T>>::Found& found) {
  if (!*found.value)
    return {found.value->failure(), found.reused};
  return {std::shared_ptr<const T>(found.value, &found.value->value()), found.reused};
}

} // namespace

Shared<NeutralCurve> SharedStages::curve(const StageInput& input) {
  return shared_value<NeutralCurve>(curves_.get(input.key, [&] { return neutral_curve(input); }));
}

Shared<UnitResponses> SharedStages::responses(const StageInput& input, std::vector<std::string>& warnings) {
  bool from_disk = false;
  const auto found = responses_.get(input.key, [&]() -> Outcome<UnitResponses> {
    const std::lock_guard alone(one_cup_);
    const ResponseStore store(options_.disk_cache ? cache_folder() : std::filesystem::path(),
                              [&](const std::string& sentence) { warnings.push_back(sentence); });
    auto stored = stored_unit_responses(response_request(input.part), store, options_.threads);
    if (!stored)
      return stored.failure();
    from_disk = stored->reused;
    return std::move(stored).value().responses;
  });
  Shared<UnitResponses> shared = shared_value<UnitResponses>(found);
  shared.reused = shared.reused || from_disk;
  return shared;
}

std::shared_ptr<const Ring> SharedStages::ring(const StageInput& input,
                                               std::shared_ptr<const UnitResponses> responses, bool fold) {
  return rings_.get(input.key, [&] { return ring_of(input, std::move(responses), fold); }).value;
}

Shared<AssembledState> SharedStages::assembly(const StageInput& input, const RingCompliance& ring,
                                              const NeutralCurve& curve, double disc_shift_mm,
                                              MeshingPhase phase) {
  ContentKey key = input.key;
  key.add(disc_shift_mm).add(phase.value());
  return shared_value<AssembledState>(
      assemblies_.get(key, [&] { return assembled_cup(input.part, ring, curve, disc_shift_mm, phase); }));
}

} // namespace strainwave
