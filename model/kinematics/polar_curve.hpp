#pragma once
// A polar curve rho = r_m + u(phi1) in closed form with its exact arc length. Internal to this room.
//
// L(phi1) = int_0^phi1 sqrt(rho^2 + rho'^2) is kept as one Chebyshev series for each smooth piece of u,
// beside the series of dL/dr_m, dL/du0 and dL/d(shape number) at fixed phi1. A pose inverts L(phi1) = r_m phi
// by Newton steps. A curve longer than the circle ends before phi1 = pi/2, a shorter one runs on as its own
// mirror image.

#include "strainwave/model/kinematics/chebyshev.hpp"
#include "strainwave/model/kinematics/curve_shape.hpp"
#include "strainwave/model/kinematics/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace strainwave {

/// Derivatives in the order of PoseVariable, without the material angle: r_m, u0, shape number.
using CurveNumber = Dual<3>;

/// Shape: double -> Displacement<double>; ShapeNumber: double -> Displacement<CurveNumber>, the same with
/// derivatives.
template <class Shape, class ShapeNumber>
class PolarCurve final : public CurveShape {
public:
  PolarCurve(double radius, Shape shape, ShapeNumber dual, std::vector<double> breaks, CurveSummary summary)
      : radius_(radius), shape_(std::move(shape)), dual_(std::move(dual)), summary_(std::move(summary)) {
    std::erase_if(breaks, [](double b) { return b <= 0.0 || b >= quarter; });
    breaks.push_back(quarter);
    double lo = 0.0;
    for (double hi : breaks) {
      add_piece(lo, hi);
      lo = hi;
    }
    summary_.u0_mm = shape_(0.0).u;
    summary_.u90_mm = shape_(quarter).u;
    summary_.perimeter_excess_mm = 4.0 * pieces_.back().end - 2.0 * pi * radius_;
  }

  CurveSummary summary() const override { return summary_; }

  RadialDisplacement displacement(double polar) const override {
    const auto u = shape_(polar);
    return {u.u, u.first, u.second};
  }

  Pose pose(double phi) const override {
    const Found at = find(phi);
    return {radius_ + at.u.u, at.beyond ? pi - at.polar : at.polar,
            (at.beyond ? 1.0 : -1.0) * std::atan2(at.u.first, radius_ + at.u.u)};
  }

  PoseDerivatives pose_derivatives(double phi) const override {
    const Found at = find(phi);
    const Displacement<CurveNumber> u = dual_(at.polar);
    const double rho = radius_ + at.u.u, first = at.u.first, speed = std::hypot(rho, first);
    const double side = at.beyond ? -1.0 : 1.0;
    const auto dl = length_derivatives(*at.piece, at.polar);
    const auto dl_quarter = length_derivatives(pieces_.back(), quarter);
    PoseDerivatives result;
    result.value = {rho, at.beyond ? pi - at.polar : at.polar, -side * std::atan2(first, rho)};
    for (std::size_t j = 0; j < 4; ++j) {
      double target = j == by_material_angle ? radius_ : j == by_neutral_radius ? phi : 0.0; // d(r_m phi)
      double drho = 0.0, dfirst = 0.0, dlength = 0.0;
      if (j > 0) {
        const auto p = static_cast<Eigen::Index>(j - 1);
        drho = u.u.derivatives()[p] + (j == by_neutral_radius ? 1.0 : 0.0);
        dfirst = u.first.derivatives()[p];
        dlength = dl[j - 1];
        if (at.beyond)
          target = 2.0 * dl_quarter[j - 1] - target;
      } else if (at.beyond) {
        target = -target;
      }
      const double dpolar = (target - dlength) / speed;
      drho += first * dpolar;
      dfirst += at.u.second * dpolar;
      result.rho[j] = drho;
      result.phi1[j] = side * dpolar;
      result.normal_rotation[j] = -side * (rho * dfirst - first * drho) / (speed * speed);
    }
    return result;
  }

private:
  static constexpr double pi = std::numbers::pi;
  static constexpr double quarter = 0.5 * pi;

  struct Piece {
    double lo, hi, centre, half_width;
    double start[4]; // L and its three derivatives at lo
    double end;      // L at hi
    int size;        // coefficients of each series
    std::vector<double> length,
        derivatives; // series of L - start (1) and of its derivatives (3 side by side)
  };

  struct Found {
    const Piece* piece;
    double polar;
    Displacement<double> u;
    bool beyond; // past the minor axis, where a curve shorter than the circle runs on as its mirror image
  };

  Found find(double phi) const {
    double target = radius_ * phi;
    const double end = pieces_.back().end;
    const bool beyond = target > end;
    if (beyond)
      target = std::max(0.0, 2.0 * end - target);
    const Piece* piece = pieces_.data();
    while (target > piece->end)
      ++piece;
    // Newton; L is smooth with L' near r_m, so the error squares each time: 1e-2, 1e-5, 1e-12, rounding.
    double polar = std::clamp(target / radius_, piece->lo, piece->hi);
    Displacement<double> u{};
    for (int step = 0; step < 12; ++step) {
      u = shape_(polar);
      const double rho = radius_ + u.u;
      const double correction = (target - length(*piece, polar)) / std::sqrt(rho * rho + u.first * u.first);
      polar = std::clamp(polar + correction, piece->lo, piece->hi);
      if (std::abs(correction) < 1e-8)
        break;
    }
    return {piece, polar, shape_(polar), beyond};
  }

  static double length(const Piece& piece, double polar) {
    const double t = (polar - piece.centre) / piece.half_width;
    return piece.start[0] + chebyshev_sum<1>(piece.length.data(), piece.size, t)[0];
  }

  static std::array<double, 3> length_derivatives(const Piece& piece, double polar) {
    const double t = (polar - piece.centre) / piece.half_width;
    auto d = chebyshev_sum<3>(piece.derivatives.data(), piece.size, t);
    for (std::size_t j = 0; j < 3; ++j)
      d[j] += piece.start[j + 1];
    return d;
  }

  void add_piece(double lo, double hi) {
    Piece piece{.lo = lo,
                .hi = hi,
                .centre = 0.5 * (lo + hi),
                .half_width = 0.5 * (hi - lo),
                .start = {},
                .end = 0.0,
                .size = 0,
                .length = {},
                .derivatives = {}};
    Eigen::MatrixXd integral, coefficients;
    const ChebyshevGrid* grid = nullptr;
    for (int size : {12, 16, 24, 32, 48, 64}) {
      grid = &chebyshev_grid(size);
      Eigen::MatrixXd integrand(size, 4);
      for (int i = 0; i < size; ++i) {
        const Displacement<CurveNumber> u = dual_(piece.centre + piece.half_width * grid->nodes[i]);
        const CurveNumber rho = u.u + CurveNumber(radius_, 3, 0);
        const CurveNumber speed = sqrt(CurveNumber(rho * rho + u.first * u.first));
        integrand(i, 0) = speed.value();
        integrand.row(i).tail<3>() = speed.derivatives().transpose();
      }
      integral.noalias() = piece.half_width * grid->integral * integrand;
      coefficients.noalias() = grid->coefficients * integral;
      if (chebyshev_tail(coefficients) < 1e-15)
        break;
    }
    piece.size = grid->size;
    piece.length.resize(static_cast<std::size_t>(piece.size));
    piece.derivatives.resize(3 * static_cast<std::size_t>(piece.size));
    for (int k = 0; k < piece.size; ++k) {
      piece.length[static_cast<std::size_t>(k)] = coefficients(k, 0);
      for (int j = 0; j < 3; ++j)
        piece.derivatives[static_cast<std::size_t>(3 * k + j)] = coefficients(k, j + 1);
    }
    if (!pieces_.empty()) {
      const Piece& before = pieces_.back();
      const auto derivatives = length_derivatives(before, before.hi);
      piece.start[0] = before.end;
      for (std::size_t j = 0; j < 3; ++j)
        piece.start[j + 1] = derivatives[j];
    }
    const double end = piece.start[0] + integral(piece.size - 1, 0);
    piece.start[0] -=
        chebyshev_sum<1>(piece.length.data(), piece.size, -1.0)[0]; // rounding of the series' own zero
    piece.end = end;
    pieces_.push_back(std::move(piece));
  }

  double radius_;
  Shape shape_;
  ShapeNumber dual_;
  CurveSummary summary_;
  std::vector<Piece> pieces_;
};

} // namespace strainwave
