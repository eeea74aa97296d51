#include "strainwave/model/forward/gradient.hpp"

#include "strainwave/common/core/units.hpp"
#include "strainwave/model/forward/run.hpp"
#include "strainwave/model/gear/fields.hpp"
#include "strainwave/model/kinematics/rim_strain.hpp"
#include "strainwave/model/meshing/pressure.hpp"
#include "strainwave/model/slopes/gradient_phase.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

namespace strainwave {

namespace {

/// Keys of the flexspline's tooth are keys of its finite elements as well.
bool acts_on_elements(const std::string& path) {
  return path.starts_with("flexspline.");
}

/// Point forces summed by tooth, in the order of LoadResult: ascending φ of the direction.
Eigen::MatrixXd by_tooth(const std::vector<LoadedPoint>& points, const Eigen::MatrixXd& force,
                         Direction direction) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || points[i].tooth != points[i - 1].tooth)
      first.push_back(i);
  first.push_back(points.size());
  const std::size_t teeth = first.size() - 1;
  Eigen::MatrixXd sum(static_cast<Eigen::Index>(teeth), force.cols());
  for (std::size_t k = 0; k < teeth; ++k) {
    const std::size_t line = direction == Direction::coast ? teeth - 1 - k : k;
    sum.row(static_cast<Eigen::Index>(line)) =
        force
            .middleRows(static_cast<Eigen::Index>(first[k]),
                        static_cast<Eigen::Index>(first[k + 1] - first[k]))
            .colwise()
            .sum();
  }
  return sum;
}

/// Slopes of the least backlash over φ: at a stationary φ, or at an end of the window, φ itself does not
/// matter.
Eigen::VectorXd least_backlash_slopes(const Gear& gear, const NeutralCurve& curve,
                                      const std::vector<std::string>& parameters, double phi_rad) {
  const auto pair = FlankPair::make(gear);
  const double space = phi_rad * gear.flexspline.teeth / gear.circular_spline.teeth;
  const PoseDerivatives pose = curve.pose_derivatives(phi_rad);
  const ToothBacklash contact = pair->drive(pose.value, space);
  const ContactSlopes slopes =
      FlankSlopes(gear, parameters, 0.0)
          .at(kinematic_slopes(curve, parameters, phi_rad), space,
              {.height = {}, .place = contact.place, .kink = contact.kink, .roll = contact.roll});
  return 1e3 * slopes.gap;
}

/// Slopes of the largest contact pressure, and it; only for the phase that has the load's `peak_mpa`.
std::pair<Eigen::VectorXd, double> peak_pressure(FlankPressure& pressure, double peak_mpa,
                                                 const PhaseSlopes& slopes,
                                                 const std::vector<LoadedPoint>& points,
                                                 const PhaseLoad& load, const Eigen::MatrixXd& force) {
  const std::vector<LineContact> contacts = pressure.of(points, load.force_n);
  const auto peak = std::max_element(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) {
    return a.pressure_mpa < b.pressure_mpa;
  });
  if (peak == contacts.end() || !(peak->pressure_mpa > 0.0) || peak->pressure_mpa < peak_mpa)
    return {Eigen::VectorXd::Constant(force.cols(), std::numeric_limits<double>::quiet_NaN()), 0.0};
  return {slopes.pressure(points, load, force, static_cast<std::size_t>(peak - contacts.begin()),
                          peak->pressure_mpa),
          peak->pressure_mpa};
}

/// Of the rim's bending strain: central differences of the curve, whose strain is smooth in its own two
/// numbers.
Eigen::VectorXd rim_strain_slopes(const Gear& gear, const NeutralCurve& curve,
                                  const std::vector<std::string>& parameters) {
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    if (parameters[j] != "wave_generator.max_radial_deformation_mm" &&
        parameters[j] != curve.shape_number_path())
      continue;
    const NumberPath number(parameters[j]);
    const double value = number.get(gear), step = 1e-5 * value;
    const auto at = [&](double other) {
      Gear changed = gear;
      number.set(changed, other);
      const auto moved = NeutralCurve::make(changed.wave_generator, changed.flexspline);
      return moved ? rim_strain(*moved, gear.flexspline.rim_thickness_mm)
                   : std::numeric_limits<double>::quiet_NaN();
    };
    slopes(static_cast<Eigen::Index>(j)) = (at(value + step) - at(value - step)) / (2.0 * step);
  }
  return slopes;
}

std::shared_ptr<const AssembledState> known_assembly(const MountedCup& cup, MeshingPhase phase) {
  auto assembled = cup.assembly(phase);
  if (!assembled) // it was there during the analysis
    throw std::logic_error("the assembly at a meshing phase was lost");
  return std::move(assembled).value();
}

/// The discs follow the parameters so that the radial displacement in the reference section stays u0. radial:
/// its slopes by column of the surface, the shift last.
std::vector<double> shift_slopes(const SlopeInputs& inputs, std::vector<double> radial) {
  const double by_shift = radial.back();
  radial.pop_back();
  for (std::size_t c = 0; c < radial.size(); ++c) {
    const auto parameter = static_cast<std::size_t>(inputs.surface_slopes.parameter()[c]);
    const bool u0 = inputs.parameters[parameter] == "wave_generator.max_radial_deformation_mm";
    radial[c] = -(radial[c] - (u0 ? 1.0 : 0.0)) / by_shift;
  }
  return radial;
}

} // namespace

bool has_exact_gradient(const Gear& gear, const std::string& path) {
  return !acts_on_elements(path) && (is_flank_parameter(gear, path) || is_surface_parameter(gear, path));
}

ForwardGradient ForwardSolution::gradient(std::span<const std::string> parameters) const {
  const MeshedGear& meshed = *run_->meshed;
  const MountedCup& cup = meshed.cup();
  const Gear& gear = meshed.gear();
  const NeutralCurve& curve = cup.curve();
  const ForwardResult& result = run_->result;
  const std::vector<SolvedLoad>& all_solved = run_->solved;
  ForwardGradient g;
  g.parameters.assign(parameters.begin(), parameters.end());
  for (const std::string& path : g.parameters)
    if (!has_exact_gradient(gear, path))
      throw std::invalid_argument("no exact gradient with respect to " + path);
  std::vector<FlankSlopes> flanks;
  for (const double z : slice_places(*cup.ring().responses))
    flanks.emplace_back(gear, g.parameters, face_coordinate(gear.flexspline, z));
  SlopeInputs inputs{.gear = gear,
                     .curve = curve,
                     .ring = cup.ring().compliance,
                     .surface = cup.surface(),
                     .flanks = meshed.flanks(),
                     .flank_slopes = std::move(flanks),
                     .surface_slopes =
                         SurfaceSlopes(gear, curve, cup.surface(), g.parameters, cup.disc_shift_mm()),
                     .parameters = g.parameters};
  if (gear.contact.reference_section_mm && inputs.surface_slopes.columns() > 1)
    inputs.surface_slopes.follow_shift(shift_slopes(
        inputs,
        PhaseSlopes(inputs, known_assembly(cup, MeshingPhase{})).radial(*gear.contact.reference_section_mm)));

  std::map<MeshingPhase, std::unique_ptr<const PhaseSlopes>> phases;
  const auto at_phase = [&](MeshingPhase phase) -> const PhaseSlopes& {
    auto& slopes = phases[phase];
    if (!slopes)
      slopes = std::make_unique<const PhaseSlopes>(inputs, known_assembly(cup, phase));
    return *slopes;
  };
  g.rim_strain = rim_strain_slopes(gear, curve, g.parameters);
  g.assembly_force_n = at_phase(MeshingPhase{}).assembly_force();
  using units::degree;
  if (const auto& assembled = result.backlash->assembled)
    g.min_backlash_um =
        1e3 *
        at_phase(MeshingPhase{}).assembled_backlash(assembled->min_phi_deg * degree, assembled->min_z_mm);
  else
    g.min_backlash_um =
        least_backlash_slopes(gear, curve, g.parameters, result.backlash->min_phi_deg * degree);
  g.load.resize(result.load.size());
  std::vector<PhaseLoadSlopes> known; // by solved load
  FlankPressure flank_pressure(gear);
  for (const SolvedLoad& solved : all_solved) {
    const PhaseSlopes& slopes = at_phase(solved.model_phase);
    const std::vector<LoadedPoint>& points = solved.model->points();
    // The rated torque is often a load of its own as well.
    const auto same =
        std::find_if(all_solved.begin(), all_solved.begin() + static_cast<std::ptrdiff_t>(known.size()),
                     [&](const SolvedLoad& other) {
                       return other.model == solved.model && other.control == solved.control &&
                              other.load.rotation_rad == solved.load.rotation_rad &&
                              other.load.force_n == solved.load.force_n &&
                              other.load.coast_force_n == solved.load.coast_force_n;
                     });
    const auto at = static_cast<std::size_t>(same - all_solved.begin());
    known.push_back(at < known.size()
                        ? known[at]
                        : slopes.of(solved.model->all_points(), PhaseModel::all_forces(solved.load),
                                    solved.load, solved.control));
    const PhaseLoadSlopes& of = known.back();
    switch (solved.use) {
    case SolvedLoad::Use::rated:
      g.rated_rotation_rad = of.rotation_rad;
      g.take_up_rad = solved.model->least_take_up_rad() > 0.0 ? slopes.least_take_up(points)
                                                              : Eigen::VectorXd::Zero(of.rotation_rad.size());
      break;
    case SolvedLoad::Use::small:
      g.small_rotation_rad = of.rotation_rad;
      break;
    case SolvedLoad::Use::load_case: {
      const auto [pressure, largest] =
          peak_pressure(flank_pressure, result.load[solved.load_case].peak_pressure.mpa, slopes, points,
                        solved.load, of.force_n);
      g.load[solved.load_case].push_back({.force_n = by_tooth(points, of.force_n, solved.direction),
                                          .rotation_rad = of.rotation_rad,
                                          .torque_nm = of.torque_nm,
                                          .tangent_nm_per_rad = of.tangent_nm_per_rad,
                                          .disc_force_n = of.disc_force_n,
                                          .peak_pressure_mpa = pressure,
                                          .largest_pressure_mpa = largest});
    }
    }
  }
  return g;
}

ForwardResult ForwardModel::analyze(const Gear& gear,
                                    std::shared_ptr<const ForwardSolution>& solution) const {
  const auto run = std::make_shared<const Run>(complete_run(stages_, gear, {.lean = true}));
  solution = run->result.status == Status::ok ? std::make_shared<const ForwardSolution>(run) : nullptr;
  return run->result;
}

} // namespace strainwave
