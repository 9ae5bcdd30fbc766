"""The program's figures beside the oracle's."""

import collections
import json
import math
import subprocess

import numpy

import events
import scheme

RELATIVE = 1e-6  # of an error
ROUND_OFF = 1e-11  # of the exact solution's own norm: no error below it is looked at more closely; more on fine meshes and in nodal values
TIME_LIMIT = 300.0  # seconds a scene

Figure = collections.namedtuple("Figure", "what ours theirs floor")


class Refused(Exception):
    """The program did not run the scene, or not to its end."""


def agree(figure):
    if figure.theirs is None or not math.isfinite(figure.theirs):
        return False
    return abs(figure.ours - figure.theirs) <= RELATIVE * abs(figure.ours) + figure.floor


def deviation(figure):
    """Relative; of what is below the floor, zero."""
    if figure.theirs is None or not math.isfinite(figure.theirs):
        return math.inf
    return max(0.0, abs(figure.ours - figure.theirs) - figure.floor) / max(abs(figure.ours), 1e-300)


def program(tvbeam, path):
    """The result of the program as it prints it."""
    try:
        done = subprocess.run([tvbeam, "run", str(path), "--json", "-"], capture_output=True, text=True, timeout=TIME_LIMIT)
    except subprocess.TimeoutExpired:
        raise Refused(f"not done after {TIME_LIMIT:g} s") from None
    if done.returncode != 0:
        said = done.stderr.replace(str(path.parent) + "/", "").strip()
        raise Refused(f"exit {done.returncode}: {said}")
    return json.loads(done.stdout)


def figures(case, result, rungs=None):
    """All figures that the result of a scene and the oracle have in common."""
    if "ladder" in case.scene:
        rows = result["ladder"]["rungs"]
        chosen = range(len(rows)) if rungs is None else rungs
        for index, (errors, sizes, march) in zip(chosen, case.ladder(rungs)):
            row = rows[index]
            place = f"s = {row['elements']}, dt = {row['dt']:.6g}"
            for name, error in errors.items():
                yield Figure(f"{place}: {name}", root(name, error), root(name, row["errors"][name]), floor(case, march, name, sizes))
    if "evolution" in case.scene:
        values, march = case.evolution()
        theirs = result["evolution"]["probes"]
        for probe, ours in values.items():
            yield from history(probe, ours, theirs[probe], march, case.scene)
        yield from event_times(events.events(march), result["evolution"]["events"], march)


def history(probe, ours, theirs, march, scene):
    """The sample of a probe at which the two differ most; values are compared like errors of their greatest size."""
    first = 1 if probe == "stress" else 0  # no stress is defined before the first solve
    if len(ours) != len(theirs) or any(value is None for value in theirs[first:]):
        yield Figure(f"{probe}: {len(ours)} samples, {len(theirs)} found", 1.0, None, 0.0)
        return
    size = max(abs(value) for value in ours[first:])
    k = max(range(first, len(ours)), key=lambda n: abs(ours[n] - theirs[n]))
    least = stress_floor(march, scene) if probe == "stress" else 1e-13
    yield Figure(f"{probe}, sample {k}", ours[k], theirs[k], 1e-8 * size + least)


def event_times(ours, theirs, march):
    """Nothing where round-off decides about contact."""
    if ours is None:
        return
    names = [f"{kind} {stop}" for kind, stop, _ in ours]
    found = [f"{event['kind']} {event['stop']}" for event in theirs]
    if names != found:
        yield Figure(f"events: {', '.join(found) or 'none'}; oracle {', '.join(names) or 'none'}", len(ours), None, 0.0)
        return
    for name, (_, _, t), event in zip(names, ours, theirs):
        yield Figure(name, t, event["t"], 1e-6 * float(march.times[-1]))


def root(name, value):
    """The norm itself of what may be a square."""
    return math.sqrt(value) if value is not None and (name.endswith("_sq") or name == "corollary") else value


def is_nodal(scene):
    """The paper's own algorithm, in nodal values of double precision."""
    return scene.get("scheme", {}).get("algorithm") == "fixed-point"


def round_off(march, scene):
    """The condition h^-4 of the oracle's own matrix, in its precision, passes ROUND_OFF from about 60 elements on; that of the paper's
    algorithm, in double precision, from a few on, and each step adds its own."""
    extended = 10.0 * float(numpy.finfo(scheme.Extended).eps) * len(march.space.nodes) ** 4
    if not is_nodal(scene):
        return max(ROUND_OFF, extended)
    nodes = max(len(march.space.nodes), scene.get("reference", {}).get("elements", 0))
    return max(ROUND_OFF, len(march.times) * float(numpy.finfo(float).eps) * nodes**4)


def stress_floor(march, scene):
    """The stress is what moves the tip back by lambda kappa/3; the tip is known to its round-off."""
    leading = 1.0 / scheme.GAMMA
    compliance = 1.0 / (3.0 * (1.0 + march.beam["zeta"] * leading / march.dt)) + march.beam["epsilon"]
    return round_off(march, scene) * abs(march.U).max() / compliance


def floor(case, march, name, sizes):
    scene = case.scene
    found = round_off(march, scene) * root(name, sizes[name])
    if name.startswith("theta") and not sizes[name]:  # of a temperature of zero: what bending takes from heat
        found += round_off(march, scene) * abs(march.beam["alpha"]) * abs(march.U).max()
    if name.startswith("sigma"):
        return found + stress_floor(march, scene) * math.sqrt(float(march.times[-1]))
    if is_nodal(scene):
        # A nodal value is off by about the tolerance, a curvature by 12/h^2 times as much.
        h = min(b - a for a, b in zip(march.space.nodes, march.space.nodes[1:]))
        found += float(scene["scheme"].get("tolerance", 1e-7)) * (1.0 if name in ("theta_L2L2", "theta_LinfL2", "u_LinfL2") else 12.0 / h**2)
    return found + 1e-15
