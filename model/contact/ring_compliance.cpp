#include "strainwave/model/contact/ring_compliance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace strainwave {

std::vector<std::pair<int, double>> lagrange_weights(std::span<const double> nodes, double x) {
  const int n = static_cast<int>(nodes.size());
  assert(n > 0);
  const int width = std::min(n, 4);
  const int above = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), x) - nodes.begin());
  if (above < n && nodes[static_cast<std::size_t>(above)] == x)
    return {{above, 1.0}};
  const int first = std::clamp(above - width / 2, 0, n - width);
  std::vector<std::pair<int, double>> weights;
  for (int i = first; i < first + width; ++i) {
    double weight = 1.0;
    for (int j = first; j < first + width; ++j) {
      if (j == i)
        continue;
      const auto a = static_cast<std::size_t>(i);
      const auto b = static_cast<std::size_t>(j);
      weight *= (x - nodes[b]) / (nodes[a] - nodes[b]);
    }
    weights.emplace_back(i, weight);
  }
  return weights;
}

RingCompliance::RingCompliance(const UnitResponses& responses, std::vector<double> rows_mm, bool fold)
    : responses_(&responses), rows_(std::move(rows_mm)),
      period_(fold ? responses.sectors / 2 : responses.sectors) {
  assert(!fold || responses.sectors % 2 == 0);
  const int n = responses.count();
  const auto block = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto stored = [&](int k) {
    return Eigen::Map<const RowMajor>(responses.data.data() + block * static_cast<std::size_t>(k), n, n);
  };

  // P: from interpolated wall points (station, row, direction) to the functionals of the responses.
  const int stations = static_cast<int>(responses.wall_offset.size());
  const int rows = static_cast<int>(rows_.size());
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(n, 2 * stations * rows);
  for (int station = 0; station < stations; ++station) {
    for (int row = 0; row < rows; ++row) {
      for (const auto& [at, weight] :
           lagrange_weights(responses.wall_z_mm, rows_[static_cast<std::size_t>(row)])) {
        for (int direction = 0; direction < 2; ++direction) {
          p(responses.wall(station, at, direction), 2 * (station * rows + row) + direction) = weight;
        }
      }
    }
  }
  for (int k = 0; k < period_; ++k) {
    Eigen::MatrixXd g = stored(k);
    if (fold)
      g += stored(k + period_);
    wall_all_.push_back(p.transpose() * g);
    wall_wall_.push_back(wall_all_.back() * p);
    all_.push_back(std::move(g));
  }
  const Eigen::Index drive = responses.flank_count();
  const Eigen::Index coast = responses.coast_count();
  for (int k = 0; k < period_; ++k) {
    // functional ← wall at offset k is wall ← functional at −k, by reciprocity
    const Eigen::MatrixXd& from = wall_all_[static_cast<std::size_t>(wrapped(-k))];
    Eigen::MatrixXd& g = flank_wall_.emplace_back(drive + coast, from.rows());
    g.topRows(drive) = from.leftCols(drive).transpose();
    g.bottomRows(coast) = from.rightCols(coast).transpose();
  }
}

std::vector<WallStation> RingCompliance::stations(double phase) const {
  const double pitch = 2.0 * std::numbers::pi / sectors();
  const double half = folded() ? std::numbers::pi / 2 : std::numbers::pi;
  std::vector<WallStation> result;
  for (int k = -period_; k <= period_; ++k) {
    for (int station = 0; station < static_cast<int>(responses_->wall_offset.size()); ++station) {
      const double phi = pitch * (k + responses_->wall_offset[static_cast<std::size_t>(station)] + phase);
      if (phi <= -half + 1e-12 || phi > half + 1e-12)
        continue;
      for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
        result.push_back({k, station, row, phi, rows_[static_cast<std::size_t>(row)]});
      }
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const WallStation& a, const WallStation& b) { return a.phi_rad < b.phi_rad; });
  return result;
}

ToothFunctional RingCompliance::tooth(int sector, double radius_mm, double circumferential, double inwards,
                                      int only_slice, FlankSide side) const {
  assert(side == FlankSide::drive || responses_->both_flanks);
  const std::vector<double>& heights = responses_->flank_radius_mm;
  const int slices = static_cast<int>(responses_->flank_z_mm.size());
  assert(!heights.empty());
  const double radius = std::clamp(radius_mm, heights.front(), heights.back());
  std::vector<std::pair<int, double>> levels;
  if (heights.size() == 1) {
    levels = {{0, 1.0}};
  } else {
    int upper = static_cast<int>(std::upper_bound(heights.begin(), heights.end(), radius) - heights.begin());
    upper = std::clamp(upper, 1, static_cast<int>(heights.size()) - 1);
    const double lo = heights[static_cast<std::size_t>(upper - 1)];
    const double hi = heights[static_cast<std::size_t>(upper)];
    const double upwards = (radius - lo) / (hi - lo);
    levels = {{upper - 1, 1.0 - upwards}, {upper, upwards}};
  }
  ToothFunctional result{sector, {}};
  for (const auto& [level, weight] : levels) {
    for (int slice = 0; slice < slices; ++slice) {
      if (only_slice >= 0 && slice != only_slice)
        continue;
      // hats at both ends of the face are half as wide as the others
      const double width = slice == 0 || slice == slices - 1 ? 0.5 : 1.0;
      const double share = only_slice >= 0 || slices == 1 ? 1.0 : width / (slices - 1);
      const double part = weight * share;
      if (part == 0.0)
        continue;
      const auto functional = [&](int direction) {
        return side == FlankSide::drive ? responses_->flank(level, slice, direction)
                                        : responses_->coast(level, slice, direction);
      };
      if (circumferential != 0.0)
        result.weights.emplace_back(functional(UnitResponses::circumferential), circumferential * part);
      if (inwards != 0.0)
        result.weights.emplace_back(functional(UnitResponses::radial), -inwards * part);
    }
  }
  return result;
}

Eigen::MatrixXd RingCompliance::wall_wall(std::span<const WallStation> stations,
                                          const Eigen::MatrixX2d& normal) const {
  const auto n = static_cast<Eigen::Index>(stations.size());
  Eigen::MatrixXd result(n, n);
  wall_wall(stations, normal, result);
  return result;
}

void RingCompliance::wall_wall(std::span<const WallStation> stations, const Eigen::MatrixX2d& normal,
                               Eigen::Ref<Eigen::MatrixXd> result) const {
  const auto n = static_cast<Eigen::Index>(stations.size());
  Eigen::VectorXd along; // displacements of one sector's wall functionals from a unit force along normal j
  for (Eigen::Index j = 0; j < n; ++j) {
    const WallStation& load = stations[static_cast<std::size_t>(j)];
    const int b = wall_index(load);
    int sector = 0;
    bool fresh = true;
    for (Eigen::Index i = j; i < n; ++i) {
      const WallStation& at = stations[static_cast<std::size_t>(i)];
      if (fresh || at.sector != sector) {
        const Eigen::MatrixXd& g = wall_wall_[static_cast<std::size_t>(wrapped(at.sector - load.sector))];
        along = g.col(b + 1) * normal(j, 0) + g.col(b) * normal(j, 1);
        sector = at.sector;
        fresh = false;
      }
      const int a = wall_index(at); // wall functionals come as (circumferential, radial)
      const double value = normal(i, 0) * along(a + 1) + normal(i, 1) * along(a);
      result(i, j) = value;
      result(j, i) = value;
    }
  }
}

Eigen::MatrixXd RingCompliance::wall_components_of_teeth(std::span<const WallStation> stations,
                                                         std::span<const ToothFunctional> teeth) const {
  const auto n = static_cast<Eigen::Index>(stations.size());
  Eigen::MatrixXd result(2 * n, static_cast<Eigen::Index>(teeth.size()));
  const auto points = static_cast<std::size_t>(wall_wall_.front().rows());
  std::vector<double> moved(points); // wall functionals of one sector
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    const ToothFunctional& tooth = teeth[static_cast<std::size_t>(j)];
    double* const column = result.col(j).data();
    int sector = 0;
    bool fresh = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      const WallStation& at = stations[static_cast<std::size_t>(i)];
      if (fresh || at.sector != sector) {
        const Eigen::MatrixXd& g = wall_all_[static_cast<std::size_t>(wrapped(at.sector - tooth.sector))];
        std::fill(moved.begin(), moved.end(), 0.0);
        for (const auto& [b, weight] : tooth.weights) {
          const double* const from = g.col(b).data();
          for (std::size_t a = 0; a < points; ++a)
            moved[a] += weight * from[a];
        }
        sector = at.sector;
        fresh = false;
      }
      const auto a = static_cast<std::size_t>(wall_index(at));
      column[2 * i] = moved[a + 1];
      column[2 * i + 1] = moved[a];
    }
  }
  return result;
}

Eigen::MatrixXd along_normals(const Eigen::MatrixX2d& normal, const Eigen::MatrixXd& components) {
  const Eigen::Index n = normal.rows();
  Eigen::MatrixXd result(n, components.cols());
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    const double* const from = components.col(j).data();
    for (Eigen::Index i = 0; i < n; ++i)
      result(i, j) = normal(i, 0) * from[2 * i] + normal(i, 1) * from[2 * i + 1];
  }
  return result;
}

Eigen::MatrixXd RingCompliance::wall_tooth(std::span<const WallStation> stations,
                                           const Eigen::MatrixX2d& normal,
                                           std::span<const ToothFunctional> teeth) const {
  return along_normals(normal, wall_components_of_teeth(stations, teeth));
}

Eigen::MatrixXd RingCompliance::tooth_tooth(std::span<const ToothFunctional> teeth) const {
  const auto n = static_cast<Eigen::Index>(teeth.size());
  Eigen::MatrixXd result(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const ToothFunctional& load = teeth[static_cast<std::size_t>(j)];
    for (Eigen::Index i = j; i < n; ++i) {
      const ToothFunctional& at = teeth[static_cast<std::size_t>(i)];
      const Eigen::MatrixXd& g = all_[static_cast<std::size_t>(wrapped(at.sector - load.sector))];
      double sum = 0.0;
      for (const auto& [a, weight_a] : at.weights) {
        for (const auto& [b, weight_b] : load.weights)
          sum += weight_a * weight_b * g(a, b);
      }
      result(i, j) = sum;
      result(j, i) = sum;
    }
  }
  return result;
}

namespace {

/// One force on a functional of a sector, N.
struct SectorForce {
  int sector = 0;
  int functional = 0;
  double force = 0.0;
};

std::vector<SectorForce> listed(std::span<const ToothFunctional> teeth, const Eigen::VectorXd& force) {
  std::vector<SectorForce> list;
  for (Eigen::Index j = 0; j < force.size(); ++j) {
    if (force(j) == 0.0)
      continue;
    const ToothFunctional& tooth = teeth[static_cast<std::size_t>(j)];
    for (const auto& [b, weight] : tooth.weights)
      list.push_back({tooth.sector, b, weight * force(j)});
  }
  return list;
}

} // namespace

// Displacements are summed sector by sector, a whole column of a response at a time: every functional of a
// sector costs as much as one of them alone.

Eigen::MatrixX2d RingCompliance::wall_displacement(std::span<const WallStation> at,
                                                   std::span<const WallStation> loaded,
                                                   const Eigen::MatrixX2d& wall_force,
                                                   std::span<const ToothFunctional> teeth,
                                                   const Eigen::VectorXd& tooth_force) const {
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(wall_wall_.front().rows(), period_);
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(period_), 0);
  for (const WallStation& point : at)
    wanted[static_cast<std::size_t>(wrapped(point.sector))] = 1;
  const auto add = [&](const std::vector<Eigen::MatrixXd>& responses, const SectorForce& load) {
    for (int sector = 0; sector < period_; ++sector) {
      if (wanted[static_cast<std::size_t>(sector)])
        moved.col(sector) +=
            load.force *
            responses[static_cast<std::size_t>(wrapped(sector - load.sector))].col(load.functional);
    }
  };
  for (Eigen::Index j = 0; j < wall_force.rows(); ++j) {
    const WallStation& load = loaded[static_cast<std::size_t>(j)];
    const int b = wall_index(load);
    if (wall_force(j, 0) != 0.0)
      add(wall_wall_, {load.sector, b + 1, wall_force(j, 0)});
    if (wall_force(j, 1) != 0.0)
      add(wall_wall_, {load.sector, b, wall_force(j, 1)});
  }
  for (const SectorForce& load : listed(teeth, tooth_force))
    add(wall_all_, load);
  Eigen::MatrixX2d result(static_cast<Eigen::Index>(at.size()), 2);
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const WallStation& point = at[static_cast<std::size_t>(i)];
    const int a = wall_index(point);
    result(i, 0) = moved(a + 1, wrapped(point.sector));
    result(i, 1) = moved(a, wrapped(point.sector));
  }
  return result;
}

/// The functionals' own displacements from those of all flank functionals, drive then coast, of their
/// sectors; `add` sums one sector's.
template <class Add>
Eigen::VectorXd RingCompliance::measured(std::span<const ToothFunctional> teeth, const Add& add) const {
  const int drive = responses_->flank_count();
  const int skipped = responses_->wall_count() + responses_->section_count();
  std::vector<int> place(static_cast<std::size_t>(period_), -1);
  Eigen::MatrixXd moved(drive + responses_->coast_count(), period_);
  Eigen::VectorXd result(static_cast<Eigen::Index>(teeth.size()));
  int known = 0;
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    const ToothFunctional& tooth = teeth[static_cast<std::size_t>(i)];
    int& at = place[static_cast<std::size_t>(wrapped(tooth.sector))];
    if (at < 0) {
      at = known++;
      moved.col(at).setZero();
      add(tooth.sector, moved.col(at));
    }
    double sum = 0.0;
    for (const auto& [a, weight] : tooth.weights)
      sum += weight * moved(a < drive ? a : a - skipped, at);
    result(i) = sum;
  }
  return result;
}

Eigen::VectorXd RingCompliance::tooth_displacement(std::span<const ToothFunctional> of,
                                                   std::span<const ToothFunctional> loaded,
                                                   const Eigen::VectorXd& force) const {
  const std::vector<SectorForce> loads = listed(loaded, force);
  const Eigen::Index drive = responses_->flank_count();
  const Eigen::Index coast = responses_->coast_count();
  return measured(of, [&](int sector, auto&& moved) {
    for (const SectorForce& load : loads) {
      const auto from = all_[static_cast<std::size_t>(wrapped(sector - load.sector))].col(load.functional);
      moved.head(drive) += load.force * from.head(drive);
      if (coast > 0)
        moved.tail(coast) += load.force * from.tail(coast);
    }
  });
}

Eigen::VectorXd RingCompliance::tooth_displacement(std::span<const ToothFunctional> teeth,
                                                   std::span<const WallStation> loaded,
                                                   const Eigen::MatrixX2d& wall_force) const {
  return measured(teeth, [&](int sector, auto&& moved) {
    for (Eigen::Index j = 0; j < wall_force.rows(); ++j) {
      if (wall_force(j, 0) == 0.0 && wall_force(j, 1) == 0.0)
        continue;
      const WallStation& load = loaded[static_cast<std::size_t>(j)];
      const Eigen::MatrixXd& g = flank_wall_[static_cast<std::size_t>(wrapped(sector - load.sector))];
      const int b = wall_index(load);
      moved += wall_force(j, 0) * g.col(b + 1) + wall_force(j, 1) * g.col(b);
    }
  });
}

Eigen::MatrixX4d RingCompliance::section(std::span<const int> at_sectors, double z_mm,
                                         std::span<const WallStation> loaded,
                                         const Eigen::MatrixX2d& wall_force,
                                         std::span<const ToothFunctional> teeth,
                                         const Eigen::VectorXd& tooth_force) const {
  assert(!responses_->section_z_mm.empty());
  const auto along = lagrange_weights(responses_->section_z_mm, z_mm);
  Eigen::MatrixX4d result = Eigen::MatrixX4d::Zero(static_cast<Eigen::Index>(at_sectors.size()), 4);
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const int sector = at_sectors[static_cast<std::size_t>(i)];
    const auto add = [&](int b, double force, const Eigen::MatrixXd& g, bool wall) {
      for (const auto& [row, weight] : along) {
        for (int quantity = 0; quantity < 4; ++quantity) {
          const int a = responses_->section(row, quantity);
          // wall_all_ holds wall ← functional; reciprocity gives functional ← wall with the opposite offset.
          result(i, quantity) += weight * force * (wall ? g(b, a) : g(a, b));
        }
      }
    };
    for (Eigen::Index j = 0; j < wall_force.rows(); ++j) {
      const WallStation& load = loaded[static_cast<std::size_t>(j)];
      const Eigen::MatrixXd& g = wall_all_[static_cast<std::size_t>(wrapped(load.sector - sector))];
      const int b = wall_index(load);
      if (wall_force(j, 0) != 0.0)
        add(b + 1, wall_force(j, 0), g, true);
      if (wall_force(j, 1) != 0.0)
        add(b, wall_force(j, 1), g, true);
    }
    for (Eigen::Index j = 0; j < tooth_force.size(); ++j) {
      if (tooth_force(j) == 0.0)
        continue;
      const ToothFunctional& tooth = teeth[static_cast<std::size_t>(j)];
      const Eigen::MatrixXd& g = all_[static_cast<std::size_t>(wrapped(sector - tooth.sector))];
      for (const auto& [b, weight] : tooth.weights)
        add(b, weight * tooth_force(j), g, false);
    }
  }
  return result;
}

} // namespace strainwave
