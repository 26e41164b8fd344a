"""Reduction of the number of terms in a :class:`orderconds.series.brackets.BracketProgram`. The number of
brackets does not change.

Let t be a number, and let B = [x, y] and C = [x, z] be two brackets with a common left factor x. The sum C +
t B = [x, z + t y] is a single bracket D. The program can compute D in place of C, because C = D - t B. The
number t is chosen to reduce the number of terms.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from orderconds.ring.protocol import Element, Ring
from orderconds.series.brackets import BracketProgram, Name, Row


def with_fewer_terms(ring: Ring, program: BracketProgram) -> BracketProgram:
    """Return a program with the same results u_1, ..., u_s and u as ``program``. If possible, the returned
    program has fewer terms.

    The ring must have division and a test for zero.

    >>> from orderconds.ring import QQ
    >>> half, k1, k2, k4 = QQ.rational(1, 2), ("k", 0), ("k", 1), ("k", 3)
    >>> brackets = (({k1: QQ.one}, {k2: half}), ({k1: QQ.one}, {k2: QQ.one, k4: QQ.one}))
    >>> stages = ({}, {}, {("B", 0): QQ.one}, {})
    >>> program = BracketProgram(brackets, stages, {("B", 0): -2 * QQ.one, ("B", 1): QQ.one}, 2, (1, 1, 1, 1))
    >>> print(with_fewer_terms(QQ, program).text(QQ))
    B1 = [k1, 1/2 k2]
    B2 = [k1, k4]
    u1 = 0
    u2 = 0
    u3 = B1
    u4 = 0
    u = B2
    """
    while True:
        better = next((p for p in _moved(ring, program) if _terms(p) < _terms(program)), None)
        if better is None:
            return program
        program = better


def _terms(program: BracketProgram) -> int:
    rows = [*program.stages, program.update, *(row for pair in program.brackets for row in pair)]
    return sum(map(len, rows))


def _moved(ring: Ring, program: BracketProgram) -> Iterator[BracketProgram]:
    for q, r in combinations(range(len(program.brackets)), 2):
        (x, y), (other, z) = program.brackets[q], program.brackets[r]
        same = x.keys() == other.keys() and all(ring.is_zero(x[n] - other[n]) is True for n in x)
        if not same or ("B", r) in y:
            continue
        names: tuple[Name, Name] = ("B", q), ("B", r)
        rows = [*program.stages, program.update, *(row for pair in program.brackets for row in pair)]
        multiples = [row[names[0]] / row[names[1]] for row in rows if all(n in row for n in names)]
        multiples += [ring.zero - z[n] / y[n] for n in y if n in z]
        for t in multiples:
            yield _with(ring, program, r, names, t)


def _with(
    ring: Ring, program: BracketProgram, r: int, names: tuple[Name, Name], t: Element
) -> BracketProgram:
    """Return a program in which the bracket B_r + t B_q replaces the bracket B_r. The argument ``names`` is
    the pair (("B", q), ("B", r)). The brackets B_q and B_r must have the same left factor."""

    def given_back(row: Row) -> Row:
        if names[1] not in row:
            return row
        return _sum(ring, row, {names[0]: ring.zero - t * row[names[1]]}, ring.one)

    q = names[0][1]
    pairs = [(given_back(x), given_back(y)) for x, y in program.brackets]
    left, right = program.brackets[r]
    pairs[r] = (left, _sum(ring, right, program.brackets[q][1], t))
    stages = tuple(map(given_back, program.stages))
    return replace(program, brackets=tuple(pairs), stages=stages, update=given_back(program.update))


def _sum(ring: Ring, row: Row, more: Row, t: Element) -> Row:
    total = dict(row)
    for name, x in more.items():
        total[name] = total.get(name, ring.zero) + t * x
    kept = {name: x for name, x in total.items() if ring.is_zero(x) is not True}
    return dict(sorted(kept.items(), key=lambda item: (item[0][0] == "B", item[0][1])))
