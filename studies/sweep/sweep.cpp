// Rows of a sweep: gears whose keys run through lists of values.
//
// Rows of a factorial sweep are ordered by cost: keys of the cup (flexspline, material, mesh) move slowest,
// then those of the wave generator, then all others, loads fastest; within a class as in the file. So a cup
// is solved once, an assembly once for each cup and wave generator, and both are shared by all threads
// through one forward model.

#include "strainwave/studies/sweep/sweep.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/results/response.hpp"
#include "strainwave/studies/file/study_gear.hpp"
#include "strainwave/studies/results/row_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace strainwave {

namespace {

/// What one variable of the sweep moves.
struct Knob {
  std::optional<NumberPath> number; ///< nothing: a load
  LoadKey load;
  std::optional<NumberPath> linked;
  double ratio = 1.0;
};

int cost_rank(std::string_view path) {
  constexpr std::array<std::string_view, 3> cup{"flexspline.", "material.", "mesh."};
  if (std::ranges::any_of(cup, [&](std::string_view table) { return path.starts_with(table); }))
    return 0;
  if (path.starts_with("wave_generator."))
    return 1;
  return path.starts_with("load_case[") ? 3 : 2;
}

Knob knob_of(const SweepVariable& v) {
  Knob knob;
  if (const auto load = load_key(v.path))
    knob.load = *load;
  else
    knob.number.emplace(v.path);
  if (v.link) {
    knob.linked.emplace(v.link->path);
    knob.ratio = v.link->ratio;
  }
  return knob;
}

/// Which value of every variable a row takes. Shared by the rows, the model and the reports.
class SweepGrid {
public:
  explicit SweepGrid(const StudyFile& study) : list_(study.part<SweepPart>().sweep.mode == SweepMode::list) {
    for (const SweepVariable& v : study.part<SweepPart>().variables)
      values_.push_back(sweep_values(v));
    for (std::size_t i = 0; i < values_.size(); ++i)
      order_.push_back(i);
    std::ranges::stable_sort(
        order_, {}, [&](std::size_t i) { return cost_rank(study.part<SweepPart>().variables[i].path); });
    rows_ = values_.front().size();
    if (list_)
      return;
    rows_ = 1;
    for (const auto& values : values_) {
      if (rows_ > most_rows / values.size())
        throw FieldError("variable", fmt::format("the values make more than {} rows", most_rows));
      rows_ *= values.size();
    }
  }

  std::uint64_t rows() const { return rows_; }
  std::size_t columns() const { return values_.size(); }
  /// Of a factorial sweep; a list may have a cup in every row.
  std::uint64_t cups(const StudyFile& study) const {
    std::uint64_t cups = 1;
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (cost_rank(study.part<SweepPart>().variables[i].path) == 0)
        cups *= list_ ? (cups > 1 ? 1 : rows_) : values_[i].size();
    return cups;
  }

  void fill(std::uint64_t first, std::size_t count, std::span<double> rows) const {
    for (std::size_t k = 0; k < count; ++k) {
      std::uint64_t rest = first + k;
      const auto row = rows.subspan(k * columns(), columns());
      for (auto i = order_.rbegin(); i != order_.rend(); ++i) {
        const auto& values = values_[*i];
        row[*i] = list_ ? values[rest] : values[rest % values.size()];
        if (!list_)
          rest /= values.size();
      }
    }
  }

private:
  static constexpr std::uint64_t most_rows = 1000000000;
  bool list_;
  std::vector<std::vector<double>> values_;
  std::vector<std::size_t> order_; ///< slowest first
  std::uint64_t rows_ = 0;
};

class SweepModel : public RowModel {
public:
  SweepModel(const StudyFile& study, const RunContext& context)
      : study_(study), warn_(context.warn),
        forward_(std::make_shared<ForwardModel>(
            ForwardOptions{.disk_cache = context.disk_cache, .threads = context.threads})) {
    for (const SweepVariable& v : study.part<SweepPart>().variables)
      knobs_.push_back(knob_of(v));
    const auto loads = study_loads(study);
    const auto wanted = [&](std::string_view name) {
      const auto& names = study.part<SweepPart>().sweep.outputs;
      return names.empty() ? !find_unavailable_response(name, study.gear, loads)
                           : std::ranges::find(names, name) != names.end();
    };
    for (std::size_t r = 0; r < gear_responses().size(); ++r)
      if (wanted(gear_responses()[r].name))
        responses_.push_back(r);
  }

  std::size_t inputs() const override { return knobs_.size(); }
  std::size_t outputs() const override { return responses_.size(); }
  std::string_view status_name(std::uint8_t status) const override { return row_status_name(status); }
  std::unique_ptr<RowWorker> worker() const override { return std::make_unique<Worker>(*this); }
  const std::vector<std::size_t>& responses() const { return responses_; }

  /// Throws FieldError where a linked number leaves the range of its key.
  StudyFile study_of(std::span<const double> row) const {
    StudyFile study = study_;
    for (std::size_t i = 0; i < knobs_.size(); ++i) {
      const Knob& knob = knobs_[i];
      if (knob.number)
        knob.number->set(study.gear, row[i]);
      else if (knob.load.torque)
        study.load_cases[knob.load.number].torque_nm = row[i];
      else
        study.load_cases[knob.load.number].rotation_rad = row[i];
      if (knob.linked)
        knob.linked->set(study.gear, knob.ratio * row[i]);
    }
    return study;
  }

private:
  class Worker : public RowWorker {
  public:
    explicit Worker(const SweepModel& model) : model_(model) {}
    void evaluate(RowSlice& slice) override {
      for (std::size_t i = 0; i < slice.rows; ++i)
        model_.evaluate(slice, i);
    }

  private:
    const SweepModel& model_;
  };

  void evaluate(RowSlice& slice, std::size_t i) const {
    StudyFile study;
    try {
      study = study_of(slice.inputs.subspan(i * inputs(), inputs()));
    } catch (const FieldError& error) {
      return slice.fail(i, row_out_of_range, error.what());
    }
    std::vector<ForwardResult> results;
    for (const Load& load : study_loads(study)) {
      study.gear.load = load;
      results.push_back(forward_->analyze(study.gear));
      const ForwardResult& result = results.back();
      if (warn_)
        std::ranges::for_each(result.warnings, warn_);
      if (result.status != Status::ok)
        return slice.fail(i, row_status_of(result.status), result.message);
    }
    const std::vector<double> values = read_responses(results);
    for (std::size_t k = 0; k < responses_.size(); ++k) {
      const double value = values[responses_[k]];
      if (!std::isfinite(value))
        return slice.fail(
            i, row_no_value,
            fmt::format("{} has no value under these loads", gear_responses()[responses_[k]].name));
      slice.outputs[i * responses_.size() + k] = value;
    }
  }

  StudyFile study_;
  std::function<void(const std::string&)> warn_;
  std::shared_ptr<ForwardModel> forward_;
  std::vector<Knob> knobs_;
  std::vector<std::size_t> responses_;
};

} // namespace

std::vector<double> sweep_values(const SweepVariable& v) {
  if (!v.values.empty() || !v.lower || !v.upper || !v.count)
    return v.values;
  std::vector<double> values(static_cast<std::size_t>(*v.count));
  for (std::size_t i = 0; i < values.size(); ++i) // both ends exactly
    values[i] = i + 1 == values.size() ? *v.upper
                                       : *v.lower + (*v.upper - *v.lower) * static_cast<double>(i) /
                                                        static_cast<double>(*v.count - 1);
  return values;
}

Outcome<SampledStudy> make_sweep_rows(const StudyFile& study, const RunContext& context) {
  const auto grid = std::make_shared<const SweepGrid>(study);
  auto model = std::make_unique<SweepModel>(study, context);
  SampledStudy sampled;
  for (const SweepVariable& v : study.part<SweepPart>().variables) {
    const auto load = load_key(v.path);
    sampled.input_columns.push_back(
        {v.path, plain_unit(load ? (load->torque ? "N·m" : "rad") : NumberPath(v.path).field().unit)});
  }
  for (const std::size_t r : model->responses())
    sampled.output_columns.push_back(
        {std::string(gear_responses()[r].name), plain_unit(gear_responses()[r].unit)});
  sampled.inputs = [grid](std::uint64_t first, std::size_t count, std::span<double> rows) {
    grid->fill(first, count, rows);
  };
  sampled.input_values = sampled.inputs;
  sampled.rows = grid->rows();
  sampled.cups = grid->cups(study);
  sampled.block_rows = 8; // some 10 ms each on a cup that is known
  sampled.slice_rows = 1;
  sampled.status_names = row_status_names();
  sampled.model_content = "sweep 2";
  const SweepModel* known = model.get();
  sampled.gear_of_row = [grid, known](std::uint64_t row) -> std::optional<Gear> {
    std::vector<double> values(grid->columns());
    grid->fill(row, 1, values);
    return gear_with_loads(known->study_of(values));
  };
  sampled.model = std::move(model);
  return sampled;
}

} // namespace strainwave
