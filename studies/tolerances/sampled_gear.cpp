#include "strainwave/studies/tolerances/sampled_gear.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/studies/tolerances/outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace strainwave {

namespace {

/// Teeth farther from contact than this are moved by first derivatives even when the discs change: 0.03 mm of
/// gap are more than any sample closes.
constexpr double near_mm = 0.03;
/// Part of a distribution outside the interpolant at either end: those rows are assembled, or have no result.
/// Wide distributions whose corners have none themselves get a smaller box.
constexpr std::array tails{1e-5, 1e-3, 1e-2};

void refuse_loads(const StudyFile& study) {
  for (std::size_t i = 0; i < study.load_cases.size(); ++i) {
    const LoadCase& c = study.load_cases[i];
    const std::string at = fmt::format("load_case[{}]", i);
    if (c.direction != Direction::drive)
      throw FieldError(at + ".direction", "samples are loaded in the drive direction");
    if (c.phases != 1)
      throw FieldError(at + ".phases", "samples stand at phase 0; the wave generator's positions are "
                                       "sampling.positions or sensitivity.positions");
    if (c.torque_nm && !(*c.torque_nm > 0.0))
      throw FieldError(at + ".torque_nm", "samples need a torque above 0");
  }
}

} // namespace

std::vector<std::string> SampledGear::status_names() {
  std::vector<std::string> names = row_status_names();
  names.resize(row_coast_contact);
  names.push_back("coast_contact");
  return names;
}

std::string_view SampledGear::status_name(std::uint8_t status) const {
  return status == row_coast_contact ? "coast_contact" : row_status_name(status);
}

std::vector<TableColumn> SampledGear::output_columns() const {
  std::vector<TableColumn> columns;
  for (const std::size_t r : wanted_) {
    const Response& response = sampled_responses()[r];
    columns.push_back({std::string(response.name), plain_unit(response.unit)});
  }
  return columns;
}

Outcome<std::shared_ptr<const SampledGear>> SampledGear::make(const StudyFile& study,
                                                              const std::vector<std::string>& outputs,
                                                              int positions, const RunContext& context) {
  refuse_loads(study);
  SampledSources sources(study);
  const ForwardModel model({.disk_cache = context.disk_cache, .threads = context.threads});
  auto mesh = nominal_mesh(model, study.gear);
  if (!mesh)
    return mesh.failure();
  if (context.warn)
    std::ranges::for_each(mesh->analysis.warnings, context.warn);
  std::vector<MeshedTooth> teeth;
  for (std::size_t i = 0; i < mesh->teeth.size(); ++i)
    teeth.push_back({mesh->teeth[i].phi_rad, mesh->teeth[i].tooth, mesh->pose[i]});
  auto tolerance = ToleranceModel::make(study.gear, mesh->curve, teeth, sources.flank_sources());
  if (!tolerance)
    return tolerance.failure();
  auto flanks = FlankPair::make(study.gear);
  if (!flanks)
    return flanks.failure();
  std::shared_ptr<SampledGear> gear(new SampledGear(std::move(sources), std::move(mesh).value(),
                                                    std::move(tolerance).value(), std::move(flanks).value()));
  for (const LoadedPoint& tooth : gear->mesh_.teeth)
    gear->cosine_.push_back(std::cos(tooth.pressure_angle_rad));
  try {
    if (auto failure = gear->add_loads(study))
      return *failure;
  } catch (const NotPositiveDefinite& error) {
    return Failure{Status::ill_conditioned, error.what()};
  }
  if (auto failure = gear->add_discs())
    return *failure;
  gear->find_near();
  for (std::size_t r = 0; r < sampled_responses().size(); ++r)
    if (outputs.empty() || std::ranges::find(outputs, sampled_responses()[r].name) != outputs.end())
      gear->wanted_.push_back(r);
  const int z1 = study.gear.flexspline.teeth;
  for (int j = 0; j < positions; ++j)
    gear->positions_.push_back(static_cast<int>(static_cast<long>(j) * z1 / positions));
  return std::shared_ptr<const SampledGear>(gear);
}

std::optional<Failure> SampledGear::add_loads(const StudyFile& study) {
  for (const LoadCase& c : study.load_cases) {
    const Control control = c.torque_nm ? Control::torque : Control::rotation;
    const double value = c.torque_nm ? *c.torque_nm : *c.rotation_rad;
    auto tangent = nominal_load(mesh_, value, control);
    if (!tangent)
      return tangent.failure();
    SampledContact contact(tangent->problem, static_cast<int>(mesh_.teeth.size()), tangent->state,
                           tangent->modes);
    loads_.push_back({control, value, std::move(tangent).value(), std::move(contact)});
  }
  return std::nullopt;
}

std::optional<Failure> SampledGear::add_discs() {
  const auto* u0 = sources_.find(SourceRole::radial_deformation);
  const auto* e = sources_.find(SourceRole::eccentricity);
  if (!u0 && !e)
    return std::nullopt;
  const auto range = [](const SampledSources::Source* source, double tail, double nominal) {
    if (!source)
      return std::pair{nominal, nominal};
    const Quantile quantile(source->distribution);
    return std::pair{quantile(tail), quantile(1.0 - tail)};
  };
  for (const double tail : tails) {
    DiscBox box;
    std::tie(box.u0_lower, box.u0_upper) =
        range(u0, tail, mesh_.gear.wave_generator.max_radial_deformation_mm);
    std::tie(box.e_lower, box.e_upper) = range(e, tail, *mesh_.curve.summary().eccentricity_mm);
    auto surface = DiscSurface::make(mesh_, box);
    if (surface) {
      discs_ = std::move(surface).value();
      break;
    }
    if (tail == tails.back())
      return surface.failure();
  }
  auto nominal = mesh_at_discs(mesh_, mesh_.gear.wave_generator.max_radial_deformation_mm,
                               *mesh_.curve.summary().eccentricity_mm);
  if (!nominal)
    return nominal.failure();
  nominal_discs_ = std::move(nominal).value();
  return std::nullopt;
}

void SampledGear::find_near() {
  const std::size_t n = mesh_.teeth.size();
  near_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    double least = mesh_.teeth[i].backlash_mm;
    for (const SampledLoad& load : loads_)
      least = std::min(least, load.tangent.state.gap(static_cast<Eigen::Index>(i)));
    near_[i] = least < near_mm;
  }
}

SampledStudy study_of(const std::shared_ptr<const SampledGear>& gear, RowInputs inputs) {
  SampledStudy study;
  for (const SampledSources::Source& source : gear->sources().sources())
    study.input_columns.push_back({source.name, source.unit});
  study.output_columns = gear->output_columns();
  study.status_names = SampledGear::status_names();
  study.model_content = "samples of the whole ring 1";
  study.model = std::make_unique<SharedRows>(gear);
  study.inputs = inputs;
  study.input_values = [gear, inputs](std::uint64_t first, std::size_t count, std::span<double> to) {
    const std::size_t n = gear->inputs(), names = gear->sources().sources().size();
    constexpr std::size_t together = 64;
    std::vector<double> rows(together * n);
    for (std::size_t i = 0; i < count; i += together) {
      const std::size_t here = std::min(together, count - i);
      inputs(first + i, here, std::span(rows).first(here * n));
      for (std::size_t j = 0; j < here; ++j)
        gear->sources().named_values(std::span(rows).subspan(j * n, n), to.subspan((i + j) * names, names));
    }
  };
  study.describe_row = [gear, inputs](std::uint64_t row) {
    std::vector<double> values(gear->inputs());
    inputs(row, 1, values);
    return gear->describe(row, values);
  };
  return study;
}

} // namespace strainwave
