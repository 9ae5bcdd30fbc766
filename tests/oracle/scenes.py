"""Scenes: read as far as the oracle can solve them, written as the program reads them.

A scene is the dictionary of its TOML document, with the text of its solution under the key "text of solution".
"""

import fractions
import math
import pathlib

import numpy

import norms
import scheme
import solution
from solution import rational

GAUSS_POINTS = (10, 14, 20, 30, 45, 65, 95, 140, 200)


class Unresolved(Exception):
    """The largest number of Gauss points does not integrate the problem."""


def read(path, solutions):
    """A scene file; solutions: the directory of the shipped ones."""
    path = pathlib.Path(path)
    scene = solution.parse_toml(path.read_text())
    if "solution" in scene:
        name = scene["solution"]
        file = path.parent / name if name.endswith(".toml") else pathlib.Path(solutions) / (name + ".toml")
        scene["text of solution"] = file.read_text()
    return scene


def write(scene, directory):
    """Writes scene.toml, and solution.toml beside it; returns the former's path."""
    directory.mkdir(parents=True, exist_ok=True)
    document = {key: value for key, value in scene.items() if key != "text of solution"}
    if "text of solution" in scene:
        document["solution"] = "./solution.toml"
        (directory / "solution.toml").write_text(scene["text of solution"])
    blocks = {key: value for key, value in document.items() if isinstance(value, dict)}
    lines = [f"{key} = {toml(value)}" for key, value in document.items() if key not in blocks]
    for name, block in blocks.items():
        lines += ["", f"[{name}]"] + [f"{key} = {toml(value)}" for key, value in block.items()]
    path = directory / "scene.toml"
    path.write_text("\n".join(lines) + "\n")
    return path


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str) and not isinstance(value, solution.Decimal):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value) if isinstance(value, float) else str(value)


class Case:
    """The problem of a scene, solved as often as is asked for."""

    def __init__(self, scene):
        beam = scene["beam"]
        self.scene = scene
        self.beam = {name: rational(beam.get(name, 0)) for name in ("alpha", "zeta", "theta_A")}
        for name, value in zip(("g1", "g2"), beam.get("stops", [])):
            self.beam[name] = rational(value)
        self.beam["epsilon"] = rational(beam.get("contact", {}).get("epsilon", 0))
        self.mesh = scene.get("mesh", {})
        if "text of solution" in scene:
            self.problem = solution.read_solution(scene["text of solution"], tuple(sorted(self.beam.items())))
        else:
            self.problem = solution.read_data(scene["data"], self.beam)

    def final_time(self):
        return max(float(self.scene[block]["final_time"]) for block in ("ladder", "evolution") if block in self.scene)

    def march(self, final_time, elements, dt, gauss):
        options = self.scene.get("scheme", {})
        steps = round(final_time / dt)
        return scheme.March(self.problem, self.beam, scheme.mesh_nodes(self.mesh, elements), options.get("time", "euler"),
                            options.get("thermal_mass", "consistent") == "lumped", final_time, steps, gauss)

    def ladder(self, rungs=None):
        """For every rung, or those of the given indices: (errors, sizes of the exact solution, march)."""
        block = self.scene["ladder"]
        final_time = rational(block["final_time"])
        measured_against = None
        if "reference" in self.scene:
            fine = self.scene["reference"]
            if fine.get("richardson"):
                raise Unresolved("an extrapolated reference is not known here")
            gauss = self.gauss_points(final_time, min(block["elements"]))
            measured_against = norms.Reference(self.march(final_time, fine["elements"], rational(fine["dt"]), gauss), gauss)
        for index, elements in enumerate(block["elements"]):
            if rungs is not None and index not in rungs:
                continue
            gauss = self.gauss_points(final_time, elements)
            march = self.march(final_time, elements, step_of(block["dt"], index, elements), gauss)
            yield *norms.errors(march, measured_against or norms.Exact(self.problem, gauss), block["norms"]), march

    def evolution(self):
        """({probe: values at the samples}, march)"""
        block = self.scene["evolution"]
        final_time = rational(block["final_time"])
        march = self.march(final_time, block["elements"], rational(block["dt"]), self.gauss_points(final_time, block["elements"]))
        every = block.get("every", 1)
        values = {}
        for probe in block["probes"]:
            name, _, place = probe.partition("@")
            x = float(place or 0)
            values[probe] = {"theta": lambda: march.temperature_at(x), "u": lambda: march.deflection_at(x),
                             "stress": lambda: march.stress, "energy": march.energy}[name]()[::every]
        return values, march

    def gauss_points(self, final_time, elements):
        """How many Gauss points on an element are enough: the number before it gives loads and interpolation errors to 1e-9."""
        nodes = scheme.mesh_nodes(self.mesh, elements)
        ends = [0.0] + [float(p.end) for p in self.problem.phases[:-1] if p.end < final_time] + [float(final_time)]
        times = [a + part * (b - a) for a, b in zip(ends, ends[1:]) for part in (0.03, 0.17, 0.31, 0.5, 0.66, 0.81, 0.97)]

        def integrals(gauss):
            space = scheme.Space(nodes, gauss)
            values = lambda name: self.problem.values(name, space.x, times)
            found = [space.integrals(values("f"), space.chi), space.integrals(values("G"), space.V_x), space.integrals(values("q"), space.V),
                     space.integrals(self.problem.theta0(space.x, 0.0), space.chi), space.integrals(self.problem.curvature0(space.x, 0.0), space.V_xx)]
            if self.problem.is_exact:
                mass = space.gram(space.chi, space.chi).astype(float).toarray()
                for name in ("theta", "theta_x", "u", "u_x", "u_xx"):
                    away = values(name)
                    nearest = numpy.linalg.solve(mass, space.integrals(away, space.chi).T.astype(float))
                    away = away - (space.chi.T @ nearest).T
                    found.append(numpy.sqrt(away**2 @ space.weights))
            return found

        coarse = integrals(GAUSS_POINTS[0])
        for gauss in GAUSS_POINTS[1:]:
            fine = integrals(gauss)
            if all(numpy.max(numpy.abs(a - b)) <= 1e-9 * numpy.max(numpy.abs(b)) + 1e-13 for a, b in zip(coarse, fine)):
                return gauss
            coarse = fine
        raise Unresolved(f"{elements} elements of {GAUSS_POINTS[-1]} Gauss points do not integrate it")


def step_of(dt, index, elements):
    """dt of a rung: of a list, or one expression in s."""
    if isinstance(dt, list):
        return rational(dt[index])
    value = solution.expression(dt, {"s": solution.exact(elements)})
    return fractions.Fraction(int(value.p), int(value.q)) if value.is_Rational else fractions.Fraction(float(value))
