#!/usr/bin/env python3
"""Grids of errors of many solutions, and long sequences that show their asymptotic orders.

    make_grids.py TVBEAM OUT.txt random FIRST LAST      every other random solution of solutions.py
    make_grids.py TVBEAM OUT.txt shipped                those that the program has

Each solution is run with three time schemes and both heat masses on 5 x 5 meshes and steps. What the order is in the end
is taken from runs that are far finer: h at one tiny step, dt on one fine mesh. The output is text:

    case SOLUTION FAMILY SCHEME MASS NORM P Q           "-": the long sequence does not say
    H DT ERROR                                          25 lines
"""
import json
import math
import os
import subprocess
import sys
import tempfile

import solutions

NORMS = ["theta_L2L2", "theta_LinfL2", "theta_L2H1", "u_LinfL2", "u_LinfH1", "u_LinfH2semi"]
SCHEMES = ["euler", "bdf2", "sdirk2"]
MASSES = ["lumped", "consistent"]
ELEMENTS = [8, 16, 32, 64, 128]
STOPPED = "alpha = 0.4\nzeta = 0.15\nstops = [-0.02, 0.1]\n"
SHIPPED = {  # beam, final time, separable
    "copetti-fernandez-2011": ("alpha = 0.017\nzeta = 0.1\nstops = [-0.02, 0.1]\n", 2.0, True),
    "end-moment": (STOPPED, 2.0, True), "force-driven": (STOPPED, 2.0, True),
    "free-decay": ("alpha = 0\nzeta = 0.15\nstops = [-0.02, 0.1]\n", 1.0, True),
    "free-oscillation": (STOPPED, 2.0, True),
    "heated-end": ("alpha = 0.5\nzeta = 0.2\ntheta_A = 0.8\nstops = [-0.5, inf]\n", 1.0, True),
    "impact": (STOPPED, 2.0, True), "moving-front": ("alpha = 0.2\nzeta = 0.1\n", 1.0, False),
    "pressed-front": (STOPPED, 1.0, False),
    "pressed-on-g1": ("alpha = 0.4\nzeta = 0.15\nstops = [-0.05, 0.1]\n", 2.0, True),
    "released-from-g2": (STOPPED, 2.0, True), "stiff-layer": (STOPPED, 0.01, True), "three-phases": (STOPPED, 2.0, True),
    "touch-without-force": (STOPPED, 2.0, True), "trigonometric-deflection": (STOPPED, 2.0, True),
    "cubic-deflection": ("alpha = 0.4\nzeta = 0.15\ntheta_A = 0.8\nstops = [-0.02, 0.1]\n", 2.0, True),
    "uncoupled": ("alpha = 0\nzeta = 0.15\nstops = [-0.02, 0.1]\n", 2.0, True),
}


def shipped():
    for name, (beam, final_time, separable) in SHIPPED.items():
        yield dict(name=name, family="shipped", text=None, beam=beam, final_time=final_time, first_steps=10,
                   separable=separable)


def errors_of(program, folder, solution, scheme, mass, elements, steps):
    """{(elements, steps): {norm: error}}"""
    path = os.path.join(folder, "scene.toml")
    name = solution["name"]
    if solution["text"] is not None:
        with open(os.path.join(folder, "solution.toml"), "w") as file:
            file.write(solution["text"])
        name = "./solution.toml"
    with open(path, "w") as file:
        file.write('solution = "{}"\n[beam]\n{}[scheme]\ntime = "{}"\nthermal_mass = "{}"\n[orders]\nfinal_time = {}\n'
                   'elements = {}\ndt = {}\nnorms = {}\n'.format(
                       name, solution["beam"], scheme, mass, solution["final_time"], elements,
                       [solution["final_time"] / n for n in steps], json.dumps(NORMS)))
    run = subprocess.run([program, "run", path, "--json", "-", "--quiet"], capture_output=True, text=True)
    if run.returncode not in (0, 3):
        raise RuntimeError("{}: {}".format(solution["name"], run.stderr))
    return {(r["elements"], r["steps"]): r["errors"] for r in json.loads(run.stdout)["orders"]["runs"]}


def usable(error):
    return error is not None and error > 1e-11


def settled(widths, errors):
    """The order that a long sequence comes to, coarse to fine; None where it does not say.

    A multiple of 1/2 that the local orders stand on, come nearer to from one to the next, or scatter about (as where the
    steps do not meet the instants of contact).
    """
    orders = [math.log(e0 / e1) / math.log(w0 / w1)
              for w0, w1, e0, e1 in zip(widths, widths[1:], errors, errors[1:])]
    if len(orders) < 3:
        return None
    nearest = round(sum(orders[-2:])) / 2
    gaps = [abs(order - nearest) for order in orders]
    if nearest <= 0:
        return None
    if max(gaps[-2:]) < 0.02 or max(gaps[-3:]) < 0.05:
        return nearest
    if gaps[-1] < 0.8 * gaps[-2] < 0.64 * gaps[-3] and gaps[-1] < 0.12:
        return nearest
    many = orders[-5:]
    slope = math.log(errors[-1 - len(many)] / errors[-1]) / math.log(widths[-1 - len(many)] / widths[-1])
    if len(many) == 5 and abs(slope - round(2 * slope) / 2) < 0.08 and min(many) < slope - 0.03 < slope + 0.03 < max(many):
        return round(2 * slope) / 2
    return None


def order_in_h(coarse_time, fine_time, elements, norm):
    widths, errors = [], []
    for s in elements:
        before, after = coarse_time[s][norm], fine_time[s][norm]
        # What halving the step changes is at least half of what is left of the time error at order one.
        if not (usable(before) and usable(after)) or abs(before - after) > 0.003 * after:
            break
        widths.append(1 / s)
        errors.append(after)
    return settled(widths, errors)


def without_space_error(errors):
    """The square of the error on an infinitely fine mesh, from meshes that are halved: squares have terms in h^2, h^4, …
    (Romberg). None where the last mesh still matters."""
    def romberg(row):
        power = 1
        while len(row) > 1:
            power *= 4
            row = [(power * fine - coarse) / (power - 1) for coarse, fine in zip(row, row[1:])]
        return row[0]

    squares = [error * error for error in errors]
    longer, shorter = romberg(squares[-4:]), romberg(squares[-3:])
    agree = abs(longer - shorter) < 0.01 * longer and longer > 0
    if agree and (longer > 1e-7 * squares[-1]):
        return longer
    # The instant of a greatest norm jumps with the mesh: the finest mesh is trusted where the one before it agrees.
    return squares[-1] if abs(squares[-2] - squares[-1]) < 0.06 * squares[-1] else None


def order_in_dt(grid, meshes, steps, norm):
    widths, errors = [], []
    for n in steps:
        row = [grid[s, n][norm] for s in meshes]
        square = without_space_error(row) if all(map(usable, row)) else None
        if square is None:
            break
        widths.append(1 / n)
        errors.append(math.sqrt(square))
    return settled(widths, errors)


def study(program, solution, out):
    steps = [solution["first_steps"] * 2**k for k in range(5)]
    separable = solution["separable"]
    long_elements = [2**k for k in range(3, 11 if separable else 8)]
    long_steps = [solution["first_steps"] * 2**k for k in range(9 if separable else 6)]
    meshes = [128, 256, 512, 1024, 2048] if separable else [16, 32, 64, 128]
    tiny = [3200, 6400] if separable else [200, 400]
    with tempfile.TemporaryDirectory() as folder:
        def run(*arguments):
            return errors_of(program, folder, solution, *arguments)
        p = {}
        for mass in MASSES:
            grid = run("sdirk2", mass, long_elements, tiny)
            coarse_time, fine_time = ({s: grid[s, n] for s in long_elements} for n in tiny)
            for norm in NORMS:
                p[mass, norm] = order_in_h(coarse_time, fine_time, long_elements, norm)
        for scheme in SCHEMES:
            grid = run(scheme, "consistent", meshes, long_steps)
            q = {norm: order_in_dt(grid, meshes, long_steps, norm) for norm in NORMS}
            for mass in MASSES:
                grid = run(scheme, mass, ELEMENTS, steps)
                for norm in NORMS:
                    say = lambda order: "-" if order is None else order
                    print("case", solution["name"], solution["family"], scheme, mass, norm, say(p[mass, norm]),
                          say(q[norm]), file=out)
                    for s in ELEMENTS:
                        for n in steps:
                            error = grid[s, n][norm]
                            print(1 / s, solution["final_time"] / n, math.nan if error is None else error, file=out)


if __name__ == "__main__":
    program, path, which = sys.argv[1:4]
    chosen = shipped() if which == "shipped" else map(solutions.solution, range(int(sys.argv[4]), int(sys.argv[5]) + 1, 2))
    with open(path, "w") as out:
        for solution in chosen:
            study(program, solution, out)
            out.flush()
            print(solution["name"], file=sys.stderr)
