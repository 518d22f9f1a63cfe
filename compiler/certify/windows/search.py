#!/usr/bin/env python3
"""Writes the tables beside it: the least damping that an adaptive window needs, and a storage function. Needs
cvxopt."""
import math
import pathlib
import textwrap

from cvxopt import matrix, solvers, spmatrix

FOLDER = pathlib.Path(__file__).resolve().parent
HEAD = "# b/|g|, then P by rows up to the diagonal, in units of 2^-23; see README.md"
DIGITS = 23          # behind the point, of P, in binary
STRICTNESS = 2**-20  # what every matrix is kept above zero by, so that rounding P leaves it there


def weights(fit, n):
    """Of the last n displacements in T v̂, the newest first."""
    if fit == "end": return [1 / n] * n
    return [6 * (j + 1) * (n - j) / (n * (n + 1) * (n + 2)) for j in range(n)]


def solve(fit, sign, delay, longest):
    """The least b, and P, with which every window's matrix is positive semidefinite."""
    states = delay + longest
    size = states + 1  # w, q0, q1 …
    place = {(0, 0): 0}
    entries = []
    # M = b e eᵀ + diag(0, P) − diag(P, 0) + ½ (e cᵀ + c eᵀ)
    for i in range(states):
        for j in range(i + 1):
            column = len(place)
            place[i + 1, j + 1] = column
            for a, b in {(i, j), (j, i)}:
                entries += [((b + 1) * size + a + 1, column, -1.0), (b * size + a, column, 1.0)]
    entries.append((0, 0, -1.0))
    G = spmatrix([e[2] for e in entries], [e[0] for e in entries], [e[1] for e in entries], (size * size, len(place)))
    h = []
    for n in range(1, longest + 1):
        H = matrix(0.0, (size, size))
        for j, weight in enumerate(weights(fit, n)):
            H[0, delay + j + 1] = H[delay + j + 1, 0] = sign * weight / 2
        h.append(H)
    cost = matrix(0.0, (len(place), 1))
    cost[0] = 1
    for accuracy in (1e-9, 1e-8, 1e-7):
        solvers.options.update(show_progress=False, abstol=accuracy, reltol=accuracy, feastol=accuracy)
        try:
            done = solvers.sdp(cost, Gs=[G] * longest, hs=h)
        except ArithmeticError:  # the matrices became singular on the way
            continue
        if done["status"] == "optimal": break
    else:
        raise SystemExit(f"nothing found: {fit} {sign} {delay} {longest}")
    x = done["x"]
    return x[0], [[x[place[i + 1, j + 1]] for j in range(i + 1)] for i in range(states)]


def entry(fit, sign, delay, longest):
    """Lifted off the boundary: P + δ diag(d, …, 2, 1) and b + δ (d + 1) add δ to every eigenvalue."""
    b, P = solve(fit, sign, delay, longest)
    states = len(P)
    for i in range(states): P[i][i] += STRICTNESS * (states - i)
    numbers = [math.ceil((b + STRICTNESS * (states + 1)) * 2**DIGITS)]
    numbers += [round(value * 2**DIGITS) for row in P for value in row]
    return textwrap.fill(f"delay {delay}, longest {longest}: " + " ".join(map(str, numbers)), 120)


def main():
    for fit in ("end", "best"):
        for sign, name in ((1, "positive"), (-1, "negative")):
            table = [HEAD] + [entry(fit, sign, delay, longest) for delay in range(4) for longest in range(1, 16)]
            (FOLDER / f"{fit}_fit_{name}.txt").write_text("\n".join(table) + "\n")


if __name__ == "__main__":
    main()
