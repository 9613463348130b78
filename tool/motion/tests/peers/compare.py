"""Minimum time by `jred fastest`, toppra and copp, on a slider-crank under a torque limit.

    pip install -r requirements.txt
    python compare.py JRED

JRED is the built command, such as target/release/jred. Dimensions are read from press.toml; the equation of motion is stated here anew, and every
motion is judged by it between its nodes. Exit status 1 if jred takes longer than another that keeps the limit, or violates the limit itself.
"""

import csv
import io
import json
import math
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import copp_py as copp
import numpy as np
import toppra
import toppra.algorithm
import toppra.constraint

HERE = Path(__file__).resolve().parent
TORQUE, SPEED = 60.0, 40.0  # N m, rad/s at the crank
START, END = math.pi, 2 * math.pi
RUNS = 21
VISCOUS = 1.0  # N m s/rad
# Largest torque between nodes that counts as within the limit: a thousandth above it.
WITHIN = 1e-3


class Press:
    """J(phi), J'(phi) and weight of a crank without mass, a rod without mass, a ram and a flywheel."""

    def __init__(self, viscous):
        file = tomllib.loads((HERE / "press.toml").read_text())
        number = lambda text: float(text.split()[0])
        mechanism = file["mechanism"]
        self.crank = number(mechanism["crank"]["length"]) / 1e3
        self.rod = number(mechanism["rod"]["length"]) / 1e3
        self.ram = number(mechanism["slider"]["mass"])
        self.flywheel = number(mechanism["flywheel"])
        self.gravity = number(file["gravity"][0])
        self.viscous = viscous

    def torque(self, phi, omega, alpha):
        r, l = self.crank, self.rod
        sin, cos = np.sin(phi), np.cos(phi)
        w = np.sqrt(l * l - (r * sin) ** 2)
        w1 = -r * r * sin * cos / w
        x1 = -r * sin + w1
        w2 = (-r * r * (cos * cos - sin * sin) - w1 * w1) / w
        x2 = -r * cos + w2
        inertia = self.flywheel + self.ram * x1 * x1
        return inertia * alpha + self.ram * x1 * x2 * omega**2 - self.ram * self.gravity * x1 + self.viscous * omega


def median(run):
    """Median time in milliseconds, and the last result."""
    times = []
    for _ in range(RUNS):
        before = time.perf_counter()
        result = run()
        times.append(1e3 * (time.perf_counter() - before))
    return statistics.median(times), result


def with_jred(command, press):
    text = (HERE / "press.toml").read_text()
    if press.viscous:
        text += f'[[load]]\non = "crank"\nviscous_moment = "{press.viscous} N m s/rad"\n'
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "press.toml"
        file.write_text(text)
        arguments = [command, "fastest", str(file), "--from", "180 deg", "--to", "360 deg"]
        arguments += ["--torque", f"{TORQUE} N m", "--motor-speed", f"{SPEED} rad/s", "--format"]
        run = lambda *more: subprocess.run([*arguments, *more], check=True, capture_output=True, text=True).stdout
        elapsed, found = median(lambda: json.loads(run("json")))
        text = run("csv", "--instants", "20011")
    rows = list(csv.DictReader(io.StringIO(text)))
    column = lambda name: np.array([float(row[name]) for row in rows])
    torque = press.torque(np.radians(column("phi [deg]")), column("omega [rad/s]"), column("alpha [rad/s^2]"))
    return found["duration"], np.abs(torque).max(), elapsed


def with_toppra(press, intervals):
    inverse = lambda q, v, a: np.array([press.torque(q[0], v[0], a[0])])
    points = np.linspace(START, END, 3)[:, None]
    path = toppra.SplineInterpolator(np.linspace(0, 1, 3), points)
    limit = toppra.constraint.JointTorqueConstraint(
        inverse, np.array([[-TORQUE, TORQUE]]), np.zeros(1),
        discretization_scheme=toppra.constraint.DiscretizationType.Interpolation)
    speed = toppra.constraint.JointVelocityConstraint(np.array([[-SPEED, SPEED]]))
    solve = lambda: toppra.algorithm.TOPPRA(
        [speed, limit], path, gridpoints=np.linspace(0, 1, intervals + 1), solver_wrapper="seidel").compute_trajectory(0, 0)
    elapsed, motion = median(solve)
    t = np.linspace(0, motion.duration, 20011)
    torque = press.torque(motion(t)[:, 0], motion(t, 1)[:, 0], motion(t, 2)[:, 0])
    return motion.duration, np.abs(torque).max(), elapsed


def with_copp(press, intervals):
    s = np.linspace(0, 1, intervals + 1)
    phi = START + (END - START) * s

    def solve():
        inverse = lambda q, v, a: np.array([press.torque(q[0], v[0], a[0])])
        robot = copp.Robot(1, capacity=intervals + 1, inverse_dynamics=inverse)
        robot.append_s(s)
        robot.set_q(phi[:, None], np.full((intervals + 1, 1), END - START), np.zeros((intervals + 1, 1)), idx_s=0)
        robot.add_velocity_limits([SPEED], [-SPEED], start_idx_s=0, length=intervals + 1)
        robot.add_torque_limits([TORQUE], [-TORQUE], start_idx_s=0, length=intervals + 1)
        problem = copp.solver.topp2_ra.Problem(robot.constraints, idx_s_interval=(0, intervals), a_boundary=(0.0, 0.0))
        before = time.perf_counter()
        a = np.asarray(copp.solver.topp2_ra.solve(problem))
        kernel.append(1e3 * (time.perf_counter() - before))
        return a

    kernel = []
    elapsed, a = median(solve)
    squares = np.maximum(a, 0) * (END - START) ** 2
    omega, way = np.sqrt(squares), np.diff(phi)
    alpha = np.diff(squares) / 2 / way
    worst = 0.0
    for share in np.linspace(0, 1, 21):
        between = np.sqrt(squares[:-1] + share * np.diff(squares))
        worst = max(worst, np.abs(press.torque(phi[:-1] + share * way, between, alpha)).max())
    return (2 * way / (omega[1:] + omega[:-1])).sum(), worst, elapsed, statistics.median(kernel)


def main(command):
    failed = False
    for viscous in [0.0, VISCOUS]:
        press = Press(viscous)
        friction = f"viscous friction of {viscous} N m s/rad" if viscous else "no friction"
        print(f"\nmove of 180 deg, {friction}")
        print("| | time [s] | largest torque / limit | computed in [ms] |\n|---|---:|---:|---:|")
        duration, torque, elapsed = with_jred(command, press)
        print(f"| jred fastest | {duration:.7f} | {torque / TORQUE:.6f} | {elapsed:.1f} (whole command) |")
        failed |= torque > TORQUE * (1 + 1e-6)
        for intervals in [1000, 8000]:
            other = with_toppra(press, intervals)
            print(f"| toppra, {intervals} intervals | {other[0]:.7f} | {other[1] / TORQUE:.6f} | {other[2]:.1f} |")
            failed |= other[1] <= TORQUE * (1 + WITHIN) and other[0] < duration * (1 - 1e-6)
            other = with_copp(press, intervals)
            print(f"| copp, {intervals} intervals | {other[0]:.7f} | {other[1] / TORQUE:.6f} | {other[2]:.1f}, solver {other[3]:.2f} |")
            failed |= other[1] <= TORQUE * (1 + WITHIN) and other[0] < duration * (1 - 1e-6)
    return int(failed)


if __name__ == "__main__":
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_file():
        sys.exit(f"{__doc__}\nThe command is not given or not there.")
    toppra.setup_logging("ERROR")
    sys.exit(main(sys.argv[1]))
