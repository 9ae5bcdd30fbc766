"""Random problems, admissible by construction; a seed gives one scene.

theta = lift + terms that vanish at both ends; lift(0) = theta_A, lift(1) = 0.
u = tip(t) L(x) + terms that vanish at x = 0 with their slope, and at x = 1; L(0) = L'(0) = 0, L(1) = 1. So u(1,t) = tip(t), which
goes from phase to phase: free between the stops, or held by one with a sigma of its sign. Penalised stops yield by -epsilon sigma.
Whatever a later phase adds begins with zero.
"""

import fractions
import random

import norms

SHAPES = [  # zero at x = 0 and x = 1
    "sin({i}*pi*x)", "x*(1 - x)", "x*(1 - x)*exp(-{i}*x)", "x*(1 - x)*tanh({k}*(x - {c}))", "x^3*(1 - x)/(1 + x)", "sinh(x)*(1 - x)",
    "x*cos(pi*x/2)", "x*log(2 - x)", "x*(1 - x)*({c}*x + {d})^{n}", "x*(1 - x)*atan({i}*x - 1)", "sin(pi*x)^2", "x*(1 - x)*sqrt(1 + x)",
]
TIMES = [
    "exp(-{a}*t)", "cos({i}*t)", "sin({i}*t)", "(1 + {a}*t)", "t^2", "1/(1 + {a}*t)", "(1 - {e}*t)^{n}", "sqrt(1 + t)", "tanh({i}*(t - {c}))",
    "log(2 + t)", "atan(3*t)", "1",
]
MIXED = [  # of x and t, no product
    "exp(-x*t)", "tanh({k}*(x - {c} - t/4))", "({c}*x + {e}*t)^{n}", "(1 - {e}*x*t)^{n}", "1/(1 + exp({k}*(x - {c} - t/3)))", "cos(x*t + {i}*x)",
    "1/(1 + {a}*x*t)", "x^(6 + t)", "sqrt(1 + x*t)", "exp(-{k}*(x - {c})^2*(1 + t))",
]
LEVERS = ["(3*x^2 - x^3)/2", "x^2", "(1 - cos(pi*x))/2", "x^2*(2 - x)", "x^3", "x^2*exp(x - 1)", "x^2*({c}*x + {d})"]  # {c} + {d} = 1
BUMPS = ["x^2*(1 - x)^2", "x^2*(1 - x)", "x^2*sin(pi*x)", "(1 - cos(2*pi*x))/8", "x^2*(1 - x)*({c}*x + {d})^{n}", "x^2*(1 - x)*exp(-{i}*x)"]
RISES = ["{s}^2*(3 - 2*{s})", "{s}", "1 - (1 - {s})^3", "sin(pi*{s}/2)^2", "{s}^2", "{s}^3*(10 - 15*{s} + 6*{s}^2)"]  # from 0 to 1 with s
FORCES = ["{s}*(1 - {s})", "{s}^2*(1 - {s})^2", "sin(pi*{s})^2", "1", "1 + t", "{s}", "1 - {s}", "exp(-t)"]  # >= 0; the first three end with 0
CLOSED_FORCES = 3


class Draw(random.Random):
    def decimal(self, low, high, digits=2):
        return f"{self.uniform(low, high):.{digits}f}"

    def chance(self, probability):
        return self.random() < probability

    def fill(self, pattern, **more):
        c = self.decimal(0.1, 0.9)
        # The sum that is raised to a high power stays below one.
        values = {"i": self.randint(1, 3), "k": self.choice([5, 8, 12, 20, 30, 40]), "n": self.choice([2, 3, 5, 12, 40, 103, 154]), "a": self.decimal(0.1, 2),
                  "c": c, "d": f"{1 - float(c):.2f}", "e": self.choice(["0.01", "0.05", "0.001", "0.1"])}
        return pattern.format(**values, **more)

    def term(self, shapes):
        """A product of a shape and a time, or what is none."""
        shape = self.fill(self.choice(shapes))
        return f"{shape}*{self.fill(self.choice(MIXED if self.chance(0.4) else TIMES))}"


def scene_of(seed, time_scheme):
    """The same problem for every time scheme."""
    draw = Draw(seed)
    scene = {"title": f"seed {seed}"}
    beam = beam_of(draw)
    final_time, steps, ends = times_of(draw)
    mesh, elements = mesh_of(draw)
    scene["beam"] = {key: value for key, value in beam.items()}
    if mesh:
        scene["mesh"] = mesh
    given = draw.chance(0.12)
    if given:
        scene["data"] = data_of(draw, beam)
    else:
        scene["text of solution"] = solution_of(draw, beam, final_time, ends)
    scene["scheme"] = {"time": time_scheme, "thermal_mass": draw.choice(["lumped", "consistent"])}
    if draw.chance(0.1) and beam["alpha"] < 0.5:
        scene["scheme"] |= {"algorithm": "fixed-point", "tolerance": 1e-13}
    elif draw.chance(0.3):
        scene["scheme"]["basis"] = "nodal"
    dt = [fractions.Fraction(final_time) / (steps * 2**level) for level in range(3)]
    with_reference = given and not mesh
    if with_reference:
        scene["reference"] = {"elements": 4 * elements, "dt": float(dt[2] / 2)}
    if not given or with_reference:
        scene["ladder"] = {"final_time": float(final_time), "elements": [elements, elements, 2 * elements], "dt": [float(step) for step in dt],
                           "norms": list(norms.PARTS)}
    if (given and (mesh or draw.chance(0.3))) or draw.chance(0.2):
        probes = [f"theta@{draw.decimal(0.03, 0.97)}", f"u@{draw.decimal(0.03, 0.97)}", "u@1", "theta@1", "theta@0", "stress", "energy"]
        scene["evolution"] = {"final_time": float(final_time), "elements": elements, "dt": float(dt[1]), "probes": probes}
    return scene


def beam_of(draw):
    beam = {"alpha": draw.choice([0.0, 0.017, 0.4, 0.4, 1.3, 3.0]), "zeta": draw.choice([0.0, 0.03, 0.1, 0.1, 1.0, 10.0])}
    if draw.chance(0.35):
        beam["theta_A"] = draw.choice([0.8, -1.5, 0.1])
    kind = draw.choice(["none", "both", "both", "both", "lower", "upper"])
    if kind != "none":
        lower, upper = draw.choice([-0.02, -0.1, -0.3]), draw.choice([0.1, 0.05, 0.3])
        beam["stops"] = [lower if kind != "upper" else float("-inf"), upper if kind != "lower" else float("inf")]
        if draw.chance(0.3):
            beam["contact"] = {"law": "penalty", "epsilon": draw.choice([0.1, 0.01, 0.001, 1e-5])}
    return beam


def times_of(draw):
    """Final time, coarsest number of steps, and the ends of phases between them, as texts in order."""
    final_time = draw.choice(["0.4", "1", "2", "0.9", "1.2", "0.7", "3"])
    steps = draw.choice([5, 8, 10, 12, 16, 20])
    ends = {}
    for _ in range(draw.choice([0, 0, 1, 1, 2, 2, 3])):
        level = fractions.Fraction(final_time) * draw.randint(1, 4 * steps - 1) / (4 * steps)
        text = draw.choice([
            str(float(level)) if len(str(float(level))) < 10 else f"{level.numerator}/{level.denominator}",
            f"{level.numerator}/{level.denominator}", f"{float(level):.3f}", f"{final_time}*sqrt(2)/{draw.randint(2, 5)}"])
        value = float(fractions.Fraction(final_time)) * 2**0.5 / int(text[-1]) if "sqrt" in text else float(fractions.Fraction(text))
        if all(abs(value - other) > 0.08 * float(final_time) for other in [0.0, float(final_time), *ends]):
            ends[value] = text
    return final_time, steps, [ends[value] for value in sorted(ends)]


def mesh_of(draw):
    """([mesh] block, elements of the coarsest mesh)"""
    elements = draw.choice([3, 4, 5, 6, 8])
    kind = draw.choice(["uniform", "uniform", "grading", "nodes"])
    if kind == "grading":
        return {"grading": draw.choice([0.8, 1.3, 1.5, 2, 2.5])}, elements
    if kind == "nodes":
        inner = sorted({draw.decimal(0.1, 0.9, 1) for _ in range(draw.randint(1, 3))})
        return {"nodes": [0.0, *map(float, inner), 1.0]}, (len(inner) + 1) * draw.randint(1, 3)
    return {}, elements


def sum_of(draw, count, shapes, scales):
    return " ".join(f"{draw.choice('+-')} {draw.choice(scales)}*{draw.term(shapes)}" for _ in range(count))


def later(draw, ends, shapes, scales):
    """What is added from each phase on, zero at its beginning."""
    added = [""]
    for end in ends:
        more = f" + {draw.choice(scales)}*(t - {end})^{draw.randint(1, 3)}*{draw.fill(draw.choice(shapes))}" if draw.chance(0.25) else ""
        added.append(added[-1] + more)
    return added


def lift(draw, beam):
    if not beam.get("theta_A"):
        return ""
    return draw.choice(["theta_A*(1 - x)", "theta_A*(1 - x)^2", "theta_A*cos(pi*x/2)", "theta_A*(1 - x)*exp(-x*t)"]) + " "


def solution_of(draw, beam, final_time, ends):
    names = {}  # ends as parameters
    for index, end in enumerate(ends):
        if draw.chance(0.4):
            names[f"t{index + 1}"] = end
    texts = [next((name for name, value in names.items() if value == end), f"({end})") for end in ends]
    theta = lift(draw, beam) + sum_of(draw, draw.randint(1, 2), SHAPES, ["0.5", "1", "2.3", "0.07"])
    thetas = [theta + more for more in later(draw, texts, SHAPES, ["0.3", "1"])]
    bump = sum_of(draw, draw.randint(0, 2), BUMPS, ["0.01", "0.05", "0.3"])
    bumps = [bump + more for more in later(draw, texts, BUMPS, ["0.02", "0.1"])]
    lever = draw.fill(draw.choice(LEVERS))
    regimes = regimes_of(draw, beam, len(ends) + 1)
    penalised = "contact" in beam and draw.chance(0.7)  # else the solution is one of rigid stops
    begins, stops = ["0", *texts], [*texts, final_time]
    lines = []
    if len(set(thetas)) == 1:
        lines.append(f'theta = "{thetas[0]}"')
    if names:
        lines += ["[parameters]"] + [f'{name} = "{value}"' for name, value in names.items()]
    for index, regime in enumerate(regimes):
        s = f"((t - {begins[index]})/({stops[index]} - {begins[index]}))" if begins[index] != "0" else f"(t/{stops[index]})"
        tip, sigma = motion(draw, beam, regime, s, penalised, len(regimes) > 1)
        u = f"({tip})*{lever} {bumps[index]}"
        if draw.chance(0.15):
            sigma = f"{sigma} + {draw.choice(['0.2', '1'])}*(1 - x)*{draw.fill(draw.choice(TIMES + MIXED))}"
        lines.append("[[phase]]" if ends else "")
        if index < len(ends):
            lines.append(f'until = "{texts[index]}"')
        if len(set(thetas)) > 1:
            lines.append(f'theta = "{thetas[index]}"')
        lines.append(f'u = "{u}"')
        if sigma != "0" or draw.chance(0.3):
            lines.append(f'sigma = "{sigma}"')
    # A solution of one phase has all its keys at the top, before [parameters].
    return "\n".join(lines) + "\n"


def regimes_of(draw, beam, count):
    """(regime, tip at the beginning, tip at the end) of each phase; regime: free, g1 or g2."""
    lower, upper = beam.get("stops", [float("-inf"), float("inf")])
    there = [name for name, stop in (("g1", lower), ("g2", upper)) if abs(stop) < 10.0]
    inside = lambda: f"{draw.uniform(max(lower, -0.1) * 0.9, min(upper, 0.1) * 0.9):.3f}"
    kinds = []
    for index in range(count):
        kind = draw.choice(["free", *there, *there])
        if kinds and kinds[-1] != "free" and kind not in ("free", kinds[-1]):
            kind = "free"
        kinds.append(kind)
    result = []
    for index, kind in enumerate(kinds):
        begin = result[-1][2] if result else inside()
        end = kinds[index + 1] if index + 1 < count and kinds[index + 1] != "free" else inside()
        result.append((kind, begin, end) if kind == "free" else (kind, kind, kind))
    return result


def motion(draw, beam, regime, s, penalised, has_neighbours):
    """Texts of u(1,t) and sigma(1,t) in one phase; s: the text that goes from 0 to 1 in it."""
    kind, begin, end = regime
    if kind == "free":
        if begin == end:  # away from a stop and back
            return f"{begin}*(1 - {draw.decimal(0.2, 0.8)}*sin(pi*{s})^2)", "0"
        return f"{begin} + ({end} - ({begin}))*({draw.fill(draw.choice(RISES), s=s)})", "0"
    # A penalised tip is on the stop where its phase borders on another one: there the force has died away.
    force = draw.fill(draw.choice(FORCES[:CLOSED_FORCES] if penalised and has_neighbours else FORCES), s=s)
    sigma = f"{'' if kind == 'g1' else '-'}{draw.choice(['0.1', '0.5', '2'])}*({force})"
    if penalised:
        return f"{kind} - {beam['contact']['epsilon']}*({sigma})", sigma
    return kind, sigma


def data_of(draw, beam):
    lower, upper = beam.get("stops", [-1.0, 1.0])
    tip = draw.uniform(max(lower, -0.1), min(upper, 0.1))
    ends = "theta_A*(1 - x) + " if beam.get("theta_A") else ""
    data = {"theta0": f"{ends}{draw.choice(['1', '2'])}*{draw.fill(draw.choice(SHAPES))}", "u0": f"{tip:.3f}*x^2"}
    if draw.chance(0.7):
        data["body_force"] = f"{draw.choice(['5', '2', '0.4'])}*{draw.choice(['sin(2*pi*t)', draw.fill(draw.choice(TIMES + MIXED))])}"
    if draw.chance(0.5):
        data["heat_source"] = draw.fill(draw.choice(SHAPES)) + "*" + draw.fill(draw.choice(TIMES + MIXED))
    return data
