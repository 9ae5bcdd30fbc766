#!/usr/bin/env python3
"""A solver to be verified: the heat equation u_t = u_xx + f on 0 < x < 1, u = 0 at both ends.

    heat-solver.py ELEMENTS DT FINAL_TIME THETA

Second-order differences on a uniform mesh; in time the theta method: 1 is implicit Euler, 0.5 Crank-Nicolson, 0 explicit
Euler, which is stable for dt <= h^2/2. The source f and the initial value are those of the manufactured solution
u = sin(pi x) cos(t).
"""

import math
import sys
import time


def exact(x, t):
    return math.sin(math.pi * x) * math.cos(t)


def source(x, t):  # u_t - u_xx of the exact solution
    return math.sin(math.pi * x) * (math.pi**2 * math.cos(t) - math.sin(t))


def step(u, t, h, dt, theta):
    """u at t + dt, from u at t."""
    r = dt / h**2
    n = len(u) - 1
    right = [0.0] * (n + 1)
    for i in range(1, n):
        f = theta * source(i * h, t + dt) + (1 - theta) * source(i * h, t)
        right[i] = u[i] + (1 - theta) * r * (u[i - 1] - 2 * u[i] + u[i + 1]) + dt * f
    # (1 + 2 theta r) v_i - theta r (v_(i-1) + v_(i+1)) = right_i, by elimination
    pivot = 1 + 2 * theta * r
    above = [0.0] * (n + 1)
    for i in range(1, n):
        denominator = pivot - theta * r * above[i - 1]
        above[i] = theta * r / denominator
        right[i] = (right[i] + theta * r * right[i - 1]) / denominator
    for i in range(n - 2, 0, -1):
        right[i] += above[i] * right[i + 1]
    return right


def main():
    n, dt, final_time, theta = int(sys.argv[1]), *map(float, sys.argv[2:])
    h = 1 / n
    start = time.perf_counter()
    u = [exact(i * h, 0) for i in range(n + 1)]
    steps = round(final_time / dt)
    for k in range(steps):
        u = step(u, k * dt, h, dt, theta)
    print(f"solved in {time.perf_counter() - start:.6f} s")
    squares = sum((u[i] - exact(i * h, final_time)) ** 2 for i in range(n + 1))
    print(f"L2 error = {math.sqrt(h * squares):.16e}")
    print(f"flux = {(4 * u[1] - u[2]) / (2 * h):.16e}")  # u_x at x = 0


main()
