#pragma once
// Contact problems for tests and benchmarks, each with its origin.

#include "model/contact/lcp.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace strainwave::contact_problems {

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
/// unit-responses.json. Teeth first. z = (F towards smaller φ, p outwards): d = G_tt F − G_tw p, w = G_ww p −
/// G_wt F, hence M = [[G_tt, −G_tw], [−G_wt, G_ww]]. Wall gaps w − [e cos φ + √(R² − e² sin² φ) − r_m],
/// linearised, R = r_m + u0 − e; q of the teeth is backlash − d of the assembly, so that the teeth's gaps on
/// the unloaded discs are the backlash.
inline ContactProblem seed_on_discs(const nlohmann::json& load_reference, const nlohmann::json& responses,
                                    ContactSolver& solver) {
  constexpr int teeth = 140, lobe = 70, rows = 3, stations = 2;
  constexpr double u0 = 0.2, e = 0.6, r_m = 14.006, disc = r_m + u0 - e;
  const auto& tooth_tooth = responses["tooth_from_tooth"][1][1];
  const auto& wall_tooth = responses["wall_from_tooth"][1];
  const auto& wall_wall = responses["wall_from_wall"];
  const auto pair = [](const nlohmann::json& row, int k) {
    const int wrapped = ((k % teeth) + teeth) % teeth;
    return row[static_cast<std::size_t>(wrapped)].get<double>() +
           row[static_cast<std::size_t>((wrapped + lobe) % teeth)].get<double>();
  };
  const auto tooth = load_reference["tooth"].get<std::vector<int>>();
  const int nt = static_cast<int>(tooth.size()), per_pitch = stations * rows, nw = lobe * per_pitch,
            n = nt + nw;
  ContactProblem p{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd::Zero(n)};
  const auto sector = [&](int w) { return w / per_pitch - lobe / 2; };
  const auto station = [&](int w) { return static_cast<std::size_t>(w % per_pitch / rows); };
  const auto row_of = [&](int w) { return static_cast<std::size_t>(w % rows); };
  std::vector<double> tt(teeth), wt(static_cast<std::size_t>(teeth * per_pitch)),
      ww(static_cast<std::size_t>(teeth * per_pitch * per_pitch));
  for (int k = 0; k < teeth; ++k) {
    tt[static_cast<std::size_t>(k)] = pair(tooth_tooth, k);
    for (int a = 0; a < per_pitch; ++a) {
      wt[static_cast<std::size_t>(k * per_pitch + a)] = pair(wall_tooth[station(a)][row_of(a)], k);
      for (int b = 0; b < per_pitch; ++b)
        ww[static_cast<std::size_t>((k * per_pitch + a) * per_pitch + b)] =
            pair(wall_wall[static_cast<std::size_t>(b)][station(a)][row_of(a)], k);
    }
  }
  const auto wrap = [](int k) { return ((k % teeth) + teeth) % teeth; };
  for (int i = 0; i < nt; ++i)
    for (int j = 0; j < nt; ++j)
      p.m(i, j) = tt[static_cast<std::size_t>(
          wrap(tooth[static_cast<std::size_t>(i)] - tooth[static_cast<std::size_t>(j)]))];
  for (int w = 0; w < nw; ++w) {
    for (int j = 0; j < nt; ++j)
      p.m(nt + w, j) = p.m(j, nt + w) = -wt[static_cast<std::size_t>(
          wrap(sector(w) - tooth[static_cast<std::size_t>(j)]) * per_pitch + w % per_pitch)];
    for (int v = 0; v < nw; ++v)
      p.m(nt + w, nt + v) = ww[static_cast<std::size_t>(
          (wrap(sector(w) - sector(v)) * per_pitch + w % per_pitch) * per_pitch + v % per_pitch)];
    const double phi = 2.0 * std::numbers::pi * (sector(w) + 0.5 * static_cast<double>(station(w))) / teeth;
    p.q[nt + w] = r_m - e * std::cos(phi) - std::sqrt(disc * disc - std::pow(e * std::sin(phi), 2));
  }
  p.m = (0.5 * (p.m + p.m.transpose())).eval();
  // Unloaded discs first: teeth far away.
  p.q.head(nt).setConstant(1e3);
  const ContactState assembled = solver.solve_at(p, 0.0);
  p.q.head(nt) =
      vector_of(load_reference["backlash_mm"]) - p.m.topRightCorner(nt, nw) * assembled.force.tail(nw);
  p.r.head(nt) = vector_of(load_reference["contact_radius_mm"]);
  return p;
}

} // namespace strainwave::contact_problems
