"""When the tip meets a stop and leaves it, from the levels of a march.

An onset is where the line through the tip at the two last free levels since the last contact reaches the stop, a release where the line
through the two last stresses of a contact reaches zero; each within its step. Where there are no such levels, or their line leaves the
step, a penalised stop is met where the line through the tips at both ends of the step meets it, and a rigid one at the end of the step.
A tip that starts on a stop, or in a penalised one, and is held there by the first step has its onset at t = 0.
"""

import math

ROUND_OFF = 1e-9


def events(march):
    """[(kind, stop, t)], or None where round-off decides whether a level is in contact."""
    lower, upper = march.beam.get("g1", -math.inf), march.beam.get("g2", math.inf)
    levels = [(float(t), float(tip), float(stress)) for t, tip, stress in zip(march.times, march.U[:, -2], march.stress)]
    largest = max(abs(stress) for _, _, stress in levels[1:])
    for _, tip, stress in levels[1:]:
        touches = min(abs(tip - lower), abs(tip - upper)) <= ROUND_OFF * abs(tip)
        if (stress == 0.0 and touches) or 0.0 < abs(stress) <= ROUND_OFF * largest:
            return None
    free, pressed, found = [levels[0][:2]], [], []
    before, tip_before = levels[0][:2]
    yields = march.beam["epsilon"] > 0.0
    for t, tip, stress in levels[1:]:
        ends = [(before, tip_before), (t, tip)] if yields else []
        if pressed and stress * pressed[-1][1] <= 0.0:
            name, stop = ("g1", lower) if pressed[-1][1] > 0.0 else ("g2", upper)
            found.append(("release", name, known(crossing(pressed, 0.0, before, t), crossing(ends, stop, before, t), t)))
            free, pressed = [], []
        if stress == 0.0:
            free.append((t, tip))
        else:
            if not pressed:
                name, stop = ("g1", lower) if stress > 0.0 else ("g2", upper)
                starts_there = len(free) == 1 and free[0][0] == 0.0 and on_stop(free[0][1] - stop, stop, yields)
                met = known(crossing(free, stop, before, t), crossing(ends, stop, before, t), t)
                found.append(("onset", name, 0.0 if starts_there else met))
            pressed.append((t, stress))
        before, tip_before = t, tip
    return found


def known(*times):
    return next(t for t in times if t is not None)


def on_stop(distance, stop, yields):
    beyond = distance if stop > 0.0 else -distance  # g1 < 0 < g2
    return abs(distance) <= 1e-12 * abs(stop) or (yields and beyond > 0.0)


def crossing(levels, value, first, last):
    """Where the line through the two last levels takes the value, if between first and last; else None."""
    if len(levels) >= 2:
        (t0, y0), (t1, y1) = levels[-2:]
        if y0 != y1:
            t = t1 + (value - y1) * (t1 - t0) / (y1 - y0)
            if first <= t <= last:
                return t
    return None
