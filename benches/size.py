"""A catalogue of drives against a cycle in NumPy, from what tool/sizing/benches/size.rs writes: python3 size.py FOLDER.

As an engineer would write it: for each motor all its drives at once, torque and speed of every sample, RMS, largest share of the
envelope by linear interpolation. Prints the best time of several runs (s), and writes the RMS torques to FOLDER/rms.
"""

import sys
import time
from pathlib import Path

import numpy as np

folder = Path(sys.argv[1])
loads = np.fromfile(folder / "loads").reshape(-1, 5)
weights = np.fromfile(folder / "weights")
drives = np.fromfile(folder / "drives").reshape(-1, 7)
motor = drives[:, 0].astype(int)
envelopes = np.fromfile(folder / "envelopes").reshape(-1, 65, 2)  # speed and torque at 65 points
starts = np.searchsorted(motor, np.arange(len(envelopes) + 1))
speed = np.abs(loads[:, 3])
duration = weights.sum()


def judge():
    rms, used = np.empty(len(drives)), np.empty(len(drives))
    for k, (first, last) in enumerate(zip(starts, starts[1:])):
        torque = drives[first:last, 2:] @ loads.T
        rms[first:last] = np.sqrt((torque * torque) @ weights / duration)
        limit = np.interp(drives[first:last, 1:2] * speed, *envelopes[k].T, right=0.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            used[first:last] = np.max(np.abs(torque) / limit, axis=1)
    return rms, used


best = float("inf")
for _ in range(3):
    start = time.perf_counter()
    rms, used = judge()
    best = min(best, time.perf_counter() - start)
rms.tofile(folder / "rms")
print(f"NumPy {np.__version__:8}             {1e3 * best:9.3f} ms")
