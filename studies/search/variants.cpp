#include "strainwave/studies/search/variants.hpp"

#include <fmt/format.h>

#include <functional>
#include <string_view>

namespace strainwave {

namespace {

struct Change {
  std::string_view name; ///< a literal
  std::function<void(Gear&)> make;
};

std::vector<Change> changes(const Gear& gear) {
  std::vector<Change> all{{"as in the study", [](Gear&) {}}};
  if (gear.contact.fidelity == Fidelity::linear)
    all.push_back({"fidelity unilateral", [](Gear& g) { g.contact.fidelity = Fidelity::unilateral; }});
  else
    all.push_back({"fidelity linear", [](Gear& g) { g.contact.fidelity = Fidelity::linear; }});
  if (gear.contact.gaps == GapModel::assembled)
    all.push_back({"kinematic gaps", [](Gear& g) {
                     g.contact.gaps = GapModel::kinematic;
                     g.contact.reference_section_mm.reset(); // of assembled gaps alone
                   }});
  else
    all.push_back({"assembled gaps", [](Gear& g) { g.contact.gaps = GapModel::assembled; }});
  all.push_back({"twice the phases", [](Gear& g) { g.load.phases *= 2; }});
  return all;
}

/// The responses under all loads, or the reason why there are none.
Evaluation analyse(const Gear& gear, const std::vector<Load>& loads, const Change& change,
                   const ForwardModel& model) {
  Evaluation evaluation;
  std::vector<ForwardResult> results;
  for (const Load& load : loads) {
    Gear changed = gear;
    changed.load = load;
    change.make(changed);
    results.push_back(model.analyze(changed));
    if (results.back().status != Status::ok) {
      evaluation.status = status_name(results.back().status);
      evaluation.message = results.back().message;
      return evaluation;
    }
  }
  evaluation.ok = true;
  evaluation.status = "ok";
  evaluation.values = read_responses(results);
  return evaluation;
}

} // namespace

std::vector<ModelVariant> optimum_variants(const Gear& baseline, const Gear& best,
                                           const std::vector<Load>& loads, const ForwardModel& model) {
  std::vector<ModelVariant> variants;
  for (const Change& change : changes(best))
    variants.push_back({std::string(change.name), analyse(baseline, loads, change, model),
                        analyse(best, loads, change, model)});
  return variants;
}

} // namespace strainwave
