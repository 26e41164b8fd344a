"""Parametrisations of all commutator-free methods, and of the symmetric commutator-free methods.

Let Q_1, ..., Q_s be the values of the stages, and let y0 be the initial value. The update is
exp(Y_m) ... exp(Y_1) y0. Each exponent is a linear combination of the vector fields at Q_1, ..., Q_s. If X is
an exponent, let bar X be the exponent with the s coefficients of X in reverse order. A method is symmetric if
it satisfies the following two conditions:

- Y_(m+1-J) = bar Y_J for J = 1, ..., m.
- For each i, the stages i and s + 1 - i have the form

      Q_i = exp(X_r) ... exp(X_1) exp(Y_k) ... exp(Y_1) y0,
      Q_{s+1-i} = exp(-bar X_r) ... exp(-bar X_1) exp(Y_{m-k}) ... exp(Y_1) y0.

  The number k, which may be zero, and the exponents X_1, ..., X_r depend on i. Stage i begins with the first
  k exponentials of the update, and stage s + 1 - i begins with the first m - k exponentials of the update.
  If s and m are odd, the middle stage i = (s + 1)/2 has another form, with k = (m - 1)/2 and bar X_j = -X_j
  for j = 1, ..., r:

      Q_i = exp(X_r) ... exp(X_1) exp(Y_{k+1} / 2) exp(Y_k) ... exp(Y_1) y0.

A step of length -h of a symmetric method is the inverse of a step of length h.
"""

from __future__ import annotations

from fractions import Fraction
from math import ceil

from orderconds.errors import InputError
from orderconds.solve.linear import Constraint, equal, named, zero
from orderconds.solve.spec import Spec

Path = list[list[str]]
Paths = tuple[list[Path], Path, list[str], list[Constraint]]
"""A parametrised method: the stages, the update, the names of all coefficients, and the constraints. Each
stage and the update is a list of exponentials. The exponential with index 0 acts first."""


def full_paths(spec: Spec) -> Paths:
    """Return the parametrisation of all commutator-free methods with the numbers of stages and exponentials
    in ``spec``. Each exponential has one coefficient for each stage. For explicit and diagonally implicit
    methods, constraints set some coefficients to zero.

    >>> stages, update, names, _ = full_paths(Spec(stages=2, explicit=True, exponentials=1, inner=1))
    >>> stages, update
    ([[], [['a2_1_1', 'a2_1_2']]], [['b1_1', 'b1_2']])
    """
    if spec.symmetric:
        raise InputError("--symmetric", where="structure full", expected="structure symmetric")
    every = range(1, spec.stages + 1)
    update = [[f"b{J}_{j}" for j in every] for J in range(1, spec.exponentials + 1)]
    numbers = range(1, spec.inner + 1)
    stages = [
        [] if spec.explicit and i == 1 else [[named("a", i, J, j) for j in every] for J in numbers]
        for i in every
    ]
    names = [x for line in update for x in line] + [x for path in stages for line in path for x in line]
    constraints = []
    for i, path in enumerate(stages, start=1):
        for line in path:
            if spec.explicit or spec.dirk:
                last = i - 1 if spec.explicit else i
                constraints += [zero(x, "--explicit" if spec.explicit else "--dirk") for x in line[last:]]
    return stages, update, names, constraints


def symmetric_paths(spec: Spec) -> Paths:
    """Return the parametrisation of symmetric methods. Each stage begins with the first k exponentials of the
    update. The number k depends on the stage, and may be zero.

    >>> stages, update, names, _ = symmetric_paths(Spec(stages=2))
    >>> stages[0], update
    ([['b1_1', 'b1_2'], ['a1_2_1', 'a1_2_2']], [['b1_1', 'b1_2'], ['b2_1', 'b2_2']])
    """
    if spec.explicit:
        raise InputError(
            "--explicit with --symmetric", where="constraints", expected="only one of these two options"
        )
    s, m, inner = spec.stages, spec.exponentials, spec.inner
    every = range(1, s + 1)
    update = [[f"b{J}_{j}" for j in every] for J in range(1, m + 1)]
    names = [x for line in update for x in line]
    why = "a symmetric update"
    constraints = [
        equal(why, (1, update[m - 1 - J][s - 1 - j]), (-1, update[J][j])) for J in range(m) for j in range(s)
    ]
    stages: list[Path] = []
    for i in every:
        middle = 2 * i == s + 1
        share = ceil((min(i, s + 1 - i) - Fraction(1, 2)) * m / s)
        whole = m // 2 if middle else share if 2 * i <= s else m - share
        path = update[:whole]
        extra = max(1, inner - (m // 2 if middle else share))
        if middle and m % 2:
            half = [named("a", i, whole + 1, j) for j in every]
            names += half
            constraints += [
                equal("a symmetric middle stage", (2, x), (-1, y))
                for x, y in zip(half, update[whole], strict=True)
            ]
            path = [*path, half]
        own = [[named("a", i, len(path) + r, j) for j in every] for r in range(1, extra + 1)]
        names += [x for line in own for x in line]
        stages.append([*path, *own])
        if spec.dirk:
            constraints += [zero(x, "--dirk") for line in stages[-1] for x in line[i:]]
        mirror = stages[s - i] if s - i < i else None
        if mirror is not None:
            partner = mirror[len(mirror) - extra :]
            constraints += [
                equal("a symmetric pair of stages", (1, own[r][s - 1 - j]), (1, partner[r][j]))
                for r in range(extra)
                for j in range(s)
            ]
    return stages, update, names, constraints
