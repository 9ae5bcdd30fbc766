"""The scheme (24)-(25) in cubic Hermite elements, heat, beam and contact in one sparse system, factored by LU.

Unknown y = (Theta, U): values of the hat functions chi_i at inner nodes, and values and slopes of the cubics V_j at all nodes but
the clamped one. Theta has zero ends, the temperature is Theta + theta_A (1 - x). Tested with chi_i and V_i,

    C y_t + S y = r + lambda e          e_i = V_i(1)
    C = | M   alpha D |    S = |     K       0 |     M: (chi, chi) or its row sums, K: (chi', chi'), D: (chi', V'), B: (V'', V'')
        | 0   zeta B  |        | -alpha D'   B |
    r = | (f, chi)                                                       |
        | -(G, V') - (q, V) + m V'(1) + alpha theta_A ((1 - x)', V')     |

from (1) and (2), (3) by parts. A solve replaces y_t by c (y - y*), and where the free tip passes a stop g it goes on with
u(1) + epsilon lambda = g; epsilon = 0 is a rigid stop.

B has the condition h^-4. Its round-off would hide errors from s = 64 on, so that tables, matrices and residuals are in extended
precision, and the LU factors of double precision refine until the residual is of it too.
"""

import fractions
import math

import numpy
import scipy.sparse
import scipy.sparse.linalg

Extended = numpy.longdouble
GAMMA = 1.0 - 1.0 / math.sqrt(2.0)


def gauss_rule(count):
    """Gauss-Legendre points and weights on [0, 1]; those of NumPy after a step of Newton's method."""
    x = numpy.polynomial.legendre.leggauss(count)[0].astype(Extended)

    def legendre(x):
        """P_count and its derivative, (x^2 - 1) P' = count (x P - P_before)."""
        before, value = numpy.ones_like(x), x
        for k in range(2, count + 1):
            before, value = value, ((2 * k - 1) * x * value - (k - 1) * before) / k
        return value, count * (x * value - before) / (x**2 - 1)

    value, slope = legendre(x)
    x = x - value / slope
    return (1 + x) / 2, 1 / ((1 - x**2) * legendre(x)[1] ** 2)


class Space:
    """Basis functions of a mesh at Gauss points; shape of the tables: functions x points.

    cells: the partition on whose intervals the points are placed, the mesh itself or a finer one."""

    def __init__(self, nodes, gauss, cells=None):
        self.nodes = numpy.asarray(nodes, dtype=Extended)
        cells = self.nodes if cells is None else cells
        point, weight = gauss_rule(gauss)
        x = (cells[:-1, None] + numpy.diff(cells)[:, None] * point).ravel()
        self.x = x.astype(float)
        self.weights = (numpy.diff(cells)[:, None] * weight).ravel()
        j = numpy.searchsorted(self.nodes, x, side="right") - 1
        h = numpy.diff(self.nodes)[j]
        xi = (x - self.nodes[j]) / h
        self.chi = self._table(1, j, hats(xi))
        self.chi_x = self._table(1, j, [-1.0 / h, 1.0 / h])
        # Function 2j has the value 1 at node j, function 2j + 1 the slope 1 there.
        self.V = self._table(2, j, cubics(xi, h))
        self.V_x = self._table(2, j, [(6 * xi**2 - 6 * xi) / h, 1 - 4 * xi + 3 * xi**2, (6 * xi - 6 * xi**2) / h, 3 * xi**2 - 2 * xi])
        self.V_xx = self._table(2, j, [(12 * xi - 6) / h**2, (6 * xi - 4) / h, (6 - 12 * xi) / h**2, (6 * xi - 2) / h])

    def _table(self, per_node, element, pieces):
        """pieces: the functions of an element's left node, then of its right one."""
        rows = numpy.concatenate([per_node * element + k for k in range(2 * per_node)])
        columns = numpy.tile(numpy.arange(len(element)), 2 * per_node)
        shape = (per_node * len(self.nodes), len(element))
        return scipy.sparse.csr_matrix((numpy.concatenate(pieces), (rows, columns)), shape=shape)

    def integrals(self, values, functions):
        """(g, phi_i) for rows of values of g at the points; shape: rows x functions."""
        return numpy.asarray((functions @ (values * self.weights).T).T)

    def gram(self, a, b):
        return (a.multiply(self.weights[None, :]) @ b.T).tocsr()


def hats(xi):
    return [1.0 - xi, xi]


def cubics(xi, h):
    """Value and slope at the left end, value and slope at the right end."""
    return [1 - 3 * xi**2 + 2 * xi**3, h * xi * (1 - xi) ** 2, 3 * xi**2 - 2 * xi**3, h * xi**2 * (xi - 1)]


def mesh_nodes(mesh, s):
    """The nodes of a [mesh] block with s elements."""
    if "nodes" in mesh:
        given = [Extended(float(node)) for node in mesh["nodes"]]
        parts = s // (len(given) - 1)
        return numpy.concatenate([[given[0]]] + [numpy.linspace(a, b, parts + 1)[1:] for a, b in zip(given, given[1:])])
    return (numpy.arange(s + 1, dtype=Extended) / s) ** Extended(float(mesh.get("grading", 1)))


class Stages:
    """The solves of a step: (c Delta t, part of the step at which the sources are taken), and y* of each."""

    def __init__(self, name, n):
        self.is_bdf2 = name == "bdf2" and n > 1
        self.solves = {"euler": [(1.0, 1)], "sdirk2": [(1.0 / GAMMA, GAMMA), (1.0 / GAMMA, 1)]}["euler" if name == "euler" else "sdirk2"]
        if self.is_bdf2:
            self.solves = [(1.5, 1)]

    def start(self, y, y_before, stages):
        if self.is_bdf2:
            return (4.0 * y - y_before) / 3.0
        return y + (1.0 - GAMMA) / GAMMA * (stages[0] - y) if stages else y


class March:
    """All states of a run. After it: theta (levels x nodes, theta_A included), U (levels x cubics), stress (levels; of t_0 nan)."""

    def __init__(self, problem, beam, nodes, time_scheme, lumped, final_time, steps, gauss):
        self.space = space = Space(nodes, gauss)
        self.times = [final_time * fractions.Fraction(n, steps) for n in range(steps + 1)]
        self.dt = float(final_time) / steps
        self.beam = {name: float(value) for name, value in beam.items()}
        self.lumped = lumped
        s = len(space.nodes) - 1
        self.inner = s - 1
        self._matrices()
        schemes = [Stages(time_scheme, n) for n in range(1, steps + 1)]
        loads = self._loads(problem, schemes)
        lower, upper = (self.beam.get(name, infinite) for name, infinite in (("g1", -math.inf), ("g2", math.inf)))
        solvers = {}
        y = self._initial(problem)
        states, stresses, before = [y], [math.nan], None
        rows = iter(loads)
        for scheme in schemes:
            stages = []
            for leading, _ in scheme.solves:
                c = leading / self.dt
                if c not in solvers:
                    solvers[c] = Solve(self.C, self.S, self.e, c, self.beam["epsilon"])
                start = scheme.start(y, before, stages)
                value, stress = solvers[c](start, next(rows), lower, upper)
                stages.append(value)
            before, y = y, stages[-1]
            states.append(y)
            stresses.append(stress)
        states = numpy.array(states)
        self.theta = numpy.zeros((steps + 1, s + 1), dtype=Extended)
        self.theta[:, 1:-1] = states[:, : self.inner]
        self.theta_zero_ends = self.theta.copy()
        self.theta += self.beam["theta_A"] * (1.0 - space.nodes)
        self.U = numpy.zeros((steps + 1, 2 * (s + 1)), dtype=Extended)
        self.U[:, 2:] = states[:, self.inner :]
        self.stress = numpy.array(stresses)

    def _matrices(self):
        space, alpha, zeta = self.space, self.beam["alpha"], self.beam["zeta"]
        hats, cubics = slice(1, -1), slice(2, None)
        mass = space.gram(space.chi, space.chi)
        if self.lumped:
            mass = scipy.sparse.csr_matrix((mass @ numpy.ones(len(space.nodes)), (range(len(space.nodes)),) * 2))
        self.M = mass[hats, hats]
        K = space.gram(space.chi_x, space.chi_x)[hats, hats]
        D = space.gram(space.chi_x, space.V_x)[hats, cubics]
        self.B = space.gram(space.V_xx, space.V_xx)[cubics, cubics]
        if self.inner == 0:  # one element: no temperature is unknown
            self.C, self.S = zeta * self.B, self.B
        else:
            self.C = scipy.sparse.bmat([[self.M, alpha * D], [None, zeta * self.B]], format="csr")
            self.S = scipy.sparse.bmat([[K, None], [-alpha * D.T, self.B]], format="csr")
        self.e = numpy.zeros(self.S.shape[0], dtype=Extended)
        self.e[-2] = 1.0

    def _loads(self, problem, schemes):
        """The right-hand side r of every solve of the run, in turn."""
        space = self.space
        times = [self.times[n + 1] if part == 1 else float(self.times[n]) + part * self.dt
                 for n, scheme in enumerate(schemes) for _, part in scheme.solves]
        at_points = lambda name: problem.values(name, space.x, times)
        beam = -space.integrals(at_points("G"), space.V_x) - space.integrals(at_points("q"), space.V)
        beam[:, -1] += problem.values("m", 1.0, times)[:, 0]
        beam -= self.beam["alpha"] * self.beam["theta_A"] * space.integrals(numpy.ones((1, len(space.x))), space.V_x)
        return numpy.hstack([space.integrals(at_points("f"), space.chi)[:, 1:-1], beam[:, 2:]])

    def _initial(self, problem):
        """Nodal values of the temperature, and the cubic whose curvature is nearest to u_xx."""
        space = self.space
        inner = space.nodes[1:-1]
        theta = problem.theta0(inner.astype(float), 0.0)[0] - self.beam["theta_A"] * (1 - inner) if self.inner else []
        load = space.integrals(problem.curvature0(space.x, 0.0), space.V_xx)[0, 2:]
        return numpy.concatenate([theta, Factors(self.B).solve(load)])

    def temperature_at(self, x):
        return numpy.array([numpy.interp(x, self.space.nodes.astype(float), theta.astype(float)) for theta in self.theta])

    def deflection_at(self, x):
        nodes = self.space.nodes
        j = min(max(int(numpy.searchsorted(nodes, x, side="right")) - 1, 0), len(nodes) - 2)
        h = nodes[j + 1] - nodes[j]
        return self.U[:, 2 * j : 2 * j + 4] @ numpy.array(cubics((x - nodes[j]) / h, h))

    def energy(self):
        """(Theta' M Theta + |U_xx|^2)/2"""
        inner, cubic = self.theta_zero_ends[:, 1:-1], self.U[:, 2:]
        heat = numpy.einsum("ni,ni->n", inner, (self.M @ inner.T).T) if self.inner else 0.0
        return (heat + numpy.einsum("ni,ni->n", cubic, (self.B @ cubic.T).T)) / 2.0


class Factors:
    """LU factors of a matrix in extended precision, its rows and columns scaled to size one first."""

    def __init__(self, matrix, refinements=4):
        self.matrix, self.refinements = matrix.tocsr(), refinements
        self.scale = 1.0 / numpy.sqrt(numpy.maximum(abs(self.matrix).max(axis=1).toarray().ravel(), 1e-300)).astype(float)
        scaling = scipy.sparse.diags(self.scale)
        self.lu = scipy.sparse.linalg.splu((scaling @ self.matrix.astype(float) @ scaling).tocsc())

    def solve(self, right):
        x = numpy.zeros(len(right), dtype=Extended)
        for _ in range(self.refinements):
            residual = right - self.matrix @ x
            x += self.scale * self.lu.solve(self.scale * residual.astype(float))
        return x


class Solve:
    """(c C + S) y = c C y* + r + lambda e, solved for y - y*; once for a free tip and once for a tip held by a stop."""

    def __init__(self, C, S, e, c, epsilon):
        self.S, self.e = S, e
        matrix = (c * C + S).tocsr()
        self.free = Factors(matrix)
        self.held = Factors(scipy.sparse.bmat([[matrix, -e[:, None]], [e[None, :], numpy.array([[epsilon]])]], format="csr"))

    def __call__(self, start, r, lower, upper):
        right = r - self.S @ start
        y = start + self.free.solve(right)
        tip = y[-2]
        if lower <= tip <= upper:
            return y, 0.0
        gap = (upper if tip > upper else lower) - start[-2]
        increment = self.held.solve(numpy.append(right, gap))
        return start + increment[:-1], increment[-1]
