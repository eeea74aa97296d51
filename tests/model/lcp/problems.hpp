#pragma once
// Contact problems for tests and benchmarks, each with its origin.

#include "strainwave/model/lcp/solver.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace strainwave::contact_problems {

/// Of the recorded problems.
inline const std::string folder = STRAINWAVE_TEST_REFERENCE;

inline nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error("cannot open " + path);
  return nlohmann::json::parse(file);
}

inline Eigen::VectorXd vector_of(const nlohmann::json& j) {
  const auto v = j.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

inline Eigen::MatrixXd matrix_of(const nlohmann::json& j) {
  Eigen::MatrixXd m(static_cast<Eigen::Index>(j.size()), static_cast<Eigen::Index>(j.front().size()));
  for (Eigen::Index row = 0; row < m.rows(); ++row)
    m.row(row) = vector_of(j[static_cast<std::size_t>(row)]).transpose();
  return m;
}

/// Seed gear, 28 teeth, D of the loaded pair with the discs' contact frozen (reference/load-path.json).
inline ContactProblem load_path(const nlohmann::json& reference) {
  const Eigen::MatrixXd d = matrix_of(reference["D_mm_per_n"]);
  return {0.5 * (d + d.transpose()), vector_of(reference["backlash_mm"]),
          vector_of(reference["contact_radius_mm"])};
}

/// All 140 teeth in one circle, D_ij = 1e-4 exp(−0.3 |i − j|) + 5e-5 δ_ij as in ties(), smooth gaps with a
/// long-wave part, r = 14.5 mm: about 60 teeth close at 4e-3 rad.
inline ContactProblem smooth(int n) {
  ContactProblem p{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd::Constant(n, 14.5)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      p.m(i, j) = 1e-4 * std::exp(-0.3 * std::abs(i - j)) + (i == j ? 5e-5 : 0.0);
    const double angle = std::numbers::pi * (i - 0.37 * n) / n;
    p.q[i] = 4e-3 + 0.11 * std::pow(std::sin(angle), 2) + 2e-3 * std::sin(1.7 * i);
  }
  return p;
}

/// Symmetric gaps: every event concerns a pair. D_ij = 1e-4 exp(−0.3 |i − j|) + 5e-5 δ_ij, c_i = 1e-3 |i
/// − 13.5|, n = 28.
inline ContactProblem ties(int n = 28) {
  ContactProblem p{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd::Constant(n, 1.0)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      p.m(i, j) = 1e-4 * std::exp(-0.3 * std::abs(i - j)) + (i == j ? 5e-5 : 0.0);
    p.q[i] = 1e-3 * std::abs(i - 0.5 * (n - 1));
  }
  return p;
}

/// Fathi 1979: M = L Lᵀ, L with 1 on the diagonal and 2 below; q = −1; solution e1.
inline ContactProblem fathi(int n) {
  Eigen::MatrixXd l = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j)
      l(i, j) = 2.0;
  return {l * l.transpose(), Eigen::VectorXd::Constant(n, -1.0), Eigen::VectorXd::Zero(n)};
}

/// Random M = B Bᵀ / n + shift I with B n × rank; normal q; r uniform in [0.5, 1.5) or zero for the first
/// `supports`.
inline ContactProblem random_spd(int n, int rank, double shift, unsigned seed, int supports = 0) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const auto centred = [&] { return uniform() + uniform() + uniform() + uniform() - 2.0; };
  Eigen::MatrixXd b(n, rank);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < rank; ++j)
      b(i, j) = centred();
  ContactProblem p{b * b.transpose() / rank + shift * Eigen::MatrixXd::Identity(n, n), Eigen::VectorXd(n),
                   Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    p.q[i] = centred();
    p.r[i] = i < supports ? 0.0 : 0.5 + uniform();
  }
  return p;
}

/// The seed gear on its discs: teeth −7 … 20 of load-path.json at tip height and 70 × 2 × 3 wall stations
/// (half the circumference; both lobes are alike, so responses are sums of offsets k and k + 70) of
/// unit-responses.json. With lobes = 2 both halves are unknowns of their own (56 + 840) and every event
/// concerns a pair. Teeth first. z = (F towards smaller φ, p outwards): d = G_tt F − G_tw p, w = G_ww p −
/// G_wt F, hence M = [[G_tt, −G_tw], [−G_wt, G_ww]]. Wall gaps w − [e cos φ + √(R² − e² sin² φ) − r_m],
/// linearised, R = r_m + u0 − e; q of the teeth is backlash − d of the assembly, so that the teeth's gaps on
/// the unloaded discs are the backlash.
inline ContactProblem seed_on_discs(const nlohmann::json& load_reference, const nlohmann::json& responses,
                                    ContactSolver& solver, int lobes = 1) {
  constexpr int sectors = 140, half = 70, rows = 3, stations = 2, per_pitch = rows * stations;
  constexpr double u0 = 0.2, e = 0.6, r_m = 14.006, disc = r_m + u0 - e;
  const auto wrap = [](int k) { return ((k % sectors) + sectors) % sectors; };
  /// Response k sectors further; of a loaded pair when the lobes are folded.
  const auto table = [&](const nlohmann::json& row) {
    const auto v = row.get<std::vector<double>>();
    std::vector<double> sum(v);
    if (lobes == 1)
      for (int k = 0; k < sectors; ++k)
        sum[static_cast<std::size_t>(k)] += v[static_cast<std::size_t>(wrap(k + half))];
    return sum;
  };
  const std::vector<double> tooth_tooth = table(responses["tooth_from_tooth"][1][1]);
  std::vector<std::vector<double>> wall_tooth, wall_wall; // [wall functional], [load × per_pitch + response]
  for (int a = 0; a < per_pitch; ++a)
    wall_tooth.push_back(table(responses["wall_from_tooth"][1][static_cast<std::size_t>(a / rows)]
                                        [static_cast<std::size_t>(a % rows)]));
  for (int b = 0; b < per_pitch; ++b)
    for (int a = 0; a < per_pitch; ++a)
      wall_wall.push_back(table(responses["wall_from_wall"][static_cast<std::size_t>(
          b)][static_cast<std::size_t>(a / rows)][static_cast<std::size_t>(a % rows)]));
  std::vector<int> tooth;
  for (int lobe = 0; lobe < lobes; ++lobe)
    for (const int i : load_reference["tooth"].get<std::vector<int>>())
      tooth.push_back(i + lobe * half);
  const int nt = static_cast<int>(tooth.size()), nw = lobes * half * per_pitch, n = nt + nw;
  const auto sector = [&](int w) { return w / per_pitch - half / 2; };
  const auto at = [&](const std::vector<double>& values, int k) {
    return values[static_cast<std::size_t>(wrap(k))];
  };
  ContactProblem p{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd::Zero(n)};
  for (int i = 0; i < nt; ++i)
    for (int j = 0; j < nt; ++j)
      p.m(i, j) = at(tooth_tooth, tooth[static_cast<std::size_t>(i)] - tooth[static_cast<std::size_t>(j)]);
  for (int w = 0; w < nw; ++w) {
    const int a = w % per_pitch;
    for (int j = 0; j < nt; ++j)
      p.m(nt + w, j) = p.m(j, nt + w) =
          -at(wall_tooth[static_cast<std::size_t>(a)], sector(w) - tooth[static_cast<std::size_t>(j)]);
    for (int v = 0; v < nw; ++v)
      p.m(nt + w, nt + v) =
          at(wall_wall[static_cast<std::size_t>(v % per_pitch * per_pitch + a)], sector(w) - sector(v));
    const int folded =
        (sector(w) + half / 2) % half - half / 2; // the second disc is the first one turned by half a circle
    const double phi = 2.0 * std::numbers::pi * (folded + 0.5 * (a / rows)) / sectors;
    p.q[nt + w] = r_m - e * std::cos(phi) - std::sqrt(disc * disc - std::pow(e * std::sin(phi), 2));
  }
  p.m = (0.5 * (p.m + p.m.transpose())).eval();
  p.q.head(nt).setConstant(1e3); // unloaded discs first: teeth far away
  const ContactState assembled = solver.solve_at(p, 0.0);
  const Eigen::VectorXd backlash = vector_of(load_reference["backlash_mm"]),
                        radius = vector_of(load_reference["contact_radius_mm"]);
  const Eigen::VectorXd moved = p.m.topRightCorner(nt, nw) * assembled.force.tail(nw);
  p.q.head(nt) = backlash.replicate(lobes, 1) - moved;
  p.r.head(nt) = radius.replicate(lobes, 1);
  return p;
}

} // namespace strainwave::contact_problems
