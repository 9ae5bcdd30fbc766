"""The error norms, by Gauss quadrature of the pointwise error at every level.

First letters: the norm in time over t_1 ... t_N (L2: the sum of squares weighted by dt; Linf: the greatest); then in space.
H1, H2 are full norms. `_sq` behind a name is the square; `corollary` is a square already.
"""

import math

import numpy

import scheme

PARTS = {  # (norm in time, squares that are added in space)
    "theta_L2L2": [("L2", ("theta",))],
    "theta_LinfL2": [("Linf", ("theta",))],
    "theta_L2H1": [("L2", ("theta", "theta_x"))],
    "u_LinfL2": [("Linf", ("u",))],
    "u_LinfH1": [("Linf", ("u", "u_x"))],
    "u_LinfH2": [("Linf", ("u", "u_x", "u_xx"))],
    "u_LinfH2semi": [("Linf", ("u_xx",))],
    "u_L2H2": [("L2", ("u", "u_x", "u_xx"))],
    "sigma_L2": [("L2", ("sigma",))],
    "corollary": [("Linf", ("u", "u_x", "u_xx")), ("L2", ("theta",)), ("L2", ("u", "u_x", "u_xx"))],
}


TABLES = {"theta": "chi", "theta_x": "chi_x", "u": "V", "u_x": "V_x", "u_xx": "V_xx"}


def discrete(march, space, name, levels=slice(1, None)):
    """A quantity of a march at the points of a space on its nodes; shape: levels x points."""
    nodal = march.theta if name.startswith("theta") else march.U
    return (getattr(space, TABLES[name]).T @ nodal[levels].T).T


class Exact:
    """What a march is measured against: the solution of a Problem."""

    def __init__(self, problem, gauss):
        self.problem, self.gauss = problem, gauss

    def space(self, march):
        return march.space

    def values(self, name, space, times):
        return self.problem.values(name, space.x, times)

    def stress(self, times):
        return self.problem.values("sigma", 1.0, times)[:, 0]


class Reference:
    """What a march is measured against: a finer march, to whose nodes and levels its own belong."""

    def __init__(self, fine, gauss):
        self.fine, self.gauss = fine, gauss

    def space(self, march):
        return scheme.Space(march.space.nodes, self.gauss, self.fine.space.nodes)

    def _levels(self, times):
        return [int(t / (self.fine.times[1] - self.fine.times[0])) for t in times]

    def values(self, name, space, times):
        return discrete(self.fine, self.fine.space, name, self._levels(times))

    def stress(self, times):
        return self.fine.stress[self._levels(times)]


def errors(march, exact, names):
    """({name: norm of the error}, {name: the same norm of the exact solution})."""
    squares, sizes = {}, {}
    space = exact.space(march)
    times = march.times[1:]
    for name in TABLES:
        values = exact.values(name, space, times)
        squares[name] = (discrete(march, space, name) - values) ** 2 @ space.weights
        sizes[name] = values**2 @ space.weights
    stress = exact.stress(times)
    squares["sigma"], sizes["sigma"] = (march.stress[1:] - stress) ** 2, stress**2
    return [{name: norm(values, march.dt, name) for name in names} for values in (squares, sizes)]


def norm(squares, dt, name):
    """A norm from the squares in space of each level."""
    root = name.removesuffix("_sq")
    total = 0.0
    for kind, quantities in PARTS[root]:
        levels = sum(squares[quantity] for quantity in quantities)
        total += dt * numpy.sum(levels) if kind == "L2" else numpy.max(levels)
    return total if name.endswith("_sq") or root == "corollary" else math.sqrt(total)
