#!/usr/bin/python3
"""Tolerances of the seed gear's frozen contact with other programs: OpenTURNS draws and does the statistics, SciPy's
non-negative least squares and Brent's root finding solve the contact. Writes tolerance-openturns.json beside this file.

Contact of load-path.json (28 teeth of one lobe, both loaded): gap = c + D F - R theta >= 0, F >= 0, 2 sum R F = 7 N.m.
  noise        c_i + normal(0, 0.5 um) for each tooth by itself
  harmonics    c_i + x1 cos(phi_i) + x2 sin(5 phi_i) + x3 cos(12 phi_i), x normal(0, 1 um)
Debian packages: python3-openturns 1.20, python3-scipy.
"""
import json
import os

import numpy as np
import openturns as ot
from scipy.optimize import brentq, nnls

folder = os.path.dirname(os.path.abspath(__file__))
reference = json.load(open(os.path.join(folder, "load-path.json")))
D = np.array(reference["D_mm_per_n"])
c0 = np.array(reference["backlash_mm"])
R = np.array(reference["contact_radius_mm"])
phi = 2.0 * np.pi * np.array(reference["tooth"]) / 140.0
torque = 3500.0  # N.mm, one lobe
L = np.linalg.cholesky(D).T  # D = L^T L
Linv = np.linalg.inv(L.T)


def solve(c):
    """Peak force [N] and rotation [rad] at the torque."""
    def forces(theta):
        return nnls(L, Linv @ (theta * R - c))[0]
    top = 2e-3
    while R @ forces(top) < torque:
        top *= 1.5
    theta = brentq(lambda t: R @ forces(t) - torque, 0.0, top, xtol=1e-13, rtol=1e-12)
    return [forces(theta).max(), theta]


check = solve(c0)
known = [k for k in reference["torque_cases"] if k["torque_nm"] == 7.0]
if known:
    assert abs(check[0] - known[0]["peak_force_n"]) < 1e-6, check

ot.RandomGenerator.SetSeed(20)
n = 20000
sample = np.array(ot.Normal([0.0] * len(c0), [5e-4] * len(c0), ot.CorrelationMatrix(len(c0))).getSample(n))
values = ot.Sample([solve(c0 + e) for e in sample])
noise = {"samples": n, "std_um": 0.5, "outputs": {}}
for k, name in enumerate(["peak_force_n", "rotation_rad"]):
    one = values.getMarginal(k)
    noise["outputs"][name] = {
        "mean": one.computeMean()[0],
        "std": one.computeStandardDeviation()[0],
        "quantiles": {str(p): one.computeQuantile(p)[0] for p in (0.05, 0.5, 0.95, 0.99)},
    }


def harmonics(x):
    return solve(c0 + x[0] * np.cos(phi) + x[1] * np.sin(5 * phi) + x[2] * np.cos(12 * phi))


function = ot.PythonFunction(3, 2, harmonics)
inputs = ot.Normal([0.0] * 3, [1e-3] * 3, ot.CorrelationMatrix(3))
size = 4096
design = ot.SobolIndicesExperiment(inputs, size, False).generate()
algorithm = ot.SaltelliSensitivityAlgorithm(design, function(design), size)
algorithm.setBootstrapSize(400)
algorithm.setUseAsymptoticDistribution(False)
indices = {"blocks": size, "std_um": 1.0, "outputs": {}}
for k, name in enumerate(["peak_force_n", "rotation_rad"]):
    indices["outputs"][name] = {
        "first": list(algorithm.getFirstOrderIndices(k)),
        "total": list(algorithm.getTotalOrderIndices(k)),
    }

json.dump({
    "origin": "tolerance_openturns.py with OpenTURNS %s" % ot.__version__,
    "nominal": {"peak_force_n": check[0], "rotation_rad": check[1]},
    "noise": noise,
    "harmonics": indices,
}, open(os.path.join(folder, "tolerance-openturns.json"), "w"), indent=1)
