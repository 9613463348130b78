"""Feed-forward of a four-bar: the firmware's table beside exact torques and a constant inertia.

Run it with ``python four_bar.py``, or as a notebook with ``marimo edit four_bar.py``.
"""

import marimo

app = marimo.App()


@app.cell
def _():
    from pathlib import Path

    import marimo as mo
    import matplotlib.pyplot as plt
    import numpy as np

    import jred

    arm = jred.Machine(Path(__file__).resolve().parents[2] / "machines" / "four-bar.toml")
    return arm, jred, mo, np, plt


@app.cell
def _(arm, mo):
    mo.md(f"# {arm.title}")


@app.cell
def _(arm, plt):
    # The reduced inertia over the turn, exact to rounding.
    turn = arm.curves(721)
    figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
    axes.plot(turn["phi [deg]"], turn["J_red [kg m^2]"] * 1e4)
    axes.set(xlabel="crank [deg]", ylabel="J_red [kg cm²]", xlim=(0, 360), ylim=(0, None))
    figure


@app.cell
def _(arm, np):
    # The motion with its exact torque, and the table that the firmware loads.
    motion = arm.curves(1000, over="time")
    model = arm.model(torque_error="0.02 N m")
    phase = model.phase(np.radians(motion["phi [deg]"]))
    omega, alpha = motion["omega [rad/s]"], motion["alpha [rad/s^2]"]
    exact = motion["T_drive [N m]"]
    table = model.torque(phase, omega, alpha)
    # The usual feed-forward: one inertia, and nothing of velocity, weight and process.
    constant = arm.curves(3600)["J_red [kg m^2]"].mean() * alpha
    return constant, exact, model, motion, omega, table


@app.cell
def _(constant, exact, mo, motion, np, plt, table):
    lines, (above, below) = plt.subplots(2, figsize=(7, 5), layout="constrained", sharex=True)
    above.plot(motion["t [s]"], exact, label="exact")
    above.plot(motion["t [s]"], constant, label="constant inertia")
    above.set(ylabel="torque [N m]")
    above.legend()
    below.plot(motion["t [s]"], 1e3 * (table - exact))
    below.set(xlabel="t [s]", ylabel="table − exact [mN m]")
    left = {
        name: float(np.sqrt(np.mean((exact - other) ** 2)))
        for name, other in [("constant inertia", constant), ("jred table", table)]
    }
    for name, rms in left.items():
        print(f"left to the controller with {name}: {rms:.4f} N m RMS")
    mo.vstack([lines, mo.md(" · ".join(f"{name}: {rms:.4f} N m RMS left to the controller" for name, rms in left.items()))])
    return (left,)


@app.cell
def _(exact, left, model, motion, np, table):
    # Within the error that the image states, wherever friction does not change its sign.
    moving = np.abs(motion["omega [rad/s]"]) > 0.1
    assert np.abs(table - exact)[moving].max() < model.validity[2] + 1e-3
    assert left["jred table"] < 0.05 * left["constant inertia"]


if __name__ == "__main__":
    app.run()
