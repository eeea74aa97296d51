#include "strainwave/model/loading/trace_load.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/lcp/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace strainwave {

namespace {

constexpr double path_tolerance = 1e-9; ///< between path and direct solution, relative

/// A load of the gear, solved directly.
struct DirectLoad {
  bool at_torque = true;
  double value = 0.0; ///< as asked for
  PhaseLoad load;
  std::vector<double> force_n; ///< of all points
};

PathPoint path_point(const LoadedPoint& point) {
  return {.tooth = point.tooth,
          .phi_deg = point.phi_rad / units::degree,
          .coast = point.coast,
          .flank_radius_mm = point.flank_radius_mm,
          .z_mm = point.z_mm};
}

double relative(double difference, double scale) {
  return scale > 0.0 ? std::abs(difference) / scale : std::abs(difference);
}

class LoadTrace {
public:
  LoadTrace(const PhaseModel& model, const Load& load, const PhaseModel* exact)
      : model_(model), load_(load), exact_(exact) {}

  Outcome<LoadPath> run() {
    if (auto failure = solve_directly())
      return *failure;
    for (selections_ = 1;; ++selections_) {
      selection_ = model_.select(index_);
      if (auto failure = trace())
        return *failure;
      if (!add_missed_points())
        break;
    }
    LoadPath path = described();
    if (auto failure = compare(path))
      return *failure;
    return path;
  }

private:
  std::optional<Failure> solve_directly() {
    std::vector<double> torques = load_.torque_nm;
    if (torques.empty() && load_.rotation_rad.empty() && load_.rated_torque_nm > 0.0)
      torques.push_back(load_.rated_torque_nm);
    for (const double torque : torques)
      if (auto failure = add_direct(true, torque, model_.at_torque(torque, solver_)))
        return failure;
    for (const double rotation : load_.rotation_rad)
      if (auto failure = add_direct(false, rotation, model_.at_rotation(rotation, solver_)))
        return failure;
    if (direct_.empty())
      return Failure{
          Status::contradiction,
          "a load path needs a load to lead to: load.torque_nm, load.rotation_rad or load.rated_torque_nm"};
    index_ = model_.first_selection().index;
    for (const DirectLoad& one : direct_)
      for (std::size_t i = 0; i < one.force_n.size(); ++i)
        if (one.force_n[i] > 0.0)
          index_.push_back(static_cast<int>(i));
    std::sort(index_.begin(), index_.end());
    index_.erase(std::unique(index_.begin(), index_.end()), index_.end());
    last_ = std::max_element(direct_.begin(), direct_.end(), [](const DirectLoad& a, const DirectLoad& b) {
      return a.load.rotation_rad < b.load.rotation_rad;
    });
    return std::nullopt;
  }

  std::optional<Failure> add_direct(bool at_torque, double value, const Outcome<PhaseLoad>& load) {
    if (!load)
      return load.failure();
    direct_.push_back({at_torque, value, *load, PhaseModel::all_forces(*load)});
    return std::nullopt;
  }

  std::optional<Failure> trace() {
    const ContactProblem& problem = selection_.load.problem;
    const auto rest = solver_.take_up(problem);
    if (!rest)
      return rest.failure();
    PathRange range{.start_rotation = std::min(0.0, *rest)};
    for (const DirectLoad& one : direct_)
      range.start_rotation = std::min(range.start_rotation, one.load.rotation_rad);
    if (last_->at_torque)
      range.end_torque = 1e3 * last_->value / selection_.load.lobes;
    else
      range.end_rotation = last_->value;
    solver_.trace(problem, range, {}, way_);
    if (way_.end() == EventPath::End::torque || way_.end() == EventPath::End::rotation)
      return std::nullopt;
    return Failure{Status::not_converged,
                   fmt::format("the load path stops at {:.6g} N·m", torque_nm(way_.end_torque()))};
  }

  double torque_nm(double of_a_lobe) const { return 1e-3 * selection_.load.lobes * of_a_lobe; }

  /// Points outside of the selection that penetrate somewhere on the way; false: none.
  bool add_missed_points() {
    const std::vector<LoadedPoint>& points = model_.all_points();
    if (selection_.index.size() == points.size())
      return false;
    std::vector<std::uint8_t> inside(points.size(), 0), missed(points.size(), 0);
    for (const int i : selection_.index)
      inside[static_cast<std::size_t>(i)] = 1;
    ContactState state;
    const auto look = [&](double rotation) {
      way_.at(rotation, state);
      const Eigen::VectorXd gap = model_.gaps(selection_, state);
      // as in PhaseModel::solve: how well gaps from the forces repeat those of the solver
      double rounding_mm = 0.0;
      for (std::size_t k = 0; k < selection_.index.size(); ++k)
        rounding_mm = std::max(rounding_mm,
                               std::abs(gap(selection_.index[k]) - state.gap(static_cast<Eigen::Index>(k))));
      for (std::size_t i = 0; i < points.size(); ++i)
        if (!inside[i] && gap(static_cast<Eigen::Index>(i)) < -(1e-13 + rounding_mm))
          missed[i] = 1;
    };
    look(way_.start_rotation());
    for (const PathEvent& event : way_.events())
      look(event.rotation);
    look(way_.end_rotation());
    const std::size_t before = index_.size();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (missed[i])
        index_.push_back(static_cast<int>(i));
    std::sort(index_.begin(), index_.end());
    return index_.size() > before;
  }

  LoadPath described() const {
    LoadPath path{.start_rotation_rad = way_.start_rotation(),
                  .start_torque_nm = torque_nm(way_.start_torque()),
                  .end_rotation_rad = way_.end_rotation(),
                  .end_torque_nm = torque_nm(way_.end_torque()),
                  .selections = selections_};
    const ContactState start = way_.at(way_.start_rotation());
    path.start_stiffness_nm_per_rad = torque_nm(start.stiffness);
    std::map<std::pair<int, bool>, int> carrying; // points of a tooth's drive or coast flank
    for (std::size_t k = 0; k < selection_.points.size(); ++k) {
      if (!start.active[k])
        continue;
      path.carries_at_start.push_back(path_point(selection_.points[k]));
      ++carrying[{selection_.points[k].tooth, selection_.points[k].coast}];
    }
    for (const PathEvent& event : way_.events())
      path.events.push_back(described(event, carrying));
    return path;
  }

  LoadPathEvent described(const PathEvent& event, std::map<std::pair<int, bool>, int>& carrying) const {
    LoadPathEvent result{.rotation_rad = event.rotation,
                         .torque_nm = torque_nm(event.torque),
                         .stiffness_nm_per_rad = torque_nm(event.stiffness_after)};
    const auto before = carrying;
    for (const ContactChange& change : way_.changes(event)) {
      const auto k = static_cast<std::size_t>(change.index);
      if (k >= selection_.points.size()) {
        ++(change.closes ? result.wall_joins : result.wall_leaves);
        continue;
      }
      const LoadedPoint& point = selection_.points[k];
      carrying[{point.tooth, point.coast}] += change.closes ? 1 : -1;
      result.changes.push_back({path_point(point), change.closes, false});
    }
    std::map<std::pair<int, bool>, bool> told;
    for (LoadPathChange& change : result.changes) {
      const std::pair flank(change.point.tooth, change.point.coast);
      const auto found = before.find(flank);
      const int was = found == before.end() ? 0 : found->second, is = carrying[flank];
      const bool whole = change.joins ? was == 0 && is > 0 : was > 0 && is == 0;
      change.whole_tooth = whole && !std::exchange(told[flank], true);
    }
    return result;
  }

  /// Every load once more, read off the path.
  std::optional<Failure> compare(LoadPath& path) {
    for (const DirectLoad& one : direct_) {
      LoadOnPath on{.at_torque = one.at_torque};
      ContactState state;
      if (one.at_torque) {
        on.torque_nm = one.value;
        on.rotation_rad = rotation_at(path, one.value);
        on.direct_difference = relative(on.rotation_rad - one.load.rotation_rad,
                                        std::max(std::abs(one.load.rotation_rad), 1e-3 * span(path)));
        state = way_.at_torque(
            std::clamp(1e3 * one.value / selection_.load.lobes, way_.start_torque(), way_.end_torque()));
      } else {
        on.rotation_rad = one.value;
        on.torque_nm = torque_at(path, one.value);
        on.direct_difference =
            relative(on.torque_nm - one.load.torque_nm,
                     std::max(std::abs(one.load.torque_nm), 1e-3 * std::abs(path.end_torque_nm)));
        state = way_.at(std::clamp(one.value, way_.start_rotation(), way_.end_rotation()));
      }
      std::vector<double> difference = one.force_n; // points outside of the selection carry nothing
      double largest = 0.0, worst = 0.0;
      for (const double force : one.force_n)
        largest = std::max(largest, force);
      for (std::size_t k = 0; k < selection_.index.size(); ++k)
        difference[static_cast<std::size_t>(selection_.index[k])] -=
            state.force(static_cast<Eigen::Index>(k));
      for (const double part : difference)
        worst = std::max(worst, std::abs(part));
      on.direct_difference = std::max(on.direct_difference, relative(worst, largest));
      if (exact_) {
        const auto exact =
            one.at_torque ? exact_->at_torque(one.value, solver_) : exact_->at_rotation(one.value, solver_);
        if (!exact)
          return exact.failure();
        if (one.at_torque)
          on.exact_minus_path_rad = exact->rotation_rad - on.rotation_rad;
        else
          on.exact_minus_path_nm = exact->torque_nm - on.torque_nm;
      }
      path.loads.push_back(on);
      if (!(on.direct_difference <= path_tolerance))
        return Failure{
            Status::certificate_failed,
            fmt::format("the load path differs from the direct solution at {:.6g} N·m by {:.2e} of "
                        "it, at most {:.0e} is allowed",
                        on.torque_nm, on.direct_difference, path_tolerance)};
    }
    return std::nullopt;
  }

  static double span(const LoadPath& path) { return path.end_rotation_rad - path.start_rotation_rad; }

  const PhaseModel& model_;
  const Load& load_;
  const PhaseModel* exact_; ///< may be null
  ContactSolver solver_;
  std::vector<DirectLoad> direct_;
  std::vector<DirectLoad>::const_iterator last_; ///< the one of the largest rotation
  std::vector<int> index_;                       ///< points in play, ascending
  PhaseModel::Selection selection_;
  EventPath way_;
  int selections_ = 0;
};

} // namespace

Contact traced_contact(const Contact& of_gear) {
  Contact contact = of_gear;
  contact.method = LoadMethod::direct;
  contact.disc_gap = DiscGap::linearised;
  return contact;
}

Outcome<LoadPath> trace_load(const PhaseModel& model, const Load& load, const PhaseModel* exact) {
  return LoadTrace(model, load, exact).run();
}

} // namespace strainwave
