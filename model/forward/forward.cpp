#include "strainwave/model/forward/forward.hpp"

#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/forward/run.hpp"
#include "strainwave/model/loading/contact_forces.hpp"
#include "strainwave/model/loading/phase_problem.hpp"
#include "strainwave/model/loading/trace_load.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace strainwave {

namespace {

/// What is asked of a gear that is meshed: the stages as for Want::compliance, then `ask`.
template <class Value, class Question>
Outcome<Value> of_meshed(const std::shared_ptr<SharedStages>& stages, const Gear& gear,
                         const Question& question) {
  Run run;
  if (auto failure = run_stages(stages, gear, {.want = Want::compliance}, run))
    return *failure;
  try {
    return question(run);
  } catch (const NotPositiveDefinite& error) {
    return ill_conditioned(gear, error);
  }
}

Outcome<ContactStates> states_of(const Gear& gear, const Run& run) {
  const auto model = run.meshed->phase_model(MeshingPhase{});
  if (!model)
    return model.failure();
  const auto assembled = run.cup->assembly(MeshingPhase{});
  if (!assembled)
    return assembled.failure();
  const RingCompliance& ring = run.cup->ring().compliance;
  ContactStates result{.request = response_request(gear), .states = {}, .warnings = run.result.warnings};
  result.states.push_back(
      contact_forces("assembled", ring, **assembled, (*assembled)->force_components(), {}, {}));
  ContactSolver solver;
  const auto add = [&](const std::string& name, const Outcome<PhaseLoad>& load) -> std::optional<Failure> {
    if (!load)
      return load.failure();
    const bool wedged = std::any_of(load->coast_force_n.begin(), load->coast_force_n.end(),
                                    [](double force) { return force > 0.0; });
    result.states.push_back(contact_forces(name, ring, **assembled, load->wall_force,
                                           wedged ? (*model)->all_points() : (*model)->points(),
                                           wedged ? PhaseModel::all_forces(*load) : load->force_n));
    result.states.back().torque_nm = load->torque_nm;
    result.states.back().rotation_rad = load->rotation_rad;
    return std::nullopt;
  };
  for (const double torque : gear.load.torque_nm)
    if (auto failure = add(fmt::format("loaded_{:g}Nm", torque), (*model)->at_torque(torque, solver)))
      return *failure;
  for (const double rotation : gear.load.rotation_rad)
    if (auto failure = add(fmt::format("loaded_{:g}rad", rotation), (*model)->at_rotation(rotation, solver)))
      return *failure;
  return result;
}

Outcome<LoadPath> path_of(const Gear& gear, const Run& run) {
  const auto own = run.meshed->phase_model(MeshingPhase{});
  if (!own)
    return own.failure();
  const auto assembled = run.cup->assembly(MeshingPhase{});
  if (!assembled)
    return assembled.failure();
  const PhaseModel traced(traced_contact(gear.contact), run.cup->ring().compliance, run.cup->surface(),
                          *assembled, (*own)->points(), (*own)->coast_points());
  const bool exact = gear.contact.disc_gap == DiscGap::exact && gear.contact.fidelity != Fidelity::linear;
  return trace_load(traced, gear.load, exact ? own->get() : nullptr);
}

Outcome<std::vector<PhaseProblem>> problems_of(const Gear& gear, const MeshedGear& meshed, bool with_load) {
  std::vector<PhaseProblem> problems;
  for (int j = 0; j < gear.load.phases; ++j) {
    const MeshingPhase phase{j, gear.load.phases};
    auto points = meshed.points(phase);
    if (!points)
      return points.failure();
    const auto assembled = meshed.cup().assembly(phase);
    if (!assembled)
      return assembled.failure();
    problems.push_back({phase.value(), std::move(points).value(), {}});
    if (!with_load)
      continue;
    const RingCompliance& ring = meshed.cup().ring().compliance;
    PhaseProblem& problem = problems.back();
    problem.load = gear.contact.fidelity == Fidelity::linear
                       ? linear_problem(ring, **assembled, problem.points)
                       : unilateral_problem(ring, **assembled, problem.points);
  }
  return problems;
}

} // namespace

ForwardModel::ForwardModel(ForwardOptions options) : stages_(std::make_shared<SharedStages>(options)) {}

ForwardResult ForwardModel::analyze(const Gear& gear, Want want) const {
  return complete_run(stages_, gear, {.want = want}).result;
}

Outcome<LoadPath> ForwardModel::load_path(const Gear& gear) const {
  return of_meshed<LoadPath>(stages_, gear, [&](const Run& run) { return path_of(gear, run); });
}

Outcome<std::vector<PhaseProblem>> ForwardModel::phase_problems(const Gear& gear) const {
  return of_meshed<std::vector<PhaseProblem>>(
      stages_, gear, [&](const Run& run) { return problems_of(gear, *run.meshed, true); });
}

Outcome<std::vector<PhaseProblem>> ForwardModel::phase_points(const Gear& gear) const {
  return of_meshed<std::vector<PhaseProblem>>(
      stages_, gear, [&](const Run& run) { return problems_of(gear, *run.meshed, false); });
}

Outcome<ContactStates> ForwardModel::contact_states(const Gear& gear) const {
  return of_meshed<ContactStates>(stages_, gear, [&](const Run& run) { return states_of(gear, run); });
}

} // namespace strainwave
