"""A plane mechanism in sympy.physics.mechanics: absolute coordinates of every body, one constraint for every joint.

Nothing here is reduced to the drive link. Lagrange's equations of the first kind have three coordinates for each body and a
multiplier for each constraint; the multipliers are the joint forces, and that of the prescribed angle is the drive torque.
"""

import mpmath as mp
import sympy as sp
from sympy.physics.mechanics import (
    LagrangesMethod, Lagrangian, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia,
)

mp.mp.dps = 40
t = dynamicsymbols._t
PHI = dynamicsymbols("phi")  # the prescribed angle of the drive link
GX, GY = sp.symbols("gx gy")


class Body:
    """A body whose coordinates are its centre of mass and its angle; points are given from its own origin."""

    def __init__(self, plane, name, mass, moment, com):
        self.name, self.com = name, com
        self.x, self.y, self.psi = dynamicsymbols(f"{name}_x {name}_y {name}_psi")
        frame = plane.N.orientnew(name, "Axis", [self.psi, plane.N.z])
        centre = plane.O.locatenew(f"{name}_com", self.x * plane.N.x + self.y * plane.N.y)
        centre.set_vel(plane.N, centre.pos_from(plane.O).diff(t, plane.N))
        self.rigid = RigidBody(name, centre, frame, mass, (inertia(frame, 0, 0, moment), centre))
        self.rigid.potential_energy = -mass * (GX * self.x + GY * self.y)

    def at(self, point):
        u, v = (p - c for p, c in zip(point, self.com))
        c, s = sp.cos(self.psi), sp.sin(self.psi)
        return sp.Matrix([self.x + u * c - v * s, self.y + u * s + v * c])


class Ground:
    """The frame."""

    psi = sp.Integer(0)

    def at(self, point):
        return sp.Matrix(point)


class Plane:
    """Bodies, joints and loads; `solve` gives positions, joint forces and drive torque."""

    def __init__(self):
        self.N, self.O = ReferenceFrame("N"), Point("O")
        self.O.set_vel(self.N, 0)
        self.ground = Ground()
        self.bodies, self.joints, self.loads, self.extra = [], [], [], 0

    def body(self, name, mass, moment=0, com=(0, 0)):
        self.bodies.append(Body(self, name.replace(" ", "_"), mass, moment, com))
        return self.bodies[-1]

    def _join(self, name, constraints, directions):
        self.joints.append((name, list(constraints), directions))

    def pin(self, name, first, p, second, q):
        """The multipliers are the force of the first body on the second."""
        self._join(name, first.at(p) - second.at(q), {"F_x": (1, 0), "F_y": (0, 1)})

    def slide(self, name, first, p, angle, second, q):
        """The point q of the second body runs along a line of the first, parallel to it."""
        line = first.psi + angle
        n = sp.Matrix([-sp.sin(line), sp.cos(line)])
        constraints = [-n.dot(second.at(q) - first.at(p)), line - second.psi]
        self._join(name, constraints, {"F_x": (n[0], 0), "F_y": (n[1], 0), "M": (0, 1)})

    def slot(self, name, first, p, second):
        """The point p of the first body runs along the axis of the second."""
        n = sp.Matrix([-sp.sin(second.psi), sp.cos(second.psi)])
        self._join(name, [n.dot(first.at(p) - second.at((0, 0)))], {"F_x": (n[0],), "F_y": (n[1],)})

    def gears(self, name, first, second, arm, radii, sign):
        """Rolling without slip, seen from the arm; the force at the pitch point is not modelled, only the ratio."""
        self._join(name, [radii[0] * (first.psi - arm.psi) + sign * radii[1] * (second.psi - arm.psi)], {})

    def load(self, body, action, at=(0, 0)):
        """`action(phi, velocity, omega)` is force and moment in N, N and N*m, from numbers."""
        names = sp.symbols(f"L{len(self.loads)}_:3")
        self.loads.append((body, action, body.at(at), names))

    def form(self, drive):
        """Lagrange's equations with `drive` as the body whose angle is prescribed."""
        self.joints.append(("drive", [PHI - drive.psi], {"T": (1,)}))
        q = [c for b in self.bodies for c in (b.x, b.y, b.psi)]
        self.qd = [c.diff(t) for c in q]
        self.constraints = [c for _, some, _ in self.joints for c in some]
        assert len(self.constraints) == len(q), "one degree of freedom, prescribed"
        forces = []
        for k, (body, _, place, names) in enumerate(self.loads):
            point = self.O.locatenew(f"P{k}", place[0] * self.N.x + place[1] * self.N.y)
            point.set_vel(self.N, point.pos_from(self.O).diff(t, self.N))
            forces.append((point, names[0] * self.N.x + names[1] * self.N.y))
            forces.append((body.rigid.frame, names[2] * self.N.z))
        L = Lagrangian(self.N, *(b.rigid for b in self.bodies)) + self.extra * drive.psi.diff(t) ** 2 / 2
        lagrange = LagrangesMethod(L, q, hol_coneqs=self.constraints, forcelist=forces, frame=self.N)
        lagrange.form_lagranges_equations()
        n = len(q)
        self.q = q
        kinetic = sum(b.rigid.kinetic_energy(self.N) for b in self.bodies) + self.extra * drive.psi.diff(t) ** 2 / 2
        arguments = [q, self.qd, [PHI, PHI.diff(t), PHI.diff(t, 2)], [GX, GY], [s for load in self.loads for s in load[3]]]
        make = lambda what: sp.lambdify(arguments, what, modules="mpmath", cse=True)
        matrix = sp.Matrix(self.constraints)
        self.g, self.jacobian = make(matrix), make(matrix.jacobian(q))
        self.system, self.right = make(lagrange.mass_matrix_full[n:, n:]), make(lagrange.forcing_full[n:, :])
        self.kinetic = make(kinetic)
        self.places = make([sp.Matrix([*place.diff(t), body.psi.diff(t)]) for body, _, place, _ in self.loads])
        self.outputs = make([
            [sp.Matrix(d) for d in directions.values()] for _, _, directions in self.joints
        ])

    def position(self, phi, guess):
        """The coordinates at an angle, by Newton's method to 30 digits."""
        q, none = mp.matrix(guess), [0] * (3 * len(self.loads))
        for _ in range(60):
            g = self.g(q, q, [phi, 0, 0], [0, 0], none)
            if mp.norm(g) < mp.mpf(10) ** -30:
                return q
            q -= mp.lu_solve(self.jacobian(q, q, [phi, 0, 0], [0, 0], none), g)
        raise ArithmeticError(f"not assembled at {phi}")

    def _lagrange(self, q, qd, motion, gravity, loads):
        solution = mp.lu_solve(self.system(q, qd, motion, gravity, loads), self.right(q, qd, motion, gravity, loads))
        # sympy's matrices carry the multipliers with the opposite sign of its equations of motion.
        return -solution[len(q):, 0]

    def solve(self, phi, q, omega, alpha, gravity):
        """J, J', drive torque and joint forces at a position; a dictionary by name."""
        n, none = len(q), [0] * (3 * len(self.loads))
        # g(q, phi) = 0 and its last row is phi - psi: J*q' = -dg/dphi.
        slope = mp.lu_solve(self.jacobian(q, q, [phi, 0, 0], [0, 0], none), mp.matrix([0] * (n - 1) + [-1]))
        bare = lambda w, a: self._lagrange(q, slope * w, [phi, w, a], [0, 0], none)[n - 1]
        inertia_, curve = bare(0, 1), 2 * bare(1, 0)
        twice = 2 * self.kinetic(q, slope, [phi, 1, 0], [0, 0], none)
        assert abs(twice - inertia_) < mp.mpf(10) ** -25 * twice, "inertia by force and by energy"
        qd, motion = slope * omega, [phi, omega, alpha]
        moves = self.places(q, qd, motion, gravity, none)
        loads = [x for (_, action, _, _), v in zip(self.loads, moves) for x in action(phi, v[:2], v[2])]
        multipliers = list(self._lagrange(q, qd, motion, gravity, loads))
        found = {"J": inertia_, "J'": curve, "T": multipliers[-1]}
        first = 0
        for (name, constraints, directions), rows in zip(self.joints[:-1], self.outputs(q, qd, motion, gravity, loads)):
            part = multipliers[first:first + len(constraints)]
            for label, row in zip(directions, rows):
                found[f"{name} {label}"] = sum(a * b for a, b in zip(row, part))
            first += len(constraints)
        return found
