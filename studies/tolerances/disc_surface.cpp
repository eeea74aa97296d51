#include "strainwave/studies/tolerances/disc_surface.hpp"

#include "strainwave/common/core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace strainwave {

namespace {

using units::pi;

double node(int k, int terms) {
  return std::cos(pi * (k + 0.5) / terms);
}
double placed(double x, double lower, double upper) {
  return 0.5 * (lower + upper) + 0.5 * (upper - lower) * x;
}
double unit(double value, double lower, double upper) {
  return upper > lower ? (2.0 * value - lower - upper) / (upper - lower) : 0.0;
}

/// T_0 … T_(terms − 1) at x.
void polynomials(double x, int terms, double* t) {
  t[0] = 1.0;
  if (terms > 1)
    t[1] = x;
  for (int k = 2; k < terms; ++k)
    t[k] = 2.0 * x * t[k - 1] - t[k - 2];
}

DiscSurface::Change difference(const MeshAtDiscs& a, const MeshAtDiscs& b, std::size_t i) {
  return {a.pose[i].rho_mm - b.pose[i].rho_mm, a.pose[i].phi1_rad - b.pose[i].phi1_rad,
          a.pose[i].normal_rotation_rad - b.pose[i].normal_rotation_rad,
          a.tooth_shift_mm[i] - b.tooth_shift_mm[i]};
}

} // namespace

Outcome<std::vector<DiscSurface::Change>> disc_change(const NominalMesh& mesh, const MeshAtDiscs& nominal,
                                                      double u0_mm, double e_mm) {
  const auto there = mesh_at_discs(mesh, u0_mm, e_mm);
  if (!there)
    return there.failure();
  std::vector<DiscSurface::Change> change;
  for (std::size_t i = 0; i < nominal.pose.size(); ++i)
    change.push_back(difference(*there, nominal, i));
  return change;
}

Outcome<DiscSurface> DiscSurface::make(const NominalMesh& mesh, const DiscBox& box,
                                       const DiscSurfaceOptions& options) {
  DiscSurface surface;
  surface.box_ = box;
  surface.teeth_ = mesh.teeth.size();
  const double u0 = mesh.gear.wave_generator.max_radial_deformation_mm;
  const double e = *mesh.curve.summary().eccentricity_mm;
  const auto nominal = mesh_at_discs(mesh, u0, e);
  if (!nominal)
    return nominal.failure();
  // points between the nodes: those of a lattice (Kronecker), the same for every degree
  constexpr int checks = 8;
  std::vector<std::pair<double, double>> points;
  std::vector<std::vector<Change>> exact;
  for (int k = 0; k < checks; ++k) {
    const double a = std::fmod(0.5 + 0.7548776662466927 * k, 1.0),
                 b = std::fmod(0.5 + 0.5698402909980532 * k, 1.0);
    points.emplace_back(placed(2.0 * a - 1.0, box.u0_lower, box.u0_upper),
                        placed(2.0 * b - 1.0, box.e_lower, box.e_upper));
    auto change = disc_change(mesh, *nominal, points.back().first, points.back().second);
    if (!change)
      return change.failure();
    exact.push_back(std::move(change).value());
  }
  std::vector<Change> found(surface.teeth_);
  for (int degree = 2;; degree += 2) {
    surface.along_u0_ = box.u0_upper > box.u0_lower ? degree + 1 : 1;
    surface.along_e_ = box.e_upper > box.e_lower ? degree + 1 : 1;
    std::vector<MeshAtDiscs> nodes;
    for (int i = 0; i < surface.along_u0_; ++i) {
      for (int j = 0; j < surface.along_e_; ++j) {
        auto there = mesh_at_discs(mesh, placed(node(i, surface.along_u0_), box.u0_lower, box.u0_upper),
                                   placed(node(j, surface.along_e_), box.e_lower, box.e_upper));
        if (!there)
          return there.failure();
        nodes.push_back(std::move(there).value());
      }
    }
    surface.fit(mesh, nodes, degree);
    surface.nominal_.assign(surface.teeth_, {});
    surface.evaluate(u0, e, surface.nominal_);
    surface.error_ = 0.0;
    for (int k = 0; k < checks; ++k) {
      const auto at = static_cast<std::size_t>(k);
      surface.at(points[at].first, points[at].second, found);
      for (std::size_t i = 0; i < surface.teeth_; ++i) {
        const Change &a = found[i], &b = exact[at][i];
        const double r = mesh.teeth[i].contact_radius_mm, high = r - mesh.pose[i].rho_mm;
        surface.error_ =
            std::max({surface.error_, std::abs(a.rho_mm - b.rho_mm), r * std::abs(a.phi1_rad - b.phi1_rad),
                      high * std::abs(a.normal_rotation_rad - b.normal_rotation_rad),
                      std::abs(a.shift_mm - b.shift_mm)});
      }
    }
    if (surface.error_ < options.tolerance_mm || degree + 2 > options.largest_degree)
      break;
  }
  if (!(surface.error_ < options.most_mm)) {
    return Failure{
        Status::not_converged,
        fmt::format(
            "the assembled state over u0 {:.6g} … {:.6g} mm and e {:.6g} … {:.6g} mm is met to {:.3g} "
            "µm by polynomials of degree {}, at most {:.3g} µm is allowed; take narrower distributions",
            box.u0_lower, box.u0_upper, box.e_lower, box.e_upper, 1e3 * surface.error_, surface.degree_,
            1e3 * options.most_mm)};
  }
  return surface;
}

void DiscSurface::fit(const NominalMesh& mesh, const std::vector<MeshAtDiscs>& nodes, int degree) {
  degree_ = degree;
  const auto n = 4 * mesh.teeth.size();
  const auto terms = static_cast<std::size_t>(along_u0_ * along_e_);
  coefficient_.assign(terms * n, 0.0);
  std::vector<double> tu(static_cast<std::size_t>(along_u0_)), te(static_cast<std::size_t>(along_e_));
  for (int i = 0; i < along_u0_; ++i) {
    polynomials(node(i, along_u0_), along_u0_, tu.data());
    for (int j = 0; j < along_e_; ++j) {
      polynomials(node(j, along_e_), along_e_, te.data());
      const MeshAtDiscs& here = nodes[static_cast<std::size_t>(i * along_e_ + j)];
      for (int a = 0; a < along_u0_; ++a) {
        for (int b = 0; b < along_e_; ++b) {
          const double weight = (a ? 2.0 : 1.0) * (b ? 2.0 : 1.0) / (along_u0_ * along_e_) *
                                tu[static_cast<std::size_t>(a)] * te[static_cast<std::size_t>(b)];
          double* c = coefficient_.data() + static_cast<std::size_t>(a * along_e_ + b) * n;
          for (std::size_t t = 0; t < mesh.teeth.size(); ++t) {
            c[4 * t] += weight * here.pose[t].rho_mm;
            c[4 * t + 1] += weight * here.pose[t].phi1_rad;
            c[4 * t + 2] += weight * here.pose[t].normal_rotation_rad;
            c[4 * t + 3] += weight * here.tooth_shift_mm[t];
          }
        }
      }
    }
  }
}

bool DiscSurface::contains(double u0_mm, double e_mm) const {
  return u0_mm >= box_.u0_lower && u0_mm <= box_.u0_upper && e_mm >= box_.e_lower && e_mm <= box_.e_upper;
}

void DiscSurface::evaluate(double u0_mm, double e_mm, std::span<Change> change) const {
  double tu[most_terms], te[most_terms];
  polynomials(unit(u0_mm, box_.u0_lower, box_.u0_upper), along_u0_, tu);
  polynomials(unit(e_mm, box_.e_lower, box_.e_upper), along_e_, te);
  static_assert(sizeof(Change) == 4 * sizeof(double));
  double* const out = &change.front().rho_mm;
  const std::size_t n = 4 * teeth_;
  std::fill_n(out, n, 0.0);
  for (int a = 0; a < along_u0_; ++a) {
    for (int b = 0; b < along_e_; ++b) {
      const double weight = tu[a] * te[b];
      const double* c = coefficient_.data() + static_cast<std::size_t>(a * along_e_ + b) * n;
      for (std::size_t i = 0; i < n; ++i)
        out[i] += weight * c[i];
    }
  }
}

void DiscSurface::at(double u0_mm, double e_mm, std::span<Change> change) const {
  evaluate(u0_mm, e_mm, change);
  for (std::size_t i = 0; i < teeth_; ++i) {
    change[i].rho_mm -= nominal_[i].rho_mm;
    change[i].phi1_rad -= nominal_[i].phi1_rad;
    change[i].normal_rotation_rad -= nominal_[i].normal_rotation_rad;
    change[i].shift_mm -= nominal_[i].shift_mm;
  }
}

} // namespace strainwave
