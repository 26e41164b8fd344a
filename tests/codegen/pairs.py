"""The table of pairs: on which groups, and by which actions, each family is tested, and in which targets.

A pair is applicable, and then test_pairs.py emits and tests it, or it is a refusal with a clear message. The
table follows from the registries: a group or an action without a sample in the tests is an error.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from inspect import signature
from typing import Any

from sympy import Rational, Symbol

from codegen.groups import SO2, DiagonalAction, LeftMultiplication, Product, Stiefel, actions, get, listing
from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import units
from codegen.ir.domain import FloatDomain
from codegen.lower import lower, method_for, names
from codegen.printers import names as target_names
from codegen.scene import FieldScene, HamiltonianScene
from codegen.scene.energy import ENERGY
from codegen.scene.problem import Problem
from orderconds.errors import InputError
from tests.codegen.family_cases import CASES, SHORT
from tests.codegen.groups.action_cases import HERE, ONE_OF_EACH
from tests.strategies import ALL_GROUPS, polynomials, quadratic

SAMPLES: dict[str, Any] = {}
"""A group of each class, by the name of the class."""
for _group in ALL_GROUPS.values():
    SAMPLES.setdefault(type(_group).__name__, _group)
# A Hamiltonian on a group of dimension one has curves as its energy levels, on which orders may be higher.
SAMPLES["SO2"] = Product(SO2(), SO2())
SIZES = {"SL": 3, "SO": 4, "Sp": 4, "Unitriangular": 3}
"""The sizes of the matrices of groups that depend on a number and are not among the groups of other tests."""
for _row in listing():
    if _row["name"] not in SAMPLES:
        _class: Any = get(_row["name"])
        _sized = bool(signature(_class).parameters)
        SAMPLES[_row["name"]] = _class(SIZES.get(_row["name"], 2)) if _sized else _class()

GROUP, ACTION = "group", "action"


@dataclass(frozen=True)
class Pair:
    """A family on the scene of a group or of an action. ``refusal`` is the message of the refusal, or '' for
    a pair that is applicable; ``method`` and ``order`` are what is tried."""

    kind: str
    row: str
    family: str
    method: str
    order: int
    hamiltonian: bool
    energy: bool
    linear: bool
    refusal: str


def rows(kind: str) -> list[str]:
    """Return the names of all groups, or of all actions."""
    return [row["name"] for row in (listing() if kind == GROUP else actions.listing())]


def _exact(values: Any) -> list[Any]:
    return [Rational(*Fraction(x).as_integer_ratio()) for x in values]


class Formulas(FloatDomain):
    """Sympy expressions as the scalars of an action whose formulas are rational."""

    def rational(self, p: int, q: int = 1) -> Any:
        """Return p/q."""
        return Rational(p, q)


def _field(row: str, group: Any, action: Any, start: list[Any], energy: bool, linear: bool) -> Problem:
    """Return a quadratic field without symmetry, a field f = B g that keeps the energy H, or a polynomial in
    the time alone.

    g_i is the derivative of H along the basis element e_i, and B is a constant skew matrix.
    """
    rng = random.Random(row)
    y = [Symbol(f"y{k}", real=True) for k in range(len(start))]
    if linear:
        f = polynomials(rng, group.dim)
        return FieldScene(group=group, action=action, y=y, f=f, y0=start, span=SHORT, name="pair")
    if not energy:
        f = [quadratic(rng, y, 3) / 2 for _ in range(group.dim)]
        return FieldScene(group=group, action=action, y=y, f=f, y0=start, span=SHORT, name="pair")
    H = quadratic(rng, y, 2 + len(y)) / 4
    d = Formulas(0.0)
    basis: Any = units(d, group.dim)
    slopes = [
        sum(H.diff(s) * v for s, v in zip(y, action.velocity(d, group, e, tuple(y)), strict=True))
        for e in basis
    ]
    f: list[Any] = [0] * group.dim
    for i in range(group.dim):
        for j in range(i):
            entry = rng.choice((-2, -1, 1, 2))
            f[i], f[j] = f[i] + entry * slopes[j], f[j] - entry * slopes[i]
    return FieldScene(
        group=group, action=action, y=y, f=f, y0=start, span=SHORT, name="pair", invariants={ENERGY: H}
    )


def _hamiltonian(row: str, group: Any) -> Problem:
    """Return a Hamiltonian in two parts: the square of the momentum, and a quadratic potential."""
    rng = random.Random(row)
    group.require(Coadjoint, "pair")
    q, mu = group.point("q"), group.dual("mu")
    # Coordinates that are constant on the group would make the potential linear.
    d = FloatDomain(0.0)
    basis: Any = units(d, group.dim)
    rates = [group.velocity(d, x, group.identity(d)) for x in basis]
    moving = [s for k, s in enumerate(q) if any(rate[k] for rate in rates)]
    T, V = mu.dot(mu) / 2, quadratic(rng, moving, 3 + group.dim) / 2
    momenta = [Rational(rng.choice((-2, -1, 1, 2)), rng.randint(2, 4)) for _ in range(group.dim)]
    return HamiltonianScene(
        group=group,
        q=q,
        mu=mu,
        H=T + V,
        parts={"T": T, "V": V},
        q0=_exact(group.identity(FloatDomain(0.0))),
        mu0=momenta,
        span=SHORT,
        name="pair",
    )


@cache
def scene_of(kind: str, row: str, hamiltonian: bool, energy: bool, linear: bool) -> Problem:
    """Return the scene of a group or of an action; InputError if there is none."""
    if kind == GROUP:
        group = SAMPLES[row]
        if hamiltonian:
            return _hamiltonian(row, group)
        start = _exact(group.identity(FloatDomain(0.0)))
        return _field(row, group, LeftMultiplication(), start, energy, linear)
    action, name = ONE_OF_EACH[row]
    return _field(row, HERE[name], action, _start(action, HERE[name]), energy, linear)


def _start(action: Any, group: Any) -> list[Any]:
    """Return an exact point of the manifold."""
    if isinstance(action, DiagonalAction):
        return [x for part in action.actions for x in _start(part, group)]
    if action.on_itself:
        return _exact(group.identity(FloatDomain(0.0)))
    size = action.point_size(group)
    if isinstance(action, Stiefel):
        return [int(k // action.columns == k % action.columns) for k in range(size)]
    return [Rational(k + 1, size + 1) for k in range(size)]


@cache
def pair(kind: str, row: str, family: str) -> Pair:
    """Return the pair, with the refusal of the scene, of the family, or of the compiler."""
    case = CASES[family][0]
    refusal = ""
    # On a group a family for Hamiltonians is tried on T*G; an action gives a field on its manifold.
    hamiltonian = kind == GROUP and case.polynomial().paired
    energy = not hamiltonian and bool(case.polynomial().invariants)
    linear = case.polynomial().linear
    try:
        scene = scene_of(kind, row, hamiltonian, energy, linear)
        lower(scene, method_for(scene, case.method))
    except InputError as error:
        refusal = str(error)
    return Pair(kind, row, family, case.method, case.order, hamiltonian, energy, linear, refusal)


def pairs(kind: str) -> Iterator[Pair]:
    """Yield all pairs of a kind."""
    for row in rows(kind):
        for family in names():
            yield pair(kind, row, family)


NOTE = "<!-- written by `make reference`; do not edit -->"

INTRODUCTION = """# Pairs that are tested

A number is the order of the method that is tried for the family, on this group or by this action. The tests
emit this method in every target, compare its steps with the interpreter, and prove its order by exact series.
A letter refers to the refusal below the table; tests compare the refusals with this page. A group acts on
itself by left multiplication. Families for Hamiltonians are tried on the cotangent bundle of the group, with
a kinetic energy and a potential. Families for linear problems are tried with a field that depends on the
time alone.
"""


def table(kind: str, title: str) -> list[str]:
    """Return the lines of one table with its refusals."""
    refusals: dict[str, str] = {}
    lines = [
        f"## {title}",
        "",
        f"| {kind} | " + " | ".join(names()) + " |",
        "|---" * (1 + len(names())) + "|",
    ]
    for row in rows(kind):
        cells = []
        for family in names():
            found = pair(kind, row, family)
            text = generic(found)
            letter = refusals.setdefault(text, letter_of(len(refusals))) if text else ""
            cells.append(letter or str(found.order))
        lines.append(f"| {row} | " + " | ".join(cells) + " |")
    return [*lines, "", *(f"- {letter}: {text}" for text, letter in refusals.items()), ""]


def generic(found: Pair) -> str:
    """Return a refusal without the names of the scene, the family and the group."""
    group = SAMPLES[found.row] if found.kind == GROUP else HERE[ONE_OF_EACH[found.row][1]]
    text = found.refusal.removeprefix("pair: ").replace(
        f"family {found.family} cannot be used on pair", "family FAMILY cannot be used on SCENE", 1
    )
    for name in (f"T*{group.name}", group.name):
        text = text.replace(f"group is {name};", "group is GROUP;").replace(f"{name} has no", "GROUP has no")
    return text.replace("*", "\\*")


def letter_of(number: int) -> str:
    """Return a, b, ..., z, aa, ab, ..."""
    first, last = divmod(number, 26)
    return (chr(96 + first) if first else "") + chr(97 + last)


def page() -> str:
    """Return the page of pairs."""
    targets = ["## Families and targets", "", "| family | " + " | ".join(target_names()) + " |"]
    targets.append("|---" * (1 + len(target_names())) + "|")
    for family, cases in CASES.items():
        methods = ", ".join(f"`{case.method}`" for case in cases)
        targets.append(f"| {family} | " + " | ".join(methods for _ in target_names()) + " |")
    lines = [NOTE, "", *INTRODUCTION.splitlines(), ""]
    lines += [*table(GROUP, "Groups and families"), *table(ACTION, "Actions and families"), *targets, ""]
    return "\n".join(lines)
