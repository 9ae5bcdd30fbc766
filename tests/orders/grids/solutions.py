"""Random exact solutions of the beam, from a grammar: smooth ones, sharp ones, and ones in contact.

solution(k) is the k-th of a fixed list, the same on every machine: a dictionary of the text of the solution, the
parameters of the beam, the final time and the coarsest step of its grid. Every product of a function of x and one of t
keeps the boundary conditions by itself: X(0) = X(1) = 0 for the temperature, Y(0) = Y'(0) = 0 for the deflection, and
what is added while the tip rests on a stop also has Y(1) = Y'(1) = 0. Instants of contact are hundredths, so that runs
with a multiple of 100 steps meet them, and the steps of the grids, which are not, do not.
"""
import random

TEMPERATURES = ["sin(pi*x)", "sin(2*pi*x)", "sin(3*pi*x)", "x*(1 - x)", "x*(1 - x)*exp({c}*x)", "x*(1 - x)*(1 + x)",
                "(1 - cos(2*pi*x))/2", "sin(pi*x)^2*x"]
SHARP_TEMPERATURES = ["x*(1 - x)*tanh({k}*(x - {m}))", "(1 - exp(-{k}*x) - x*(1 - exp(-{k})))", "sin(5*pi*x)/2"]
DEFLECTIONS = ["x^2*(3 - x)/2", "x^2/2", "(1 - cos(pi*x))/2", "(1 - cos(pi*x))^2/4", "x^2*exp(-{c}*x)", "x^2*(2 - x)",
               "x^2*sin({c}*x)"]
BUBBLES = ["x^2*(1 - x)^2", "x^2*(1 - x)^2*exp({c}*x)", "x^2*(1 - x)^2*cos(pi*x)", "x^2*sin(pi*x)^2"]
TIMES = ["cos({w}*t)", "sin({w}*t)", "exp(-{c}*t)", "exp({c}*t/2)", "(1 + {c}*t)", "(1 + t^2)", "1/(1 + {c}*t)",
         "cos({w}*t + {c})"]
SHARP_TIMES = ["(1 + exp(-{r}*t))", "tanh({k}*(t - {m}))", "(1 + {c}*sin({r}*t))", "exp(-{k}*(t - {m})^2)"]


class Grammar:
    def __init__(self, k):
        self.random = random.Random(15000 + k)

    def one(self, forms):
        numbers = dict(c=round(self.random.uniform(0.3, 2.0), 2), w=round(self.random.uniform(0.5, 5.0), 2),
                       k=round(self.random.uniform(3, 9), 1), m=round(self.random.uniform(0.2, 0.8), 2),
                       r=round(self.random.uniform(5, 15), 1))
        return self.random.choice(forms).format(**numbers)

    def product(self, shapes, times):
        return "{}*{}*{}".format(round(self.random.uniform(0.3, 1.2), 2), self.one(times), self.one(shapes))

    def sum(self, shapes, times, most):
        return " + ".join(self.product(shapes, times) for _ in range(self.random.randint(1, most)))


def phases(grammar, bubbles):
    """Contact: onset, release, both, or all the time."""
    random_ = grammar.random
    w, b = "(3*x^2 - x^3)/2", "{}*({})".format("g2/4", bubbles)
    first = round(random_.uniform(0.2, 0.5), 2)
    last = round(random_.uniform(0.55, 0.85), 2)
    m, n = random_.choice([1, 2, 2, 3, 3]), random_.choice([1, 2, 2])
    rise = "g2*{}*(1 - (1 - t/{})^{}) + {}".format(w, first, m, b)
    rest = "g2*{} + {}".format(w, b)
    fall = "g2*{}*exp(-(t - {})^{}) + {}".format(w, last, max(m, 2), b)
    kind = random_.choice(["onset", "release", "both", "pressed"])
    if kind == "onset":
        return [(first, rise, "0"), (None, rest, "-(t - {})^{}".format(first, n))]
    if kind == "release":
        return [(last, rest, "-({} - t)^{}".format(last, n)), (None, fall, "0")]
    if kind == "both":
        return [(first, rise, "0"), (last, rest, "-8*(t - {})^{}*({} - t)^{}".format(first, n, last, n)),
                (None, fall, "0")]
    return [(None, "g1*{} + {}".format(w, b), "1 + t/2")]


def solution(k):
    grammar = Grammar(k)
    random_ = grammar.random
    family = ["smooth", "contact", "smooth", "contact", "sharp", "contact", "smooth", "sharp", "contact", "product"][k % 10]
    sharp = family == "sharp"
    shapes = TEMPERATURES + (SHARP_TEMPERATURES * 2 if sharp else [])
    times = TIMES + (SHARP_TIMES * 2 if sharp else [])
    text = 'name = "random-{}"\npurpose = "{}"\n'.format(k, family)
    if family == "product":  # does not separate
        theta = "sin(pi*x*(1 + {}*t*(1 - x)))/2".format(round(random_.uniform(0.3, 1.5), 2))
    else:
        theta = grammar.sum(shapes, times, 3)
    text += 'theta = "{}"\n'.format(theta)
    if family == "contact":
        for until, u, sigma in phases(grammar, grammar.sum(BUBBLES, TIMES, 2)):
            text += "[[phase]]\n"
            if until is not None:
                text += "until = {}\n".format(until)
            text += 'u = "{}"\nsigma = "{}"\n'.format(u, sigma)
    elif family == "product":
        text += 'u = "x^2*exp(-{}*x*t)/50"\n'.format(round(random_.uniform(0.5, 1.5), 2))
    else:
        text += 'u = "({})/20"\n'.format(grammar.sum(DEFLECTIONS, times, 2))
    beam = "alpha = {}\nzeta = {}\n".format(random_.choice([0.017, 0.1, 0.3, 0.5, 1.0]), random_.choice([0.05, 0.1, 0.3, 1.0]))
    if family == "contact":
        beam += "stops = [-0.02, 0.1]\n"
    return dict(name="random-{}".format(k), family=family, text=text, beam=beam, final_time=1.0,
                first_steps=random_.choice([10, 20]), separable=family != "product")


if __name__ == "__main__":
    import sys
    for k in map(int, sys.argv[1:]):
        print(solution(k)["text"])
