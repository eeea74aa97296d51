// Samples of the whole ring against the general solver on the whole problem, against the forward model, and
// the tangent against exact contact.

#include "strainwave/model/forward/ring_pair.hpp"
#include "strainwave/model/lcp/sampled_contact.hpp"
#include "tests/model/forward/shared_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace strainwave {
namespace {

const NominalMesh& seed_mesh() {
  static const NominalMesh mesh = nominal_mesh(testing_support::shared_model(), seed_gear()).value();
  return mesh;
}

const LoadTangent& seed_load() {
  static const LoadTangent load = nominal_load(seed_mesh(), 7.0).value();
  return load;
}

/// Errors of single teeth: gaps ± some µm, lever arms ± some hundredths.
struct RandomTeeth {
  std::vector<double> gap, radius;
  RandomTeeth(const ContactProblem& problem, int teeth, unsigned seed, double gap_mm) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> error(-1.0, 1.0);
    for (int i = 0; i < teeth; ++i) {
      gap.push_back(problem.q(i) + gap_mm * error(random));
      radius.push_back(problem.r(i) + 0.02 * error(random));
    }
  }
  ContactSample sample(std::span<const double> amplitude = {}) const { return {gap, radius, amplitude}; }
};

TEST(SampledContact, NominalSampleOfTheRingIsTheForwardModelsLoad) {
  Gear gear = seed_gear();
  gear.load.torque_nm = {7.0};
  const ForwardResult folded = testing_support::shared_model().analyze(gear);
  const LoadResult& load = folded.load.at(0);
  const SampledContact contact(seed_load().problem, static_cast<int>(seed_mesh().teeth.size()),
                               seed_load().state);
  SampleSolver solver(contact);
  SampledState state;
  const auto n = static_cast<Eigen::Index>(contact.teeth());
  const std::vector<double> q(contact.problem().q.begin(), contact.problem().q.begin() + n);
  const std::vector<double> r(contact.problem().r.begin(), contact.problem().r.begin() + n);
  ASSERT_FALSE(solver.solve_torque({q, r, {}}, 7000.0, state));
  EXPECT_EQ(state.changed_stations, 0);
  EXPECT_FALSE(state.fallback);
  // both end their Newton steps below 1e-11 mm of the wall's gap, whose sums over some hundred stations move
  // θ R by 1e-10
  EXPECT_NEAR(state.rotation, load.rotation_rad, 1e-9 / 14.7);
  EXPECT_NEAR(*std::max_element(state.force.begin(), state.force.end()), load.peak_force_n,
              1e-7 * load.peak_force_n);
  EXPECT_EQ(std::count_if(state.force.begin(), state.force.end(), [](double f) { return f > 0.0; }),
            2 * load.engaged_count);
}

TEST(SampledContact, RandomSamplesAreTheGeneralSolversSolutions) {
  const ContactProblem& nominal = seed_load().problem;
  const int teeth = static_cast<int>(seed_mesh().teeth.size());
  const SampledContact contact(nominal, teeth, seed_load().state);
  SampleSolver solver(contact);
  ContactSolver general;
  int changed = 0;
  for (unsigned k = 0; k < 20; ++k) {
    const RandomTeeth errors(nominal, teeth, k, k % 2 ? 2e-3 : 10e-3);
    SampledState state;
    ASSERT_FALSE(solver.solve_torque(errors.sample(), 7000.0, state));
    ContactProblem whole = nominal;
    whole.q.head(teeth) = Eigen::Map<const Eigen::VectorXd>(errors.gap.data(), teeth);
    whole.r.head(teeth) = Eigen::Map<const Eigen::VectorXd>(errors.radius.data(), teeth);
    const ContactState exact = general.solve_torque(whole, 7000.0, seed_load().state.active).value();
    ASSERT_FALSE(state.fallback);
    changed += state.changed_stations;
    const double scale = exact.force.head(teeth).maxCoeff();
    EXPECT_NEAR(state.rotation, exact.rotation, 1e-9 * exact.rotation);
    EXPECT_NEAR(state.stiffness, exact.stiffness, 1e-8 * exact.stiffness);
    for (int i = 0; i < teeth; ++i) {
      EXPECT_NEAR(state.force[static_cast<std::size_t>(i)], exact.force(i), 1e-9 * scale);
      EXPECT_NEAR(state.gap[static_cast<std::size_t>(i)], exact.gap(i), 1e-9 * 0.01);
    }
  }
  EXPECT_GT(changed, 20); // the wall's contact did not stay as it was
}

TEST(SampledContact, FallBackGivesTheSameAnswer) {
  const int teeth = static_cast<int>(seed_mesh().teeth.size());
  const SampledContact contact(seed_load().problem, teeth, seed_load().state);
  const RandomTeeth errors(seed_load().problem, teeth, 7, 5e-3);
  SampleSolver blocks(contact), whole(contact, {.max_steps = 0});
  SampledState a, b;
  ASSERT_FALSE(blocks.solve_torque(errors.sample(), 7000.0, a));
  ASSERT_FALSE(whole.solve_torque(errors.sample(), 7000.0, b));
  EXPECT_FALSE(a.fallback);
  EXPECT_TRUE(b.fallback);
  EXPECT_NEAR(a.rotation, b.rotation, 1e-9 * b.rotation);
  EXPECT_EQ(a.changed_stations, b.changed_stations);
  for (std::size_t i = 0; i < a.force.size(); ++i)
    EXPECT_NEAR(a.force[i], b.force[i], 1e-7);
}

TEST(SampledContact, NoSampleShapesTheNext) {
  const int teeth = static_cast<int>(seed_mesh().teeth.size());
  const SampledContact contact(seed_load().problem, teeth, seed_load().state);
  const RandomTeeth one(seed_load().problem, teeth, 1, 5e-3), two(seed_load().problem, teeth, 2, 20e-3);
  SampleSolver fresh(contact), used(contact);
  SampledState a, b;
  ASSERT_FALSE(fresh.solve_torque(one.sample(), 7000.0, a));
  ASSERT_FALSE(used.solve_torque(two.sample(), 9000.0, b));
  ASSERT_FALSE(used.solve_torque(one.sample(), 7000.0, b));
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.gap, b.gap);
}

/// Largest tooth force and rotation of errors, with exact discs and all Newton steps on the whole ring.
struct Exact {
  double rotation = 0.0, peak = 0.0;
};
Exact exact_load(const NominalMesh& mesh, const RandomTeeth& errors, const ContactProblem& tangent) {
  std::vector<LoadedPoint> teeth = mesh.teeth;
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    teeth[i].backlash_mm += errors.gap[i] - tangent.q(static_cast<Eigen::Index>(i));
    teeth[i].contact_radius_mm = errors.radius[i];
  }
  ContactSolver solver;
  const LoadProblem load = unilateral_problem(*mesh.ring, mesh.assembled, teeth);
  const ContactState start = solver.solve_torque(load.problem, 7000.0, seed_load().state.active).value();
  const ExactLoad exact =
      correct_to_exact_gap(*mesh.ring, mesh.surface, mesh.assembled, load, start, Control::torque, solver)
          .value();
  return {exact.state.rotation, exact.state.force.head(load.point_count).maxCoeff()};
}

TEST(LoadTangent, LeavesOutTermsOfSecondOrderAlone) {
  const int teeth = static_cast<int>(seed_mesh().teeth.size());
  const SampledContact contact(seed_load().problem, teeth, seed_load().state);
  SampleSolver solver(contact);
  double rotation[2] = {}, peak[2] = {};
  for (const int size : {0, 1}) {
    for (unsigned k = 0; k < 3; ++k) {
      const RandomTeeth errors(seed_load().problem, teeth, 40 + k, size == 0 ? 8e-3 : 2e-3);
      SampledState state;
      ASSERT_FALSE(solver.solve_torque(errors.sample(), 7000.0, state));
      const Exact exact = exact_load(seed_mesh(), errors, seed_load().problem);
      rotation[size] = std::max(rotation[size], std::abs(state.rotation - exact.rotation) / exact.rotation);
      peak[size] = std::max(peak[size],
                            std::abs(*std::max_element(state.force.begin(), state.force.end()) - exact.peak) /
                                exact.peak);
    }
  }
  // measured: rotation 1e-5 and 8e-7, peak 2e-6 and 1e-6; a quarter of the errors leaves a sixteenth
  EXPECT_LT(rotation[0], 3e-5);
  EXPECT_LT(rotation[1], 0.2 * rotation[0]);
  EXPECT_LT(peak[0], 3e-5);
}

} // namespace
} // namespace strainwave
