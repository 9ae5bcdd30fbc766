"""An exact solution (or given data) as text, read and differentiated anew.

The text is Python's but for `^`, so that Python's own parser gives the tree; SymPy differentiates. Nothing is shared with mms/.

    f = theta_t - theta_xx - alpha u_xxt                      (1)
    q = sigma_x                                               (2)
    G = sigma + u_xxx + zeta u_xxxt + alpha theta_x           (3)
    m = u_xx(1,t) + zeta u_xxt(1,t)                           (9)
"""

import ast
import fractions
import functools
import math
import tomllib
import warnings

import mpmath
import numpy
import sympy

X, T = sympy.symbols("x t", real=True)
FUNCTIONS = {name: getattr(sympy, name) for name in
             "sin cos tan asin acos atan sinh cosh tanh exp log sqrt".split()}
OPERATIONS = {ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
              ast.Div: lambda a, b: a / b, ast.Pow: lambda a, b: a**b}
FIELDS = ("theta", "theta_x", "u", "u_x", "u_xx", "f", "G", "q")  # of x and t
AMPLITUDES = ("sigma", "m")  # of t alone, at x = 1


def exact(number):
    """A decimal, as tomllib or Python's parser hands it on, as the rational that was written."""
    return sympy.Rational(str(number))


def expression(text, names):
    """The SymPy expression of a text or a number; names: what it may use besides pi and the functions."""
    text = str(text)
    source = text.replace("^", "**")

    def translate(node):
        if isinstance(node, ast.Constant) and not isinstance(node.value, (str, bytes, bool, complex)):
            return exact(ast.get_source_segment(source, node))
        if isinstance(node, ast.Name) and (node.id == "pi" or node.id in names):
            return sympy.pi if node.id == "pi" else names[node.id]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
            inner = translate(node.operand)
            return -inner if isinstance(node.op, ast.USub) else inner
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATIONS:
            return OPERATIONS[type(node.op)](translate(node.left), translate(node.right))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
            return FUNCTIONS[node.func.id](*map(translate, node.args))
        raise ValueError(f"not understood in {text!r}: {ast.dump(node)}")

    return translate(ast.parse(source.strip(), mode="eval").body)


def in_extended_precision(function):
    return lambda value: function(numpy.asarray(value, dtype=numpy.longdouble))


# Of constants, too: exp(1000) of a Python number is infinite.
EXTENDED = {name: in_extended_precision(getattr(numpy, name)) for name in
            "sin cos tan arcsin arccos arctan sinh cosh tanh exp log sqrt".split()}


class Compiled:
    """A function of x and t in double precision. What is no finite number there is evaluated in extended precision, which has the range,
    and with 50 digits where that has none either.

    SymPy writes (0.53 x + 0.47)^154 as (53 x + 47)^154/100^154. Numbers that no double holds, or nearly so, are handed over in extended
    precision."""

    def __init__(self, formula):
        self.formula = sympy.sympify(formula)
        self.is_zero = self.formula == 0
        self.large = {number: sympy.Dummy() for number in self.formula.atoms(sympy.Rational) if max(abs(number.p), number.q) > 10**60}
        self.numbers = [numpy.longdouble(str(number.p)) / numpy.longdouble(str(number.q)) for number in self.large]
        self.fast = self.lambdify("numpy")
        self.wide = self.careful = None

    def lambdify(self, modules):
        # Without cse: that of SymPy 1.11 changes the value of some sums with derivatives of tanh.
        return sympy.lambdify((X, T, *self.large.values()), self.formula.xreplace(self.large), modules)

    def __call__(self, x, t):
        """Values at all pairs; shape: times, points."""
        x, t = numpy.atleast_1d(x)[None, :], numpy.atleast_1d(t)[:, None]
        shape = (t.shape[0], x.shape[1])
        if self.is_zero:
            return numpy.zeros(shape)
        number = numpy.longdouble if self.large else float
        values = self.values(self.fast, x.astype(number), t.astype(number), shape)
        rows, columns = numpy.nonzero(~numpy.isfinite(values))
        if len(rows):
            self.wide = self.wide or self.lambdify([EXTENDED, "numpy"])
            values[rows, columns] = self.values(self.wide, x[0, columns].astype(numpy.longdouble),
                                                t[rows, 0].astype(numpy.longdouble), rows.shape)
        for row, column in zip(*numpy.nonzero(~numpy.isfinite(values))):
            values[row, column] = self.with_digits(x[0, column], t[row, 0])
        return values

    def values(self, function, x, t, shape):
        """NaN where Python refuses constants that no double holds."""
        with warnings.catch_warnings(), numpy.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            try:
                return numpy.array(numpy.broadcast_to(function(x, t, *self.numbers), shape), dtype=float)
            except (OverflowError, ZeroDivisionError, TypeError, AttributeError):
                return numpy.full(shape, math.nan)

    def with_digits(self, x, t, digits=50):
        if self.careful is None:
            self.careful = sympy.lambdify((X, T), self.formula, "mpmath")
        with mpmath.workdps(digits):
            return float(mpmath.re(self.careful(mpmath.mpf(float(x)), mpmath.mpf(float(t)))))

    def worst_of(self, points):
        """The largest error of double precision at some (x, t), over the largest value there."""
        values = [(float(self(x, t)[0, 0]), self.with_digits(x, t)) for x, t in points]
        largest = max(abs(value) for _, value in values)
        return max(abs(a - b) for a, b in values) / largest if largest > 0.0 else 0.0


class Phase:
    """The functions of one phase; end: the exact time at which it ends, or None."""

    def __init__(self, end, theta, u, sigma, beam):
        self.end = end
        alpha, zeta = beam["alpha"], beam["zeta"]
        u_xx = sympy.diff(u, X, 2)
        u_xxt = sympy.diff(u_xx, T)
        formulas = {
            "theta": theta, "theta_x": sympy.diff(theta, X),
            "u": u, "u_x": sympy.diff(u, X), "u_xx": u_xx,
            "f": sympy.diff(theta, T) - sympy.diff(theta, X, 2) - alpha * u_xxt,
            "G": sigma + sympy.diff(u_xx, X) + zeta * sympy.diff(u_xxt, X) + alpha * sympy.diff(theta, X),
            "q": sympy.diff(sigma, X),
            "sigma": sigma.subs(X, 1), "m": (u_xx + zeta * u_xxt).subs(X, 1),
        }
        self.functions = {name: Compiled(formula) for name, formula in formulas.items()}


class Problem:
    """What a run needs: sources, initial values and, of a solution, the exact functions."""

    def __init__(self, phases, theta0=None, curvature0=None, is_exact=True):
        self.phases = phases
        self.is_exact = is_exact
        self.theta0 = theta0 or phases[0].functions["theta"]
        self.curvature0 = curvature0 or phases[0].functions["u_xx"]

    def values(self, name, x, times):
        """A function of the problem at points x and at exact times; shape: times, points. A time that ends a phase
        belongs to it."""
        x = numpy.atleast_1d(x)
        phase_of = numpy.array([self.phase_at(t) for t in times])
        result = numpy.empty((len(times), len(x)))
        for index, phase in enumerate(self.phases):
            rows = numpy.nonzero(phase_of == index)[0]
            if len(rows):
                result[rows] = phase.functions[name](x, numpy.array([float(times[row]) for row in rows]))
        return result

    def phase_at(self, t):
        for index, phase in enumerate(self.phases[:-1]):
            # A level that is the end but for a few of the last digits of a double is that end; what is not rational is
            # known less well.
            slack = 1e-15 if isinstance(t, fractions.Fraction) and isinstance(phase.end, fractions.Fraction) else 1e-13
            if float(t) <= float(phase.end) * (1.0 + slack):
                return index
        return len(self.phases) - 1

    def least_precise(self, final_time, count=6):
        """(relative error, name) of the function that double precision evaluates worst, at points of no pattern."""
        worst = (0.0, "")
        steps = [math.modf(k * (math.sqrt(5.0) - 1.0) / 2.0)[0] for k in range(1, count + 1)]
        for index, phase in enumerate(self.phases):
            first = float(self.phases[index - 1].end) if index else 0.0
            last = float(phase.end) if phase.end is not None else max(final_time, first)
            points = [(math.modf(7.0 * s + 0.13)[0], first + s * (last - first)) for s in steps]
            for name, function in phase.functions.items():
                worst = max(worst, (function.worst_of(points), name))
        return worst


def end_of_phase(formula):
    """As a Fraction where it is one, else as a float of 30 digits."""
    if formula.is_Rational:
        return fractions.Fraction(int(formula.p), int(formula.q))
    return float(formula.evalf(30))


class Decimal(str):
    """A number of TOML with a point or an exponent, as it is written."""


def parse_toml(text):
    return tomllib.loads(text, parse_float=Decimal)


def rational(value):
    """A number of TOML, read by parse_toml, exactly; infinities are floats."""
    text = str(value).replace("_", "")
    return float(text) if "inf" in text else fractions.Fraction(text)


def beam_names(beam):
    """The symbols of the model; stops that are not there have no name."""
    names = {"x": X, "t": T}
    for name in ("alpha", "zeta", "theta_A", "g1", "g2"):
        if name in beam and not (isinstance(beam[name], float) and math.isinf(beam[name])):
            names[name] = sympy.Rational(beam[name].numerator, beam[name].denominator)
    return names


@functools.lru_cache(maxsize=None)
def read_solution(text, beam):
    """The Problem of a solution file on a beam, which is pairs of names (alpha, zeta, theta_A, g1, g2) and Fractions."""
    document = parse_toml(text)
    names = beam_names(dict(beam))
    for name, value in document.get("parameters", {}).items():
        names[name] = expression(value, {})
    phases = []
    for part in document.get("phase", [{}]):
        held = {**document, **part}
        end = end_of_phase(expression(part["until"], names)) if "until" in part else None
        theta, u, sigma = (expression(held.get(key, "0"), names) for key in ("theta", "u", "sigma"))
        if "sigma" not in held and dict(beam).get("epsilon", 0) > 0:
            sigma = penalised_stress(u.subs(X, 1), names, dict(beam)["epsilon"])
        phases.append(Phase(end, theta, u, sigma, names))
    return Problem(phases)


def positive_part(value):
    return (value + sympy.Abs(value)) / 2


def penalised_stress(tip, names, epsilon):
    """sigma(1,t) = -((u(1,t) - g2)^+ - (g1 - u(1,t))^+)/epsilon."""
    stress = sympy.Integer(0)
    if "g2" in names:
        stress -= positive_part(tip - names["g2"])
    if "g1" in names:
        stress += positive_part(names["g1"] - tip)
    return stress / sympy.Rational(epsilon.numerator, epsilon.denominator)


def read_data(data, beam):
    """The Problem of a [data] block: f and q are given, G = m = 0 and no solution is known."""
    names = beam_names(beam)
    zero = Compiled(0)
    phase = Phase(None, sympy.Integer(0), sympy.Integer(0), sympy.Integer(0), {"alpha": 0, "zeta": 0})
    phase.functions["f"] = Compiled(expression(data.get("heat_source", "0"), names))
    phase.functions["q"] = Compiled(expression(data.get("body_force", "0"), names))
    theta0 = Compiled(expression(data["theta0"], names)) if "theta0" in data else zero
    u0 = Compiled(sympy.diff(expression(data["u0"], names), X, 2)) if "u0" in data else zero
    return Problem([phase], theta0, u0, is_exact=False)
