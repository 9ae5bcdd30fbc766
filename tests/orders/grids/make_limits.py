#!/usr/bin/env python3
"""Sequences of values whose limits are known, for limit_scores.

    make_limits.py synthetic COUNT SEED OUT.txt         by the recipe of ../limit_coverage.cpp
    make_limits.py beam TVBEAM COUNT FIRST OUT.txt      of the random solutions from number FIRST on (solutions.py)

The beam's values are the temperature at x = 0.4, the deflection at x = 0.5 and at the tip, at the final time; elements and
steps are refined together. Output, as text:

    case LEVELS LIMIT GROUP…                            what the sequence is counted in
    H VALUE                                             LEVELS lines, coarse to fine
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import solutions

FAMILIES = ["pure", "next_term", "logarithm", "scatter", "alternating", "floor"]
PROBES = ["theta@0.4", "u@0.5", "u@1"]
LADDERS = [[4, 8, 16, 32, 64, 128, 256], [16, 24, 36, 54, 81], [10, 20, 30, 40, 50, 60], [8, 12, 16, 24, 32, 48, 64, 96],
           [64, 80, 100, 125]]


def levels_group(levels):
    return "3_or_4_levels" if levels < 5 else "5_to_7_levels" if levels < 8 else "8_to_12_levels"


def write(out, limit, rows, groups):
    print("case", len(rows), repr(limit), "all", *groups, file=out)
    for h, value in rows:
        print(repr(h), repr(value), file=out)


def synthetic(generator):
    """limit, rows, groups"""
    between = generator.uniform
    family = generator.choice(FAMILIES)
    limit, p = between(-1, 1), between(0.5, 6)
    ratio = math.exp(between(math.log(1.04), math.log(3)))
    levels, power = generator.randint(3, 12), generator.choice([1, 2])
    nearby = {"next_term": 3, "scatter": 0.5, "floor": 0.5}.get(family, 0)
    following = between(-nearby, nearby)
    logarithm = between(0, 1) if family == "logarithm" else 0
    scatter = between(0, 0.03) if family == "scatter" else 0
    floor = ratio**((1 - levels) * p) * 10**between(-2, 0) if family == "floor" else 0
    rows = []
    for k in range(levels):
        h = ratio**-k
        error = h**p * (1 + following * h**power) * (1 - logarithm * math.log(h))
        if family == "alternating" and k % 2 == 1:
            error = -error
        rows.append((h, limit + error * (1 + scatter * generator.gauss(0, 1)) + floor * between(-0.5, 0.5)))
    return limit, rows, [family, "order_up_to_2" if p <= 2 else "order_above_2", levels_group(levels),
                         "ratio_below_1.2" if ratio < 1.2 else "ratio_1.2_to_1.6" if ratio < 1.6 else "ratio_above_1.6"]


def beam(program, folder, k):
    """A random ladder of a random solution: what synthetic() gives, for each probe."""
    solution = solutions.solution(k)
    generator = random.Random(17000 + k)
    scheme = generator.choice(["euler", "bdf2", "sdirk2"])
    mass = generator.choice(["lumped", "consistent"])
    ladder = generator.choice(LADDERS)
    steps_per_element = generator.choice([1, 2, 5])
    length = generator.randint(min(4, len(ladder)), len(ladder))
    with open(os.path.join(folder, "solution.toml"), "w") as file:
        file.write(solution["text"])
    values = {probe: [] for probe in PROBES}
    for s in ladder[:length]:
        steps = s * steps_per_element
        path = os.path.join(folder, "scene.toml")
        with open(path, "w") as file:
            file.write('solution = "./solution.toml"\n[beam]\n{}[scheme]\ntime = "{}"\nthermal_mass = "{}"\n[evolution]\n'
                       'final_time = {}\nelements = {}\ndt = {!r}\nevery = {}\nprobes = {}\n'.format(
                           solution["beam"], scheme, mass, solution["final_time"], s, solution["final_time"] / steps,
                           steps, json.dumps(PROBES)))
        run = subprocess.run([program, "run", path, "--json", "-", "--quiet"], capture_output=True, text=True)
        if run.returncode != 0:
            raise RuntimeError("{}: {}".format(solution["name"], run.stderr))
        evolution = json.loads(run.stdout)["evolution"]
        for probe in PROBES:
            values[probe].append((1 / s, evolution["probes"][probe][-1]))
    for probe in PROBES:
        yield evolution["exact"][probe][-1], values[probe], [probe, solution["family"], scheme, levels_group(length)]


if __name__ == "__main__":
    if sys.argv[1] == "synthetic":
        count, seed = map(int, sys.argv[2:4])
        generator = random.Random(seed)
        with open(sys.argv[4], "w") as out:
            for _ in range(count):
                write(out, *synthetic(generator))
    else:
        count, first = map(int, sys.argv[3:5])
        with open(sys.argv[5], "w") as out, tempfile.TemporaryDirectory() as folder:
            for k in range(first, first + -(-count // len(PROBES))):
                for sequence in beam(sys.argv[2], folder, k):
                    write(out, *sequence)
