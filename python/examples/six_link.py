"""Dimensions of a six-link press for the least RMS torque of its drive.

Run it with ``python six_link.py``, or as a notebook with ``marimo edit six_link.py``.
"""

import marimo

app = marimo.App()


@app.cell
def _():
    from pathlib import Path

    import marimo as mo
    import numpy as np

    import jred

    return Path, jred, mo, np


@app.cell
def _(mo):
    mo.md(
        """
        # A six-link press with less torque

        Crank, rocker and rod may be changed, and the mass that balances the crank. The stroke must stay at 120 mm, and the
        drive must keep every rule. The objective is the RMS torque at the motor's side of the drive train over the cycle.
        """
    )


@app.cell
def _(Path, jred, np):
    machines = Path(__file__).resolve().parents[2] / "machines"
    press = jred.Machine(machines / "six-link.toml")
    # A named drive: its margins are smooth functions of the dimensions.
    drive = jred.evaluate(press)["drive"]

    # The quantities that may change, and their bounds in the units of the file.
    names = ["crank.length", "rocker.length", "rod.length", "centres"]
    names = [f"mechanism.{name}" for name in names] + ["mechanism.crank.com.1"]
    bounds = np.array([[70.0, 100.0], [45.0, 75.0], [200.0, 320.0], [20.0, 40.0], [-60.0, 20.0]])
    start = np.array([80.0, 60.0, 260.0, 30.0, 10.0])

    def judged(values):
        """RMS torque (N m) and the margins that must not be negative: rules of the drive, and the stroke."""
        changed = press
        for name, value in zip(names, values):
            changed = changed.set(name, f"{value} mm")
        curves = changed.curves(200, over="time")
        rms = float(np.sqrt(np.mean(curves["T_input [N m]"] ** 2)))
        points = changed.curves(181, points=True)
        ram = points["slider com x [m]"]
        margins = jred.evaluate(changed, drive=drive)["margins"]
        margins["stroke"] = 0.01 - abs((ram.max() - ram.min()) / 0.120 - 1.0)
        return rms, margins

    def cost(values):
        """The objective of methods without constraints: violations cost."""
        try:
            rms, margins = judged(np.clip(values, *bounds.T))
        except jred.JredError:
            return 1e3
        outside = np.abs(values - np.clip(values, *bounds.T)).sum()
        return rms + 100.0 * sum(1e-3 - margin for margin in margins.values() if margin < 1e-3) + outside

    before, margins = judged(start)
    return bounds, before, cost, drive, judged, margins, names, start


@app.cell
def _(before, drive, margins, mo):
    least = min(margins, key=margins.get)
    mo.md(f"At first: {before:.2f} N m RMS with {drive}; the least margin is that of {least}, {margins[least]:.0%}.")


@app.cell
def _(bounds, jred, judged, names):
    # Optuna: constraints are the negative margins.
    import optuna

    optuna.logging.set_verbosity(optuna.logging.WARNING)

    def objective(trial):
        values = [trial.suggest_float(name, *bound) for name, bound in zip(names, bounds)]
        try:
            rms, margins = judged(values)
        except jred.JredError as error:
            raise optuna.TrialPruned(str(error)) from error
        for rule, margin in margins.items():
            trial.set_constraint(rule, -margin)
        trial.set_user_attr("least margin", min(margins.values()))
        return rms

    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1))
    study.enqueue_trial(dict(zip(names, [80.0, 60.0, 260.0, 30.0, 10.0])))
    study.optimize(objective, n_trials=150)
    feasible = [t for t in study.trials if t.value is not None and t.user_attrs["least margin"] >= 0]
    optuna_best = min(feasible, key=lambda trial: trial.value)
    return (optuna_best,)


@app.cell
def _(bounds, cost, np, start):
    # CMA-ES, in shares of the bounds.
    import cma

    width = bounds[:, 1] - bounds[:, 0]
    options = {"seed": 1, "maxfevals": 300, "verbose": -9}
    found, _ = cma.fmin2(lambda share: cost(bounds[:, 0] + share * width), (start - bounds[:, 0]) / width, 0.2, options)
    cma_best = np.clip(bounds[:, 0] + found * width, *bounds.T)
    return (cma_best,)


@app.cell
def _(bounds, cma_best, cost):
    # SciPy's simplex from there.
    from scipy.optimize import minimize

    simplex = minimize(cost, cma_best, method="Nelder-Mead", bounds=bounds, options={"maxfev": 200, "xatol": 0.05})
    return (simplex,)


@app.cell
def _(before, cma_best, judged, mo, names, optuna_best, simplex):
    rows = [
        ("Optuna", list(optuna_best.params.values())),
        ("CMA-ES", list(cma_best)),
        ("CMA-ES, then simplex", list(simplex.x)),
    ]
    results = []
    for method, values in rows:
        rms, kept = judged(values)
        dimensions = {name.removeprefix("mechanism."): round(float(value), 2) for name, value in zip(names, values)}
        results.append(
            {"method": method, "RMS torque [N m]": round(rms, 3), "least margin": round(min(kept.values()), 4)} | dimensions
        )
        print(f"{method}: {rms:.3f} N m, at first {before:.3f}; least margin {min(kept.values()):.4f}")
    assert min(result["RMS torque [N m]"] for result in results) < before
    mo.ui.table(results)


if __name__ == "__main__":
    app.run()
