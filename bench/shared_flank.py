#!/usr/bin/python3
"""Least peak force that one flank shared by all teeth can reach, found by a global solver (HiGHS).

    strainwave export gear.toml --contact contact.h5
    bench/shared_flank.py contact.h5 --torque-nm 7 --rotation-rad 2.686e-3

A bound on single teeth (optimize/gear/gear_bound.hpp) may give every tooth its own clearance. A gear cannot: one removal m(h) along
the flank serves all teeth. Here it is a variable, linear between knots, beside the forces F_p of all points of one phase:

    minimise t   subject to   Σ F_p of a tooth ≤ t,   lobes Σ r_p F_p = T,   θ ≤ rotation allowed,
                 gap_p = q_p + m(h_p) + (D F)_p − r_p θ ≥ 0,   F_p ≥ 0,   F_p gap_p = 0,
                 q_p + m(h_p) ≥ least backlash.

The products make it a mixed-integer linear programme (one binary for each point); its dual bound is a proof for this phase,
this wave generator and this wall contact. D holds the wall stations that the forces themselves close: solved again until the
peak force rests. With several phases every one of them has to be carried: the largest bound of the single phases holds.
"""
import argparse

import h5py
import numpy as np
import scipy.sparse as sparse
from scipy.linalg import solve_triangular
from scipy.optimize import Bounds, LinearConstraint, milp, nnls

UM = 1e3  # gaps in µm inside the programme, forces in N


class Phase:
    def __init__(self, group):
        self.compliance = group["compliance"][:]
        self.gap = group["gap"][:]
        self.tooth = group["tooth"][:].astype(int)
        self.radius = group["flank_radius"][:]
        self.lobes = float(group["lobes"][0])
        self.points = len(self.tooth)
        self.lever = group["lever"][: self.points]
        self.backlash = group["backlash"][:] * np.cos(group["pressure_angle"][:])  # along the force

    def tangent(self, force):
        """(D, q) with the wall stations held that these tooth forces close."""
        n = self.points
        if len(self.gap) == n:
            return self.compliance, self.gap
        wall = self.compliance[n:, n:]
        gap = self.gap[n:] + self.compliance[n:, :n] @ force
        factor = np.linalg.cholesky(wall)
        pressure, _ = nnls(factor.T, -solve_triangular(factor, gap, lower=True), maxiter=100 * len(gap))
        held = n + np.flatnonzero(pressure > 0)
        block = np.linalg.solve(self.compliance[np.ix_(held, held)], self.compliance[np.ix_(held, range(n))])
        coupling = self.compliance[np.ix_(range(n), held)]
        return self.compliance[:n, :n] - coupling @ block, self.gap[:n] - block.T @ self.gap[held]


    def loaded(self, rotation):
        """Tooth forces of the unmodified flank at a rotation."""
        near = np.concatenate([np.flatnonzero(self.backlash < self.lever * rotation + 1e-3),
                               np.arange(self.points, len(self.gap))])
        factor = np.linalg.cholesky(self.compliance[np.ix_(near, near)])
        lever = np.concatenate([self.lever, np.zeros(len(self.gap) - self.points)])[near]
        found, _ = nnls(factor.T, -solve_triangular(factor, self.gap[near] - rotation * lever, lower=True),
                        maxiter=100 * len(near))
        force = np.zeros(self.points)
        force[near[near < self.points]] = found[near < self.points]
        return force


def knot_weights(radius, knots):
    places = np.linspace(radius.min(), radius.max(), knots)
    step = places[1] - places[0]
    weights = np.zeros((len(radius), knots))
    for i, r in enumerate(radius):
        k = min(int((r - places[0]) / step), knots - 2)
        share = (r - places[k]) / step
        weights[i, k], weights[i, k + 1] = 1 - share, share
    return weights


def shared_flank(phase, force, torque, rotation, knots, clearance, seconds, largest_removal=30.0):
    d, q = phase.tangent(force)
    near = np.flatnonzero(phase.backlash < phase.lever * rotation + 1e-2)  # others cannot carry
    n, teeth = len(near), sorted(set(phase.tooth[near]))
    d, q, lever = d[np.ix_(near, near)], q[near], phase.lever[near]
    weights = knot_weights(phase.radius[near], knots)
    membership = np.array([[float(t == k) for t in phase.tooth[near]] for k in teeth])
    most_force, most_gap = 80.0, 250.0
    at_f, at_b, at_m = slice(0, n), slice(n, 2 * n), slice(2 * n, 2 * n + knots)
    at_t, at_theta, size = 2 * n + knots, 2 * n + knots + 1, 2 * n + knots + 2

    def rows(count, **blocks):
        matrix = sparse.lil_matrix((count, size))
        for name, block in blocks.items():
            place = {"f": at_f, "b": at_b, "m": at_m, "t": [at_t], "theta": [at_theta]}[name]
            matrix[:, place] = block
        return matrix.tocsr()

    gap = dict(f=UM * d, m=weights, theta=-lever[:, None])  # θ in mrad
    identity = np.eye(n)
    constraints = [
        LinearConstraint(rows(n, **gap), -UM * q, np.inf),
        LinearConstraint(rows(n, **gap, b=most_gap * identity), -np.inf, most_gap - UM * q),
        LinearConstraint(rows(n, f=identity, b=-most_force * identity), -np.inf, 0),
        LinearConstraint(rows(len(teeth), f=membership, t=-np.ones((len(teeth), 1))), -np.inf, 0),
        LinearConstraint(rows(1, f=phase.lobes * lever[None, :]), 1e3 * torque, 1e3 * torque),
        LinearConstraint(rows(n, m=weights), clearance - UM * phase.backlash[near], np.inf),
    ]
    lower, upper, cost, whole = np.zeros(size), np.full(size, np.inf), np.zeros(size), np.zeros(size)
    upper[at_f], upper[at_b], upper[at_m], upper[at_theta] = most_force, 1, largest_removal, 1e3 * rotation
    cost[at_t], whole[at_b] = 1, 1
    found = milp(cost, constraints=constraints, bounds=Bounds(lower, upper), integrality=whole,
                 options=dict(time_limit=seconds, mip_rel_gap=0.01))
    if found.x is None:
        return None, found
    force = np.zeros(phase.points)
    force[near] = found.x[at_f]
    per_tooth = dict(zip(teeth, membership @ found.x[at_f]))
    return dict(force=force, peak=found.fun, bound=found.mip_dual_bound, removal=found.x[at_m],
                rotation=1e-3 * found.x[at_theta], per_tooth=per_tooth), found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--torque-nm", type=float, default=7.0)
    parser.add_argument("--rotation-rad", type=float, required=True)
    parser.add_argument("--knots", type=int, default=5)
    parser.add_argument("--clearance-um", type=float, default=1.0)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--rounds", type=int, default=3, help="of wall contact and programme")
    options = parser.parse_args()
    with h5py.File(options.file) as file:
        phases = [(name, Phase(file[name])) for name in sorted(file) if name.startswith("phase_")]
    for name, phase in phases:
        force = phase.loaded(options.rotation_rad)
        force *= 1e3 * options.torque_nm / (phase.lobes * phase.lever @ force)
        before = np.inf
        for _ in range(options.rounds):
            best, status = shared_flank(phase, force, options.torque_nm, options.rotation_rad, options.knots,
                                        options.clearance_um, options.seconds)
            if best is None or abs(best["peak"] - before) < 0.01 * best["peak"]:
                break
            force, before = best["force"], best["peak"]
        if best is None:
            print(f"{name}: {status.message}")
            continue
        carried = {int(k): round(float(f), 1) for k, f in best["per_tooth"].items() if f > 0.05}
        print(f"{name}: peak {best['peak']:.2f} N, none below {best['bound']:.2f} N; rotation "
              f"{best['rotation']:.4e} rad; removal {np.round(best['removal'], 2).tolist()} µm (root … tip); N by tooth {carried}")


if __name__ == "__main__":
    main()
