#include "model/forward/forward.hpp"

#include "model/forward/load_cases.hpp"
#include "model/forward/stage_memory.hpp"
#include "model/flexspline/response_store.hpp"
#include "model/flexspline/responses.hpp"
#include "model/gear/fields.hpp"
#include "model/tooth/backlash.hpp"
#include "model/tooth/consistency.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <thread>

namespace strainwave {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Times a stage and notes how it came about.
class StageClock {
public:
  StageClock(ForwardResult& result, std::string name)
      : result_(result), name_(std::move(name)), start_(std::chrono::steady_clock::now()) {}
  void done(StageStatus status) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    result_.stages.push_back({name_, spent.count(), status});
  }

private:
  ForwardResult& result_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
};

ContentKey curve_key(const WaveGenerator& wg, const Flexspline& fs) {
  ContentKey key;
  key.add(static_cast<double>(wg.shape)).add(fs.neutral_radius_mm).add(fs.rim_thickness_mm);
  key.add(wg.max_radial_deformation_mm);
  for (const auto& number : {wg.eccentricity_mm, wg.wrap_angle_deg, wg.force_angle_deg}) {
    key.add(number ? 1.0 : 0.0).add(number.value_or(0.0));
  }
  if (wg.shape == WaveGeneratorShape::table) {
    std::ifstream file(wg.table_file);
    key.add(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  return key;
}

WaveGeneratorResult describe(const NeutralCurve& curve) {
  const CurveSummary& s = curve.summary();
  return {.wrap_angle_deg = s.wrap_angle_rad.value_or(0.0) / degree,
          .disc_radius_mm = s.disc_radius_mm.value_or(0.0),
          .eccentricity_mm = s.eccentricity_mm.value_or(0.0),
          .u90_mm = s.u90_mm,
          .shape = std::string(choice_name(curve.shape()))};
}

/// What this version cannot do, as the status not_available.
std::optional<Failure> find_unavailable(const Gear& gear, Want want) {
  if (want == Want::backlash) return std::nullopt;
  const auto refuse = [](std::string sentence) { return Failure{Status::not_available, std::move(sentence)}; };
  const Contact& c = gear.contact;
  if (c.fidelity == Fidelity::nonlinear || c.assembly == AssemblyModel::nonlinear) {
    return refuse("the nonlinear finite-element check is not in this version; use contact.fidelity = \"unilateral\" and "
                  "contact.assembly = \"small_displacement\"");
  }
  if (c.flank_points != 1 || c.face_slices != 1 || c.gaps != GapModel::kinematic || c.reference_section_mm) {
    return refuse("contact over the whole flank is not in this version; use contact.flank_points = 1, face_slices = 1 and "
                  "gaps = \"kinematic\" without reference_section_mm");
  }
  if (gear.wave_generator.shape == WaveGeneratorShape::four_force && c.fidelity != Fidelity::linear) {
    return refuse("a four_force wave generator has no surface to lift off from; use contact.fidelity = \"linear\"");
  }
  return std::nullopt;
}

} // namespace

struct ForwardModel::State {
  explicit State(ForwardOptions given) : options(given) {}
  ForwardOptions options;
  StageMemory<Outcome<NeutralCurve>> curves{64};
  StageMemory<UnitResponses> responses{8};
  StageMemory<RingCompliance> rings{8};
  StageMemory<Outcome<AssembledState>> assemblies{64};

  std::shared_ptr<const UnitResponses> unit_responses(const Gear& gear, ForwardResult& result, Failure& failure);
};

ForwardModel::ForwardModel(ForwardOptions options) : state_(std::make_unique<State>(options)) {}
ForwardModel::~ForwardModel() = default;

} // namespace strainwave
