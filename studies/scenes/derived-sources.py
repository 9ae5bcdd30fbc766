#!/usr/bin/env python3
"""Compares what is derived from a file of equations with differences of its fields, written out here a second time.

    derived-sources.py SYSTEM LANGUAGE H [NAME=FORMULA...]

reads the file `derived`, all functions of SYSTEM in LANGUAGE, evaluates each in three points, and prints how far they
are from the equations applied to the fields by components, with central differences of width H in the place of
derivatives. What is derived right differs by the error of the differences, which is of second order. A FORMULA is one
that stands in a template or a command, compared with the function of the same name. Exact values must agree to round-off.
"""

import math
import re
import sys

H = 0.0
X, Y, Z, T = range(4)


class Field:
    """A function of the point (x, y, z, t), with arithmetic, and derivatives by differences."""

    def __init__(self, function):
        self.at = function

    def by(self, *axes):
        """The derivative by the first axis of that by the others."""
        if not axes:
            return self
        axis, slope = axes[0], self.by(*axes[1:]).at

        def difference(p):
            ahead, behind = list(p), list(p)
            ahead[axis] += H
            behind[axis] -= H
            return (slope(ahead) - slope(behind)) / (2 * H)

        return Field(difference)

    def __add__(self, other):
        return Field(lambda p: self.at(p) + field(other).at(p))

    def __mul__(self, other):
        return Field(lambda p: self.at(p) * field(other).at(p))

    def __truediv__(self, other):
        return Field(lambda p: self.at(p) / field(other).at(p))

    def __sub__(self, other):
        return self + -1 * field(other)

    def __neg__(self):
        return -1 * self

    __radd__, __rmul__ = __add__, __mul__


def field(value):
    """Of a formula in x, y, z, t, of a number, or of a field itself."""
    if isinstance(value, str):
        code = compile(value, value, "eval")
        return Field(lambda p: eval(code, vars(math), dict(zip("xyzt", p))))
    return value if isinstance(value, Field) else Field(lambda p: value)


def fields(*formulas):
    return [field(formula) for formula in formulas]


class System:
    """What the functions of a file are to be: named fields, and where they are known."""

    def __init__(self, exact, sources, boundary=None, initial=None, start=0.0, size=4, plane=None):
        self.places = {}  # of data: axis and position
        self.wanted = dict(sources)
        self.sources = list(sources)
        for name, value in exact.items():
            self.wanted[name + "_exact"] = value
            for axis in range(3):
                if axis in (plane or (X, Y, Z)[:size]):
                    self.wanted[f"{name}_exact_{'xyz'[axis]}"] = value.by(axis)
        for name, (axis, position, value) in (boundary or {}).items():
            self.wanted[name], self.places[name] = value, (axis, position)
        for name, value in (initial or {}).items():
            self.wanted[name + "_initial"], self.places[name + "_initial"] = value, (T, start)


def numbered(name, components):
    return {f"{name}{i + 1}": one for i, one in enumerate(components)}


def heat_2d():
    u = field("sin(pi*x)*sin(pi*y)*cos(t)")
    return System({"u": u}, {"f": u.by(T) - u.by(X, X) - u.by(Y, Y)}, {"flux": (X, 1, u.by(X))}, {"u": u}, size=2)


def advection_diffusion():
    c = field("exp(-t)*sin(2*x + y)*cos(y - 1) + x*y")
    x, y, k = fields("x", "y", "0.05 + 0.05*x*x")
    f = c.by(T) - y * c.by(X) + x * c.by(Y) - (k * c.by(X)).by(X) - (k * c.by(Y)).by(Y)
    return System({"c": c}, {"f": f}, {"outflow": (Y, 1, k * c.by(Y))}, {"c": c}, size=2)


def elasticity():
    u, v = fields("sin(pi*x)*cos(pi*y)", "x**2*sin(pi*y) + x*y")
    xx = 1.4 * u.by(X) + 0.6 * v.by(Y)
    yy = 1.4 * v.by(Y) + 0.6 * u.by(X)
    xy = 0.4 * (u.by(Y) + v.by(X))
    sources = {"f1": -(xx.by(X) + xy.by(Y)), "f2": -(xy.by(X) + yy.by(Y))}
    return System({"u1": u, "u2": v}, sources, {"traction1": (X, 1, xx), "traction2": (X, 1, xy)}, size=2)


def navier_stokes():
    u = field("2*pi*sin(pi*x)**2*sin(pi*y)*cos(pi*y)*cos(t)")
    v = field("-2*pi*sin(pi*x)*cos(pi*x)*sin(pi*y)**2*cos(t)")
    p = field("cos(pi*x)*sin(pi*y)*exp(-t)")
    sources = {f"f{i + 1}": w.by(T) + u * w.by(X) + v * w.by(Y) + p.by(axis) - 0.01 * (w.by(X, X) + w.by(Y, Y))
               for i, (w, axis) in enumerate(((u, X), (v, Y)))}
    sources["continuity"] = u.by(X) + v.by(Y)
    return System({"v1": u, "v2": v, "p": p}, sources, {}, {"v1": u, "v2": v}, size=2)


def curl(a):
    return [a[2].by(Y) - a[1].by(Z), a[0].by(Z) - a[2].by(X), a[1].by(X) - a[0].by(Y)]


def maxwell():
    e = fields("sin(pi*y)*sin(pi*z)*cos(t)", "sin(pi*z)*cos(pi*x)*exp(-t)", "x*y*cos(2*t) + sin(pi*x)")
    h = fields("cos(pi*y)*z*sin(t)", "x*cos(pi*z)*cos(t)", "sin(x + y)*exp(-z)*cos(t)")
    sources = numbered("current", [c - 2 * a.by(T) - 0.3 * a for c, a in zip(curl(h), e)])
    sources |= numbered("faraday", [1.5 * a.by(T) + c for c, a in zip(curl(e), h)])
    sources["charge"] = 2 * (e[0].by(X) + e[1].by(Y) + e[2].by(Z))
    sources["magnetic"] = 1.5 * (h[0].by(X) + h[1].by(Y) + h[2].by(Z))
    exact = numbered("E", e) | numbered("H", h)
    return System(exact, sources, {}, exact)


def compressible_navier_stokes():
    rho = field("1 + 0.15*sin(pi*x) + 0.1*cos(pi*y/2) + 0.12*sin(pi*z) + 0.05*sin(t)")
    v = fields("2 + 0.3*sin(pi*x/2)*cos(pi*y) + 0.2*cos(pi*(x + z))*cos(t)",
               "1.5 + 0.2*cos(pi*x)*sin(pi*y/2) + 0.1*sin(pi*(y + z))*sin(t)",
               "1 + 0.25*sin(pi*x)*sin(pi*y)*cos(pi*z/2) + 0.1*sin(2*t)")
    p = field("1000*(1 + 0.2*cos(pi*x)*cos(pi*y/2) + 0.1*sin(pi*z)*cos(t))")
    heat = [-0.3 * (p / (287 * rho)).by(i) for i in range(3)]
    energy = p / 0.4 + 0.5 * rho * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    divergence = v[0].by(X) + v[1].by(Y) + v[2].by(Z)
    stress = [[0.1 * (v[i].by(j) + v[j].by(i) - (2 / 3 * divergence if i == j else field(0))) for j in range(3)]
              for i in range(3)]
    sources = {"mass": rho.by(T), "energy": energy.by(T)}
    for i in range(3):
        sources[f"momentum{i + 1}"] = (rho * v[i]).by(T) + p.by(i)
        for j in range(3):
            sources[f"momentum{i + 1}"] += (rho * v[i] * v[j] - stress[i][j]).by(j)
        work = stress[i][0] * v[0] + stress[i][1] * v[1] + stress[i][2] * v[2]
        sources["mass"] += (rho * v[i]).by(i)
        sources["energy"] += ((energy + p) * v[i] - work + heat[i]).by(i)
    names = ["mass", "momentum1", "momentum2", "momentum3", "energy"]
    return System({"rho": rho} | numbered("v", v) | {"p": p}, {name: sources[name] for name in names})


def wave_3d():
    u = field("sin(pi*x)*sin(2*pi*y)*cos(pi*z/2)*exp(-t/2)*cos(3*t)")
    s = field("exp(-x*y)/(1 + z*z)")
    f = u.by(T, T) + 0.2 * u.by(T) - (s * u.by(X)).by(X) - (s * u.by(Y)).by(Y) - (s * u.by(Z)).by(Z)
    return System({"u": u}, {"f": f}, {}, {"u": u, "rate": u.by(T)})


def thermoviscoelastic_rod():
    u, theta = fields("x**2*(3 - x)*sin(t)/10", "exp(-t)*sin(pi*x) + x*(1 - x)")
    stress = 3 * u.by(X) + 0.2 * u.by(X, T) - 0.4 * theta
    sources = {"force": 1.2 * u.by(T, T) - stress.by(X),
               "heat": 1.1 * theta.by(T) - 0.7 * theta.by(X, X) + 0.4 * u.by(X, T)}
    initial = {"u": u, "rate": u.by(T), "theta": theta}
    return System({"u": u, "theta": theta}, sources, {"traction": (X, 1, stress)}, initial, size=1)


def beam():
    theta, u = fields("cos(t)*sin(pi*x)", "x**2*(3 - x)*sin(t)/100")
    sources = {"f": theta.by(T) - theta.by(X, X) - 0.3 * u.by(X, X, T),
               "G": u.by(X, X, X) + 0.1 * u.by(X, X, X, T) + 0.3 * theta.by(X)}
    boundary = {"m": (X, 1, u.by(X, X) + 0.1 * u.by(X, X, T))}
    return System({"theta": theta, "u": u}, sources, boundary, {"theta": theta, "u": u}, size=1)


def total(terms):
    sum_of_all = field(0)
    for term in terms:
        sum_of_all += term
    return sum_of_all


def product(matrix, vector):
    return [total(a * b for a, b in zip(row, vector)) for row in matrix]


def turned(matrix):
    return [list(column) for column in zip(*matrix)]


def divergence(matrix):
    return [total(entry.by(j) for j, entry in enumerate(row)) for row in matrix]


def operators_in_space():
    k, c, w = -0.75, 1.5e-3, math.pi / 3
    u = field("sin(pi/3*x)*cosh(y/2)*exp(-z)*cos(t) + 2")
    v = fields("x**2*y**2 + x*z - sin(z*t)", "exp(-x)*z**3 + x*t*y**2 + y*z", "-(x - z)**2*cos(y) + t*x")
    space = range(3)
    slopes = [[v[i].by(j) for j in space] for i in space]
    spread = total(slopes[i][i] for i in space)
    shear = [[slopes[i][j] + slopes[j][i] - (2 / 3 if i == j else 0) * spread for j in space] for i in space]
    flow = [[v[i] * v[j] + (k if i == j else 0) * u for j in space] for i in space]
    one, x, y, z, t = fields("1", "x", "y", "z", "t")
    m = [[x, y * u, one], [z * z, v[0], -t], [v[2], x * y * z, u * u]]
    laplace = [a.by(X, X) + a.by(Y, Y) + a.by(Z, Z) for a in v]
    advection = total(a * u.by(i) for i, a in enumerate(v))
    sources = {"scalar": u.by(T) - k * (u.by(X, X) + u.by(Y, Y) + u.by(Z, Z)) + advection / (2 + u * u)
                         - c * u.by(X, X, Y)}
    sources |= numbered("momentum", [(u * v[i]).by(T) + divergence(flow)[i] - k * divergence(shear)[i]
                                     + curl(v)[i] / (u * u) for i in space])
    sources |= numbered("transposed", [divergence(turned(slopes))[i] - divergence(turned(m))[i] + laplace[i]
                                       for i in space])
    sources |= numbered("rows", [a - 3 * b for a, b in zip(product(m, v), product(turned(m), v))])
    sources["squares"] = (total(0.5 * (slopes[i][j] + slopes[j][i]) * slopes[i][j] for i in space for j in space)
                          + total(slopes[i][j] * m[i][j] for i in space for j in space)
                          - total(m[i][j] * m[j][i] for i in space for j in space)
                          + total(a * a for a in v) / 0.75 - total(shear[i][i] for i in space))
    sources["signs"] = u * u * u + field(
        "-(0.75*0.75) - (x - y - z) - (x - y + z) + x/((y + 1)*(z + 2)) - x*(z + 2)/(y + 1) + 16")
    f = u.at
    sources |= numbered("functions", [
        Field(lambda p: math.asin(f(p) / 9) + math.acos(p[X] / 4) + math.atan(v[1].at(p))
              + math.sinh(p[X] - p[T]) + math.tanh(p[Y])),
        Field(lambda p: math.tan(p[X] / 2) * math.log(f(p)) + math.sqrt(1 + p[X] ** 2) ** 3
              - math.exp(-f(p) ** 2 / 2) * math.cosh(0.75 * p[X])),
        Field(lambda p: (1 + p[X]) ** 2.5 - (1 + p[Y] ** 2) ** -1.5 + f(p) ** w - (2 + math.sin(p[Z])) ** p[X])])
    boundary = {f"pull{i + 1}": (X, 1, flow[i][0] - shear[i][0]) for i in space}
    boundary["ground"] = (Z, 0, k * u.by(Z) - 2 * u)
    initial = {"u": u} | numbered("v", [v[i] - k * u.by(i) for i in space])
    return System({"u": u} | numbered("v", v), sources, boundary, initial)


def operators_in_the_plane():
    nu = -0.02
    psi = field("x**3*y - sin(x - 2*y)*t + 1")
    w = fields("x**4 + 2*x*t*cos(x - 2*y) + t*y",
               "-(4*x**3*y - sin(x - 2*y)*t + 1 - x*t*cos(x - 2*y)) - x**2")
    x, y, t = fields("x", "y", "t")
    slopes = [[w[i].by(j) for j in range(2)] for i in range(2)]
    stress = [[nu * (slopes[i][j] + slopes[j][i]) - (psi if i == j else field(0)) for j in range(2)] for i in range(2)]
    turns = [psi.by(Y), -psi.by(X)]
    sources = {"vortex": psi.by(T) - (w[1].by(X) - w[0].by(Y)) + w[0] * psi.by(X) + w[1] * psi.by(Y)}
    sources |= numbered("force", [w[i].by(T) + product(slopes, w)[i] - divergence(stress)[i] + turns[i]
                                  for i in range(2)])
    other = divergence([[psi, w[1]], [w[0], x * t]])
    sources |= numbered("skew", [a - b for a, b in zip(divergence(turned(stress)), other)])
    sources["powers"] = psi * psi / field("(y*y + 1)**2.5") + field(
        "exp(log(x*x + y + 1)/3 - t*log(2)) + 8e-6*exp(y*log(2 + x))")
    sources["joined"] = psi + field("exp((2 + x/3)*log(y + 1))").by(Y) + field(
        "sinh(x)*tanh(x) + 2*tanh(y)/cosh(y)")
    free = product(turned(slopes), [x, y])
    boundary = {"side1": (X, 2, stress[0][0]), "side2": (X, 2, stress[1][0]),
                "free1": (X, 0.7, 2 * free[0]), "free2": (X, 0.7, 2 * free[1])}
    initial = numbered("rate", [a.by(T) - nu * a for a in w])
    return System({"psi": psi} | numbered("w", w), sources, boundary, initial, start=0.5, size=2)


def require_double(fortran):
    if single := re.search(r"(?<![\w.])(\d+\.\d*|\d+(?=e))(e[-+]?\d+)?(?![\w.])", fortran):
        sys.exit(f"{single[0]} is of single precision")


class Derived:
    """The functions of generated code, read as Python."""

    def __init__(self, text, language):
        text = re.sub(r"\blambda\b", "lambda_", text)  # a word of Python
        self.first = 1 if language == "fortran" else 0
        self.power = language in ("freefem", "julia", "moose")
        self.functions = {}
        self.codes = {}
        self.names = {name: getattr(math, name) for name in dir(math) if not name.startswith("_")}
        if language in ("c", "c++", "freefem"):
            self.read_braces(re.sub(r"//.*", "", text).replace("std::", ""))
        elif language == "fortran":
            require_double(re.sub(r"!.*", "", text))
            text = re.sub(r"&\n\s*", " ", re.sub(r"!.*", "", text)).replace("_dp", "")
            self.read_blocks(text, r"protected :: (\w+) = (.*)", r"(?:function|subroutine) (\w+)\((.*?)\)\n(.*?)\n *end")
        elif language == "moose":
            self.read_moose(re.sub(r"#.*", "", text))
        else:
            text = re.sub(r"#.*", "", text)
            self.read_blocks(text, r"^(?:const )?(\w+) = (\S+)$", r"(?:def|function) (\w+)\((.*?)\):?\n(.*?)(?=\n\S|\Z)")
        if self.names["pi"] != math.pi:
            sys.exit(f"pi is {self.names['pi']}")

    def value(self, formula, known):
        if formula not in self.codes:
            self.codes[formula] = compile(formula.replace("^", "**") if self.power else formula, formula, "eval")
        return eval(self.codes[formula], self.names, known)

    def add(self, name, arguments, steps):
        """steps: (variable, formula); of what is returned the variable is empty, or values[i]; in Fortran from 1."""
        places = [int(place) for place in re.findall(r"values\D(\d+)", " ".join(step[0] for step in steps))]
        if places != [place + self.first for place in range(len(places))]:
            sys.exit(f"values of {name} at {places}")

        def call(point):
            known = {word: point["xyzt".index(word)] for word in re.findall(r"\b[xyzt]\b", arguments)}
            results = []
            for variable, formula in steps:
                value = self.value(formula, known)
                if variable in ("", name) or variable.startswith("values"):
                    results.append(value)
                else:
                    known[variable] = value
            return results[0] if len(results) == 1 else results

        self.functions[name] = call

    def read_braces(self, text):
        for name, value in re.findall(r"^(?:(?:static )?const(?:expr)? double|constexpr double|real) (\w+) = ([^;]+);",
                                      text, re.M):
            self.names[name] = float(value)
        for name, arguments, body in re.findall(r"(?:double|real|void) (\w+)\(([^{]*)\) \{(.*?)\n\}", text, re.S):
            steps = []
            for statement in re.sub(r"\s+", " ", body).split(";"):
                statement = re.sub(r"^ *(?:const double|real) ", "", statement).strip()
                if statement.startswith("return "):
                    steps.append(("", statement[7:]))
                elif " = " in statement:
                    for one in re.split(r", (?=\w+ = )", statement):
                        steps.append(tuple(one.split(" = ", 1)))
            self.add(name, arguments, steps)

    def read_blocks(self, text, constant, function):
        for name, value in re.findall(constant, text, re.M):
            if name != "dp":
                self.names[name] = self.value(value, {})
        for name, arguments, body in re.findall(function, text, re.S):
            body = re.sub(r"\n {8,}", " ", body)  # lines that go on
            steps = [one.split(" = ", 1) for one in re.findall(r"^ *([\w()]+ = .*)$", body, re.M)]
            returned = re.search(r"return (.*)", body)
            if returned:
                steps.append(["", returned[1]])
            self.add(name, arguments, steps)

    def read_moose(self, text):
        names = re.search(r"symbol_names = '(.*)'", text)
        values = re.search(r"symbol_values = '(.*)'", text)
        if names:
            self.names |= dict(zip(names[1].split(), map(float, values[1].split())))
        for name, expression in re.findall(r"\[(\w+)\]\s+type = ParsedFunction\s+expression = '(.*?)'", text, re.S):
            *shared, value = re.sub(r"\s+", " ", expression).split(";")
            self.add(name, "x y z t", [one.strip().split(" := ") for one in shared] + [("", value.strip())])


POINTS = [(0.35, 0.62, 0.44, 0.7), (0.81, 0.27, 0.68, 1.1), (0.56, 0.93, 0.15, 0.3)]


def called(name, language):
    """FreeFEM has no names with _."""
    return name.replace("_", "") if language == "freefem" else name


def difference(value, wanted):
    """As a part of what is wanted, or of one."""
    return abs(value - wanted) / max(1.0, abs(wanted))


def main():
    global H
    system, language, H = globals()[sys.argv[1].replace("-", "_")](), sys.argv[2], float(sys.argv[3])
    with open("derived") as file:
        derived = Derived(file.read(), language)
    expected = {called(name, language): name for name in system.wanted}
    found = set(derived.functions) - {"sources"}
    if expected.keys() != found:
        sys.exit(f"functions without counterpart: {sorted(expected.keys() ^ found)}")
    if language == "fortran":
        require_double("\n".join(text.split("=", 1)[1] for text in sys.argv[4:]))
    formulas = [text.replace("std::", "").replace("_dp", "").split("=", 1) for text in sys.argv[4:]]
    sums = dict.fromkeys(("sources", "data", "exact", "formulas"), 0.0)
    for point in POINTS:
        wanted = {}
        at = {}
        for name, exact in system.wanted.items():
            at[name] = list(point)
            if name in system.places:
                axis, position = system.places[name]
                at[name][axis] = position
            wanted[name] = exact.at(at[name])
            kind = "sources" if name in system.sources else "data" if name in system.places else "exact"
            apart = difference(derived.functions[called(name, language)](at[name]), wanted[name])
            if name.endswith("_exact") and not apart < 1e-13:  # no difference quotient is in it
                sys.exit(f"{name} is off by {apart}")
            sums[kind] += apart
        if "sources" in derived.functions:
            together = derived.functions["sources"](list(point))
            for name, value in zip(system.sources, together, strict=True):
                sums["sources"] += difference(value, wanted[name])
        for name, text in formulas:
            sums["formulas"] += difference(derived.value(text, dict(zip("xyzt", at[name]))), wanted[name])
    for kind, total_difference in sums.items():
        print(f"{kind} = {total_difference:.16e}")


main()
