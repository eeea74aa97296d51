// The stages of an analysis that know the cup: finite elements, assembly on the wave generator, compliance of
// the teeth.

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/response_store.hpp"
#include "strainwave/model/forward/analysis.hpp"
#include "strainwave/model/meshing/assembled_backlash.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {

namespace {

using units::degree;

/// D is symmetric by construction, so its own transpose proves nothing. Three of its columns (first, middle,
/// last tooth) are found again from a unit force and the reaction of the held wall, and compared with the
/// rows; relative.
double reciprocity_error(const RingCompliance& ring, const AssembledState& assembled,
                         const std::vector<LoadedPoint>& teeth, const Eigen::MatrixXd& d) {
  const std::vector<ToothFunctional> functionals = tooth_functionals(ring, teeth);
  double error = 0.0;
  for (const Eigen::Index j : {Eigen::Index{0}, d.rows() / 2, d.rows() - 1}) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(d.rows(), j);
    const Eigen::VectorXd column =
        ring.tooth_displacement(functionals, functionals, unit) -
        ring.tooth_displacement(functionals, assembled.stations,
                                frozen_reaction(ring, assembled, functionals, unit));
    error = std::max(error, (column.transpose() - d.row(j)).cwiseAbs().maxCoeff());
  }
  return error / d.cwiseAbs().maxCoeff();
}

} // namespace

std::optional<Failure> Analysis::flexspline() {
  StageClock clock(result_, "flexspline");
  const ResponseRequest request = response_request(gear_);
  ContentKey key;
  for (const std::uint64_t word : response_key(request))
    key.add(std::string_view(reinterpret_cast<const char*>(&word), 8));
  bool from_disk = false;
  const auto [responses, in_memory] = state_.responses.get(key, [&] {
    const ResponseStore store(state_.options.disk_cache ? cache_folder() : std::filesystem::path(),
                              [&](const std::string& sentence) { result_.warnings.push_back(sentence); });
    auto stored = stored_unit_responses(request, store, state_.options.threads);
    if (!stored)
      return std::make_shared<const Outcome<UnitResponses>>(stored.failure());
    from_disk = stored->reused;
    return std::make_shared<const Outcome<UnitResponses>>(std::move(stored).value().responses);
  });
  if (!*responses)
    return responses->failure();

  fold_ = gear_.contact.lobes == 2 && gear_.flexspline.teeth % 2 == 0;
  const std::vector<double> rows = contact_rows(gear_);
  ring_key_ = key;
  for (const double row : rows)
    ring_key_.add(row);
  ring_key_.add(fold_ ? 1.0 : 0.0);
  const auto ring = state_.rings.get(ring_key_, [&] {
    const std::shared_ptr<const UnitResponses> shared(responses, &responses->value());
    return std::make_shared<const Ring>(Ring{shared, RingCompliance(*shared, rows, fold_)});
  });
  ring_ = ring.first;
  clock.done(in_memory || from_disk ? StageStatus::reused : StageStatus::computed);
  Certificate certificate;
  certificate.reciprocity = ring_->responses->reciprocity_error;
  certificate.discretisation_estimate = ring_->responses->discretisation_estimate;
  result_.certificate = certificate;
  surface_ = surface_of(gear_, **curve_);
  return std::nullopt;
}

Outcome<std::shared_ptr<const AssembledState>> Analysis::assembly(double phase, bool* reused) {
  ContentKey key = ring_key_;
  key.add(curve_key_.bits());
  key.add(gear_.wave_generator.disc_taper_um)
      .add(static_cast<double>(gear_.contact.disc_gap))
      .add(disc_shift_)
      .add(phase);
  const auto [state, known] = state_.assemblies.get(key, [&] {
    const RingCompliance& ring = ring_->compliance;
    if (gear_.wave_generator.shape == WaveGeneratorShape::four_force) {
      return std::make_shared<const Outcome<AssembledState>>(
          hold_at_lines(ring, *gear_.wave_generator.force_angle_deg * degree,
                        (*curve_)->displacement(*gear_.wave_generator.force_angle_deg * degree).u_mm, phase));
    }
    ContactSolver solver;
    return std::make_shared<const Outcome<AssembledState>>(assemble(ring, *surface_, phase, solver));
  });
  if (reused)
    *reused = *reused && known;
  if (!*state)
    return state->failure();
  return std::shared_ptr<const AssembledState>(state, &state->value());
}

std::optional<Failure> Analysis::shift_discs(bool& reused) {
  if (!gear_.contact.reference_section_mm)
    return std::nullopt;
  constexpr double tolerance_mm = 1e-9;
  double before = 0.0;
  double excess_before = 0.0;
  for (int step = 0; step < 30; ++step) {
    surface_ = surface_of(gear_, **curve_, disc_shift_);
    const auto assembled = assembly(0.0, &reused);
    if (!assembled)
      return assembled.failure();
    const AssembledPoses poses(ring_->compliance, **assembled, gear_.flexspline.neutral_radius_mm, 0.0,
                               {*gear_.contact.reference_section_mm});
    const double excess = poses.radial(0.0, 0) - gear_.wave_generator.max_radial_deformation_mm;
    if (std::abs(excess) < tolerance_mm)
      return std::nullopt;
    const double slope = step > 0 ? (excess - excess_before) / (disc_shift_ - before) : 1.0;
    before = disc_shift_;
    excess_before = excess;
    disc_shift_ -= excess / slope;
    if (!(std::abs(disc_shift_) < 0.2 * gear_.flexspline.neutral_radius_mm))
      break; // slope lost
  }
  return Failure{Status::not_converged,
                 fmt::format("no shift of the discs brings the section at z = {} mm to u0 = {} mm",
                             *gear_.contact.reference_section_mm,
                             gear_.wave_generator.max_radial_deformation_mm)};
}

std::optional<Failure> Analysis::first_assembly() {
  StageClock clock(result_, "assembly");
  bool reused = true;
  if (auto failure = shift_discs(reused))
    return failure;
  const auto assembled = assembly(0.0, &reused);
  if (!assembled)
    return assembled.failure();
  const AssembledState& a = **assembled;
  AssemblyResult out{.contact_force_n = a.disc_force_n,
                     .contact_lo_deg = a.contact_lo_rad / degree,
                     .contact_hi_deg = a.contact_hi_rad / degree,
                     .disc_shift_mm = disc_shift_,
                     .newton_steps = a.newton_steps};
  const int middle_row = static_cast<int>(ring_->compliance.rows_mm().size() / 2);
  for (std::size_t i = 0; i < a.stations.size(); ++i) { // phase 0: a station stands on the major axis
    if (a.stations[i].row == middle_row && std::abs(a.stations[i].phi_rad) < 1e-9) {
      out.radial_deformation_mm = a.displacement(static_cast<Eigen::Index>(i), 0);
    }
  }
  result_.assembly = out;
  clock.done(reused ? StageStatus::reused : StageStatus::computed);
  return std::nullopt;
}

std::optional<Failure> Analysis::compliance() {
  StageClock clock(result_, "compliance");
  const auto points = loaded_points(0.0);
  if (!points)
    return points.failure();
  const auto assembled = assembly(0.0);
  if (!assembled)
    return assembled.failure();
  const RingCompliance& ring = ring_->compliance;
  std::vector<LoadedPoint> of_teeth; // the point of least take-up of every tooth
  for (const LoadedPoint& point : *points) {
    if (of_teeth.empty() || of_teeth.back().tooth != point.tooth) {
      of_teeth.push_back(point);
    } else if (point.backlash_mm / point.contact_radius_mm <
               of_teeth.back().backlash_mm / of_teeth.back().contact_radius_mm) {
      of_teeth.back() = point;
    }
  }
  const Eigen::MatrixXd d = frozen_compliance(ring, **assembled, tooth_functionals(ring, of_teeth));
  ComplianceResult out;
  for (const LoadedPoint& point : of_teeth)
    out.tooth.push_back(point.tooth);
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    out.matrix_um_per_n.emplace_back();
    for (Eigen::Index j = 0; j < d.cols(); ++j)
      out.matrix_um_per_n.back().push_back(1e3 * d(i, j));
  }
  out.reciprocity_error = reciprocity_error(ring, **assembled, of_teeth, d);
  result_.compliance = std::move(out);
  clock.done(StageStatus::computed);
  if (want_ == Want::compliance) {
    if (const auto flaw = result_.certificate->find_flaw())
      return Failure{Status::certificate_failed, "the certificate does not hold: " + *flaw};
  }
  return std::nullopt;
}

std::optional<Failure> Analysis::backlash_as_assembled() {
  if (gear_.contact.gaps != GapModel::assembled)
    return std::nullopt;
  const auto assembled = assembly(0.0);
  if (!assembled)
    return assembled.failure();
  const std::vector<double> z = backlash_sections(gear_.flexspline);
  std::vector<FlankPair> flanks;
  for (const double at : z) {
    auto pair = FlankPair::make(gear_, face_coordinate(gear_.flexspline, at));
    if (!pair)
      return pair.failure();
    flanks.push_back(std::move(pair).value());
  }
  const AssembledPoses poses(ring_->compliance, **assembled, gear_.flexspline.neutral_radius_mm, 0.0, z);
  std::vector<double> phi; // of one lobe; the other stands alike
  const Backlash& table = tables_.at(0.0);
  for (std::size_t i = 0; i < table.tooth.size(); ++i) {
    if (table.lobe[i] == 0)
      phi.push_back(table.phi_rad[i]);
  }
  AssembledBacklash b = assembled_backlash(
      poses, flanks, z, phi, static_cast<double>(gear_.flexspline.teeth) / gear_.circular_spline.teeth);
  b.interference = b.min_um < 0.0;
  // the kinematic sentence speaks of a cup that does not stand like that
  result_.message.clear();
  if (b.interference) {
    result_.message = fmt::format("the flanks of the assembled cup interfere before any load: least backlash "
                                  "{:.3f} µm at φ = {:.3f}°, z = {:.3f} mm",
                                  b.min_um, b.min_phi_deg, b.min_z_mm);
  }
  result_.backlash->assembled = std::move(b);
  return std::nullopt;
}

} // namespace strainwave
