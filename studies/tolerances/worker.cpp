#include "strainwave/studies/tolerances/outputs.hpp"
#include "strainwave/studies/tolerances/sampled_gear.hpp"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

namespace strainwave {

/// One thread's way through rows: all buffers are its own, nothing is allocated for a row that has a result
/// (but for rows beyond the interpolant of the discs).
class SampledGearWorker : public RowWorker {
public:
  explicit SampledGearWorker(const SampledGear& gear) : gear_(gear) {
    const std::size_t n = gear.mesh_.teeth.size();
    for (auto* v : {&backlash_, &radius_, &coast_, &gap_, &arm_, &shift_})
      v->assign(n, 0.0);
    for (const LoadedPoint& tooth : gear.mesh_.teeth)
      phi_.push_back(tooth.phi_rad);
    for (const SampledLoad& load : gear.loads_)
      solvers_.push_back(std::make_unique<SampleSolver>(load.contact));
    if (gear.discs_) {
      errors_.resize(n);
      change_.resize(n);
    }
  }

  /// Called after every solved position and load, with the worker's buffers: for people who ask about one
  /// row.
  std::function<void(const SampledGearWorker&, int position, std::size_t load)> look;

  std::span<const double> backlash_mm() const { return backlash_; }
  std::span<const double> coast_backlash_mm() const { return coast_; }
  std::span<const double> contact_radius_mm() const { return radius_; }
  const SampledState& state() const { return state_; }

  void evaluate(RowSlice& slice) override {
    for (std::size_t i = 0; i < slice.rows; ++i)
      row(slice, i, slice.inputs.subspan(i * gear_.inputs(), gear_.inputs()));
  }

private:
  void row(RowSlice& slice, std::size_t at, std::span<const double> values) {
    if (gear_.discs_ && !move_discs(slice, at, values))
      return;
    SampledOutputs worst{};
    bool first = true;
    for (const int position : gear_.positions_) {
      if (gear_.discs_)
        search_flanks(values, position);
      else
        gear_.tolerance_.backlash(values, position, backlash_, radius_, coast_);
      for (std::size_t k = 0; k < gear_.loads_.size(); ++k) {
        if (!solve(slice, at, values, k, position))
          return;
        if (look)
          look(*this, position, k);
        const SampledOutputs outputs = read_outputs({state_, backlash_, radius_, gear_.cosine_, phi_});
        if (first)
          worst = outputs;
        else
          worse_of(worst, outputs);
        first = false;
      }
    }
    for (std::size_t k = 0; k < gear_.wanted_.size(); ++k) {
      const double value = worst[gear_.wanted_[k]];
      if (!std::isfinite(value))
        return slice.fail(
            at, row_no_value,
            fmt::format("{} has no value for this sample", sampled_responses()[gear_.wanted_[k]].name));
      slice.outputs[at * gear_.wanted_.size() + k] = value;
    }
  }

  bool solve(RowSlice& slice, std::size_t at, std::span<const double> values, std::size_t k, int position) {
    const SampledLoad& load = gear_.loads_[k];
    const ContactProblem& nominal = load.tangent.problem;
    for (std::size_t i = 0; i < backlash_.size(); ++i) {
      const double c = gear_.cosine_[i];
      gap_[i] =
          nominal.q(static_cast<Eigen::Index>(i)) + c * (backlash_[i] - gear_.mesh_.teeth[i].backlash_mm);
      arm_[i] = c * radius_[i];
    }
    if (gear_.discs_)
      for (std::size_t i = 0; i < gap_.size(); ++i)
        gap_[i] += shift_[i];
    const auto modes = std::span<const double>(amplitude_)
                           .first(gear_.discs_ ? std::min(amplitude_.size(), load.contact.modes()) : 0);
    const ContactSample sample{gap_, arm_, modes};
    double value = load.value;
    if (const auto* source = gear_.sources_.find(SourceRole::torque, k))
      value = values[source->first];
    std::optional<Failure> failure;
    if (load.control == Control::torque) {
      if (!(value > 0.0)) {
        slice.fail(at, row_out_of_range,
                   fmt::format("a torque of {:.6g} N·m was drawn; it has to be above 0", value));
        return false;
      }
      failure = solvers_[k]->solve_torque(sample, 1e3 * value, state_);
    } else {
      failure = solvers_[k]->solve_at(sample, value, state_);
    }
    if (failure) {
      slice.fail(at, row_status_of(failure->status), failure->message);
      return false;
    }
    return coast_is_free(slice, at, value, load.control, position);
  }

  /// The coast gap under load is c + c_coast − drive gap: what the tooth has left of its whole clearance.
  bool coast_is_free(RowSlice& slice, std::size_t at, double value, Control control, int position) {
    for (std::size_t i = 0; i < backlash_.size(); ++i) {
      const double free = backlash_[i] + coast_[i] - state_.gap[i] / gear_.cosine_[i];
      if (!(free < 0.0))
        continue;
      slice.fail(
          at, row_coast_contact,
          fmt::format(
              "under {:.4g} {} the coast flank of the tooth at {:.2f}° would be {:.3g} µm inside its space "
              "(position {} of the wave generator); only drive flanks carry in samples",
              value, control == Control::torque ? "N·m" : "rad", phi_[i] * 180.0 / std::numbers::pi,
              -1e3 * free, position));
      return false;
    }
    return true;
  }

  /// The row's discs: change_ of all teeth, amplitudes of the wall's modes.
  bool move_discs(RowSlice& slice, std::size_t at, std::span<const double> values) {
    const double u0_nominal = gear_.mesh_.gear.wave_generator.max_radial_deformation_mm;
    const double e_nominal = *gear_.mesh_.curve.summary().eccentricity_mm;
    const auto* u0_source = gear_.sources_.find(SourceRole::radial_deformation);
    const auto* e_source = gear_.sources_.find(SourceRole::eccentricity);
    const double u0 = u0_source ? values[u0_source->first] : u0_nominal;
    const double e = e_source ? values[e_source->first] : e_nominal;
    if (gear_.discs_->contains(u0, e)) {
      gear_.discs_->at(u0, e, change_);
    } else {
      auto change = disc_change(gear_.mesh_, *gear_.nominal_discs_, u0, e);
      if (!change) {
        slice.fail(at, row_status_of(change.failure().status), change.failure().message);
        return false;
      }
      change_ = std::move(change).value();
    }
    // R = r_m + u0 − e
    amplitude_ = DiscChange{e - e_nominal, (u0 - u0_nominal) - (e - e_nominal)}.amplitudes();
    for (std::size_t i = 0; i < shift_.size(); ++i)
      shift_[i] = change_[i].shift_mm;
    return true;
  }

  /// Backlash of the moved poses: near contact by the direct geometry, elsewhere by first derivatives.
  void search_flanks(std::span<const double> values, int position) {
    const ToleranceModel& model = gear_.tolerance_;
    model.errors(values, position, errors_);
    for (std::size_t i = 0; i < backlash_.size(); ++i) {
      const Pose& nominal = gear_.mesh_.pose[i];
      const DiscSurface::Change& change = change_[i];
      const ToothErrors& error = errors_[i];
      // as a motion: outwards, along the circle, and of the tooth's direction in space
      ToothMotion motion = error.motion;
      motion +=
          {change.rho_mm, nominal.rho_mm * change.phi1_rad, change.phi1_rad + change.normal_rotation_rad};
      coast_[i] = model.nominal_coast_mm(i) + model.coast_by(i, motion) + error.coast_backlash_mm;
      if (gear_.near_[i]) {
        Pose pose{nominal.rho_mm + change.rho_mm, nominal.phi1_rad + change.phi1_rad,
                  nominal.normal_rotation_rad + change.normal_rotation_rad};
        const ToothBacklash direct =
            gear_.flanks_.drive(moved(pose, error.motion), model.place(i).space_angle_rad);
        if (direct.overlap) {
          backlash_[i] = direct.backlash_mm + error.backlash_mm;
          radius_[i] = direct.contact_radius_mm + error.radius_mm;
          continue;
        }
      }
      backlash_[i] = model.nominal(i).backlash_mm + model.backlash_by(i, motion) + error.backlash_mm;
      radius_[i] = model.nominal(i).contact_radius_mm + model.radius_by(i, motion) + error.radius_mm;
    }
  }

  const SampledGear& gear_;
  std::vector<std::unique_ptr<SampleSolver>> solvers_;
  SampledState state_;
  std::vector<double> backlash_, radius_, coast_, gap_, arm_, shift_, phi_;
  std::vector<ToothErrors> errors_;
  std::vector<DiscSurface::Change> change_;
  std::array<double, 3> amplitude_{};
};

std::string SampledGear::describe(std::uint64_t row, std::span<const double> values) const {
  using nlohmann::ordered_json;
  ordered_json json{{"row", row}};
  for (const SampledSources::Source& source : sources_.sources()) {
    const auto own = values.subspan(source.first, source.count);
    if (source.one_number())
      json["sources"][source.name] = own[0];
    else
      json["sources"][source.name] = std::vector<double>(own.begin(), own.end());
  }
  SampledGearWorker worker(*this);
  worker.look = [&](const SampledGearWorker& at, int position, std::size_t load) {
    ordered_json one{{"position", position}, {"rotation_rad", at.state().rotation}};
    one["torque_nm"] = 1e-3 * at.state().torque;
    one["changed_wall_stations"] = at.state().changed_stations;
    for (std::size_t i = 0; i < mesh_.teeth.size(); ++i) {
      one["phi_deg"].push_back(mesh_.teeth[i].phi_rad * 180.0 / std::numbers::pi);
      one["backlash_um"].push_back(1e3 * at.backlash_mm()[i]);
      one["contact_radius_mm"].push_back(at.contact_radius_mm()[i]);
      one["force_n"].push_back(at.state().force[i]);
      one["loaded_backlash_um"].push_back(1e3 * at.state().gap[i] / cosine_[i]);
    }
    json["loads"][load].push_back(std::move(one));
  };
  std::vector<double> outputs(wanted_.size());
  std::uint8_t status = row_ok;
  std::vector<RowMessage> messages;
  RowSlice slice{.first = row,
                 .rows = 1,
                 .inputs = values,
                 .outputs = outputs,
                 .status = {&status, 1},
                 .messages = &messages};
  worker.evaluate(slice);
  json["status"] = status_name(status);
  if (!messages.empty())
    json["message"] = messages.front().text;
  for (std::size_t k = 0; k < wanted_.size() && status == row_ok; ++k)
    json["outputs"][std::string(sampled_responses()[wanted_[k]].name)] = outputs[k];
  return json.dump(2);
}

std::unique_ptr<RowWorker> SampledGear::worker() const {
  return std::make_unique<SampledGearWorker>(*this);
}

} // namespace strainwave
