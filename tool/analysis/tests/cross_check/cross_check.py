"""Machines of machines/ by sympy.physics.mechanics, compared with `jred reduce`.

    pip install -r requirements.txt
    python cross_check.py JRED            compare only
    python cross_check.py JRED --write    and write the results, which `cargo test -p jred-analysis cross_check` reads

JRED is the built command, such as target/debug/jred. The machine file gives dimensions and loads; joints, equations and signs are stated here anew.
Exit status 1 if a figure violates the tolerance, 2 if JRED is not given or not there.
"""

import csv
import io
import subprocess
import sys
import tomllib
from pathlib import Path

import mpmath as mp
import sympy as sp

from plane import Plane

HERE = Path(__file__).resolve().parent
MACHINES = HERE.parents[3] / "machines"
POSITIONS = 37
OMEGA, ALPHA = 3 * mp.pi, mp.mpf(40)  # 90 rpm, 40 rad/s^2
MOTION = ["--speed", "90 rpm", "--accel", "40 rad/s^2"]
# jred computes in double precision. Largest error of a column over the largest figure of its kind.
TOLERANCE = 1e-13

UNITS = {
    "mm": "1e-3", "m": "1", "kg": "1", "kg m^2": "1", "kg cm^2": "1e-4", "N": "1", "kN": "1e3", "N m": "1", "deg": None,
    "m/s^2": "1", "N m s/rad": "1",
}


def si(text):
    """An exact number in SI units."""
    number, unit = text.split(" ", 1)
    return sp.Rational(number) * (sp.pi / 180 if unit == "deg" else sp.Rational(UNITS[unit]))


def pair(texts):
    return tuple(si(x) for x in texts)


def link(plane, table, name):
    zero = ["0 mm", "0 mm"]
    return plane.body(name, si(table["mass"]), si(table.get("inertia", "0 kg m^2")), pair(table.get("com", zero)))


def added(file):
    """Inertia that turns with the crank: flywheel, and one stage of belt or gears."""
    total = si(file["mechanism"].get("flywheel", "0 kg m^2"))
    for train in file.get("drive_train", []):
        stage = train.get("stage", [train])[0]
        first, second = stage["driver"], stage["driven"]
        if train["type"] == "belt":
            ratio = si(second["radius"]) / si(first["radius"])
            total += si(train["belt_mass"]) * si(second["radius"]) ** 2
        else:
            ratio = sp.Rational(second["teeth"], first["teeth"])
        total += si(first["inertia"]) * ratio**2 + si(second["inertia"])
    return total


def window(load):
    """Share of a load at an angle: 10z^3 - 15z^4 + 6z^5 up and down within `between`."""
    if "between" not in load:
        return lambda phi: 1
    first, last = (mp.mpf(sp.N(x, 45)) for x in pair(load["between"]))
    ramp = mp.mpf(sp.N(si(load["ramp"]), 45))

    def share(phi):
        place = (phi - first) % (2 * mp.pi)
        z = min(place, (last - first) - place) / ramp
        z = max(mp.mpf(0), min(mp.mpf(1), z))
        return z**3 * (10 - 15 * z + 6 * z**2)

    return share


def action(load):
    share = window(load)
    value = lambda key: mp.mpf(sp.N(si(load[key]), 45))
    at_rest = mp.mpf(10) ** -20
    if "force" in load:
        fx, fy = (mp.mpf(sp.N(x, 45)) for x in pair(load["force"]))
        return lambda phi, v, w: (share(phi) * fx, share(phi) * fy, 0)
    if "opposing_force" in load:
        def oppose(phi, v, w):
            size = mp.hypot(*v)
            return (0, 0, 0) if size < at_rest else (*(-value("opposing_force") * share(phi) * x / size for x in v), 0)
        return oppose
    if "opposing_moment" in load:
        return lambda phi, v, w: (0, 0, 0 if abs(w) < at_rest else -value("opposing_moment") * share(phi) * mp.sign(w))
    if "viscous_moment" in load:
        return lambda phi, v, w: (0, 0, -value("viscous_moment") * share(phi) * w)
    raise KeyError(load)


def press(p, m):
    crank, rod, slider = (link(p, m[n], n) for n in ("crank", "rod", "slider"))
    r, l = si(m["crank"]["length"]), si(m["rod"]["length"])
    p.pin("crank pivot", p.ground, (0, 0), crank, (0, 0))
    p.pin("crank pin", crank, (r, 0), rod, (0, 0))
    p.pin("slider pin", rod, (l, 0), slider, (0, 0))
    p.slide("guide", p.ground, (0, si(m["offset"])), 0, slider, (0, 0))
    return {"crank": crank, "rod": rod, "slider": slider}, {"crank": (0, 0, 0), "rod": (r, 0, 0), "slider": (r + l, 0, 0)}


def four_bar(p, m):
    crank, coupler, rocker = (link(p, m[n], n) for n in ("crank", "coupler", "rocker"))
    c = pair(m["pivot"])
    p.pin("crank pivot", p.ground, (0, 0), crank, (0, 0))
    p.pin("crank pin", crank, (si(m["crank"]["length"]), 0), coupler, (0, 0))
    p.pin("rocker pin", coupler, (si(m["coupler"]["length"]), 0), rocker, (si(m["rocker"]["length"]), 0))
    p.pin("rocker pivot", p.ground, c, rocker, (0, 0))
    bodies = {"crank": crank, "coupler": coupler, "rocker": rocker}
    # Left of the line from crank pin to pivot: above it.
    return bodies, {"crank": (0, 0, 0), "coupler": (0.06, 0, 0.6), "rocker": (*c, 1.8)}


def six_link(p, m):
    names = ("crank", "block", "rocker", "rod", "slider")
    crank, block, rocker, rod, slider = bodies = [link(p, m[n], n) for n in names]
    r, b, l2, l3 = (si(x) for x in (m["crank"]["length"], m["centres"], m["rocker"]["length"], m["rod"]["length"]))
    p.pin("crank pivot", p.ground, (0, 0), crank, (0, 0))
    p.pin("crank pin", crank, (r, 0), block, (0, 0))
    p.slide("slot", rocker, (0, 0), 0, block, (0, 0))
    p.pin("rocker pivot", p.ground, (-b, 0), rocker, (0, 0))
    p.pin("rocker pin", rocker, (l2, 0), rod, (0, 0))
    p.pin("slider pin", rod, (l3, 0), slider, (0, 0))
    p.slide("guide", p.ground, (0, si(m["guide"])), 0, slider, (0, 0))
    starts = ((0, 0, 0), (r, 0, 0), (-b, 0, 0), (l2 - b, 0, 0), (l2 - b + l3, 0, 0))
    return dict(zip(names, bodies)), dict(zip(names, starts))


def toggle_press(p, m):
    names = ("crank", "rod", "upper", "lower", "ram")
    crank, rod, upper, lower, ram = bodies = [link(p, m[n], n) for n in names]
    r, l, u, w = (si(m[n]["length"]) for n in names[:4])
    pivot = pair(m["pivot"])
    p.pin("crank pivot", p.ground, (0, 0), crank, (0, 0))
    p.pin("crank pin", crank, (r, 0), rod, (0, 0))
    p.pin("knuckle of the rod", rod, (l, 0), upper, (u, 0))
    p.pin("upper pivot", p.ground, pivot, upper, (0, 0))
    p.pin("knuckle of the lower link", upper, (u, 0), lower, (0, 0))
    p.pin("ram pin", lower, (w, 0), ram, (0, 0))
    p.slide("guide", p.ground, (0, si(m["guide"])), 0, ram, (0, 0))
    starts = ((0, 0, 0), (0.06, 0, 1.7), (*pivot, -0.3), (0, 0.33, 0.3), (0.24, 0.4, 0))
    return dict(zip(names, bodies)), dict(zip(names, starts))


def geneva(p, m):
    a, half = si(m["centre_distance"]), sp.pi / m["slots"]
    crank, wheel = link(p, m["crank"], "crank"), link(p, m["wheel"], "wheel")
    p.pin("crank bearing", p.ground, (0, 0), crank, (0, 0))
    p.pin("wheel bearing", p.ground, (a, 0), wheel, (0, 0))
    p.slot("pin or locking arc", crank, (a * sp.sin(half), 0), wheel)
    return {"crank": crank, "wheel": wheel}, {"crank": (0, 0, 0), "wheel": (a, 0, sp.pi)}


def linkage(p, m):
    bodies, points, starts = {"ground": p.ground}, {"ground": {}}, {}
    for table in m["body"]:
        name = table["name"]
        bodies[name] = link(p, table, name)
        starts[name] = (0.1, 0.1, si(table["angle"]) if "angle" in table else sp.pi / 2)
    tables = [{"name": "ground", "points": m.get("ground", {})}, *m["body"]]
    points = {x["name"]: {k: pair(v) for k, v in x.get("points", {}).items()} for x in tables}

    def place(text):
        body, _, point = text.partition(".")
        return bodies[body], points[body][point] if point else (0, 0)

    for joint in m["joint"]:
        (first, p1), (second, p2) = (place(x) for x in joint["between"])
        kind = joint.get("type", "revolute")
        if kind == "revolute":
            p.pin(joint["name"], first, p1, second, p2)
        elif kind == "prismatic":
            p.slide(joint["name"], first, p1, si(joint["direction"]), second, p2)
        else:
            sign = -1 if joint.get("mesh") == "internal" else 1
            p.gears(joint["name"], first, second, bodies[joint["carrier"]], pair(joint["radii"]), sign)
    return bodies, starts


# Machine, model, drive link, and whether jred's joint forces are compared.
CASES = {
    "press": (press, "crank", True),
    "four-bar": (four_bar, "crank", True),
    "six-link": (six_link, "crank", True),
    "toggle-press": (toggle_press, "crank", True),
    "linkage-press": (linkage, "crank", True),
    "geneva": (geneva, "crank", True),
    # A mesh is a ratio here, without a place for its force: torque and inertia only.
    "linkage-planetary": (linkage, "arm", False),
}


def reference(name):
    """Rows of the other library, by column."""
    build, drive, forces = CASES[name]
    file = tomllib.loads((MACHINES / f"{name}.toml").read_text())
    p = Plane()
    bodies, starts = build(p, file["mechanism"])
    p.extra = added(file)
    for load in file.get("load", []):
        p.load(bodies[load["on"]], action(load), pair(load.get("at", ["0 mm", "0 mm"])))
    p.form(bodies[drive])
    gravity = [mp.mpf(sp.N(x, 45)) for x in pair(file["gravity"])]
    # The starting values are those of the bodies' origins.
    guess = []
    for body, start in ((bodies[n], starts[n]) for n in bodies if n != "ground"):
        x, y, psi = (float(s) for s in start)
        u, v = (float(c) for c in body.com)
        guess += [x + u * float(sp.cos(psi)) - v * float(sp.sin(psi)), y + u * float(sp.sin(psi)) + v * float(sp.cos(psi)), psi]
    rows, q = [], guess
    for k in [*range(POSITIONS)]:
        phi = 2 * mp.pi * k / POSITIONS
        if name == "geneva":  # the slot that is engaged; in the dwell the wheel does not move
            centred = phi - 2 * mp.pi if phi > mp.pi else phi
            if abs(centred) > mp.pi / 2 - mp.pi / file["mechanism"]["slots"]:
                continue
            q = p.position(centred, guess)
        else:
            q = p.position(phi, q)
        found = p.solve(phi, q, OMEGA, ALPHA, gravity)
        keys = [key for key in found if forces or key in ("J", "J'", "T")]
        rows.append({"position": k} | {key: found[key] for key in keys})
    return rows


def jred(command, name):
    """Rows of the command, under the same names."""
    def run(*options):
        call = [command, "reduce", str(MACHINES / f"{name}.toml"), "--positions", str(POSITIONS), "--format", "csv"]
        text = subprocess.run([*call, *options, *MOTION], check=True, capture_output=True, text=True).stdout
        return list(csv.DictReader(io.StringIO(text)))

    rows = []
    for curves, forces in zip(run(), run("--reactions")):
        row = {"J": curves["J_red [kg m^2]"], "J'": curves["J_red' [kg m^2/rad]"], "T": forces["T_drive [N m]"]}
        row |= {key.rsplit(" [", 1)[0]: value for key, value in forces.items()}
        rows.append({key: float(value) for key, value in row.items()})
    return rows


def kind(column):
    """Columns that are measured by one size: all forces, all moments of joints, and each of the others."""
    return column.rsplit(" ", 1)[-1].split("_")[0]


def main():
    words = [word for word in sys.argv[1:] if word != "--write"]
    if len(words) != 1 or not Path(words[0]).is_file():
        print("name the built command: python cross_check.py ../../../../target/debug/jred [--write]", file=sys.stderr)
        return 2
    command = words[0]
    worst = 0.0
    print(f"{'machine':<20} {'quantity':<10} {'figures':>8} {'largest':>12} {'error':>10}")
    for name in CASES:
        rows = reference(name)
        found = jred(command, name)
        sizes, errors, counts = {}, {}, {}
        for row in rows:
            for column, value in row.items():
                if column == "position":
                    continue
                other, label = found[row["position"]][column], kind(column)
                sizes[label] = max(sizes.get(label, 0), abs(value))
                errors[label] = max(errors.get(label, 0), abs(value - other))
                counts[label] = counts.get(label, 0) + 1
        # A guide's moment may be zero throughout: then it is measured by the drive torque.
        for label, size in sizes.items():
            size = max(size, sizes["T"]) if label == "M" else size
            error = float(errors[label] / size) if size else float(errors[label])
            worst = max(worst, error)
            print(f"{name:<20} {label:<10} {counts[label]:>8} {float(size):>12.5g} {error:>10.1e}")
        if "--write" in sys.argv:
            with open(HERE / f"{name}.csv", "w", newline="") as file:
                file.write(f"# machines/{name}.toml by sympy {sp.__version__}, mpmath {mp.__version__}: ")
                file.write("python cross_check.py JRED --write\n")
                writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
                writer.writeheader()
                for row in rows:
                    figure = lambda v: "0" if abs(v) < mp.mpf(10) ** -25 else mp.nstr(v, 17)
                    writer.writerow({k: v if k == "position" else figure(v) for k, v in row.items()})
    print(f"largest error {worst:.1e}, tolerance {TOLERANCE:.0e}: {'satisfies' if worst <= TOLERANCE else 'violates'}")
    return int(not worst <= TOLERANCE)


if __name__ == "__main__":
    sys.exit(main())
