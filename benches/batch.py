"""Inverse dynamics of a batch in NumPy, from the table and samples that benches/batch.rs writes: python3 batch.py FOLDER.

Prints NumPy's version and the best time of several runs (s), and writes the torques to FOLDER/torque.
"""

import sys
import time
from pathlib import Path

import numpy as np

folder = Path(sys.argv[1])
rows = np.fromfile(folder / "table", np.float32)
viscous, coulomb = np.fromfile(folder / "constants", np.float32)
phase = np.fromfile(folder / "phase", np.uint32)
omega = np.fromfile(folder / "omega", np.float32)
alpha = np.fromfile(folder / "alpha", np.float32)

CURVES = 2  # J and load, four coefficients each
rows = rows.reshape(-1, 4 * CURVES)
cells = len(rows)
# One array a coefficient: gathers of whole rows take longer.
j0, j1, j2, j3, g0, g1, g2, g3 = np.ascontiguousarray(rows.T)
half_slope = np.float32(0.5 * cells / (2 * np.pi))


def torques():
    place = phase * (cells / 2**32)
    cell = place.astype(np.intp)
    u = (place - cell).astype(np.float32)
    a1, a2, a3 = j1[cell], j2[cell], j3[cell]
    inertia = ((a3 * u + a2) * u + a1) * u + j0[cell]
    slope = (3 * a3 * u + 2 * a2) * u + a1
    load = ((g3[cell] * u + g2[cell]) * u + g1[cell]) * u + g0[cell]
    speed = (half_slope * slope * omega + viscous) * omega
    return inertia * alpha + speed - load + coulomb * np.sign(omega)


best = float("inf")
for _ in range(15):
    start = time.perf_counter()
    answer = torques()
    best = min(best, time.perf_counter() - start)
answer.astype(np.float32).tofile(folder / "torque")
print(np.__version__, best, answer.dtype)
