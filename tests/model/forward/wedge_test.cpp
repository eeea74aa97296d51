// Drive and coast flanks together: signs, mirror symmetry, wedged gears at rest, against solutions by other
// methods.

#include "strainwave/model/export/result_json.hpp"
#include "strainwave/model/flexspline/response_request.hpp"
#include "strainwave/model/flexspline/responses.hpp"
#include "strainwave/model/forward/forward.hpp"
#include "strainwave/model/loading/load_cases.hpp"
#include "strainwave/model/loading/phase_model.hpp"
#include "strainwave/model/meshing/flank_points.hpp"
#include "strainwave/model/meshing/gear_surface.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace strainwave {
namespace {

Gear seed_with(double profile_shift, ForceDirection direction = ForceDirection::flank_normal) {
  Gear gear = seed_gear();
  gear.circular_spline.profile_shift = profile_shift;
  gear.contact.force_direction = direction;
  gear.load.torque_nm = {7.0};
  return gear;
}

/// Finite elements once for each number of points: the cup is the same in every test here.
const UnitResponses& cup_of(const Gear& gear) {
  static std::map<std::pair<int, int>, UnitResponses> solved;
  const std::pair key(gear.contact.flank_points, gear.contact.face_slices);
  const auto found = solved.find(key);
  return found != solved.end()
             ? found->second
             : solved.emplace(key, unit_responses(response_request(gear)).value()).first->second;
}

/// All that a PhaseModel is made of, kept together.
struct Pair {
  Pair(const Gear& given, MeshingPhase at_phase)
      : gear(given), responses(cup_of(gear)), ring(responses, contact_rows(gear), true),
        curve(NeutralCurve::make(gear.wave_generator, gear.flexspline).value()),
        discs(surface_of(gear, curve)) {
    ContactSolver solver;
    assembled =
        std::make_shared<const AssembledState>(assemble(ring, discs, at_phase.value(), solver).value());
    for (const double z : slice_places(responses))
      flanks.push_back(FlankPair::make(gear, face_coordinate(gear.flexspline, z)).value());
    drive = points_at(at_phase);
    coast = points_at(at_phase.mirrored());
    for (LoadedPoint& point : coast) {
      point.tooth = mirrored_tooth(point.tooth, at_phase);
      point.phi_rad = -point.phi_rad;
      point.coast = true;
    }
    std::reverse(coast.begin(), coast.end());
    all = drive;
    all.insert(all.end(), coast.begin(), coast.end());
  }
  std::vector<LoadedPoint> points_at(MeshingPhase phase) const {
    return flank_points(gear, responses, backlash(gear, curve, phase.value()).value(), flanks,
                        [&](int, double phi, int) { return curve.pose(phi); });
  }
  PhaseModel model() const { return {gear.contact, ring, discs, assembled, drive, coast}; }

  Gear gear;
  const UnitResponses& responses;
  RingCompliance ring;
  NeutralCurve curve;
  WaveGeneratorSurface discs;
  std::shared_ptr<const AssembledState> assembled;
  std::vector<FlankPair> flanks;
  std::vector<LoadedPoint> drive, coast, all;
};

double sum(const std::vector<double>& forces) {
  double total = 0.0;
  for (const double force : forces)
    total += force;
  return total;
}

TEST(Wedge, TurningBackIsTheMirrorImageOfTurningForwards) {
  // No symmetry of the finite elements is used anywhere: the coast flank has its own hats. What a rotation of
  // −θ does on the coast flanks must be what θ does on the drive flanks.
  for (const ForceDirection direction : {ForceDirection::circumferential, ForceDirection::flank_normal}) {
    const Pair pair(seed_with(2.19, direction), MeshingPhase{});
    const PhaseModel model = pair.model();
    ContactSolver solver;
    const PhaseLoad forwards = model.at_rotation(2.5e-3, solver).value();
    const PhaseLoad back = model.at_rotation(-2.5e-3, solver).value();
    EXPECT_GT(forwards.torque_nm, 5.0);
    EXPECT_NEAR(back.torque_nm, -forwards.torque_nm, 1e-8);
    EXPECT_EQ(sum(forwards.coast_force_n), 0.0);
    EXPECT_EQ(sum(back.force_n), 0.0);
    ASSERT_EQ(back.coast_force_n.size(), forwards.force_n.size());
    for (std::size_t i = 0; i < forwards.force_n.size(); ++i) {
      EXPECT_NEAR(back.coast_force_n[i], forwards.force_n[forwards.force_n.size() - 1 - i], 1e-6) << i;
    }
  }
}

TEST(Wedge, AForceOnTheCoastFlankTurnsTheToothForwards) {
  const Pair pair(seed_with(2.19), MeshingPhase{});
  const LoadedPoint& drive = pair.drive[pair.drive.size() / 2];
  const LoadedPoint* same = nullptr;
  for (const LoadedPoint& point : pair.coast)
    if (point.tooth == drive.tooth)
      same = &point;
  ASSERT_NE(same, nullptr);
  const auto functionals = tooth_functionals(pair.ring, std::vector<LoadedPoint>{drive, *same});
  // F on the tooth is minus the functional: a coast force moves the drive flank out along its own normal
  // (towards larger φ), and a drive force moves it back, further than the coast force on the far side does.
  const Eigen::VectorXd by_coast =
      pair.ring.tooth_displacement(functionals, functionals, Eigen::VectorXd(-Eigen::VectorXd::Unit(2, 1)));
  const Eigen::VectorXd by_drive =
      pair.ring.tooth_displacement(functionals, functionals, Eigen::VectorXd(-Eigen::VectorXd::Unit(2, 0)));
  EXPECT_GT(by_coast(0), 0.0);
  EXPECT_LT(by_coast(1), 0.0);
  EXPECT_LT(by_drive(0), 0.0);
  EXPECT_LT(by_coast(0), -by_drive(0));
  EXPECT_NEAR(by_coast(0), by_drive(1), 1e-12 * by_coast(0)); // Maxwell and Betti
}

TEST(Wedge, AtRestOnAMirrorPhaseTheForcesAreMirrorImages) {
  const Pair pair(seed_with(2.08), MeshingPhase{});
  const PhaseModel model = pair.model();
  EXPECT_GT(model.overlap_rad(), 0.0);
  ContactSolver solver;
  const PhaseLoad rest = model.at_torque(0.0, solver).value();
  EXPECT_NEAR(rest.rotation_rad, 0.0, 1e-11);
  EXPECT_NEAR(rest.torque_nm, 0.0, 1e-9);
  EXPECT_GT(sum(rest.force_n), 10.0);
  const std::size_t n = rest.force_n.size();
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(rest.coast_force_n[i], rest.force_n[n - 1 - i], 1e-6) << i;
}

TEST(Wedge, PhasesThatMirrorEachOtherRestAtOppositeRotations) {
  const Gear gear = seed_with(2.08);
  ContactSolver solver;
  const PhaseLoad early = Pair(gear, MeshingPhase{1, 4}).model().at_torque(0.0, solver).value();
  const PhaseLoad late = Pair(gear, MeshingPhase{3, 4}).model().at_torque(0.0, solver).value();
  EXPECT_GT(std::abs(early.rotation_rad), 1e-7);
  EXPECT_NEAR(early.rotation_rad, -late.rotation_rad, 1e-11);
  EXPECT_NEAR(sum(early.force_n), sum(late.coast_force_n), 1e-6);
}

/// Projected Gauss–Seidel at a rotation, to convergence.
Eigen::VectorXd gauss_seidel(const ContactProblem& problem, double rotation, Eigen::VectorXd z) {
  const Eigen::VectorXd b = problem.q - rotation * problem.r;
  for (int sweep = 0; sweep < 200000; ++sweep) {
    double change = 0.0;
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      const double next = std::max(0.0, z(i) - (b(i) + problem.m.row(i).dot(z)) / problem.m(i, i));
      change = std::max(change, std::abs(next - z(i)));
      z(i) = next;
    }
    if (change < 1e-11)
      break;
  }
  return z;
}

TEST(Wedge, RestEqualsProjectedGaussSeidelWithABisectedRotation) {
  Gear gear = seed_with(2.08);
  gear.contact.fidelity = Fidelity::linear;
  gear.contact.window_deg = {-21.0, 51.0};
  const Pair pair(gear, MeshingPhase{1, 4});
  ContactSolver solver;
  const PhaseLoad rest = pair.model().at_torque(0.0, solver).value();

  const ContactProblem all = linear_problem(pair.ring, *pair.assembled, pair.all).problem;
  double low = -1e-3;
  double high = 1e-3;
  Eigen::VectorXd z = Eigen::VectorXd::Zero(all.size());
  for (int step = 0; step < 45; ++step) {
    const double middle = 0.5 * (low + high);
    z = gauss_seidel(all, middle, z);
    (all.r.dot(z) < 0.0 ? low : high) = middle;
  }
  EXPECT_NEAR(rest.rotation_rad, 0.5 * (low + high), 1e-10);
  const std::vector<double> force = PhaseModel::all_forces(rest);
  for (std::size_t i = 0; i < force.size();
       ++i) // torque per rotation of 5e6 N·mm/rad over R, times the 1e-10 rad above
    EXPECT_NEAR(force[i], z(static_cast<Eigen::Index>(i)), 1e-4) << i;
}

TEST(Wedge, OnePairOfFlanksIsAClosedFormAndLinearInTheOverlap) {
  // x2 so that two teeth alone overlap: tooth 2 on the drive flank, tooth −2 on the coast flank. By symmetry
  // both carry F at θ = 0: (D_dd + D_dc) F = −c.
  Gear gear = seed_with(2.137);
  gear.contact.fidelity = Fidelity::linear;
  double least_overlap = 0.0;
  double least_force = 0.0;
  for (const double profile_shift : {2.1375, 2.135}) {
    gear.circular_spline.profile_shift = profile_shift;
    const Pair pair(gear, MeshingPhase{});
    ContactSolver solver;
    const PhaseLoad rest = pair.model().at_torque(0.0, solver).value();
    const std::size_t i = static_cast<std::size_t>(
        std::max_element(rest.force_n.begin(), rest.force_n.end()) - rest.force_n.begin());
    const std::size_t j = rest.force_n.size() - 1 - i;
    ASSERT_EQ(std::count_if(rest.force_n.begin(), rest.force_n.end(), [](double f) { return f > 0.0; }), 1);
    const std::vector<LoadedPoint> two = {pair.drive[i], pair.coast[j]};
    const Eigen::MatrixXd d =
        frozen_compliance(pair.ring, *pair.assembled, tooth_functionals(pair.ring, two));
    const double overlap = -pair.drive[i].backlash_mm * std::cos(pair.drive[i].pressure_angle_rad);
    ASSERT_GT(overlap, 0.0);
    EXPECT_NEAR(rest.force_n[i], overlap / (d(0, 0) + d(0, 1)), 1e-9 * rest.force_n[i]);
    EXPECT_NEAR(rest.coast_force_n[j], rest.force_n[i], 1e-8 * rest.force_n[i]);
    if (least_force > 0.0) { // contact height and pressure angle hardly move
      EXPECT_NEAR(rest.force_n[i] / least_force, overlap / least_overlap, 1e-2 * overlap / least_overlap);
    }
    least_overlap = overlap;
    least_force = rest.force_n[i];
  }
}

TEST(Wedge, SelectionGivesTheSolutionOfAllPointsOfBothFlanks) {
  Gear gear = seed_with(2.12);
  gear.contact.flank_points = 5;
  gear.contact.face_slices = 3;
  gear.contact.window_deg = {-21.0, 51.0};
  const Pair pair(gear, MeshingPhase{1, 4});
  const PhaseModel model = pair.model();
  const LoadProblem all = unilateral_problem(pair.ring, *pair.assembled, pair.all);
  ContactSolver solver;
  for (const double torque_nm : {0.0, 1.0, 7.0}) {
    const PhaseLoad load = model.at_torque(torque_nm, solver).value();
    const ContactState start = solver.solve_torque(all.problem, 0.5e3 * torque_nm).value();
    const ExactLoad exact =
        correct_to_exact_gap(pair.ring, pair.discs, *pair.assembled, all, start, Control::torque, solver)
            .value();
    EXPECT_TRUE(exact.certificate.holds());
    EXPECT_NEAR(load.rotation_rad, exact.state.rotation, 1e-12) << torque_nm;
    const std::vector<double> force = PhaseModel::all_forces(load);
    for (std::size_t i = 0; i < force.size(); ++i)
      EXPECT_NEAR(force[i], exact.state.force(static_cast<Eigen::Index>(i)), 1e-7) << torque_nm << " " << i;
    if (torque_nm < 2.0) {
      EXPECT_GT(sum(load.coast_force_n), 0.0);
    }
  }
}

TEST(Wedge, AnalysisOfAWedgedGearSaysHowHard) {
  ForwardModel model({.disk_cache = false});
  Gear gear = seed_with(2.1);
  gear.load.torque_nm = {0.0, 0.1, 7.0};
  gear.load.direction = Direction::both;
  gear.load.phases = 2;
  const ForwardResult result = model.analyze(gear);
  ASSERT_EQ(result.status, Status::ok) << result.message;
  ASSERT_TRUE(result.wedge.has_value());
  const WedgeResult& wedge = *result.wedge;
  EXPECT_GT(wedge.peak_force_n, 1.0);
  EXPECT_GT(wedge.sum_force_n, wedge.peak_force_n);
  EXPECT_EQ(wedge.drive_count, wedge.coast_count);
  // The load at no torque is the rest itself, drive and coast forces together; how well they cancel is the
  // certificate's to say, not the torque's.
  const LoadResult& at_rest = result.load[0];
  EXPECT_EQ(at_rest.torque_nm, 0.0);
  EXPECT_TRUE(result.certificate->holds());
  ASSERT_FALSE(at_rest.coast.tooth.empty());
  EXPECT_NEAR(sum(at_rest.force_n) + sum(at_rest.coast.force_n), wedge.sum_force_n, 1e-6);
  // Lost motion is the elastic turn between ±4 % of the rated torque.
  ASSERT_TRUE(result.stiffness.has_value());
  EXPECT_GT(result.stiffness->lost_motion_arcmin, 0.0);
  EXPECT_EQ(result.stiffness->take_up_rad, 0.0);
  // Coast direction: the mirror image, with the same forces on the other side.
  const LoadResult& driven = result.load[2];
  const LoadResult& coasted = result.load[5];
  EXPECT_EQ(coasted.direction, Direction::coast);
  EXPECT_NEAR(coasted.peak_force_n, driven.peak_force_n, 1e-6);
  EXPECT_NEAR(sum(result.load[4].coast.force_n), sum(result.load[1].coast.force_n), 1e-6);
  const auto json = nlohmann::json::parse(result_json_text(result));
  EXPECT_EQ(json["wedge"]["drive_count"], wedge.drive_count);
  EXPECT_EQ(json["load"][0]["coast"]["force_n"].size(), json["load"][0]["coast"]["tooth"].size());
}

TEST(Wedge, AFreeGearHasNone) {
  ForwardModel model({.disk_cache = false});
  const ForwardResult result = model.analyze(seed_with(2.19));
  EXPECT_FALSE(result.wedge.has_value());
  EXPECT_TRUE(result.load[0].coast.tooth.empty());
  const auto json = nlohmann::json::parse(result_json_text(result));
  EXPECT_TRUE(json["wedge"].is_null());
  EXPECT_FALSE(json["load"][0].contains("coast"));
}

} // namespace
} // namespace strainwave
