"""Table 4.1 of Marthinsen's thesis from emitted C: orders, properties and energy errors of fourteen methods.

The methods integrate the oscillator H = ((1 + eps sin(alpha t)) q.q + p.p)/2 with eps = 0.1, alpha = 0.123
and h = 0.3 over 166666 steps. The reference is Lie-Gauss with h = 0.02.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache

import numpy as np

from codegen.certify import certified_order
from codegen.emitter import emit
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.lab.runner import split_state
from codegen.loader import load as loaded
from codegen.lower import lower, method_for, problem_for
from codegen.scenes import load
from orderconds.tableau import Magnus, PartitionedRungeKutta, RungeKutta, Tableau, find
from orderconds.tableau.method_properties import symmetric, symmetric_product, symplectic, symplectic_pair

STEPS, H, FINE = 166_666, 0.3, 15
COLUMNS, CANONICAL = "linear_oscillator_sl2", "linear_oscillator"
D = PreciseDomain(Fraction(3, 10), 40)


@dataclass(frozen=True)
class Row:
    """A row of the table: the printed name, scene and method, the name of the tableau, the printed error, and
    the error by this program."""

    name: str
    scene: str
    method: str
    tableau: str
    printed: str
    error: float


ROWS = (
    Row("Lie-Gauss", COLUMNS, "magnus:magnus4", "magnus4", "3.20e-5", 3.200e-5),
    Row(
        "Lie-midpoint, triple jump",
        COLUMNS,
        "magnus:lie_midpoint_triple_jump",
        "lie_midpoint_triple_jump",
        "1.50e-4",
        1.503e-4,
    ),
    Row("Lie-midpoint", COLUMNS, "magnus:magnus2", "magnus2", "4.56e-3", 4.560e-3),
    Row("Lie-Euler", COLUMNS, "magnus:lie_euler", "lie_euler", "2.50e-2", 2.498e-2),
    Row("Gauss-Legendre", CANONICAL, "rk:gauss2", "gauss2", "7.98e-2", 7.983e-2),
    Row("Midpoint, triple jump", CANONICAL, "rk:triple_jump", "triple_jump", "0.149", 0.1494),
    Row("Midpoint", CANONICAL, "rk:midpoint", "midpoint", "0.149", 0.1486),
    Row("ExpSymNonCan", COLUMNS, "step:exp_sym_non_can", "", "0.149", 5.455e-2),
    Row("Kahan, triple jump", CANONICAL, "rk:kahan_triple_jump", "kahan_triple_jump", "0.150", 0.1503),
    Row("Projection", COLUMNS, "step:projection", "", "0.153", 0.1527),
    Row("Kahan", CANONICAL, "rk:kahan", "kahan", "0.168", 0.1680),
    Row("ExpNonCan", COLUMNS, "step:exp_non_can", "", "2.61", 5.817e-2),
    Row("Symplectic Euler", CANONICAL, "vcg:euler", "symplectic_euler", "6.44", 6.441),
    Row("Radau IIA", CANONICAL, "rk:radau2a2", "radau2a2", "31.5", 31.55),
)
"""The rows in the order of the table. On T*R^4, vcg:euler is the symplectic Euler method whose step first
computes P, with the time at the beginning of the step."""


def energies(row: Row, h: float, steps: int, stride: int = 1) -> np.ndarray:
    """Return H after each ``stride`` steps of emitted C."""
    module = loaded(emit(row.scene, row.method, "c"))
    states = np.array(module.trajectory([1.0, 2.0, 3.0, 4.0, 4.0, 1.0, 2.0, 3.0], h, steps, stride))[1:]
    stiffness = 1 + 0.1 * np.sin(0.123 * h * stride * np.arange(1, len(states) + 1))
    return (stiffness * (states[:, :4] ** 2).sum(axis=1) + (states[:, 4:] ** 2).sum(axis=1)) / 2


@cache
def reference(steps: int) -> np.ndarray:
    """Return H of Lie-Gauss with the step size 0.02 after each 0.3 units of time."""
    return energies(ROWS[0], H / FINE, FINE * steps, FINE)


def error(row: Row, steps: int = STEPS) -> float:
    """Return the largest energy error of a row."""
    return float(abs(energies(row, H, steps) - reference(steps)).max())


def order(row: Row) -> int:
    """Return the order of a row on its scene."""
    scene = load(row.scene)
    return certified_order(method_for(scene, row.method), scene).order


def properties(row: Row) -> str:
    """Return the letters C (canonical), S (symmetric) and E (exponential) that hold for a row.

    They follow from the coefficients of a tableau. For a stated step, C follows from the type of the formula:
    its matrix is in the group for every A(t). S and E are identities, which are evaluated with 40 digits.
    """
    if row.tableau:
        verdicts = _of_tableau(Tableau.load(find(row.tableau)))
    else:
        name = row.method.partition(":")[2]
        canonical = load(row.scene).steps[name].canonical
        verdicts = (canonical, _returns(row.method), _exact_for_constant_matrices(row.method))
    return "".join(letter for letter, holds in zip("CSE", verdicts, strict=True) if holds)


def _of_tableau(tableau: Tableau) -> tuple[bool, bool, bool]:
    ring, method = tableau.ring, tableau.read_as(("rk",)) or tableau.method
    if isinstance(method, Magnus):
        # Exponents are Lie elements, so each exponential is symplectic. If all A_i are one matrix, brackets
        # vanish, and the step is the exponential of h A times the sum of the coefficients.
        total = sum((x for e in method.exponents for term, x in e if isinstance(term, int)), ring.rational(0))
        return True, symmetric_product(method, ring) is True, ring.is_zero(total - ring.one) is True
    # The stability function of a Runge-Kutta method is rational, and the exponential function is not.
    if isinstance(method, PartitionedRungeKutta):
        halves = RungeKutta(method.A, method.b), RungeKutta(method.A_hat, method.b_hat)
        mirrored = all(symmetric(half, ring) is True for half in halves)
        return symplectic_pair(method, ring) is True, mirrored, False
    assert isinstance(method, RungeKutta)
    return symplectic(method, ring) is True, symmetric(method, ring) is True, False


def _step(scene_name: str, method: str, y, t, h) -> list:
    scene = load(scene_name)
    chosen = method_for(scene, method)
    domain, problem = PreciseDomain(h, 40), problem_for(scene, chosen)
    values = {"t": t, **split_state(problem, y)}
    program = lower(scene, chosen)
    out = interpret(program, problem, domain, {v.name: values[v.name] for v in program.inputs})
    return [x for block in problem.state for x in flatten(block.kind, out[block.name])]


def _returns(method: str) -> bool:
    """Return True if a step with h and a step with -h return to the initial state."""
    start, t, h = load(COLUMNS).initial(D), D.rational(1, 3), Fraction(3, 10)
    end = _step(COLUMNS, method, start, t, h)
    back = _step(COLUMNS, method, end, t + D.rational(3, 10), -h)
    return all(abs(a - b) < 1e-30 for a, b in zip(start, back, strict=True))


def _exact_for_constant_matrices(method: str) -> bool:
    """Return True if a step is exact for eps = 0, where A does not depend on t."""
    name, h = f"{COLUMNS}[eps=0]", Fraction(3, 10)
    start = load(name).initial(D)
    ends = (_step(name, each, start, D.rational(0), h) for each in (method, "magnus:lie_euler"))
    return all(abs(a - b) < 1e-30 for a, b in zip(*ends, strict=True))


PREFACE = """<!-- written by `python .ci/oscillator.py`; do not edit -->

# Energy errors of a driven oscillator

The methods of Table 4.1 of Marthinsen's thesis integrate H = ((1 + 0.1 sin(0.123 t)) q.q + p.p)/2 with four
degrees of freedom, h = 0.3 and 166666 steps. The program emits each method in C. The error is the largest
difference from the energy of Lie-Gauss with h = 0.02. The scenes are `linear_oscillator_sl2` for methods
that begin with `magnus` or `step`, and `linear_oscillator` for all other methods.

The properties are C (canonical), S (symmetric) and E (exponential: exact for constant matrices). They
follow from the coefficients of the tableaux, and for stated steps from their formulas.

| method | `--method` | order | properties | error | printed |
|---|---|---|---|---|---|
"""

NOTES = """
The printed errors of *ExpNonCan* and *ExpSymNonCan* do not come from the printed formulas, which are used
here. The letter C requires that a step is symplectic for every A(t) in the algebra. For this oscillator the
exponents of both methods are in the algebra, so that both are canonical here. *ExpSymNonCan* has order 2;
its printed order is 1.
"""


def page() -> str:
    """Return the page docs/reference/oscillator.md."""
    lines = [
        f"| {row.name} | `{row.method}` | {order(row)} | {properties(row)} | {error(row):.3e} "
        f"| {row.printed} |"
        for row in ROWS
    ]
    return PREFACE + "\n".join(lines) + "\n" + NOTES
