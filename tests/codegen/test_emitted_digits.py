"""The order of an emitted step is proved for the digits that are printed in its text.

The text, C or Python, is executed over Taylor series in h with balls of 300 bits
(:mod:`tests.emitted_c`, :mod:`tests.emitted_python`). Its digits are the doubles (or singles) that a
compiler reads. So folded, shared and combined coefficients need no recovery: all digits of the step take
part, and nothing else is rounded. The defect is the series of the step minus that of the exact flow. It is
proved to vanish up to h^p for the stated order p, except for a part that the rounding of digits explains:

- The header states a bound of the residuals of the order conditions at rounded coefficients. The order
  conditions come from the engine. The defects of the same step with slightly wrong coefficients, divided by
  the residuals of these coefficients, give the defect that a residual of one causes on this scene.
- Digits of the scene, such as moments of inertia, are rounded as well. Their part is at most a multiple of
  the unit roundoff times the Taylor coefficients of the flow.

The proof is for one scene and one state without symmetry. It does not treat the rounding errors of a step at
run time. Where a step divides by h^2, a pole that the rounding of digits causes is dropped.
"""

from __future__ import annotations

import json
import random
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import codegen
from codegen import scenes
from codegen.certify import certified_order
from codegen.ir.interpret import interpret
from codegen.ir.precision import PRECISIONS, Precision
from codegen.ir.values import Kind
from codegen.lower import families_for, lower, lowering, problem_for
from codegen.method import Method, parse
from codegen.rounded_conditions import largest_residual
from codegen.scene.problem import Problem
from orderconds import families
from orderconds.ring import QQ
from orderconds.tableau import RungeKutta, Tableau, library
from tests import emitted_c, emitted_python
from tests.taylor_numbers import Taylor, TaylorDomain, truncated

GENERATED = Path(__file__).parents[2] / "generated"
SLACK = 16
"""A defect may be so many times what the header's bound and the roundoff explain.

Folded coefficients are rounded on their own, and several digits of a file contribute to one coefficient."""
WRONG = Fraction(1, 2**20)
"""The largest relative error of the slightly wrong coefficients."""
DRAWS = 3


@dataclass(frozen=True)
class Module:
    """An emitted module: its texts by suffix, and what its manifest states."""

    scene: str
    method: str
    target: str
    order: int
    precision: str
    texts: Mapping[str, str]

    @property
    def suffix(self) -> str:
        return {"c": ".c", "python": ".py"}[self.target]

    def bound(self) -> float:
        """Return the bound of the residuals that the header states."""
        words = " ".join(re.sub(r"^ \*", "", self.texts[self.suffix], flags=re.MULTILINE).split())
        found = re.search(
            r"rounded to \w+ precision, the residuals of the order conditions are (?:at most (\S+)|zero)",
            words,
        )
        assert found is not None, "the header states no bound"
        return float(found[1] or 0)


def module(entry: Mapping[str, Any], texts: Mapping[str, str]) -> Module:
    stated = (entry[key] for key in ("scene", "method", "target", "order"))
    by_suffix = {Path(name).suffix: text for name, text in texts.items()}
    return Module(*stated, entry["interface"]["precision"], by_suffix)


def generated() -> list[Module]:
    return [
        module(entry, {name: (path.parent / name).read_text(encoding="utf-8") for name in entry["files"]})
        for path in sorted(GENERATED.glob("*/manifest.json"))
        for entry in json.loads(path.read_text(encoding="utf-8"))["modules"]
    ]


# Series


def start(scene: Problem) -> tuple[Taylor, ...]:
    """Return a state without symmetry: the initial state moved by the group, with other momenta."""
    domain = TaylorDomain()
    numbers = [domain.rational(7 * (k * k + 3) % 31 - 15, 97) for k in range(2 * scene.group.dim)]
    x, covector = tuple(numbers[: scene.group.dim]), numbers[scene.group.dim :]
    given = list(scene.initial(domain))
    state: list[Taylor] = []
    for block in scene.state:
        value = tuple(given[len(state) : len(state) + len(block.symbols)])
        if block.kind is Kind.DUAL:
            state += [a + b for a, b in zip(value, covector, strict=True)]
        else:
            state += scene.action.actexp(domain, scene.group, x, value)
    return tuple(state)


def time_of(scene: Problem) -> Taylor:
    return TaylorDomain().rational(scene.span[0].numerator, scene.span[0].denominator)


def flow(scene: Problem, given: Sequence[Taylor], order: int) -> tuple[Taylor, ...]:
    """Return the exact solution after the time h, by Picard iteration."""
    domain = TaylorDomain()
    state = tuple(given)
    for _ in range(order + 1):
        velocity = scene.velocity(domain, state, time_of(scene) + domain.h)
        state = tuple(x + Taylor(v.series.integral()) for x, v in zip(given, velocity, strict=True))
    return state


def interpreted(scene: Problem, method: Method, given: Sequence[Taylor]) -> tuple[Taylor, ...]:
    """Return the state after one step of the lowered program, before any pass."""
    problem = problem_for(scene, method)
    inputs: dict[str, object] = {"t": time_of(scene)}
    for block in problem.state:
        first = sum(len(x) for name, x in inputs.items() if name != "t")
        inputs[block.name] = tuple(given[first : first + len(block.symbols)])
    result = interpret(lower(scene, method), problem, TaylorDomain(), inputs)
    return tuple(x for block in problem.state for x in result[block.name])


def sizes(series: Sequence[Taylor], order: int) -> list[float]:
    """Return an upper bound of the largest coefficient of each power up to h^order."""
    return [max(float(x.coefficient(k).abs_upper()) for x in series) for k in range(order + 1)]


def difference(a: Sequence[Taylor], b: Sequence[Taylor], order: int) -> list[float]:
    return sizes([x - y for x, y in zip(a, b, strict=True)], order)


# What the digits explain


def wrong_coefficients(method: Method, seed: int, order: int) -> Method:
    """Return the method with each coefficient changed by a relative error below :data:`WRONG`."""
    draw = random.Random(seed)

    def convert(x: object) -> object:
        value = method.number(x)
        exact = Fraction(float(value)) * (1 + WRONG * Fraction(draw.randint(-(2**10), 2**10), 2**10))
        return QQ.rational(exact.numerator, exact.denominator)

    # Minimal brackets exist only for coefficients that satisfy the conditions; with a cut-off at the order,
    # RKMK has the same conditions.
    cut = method.cutoff
    if cut is None and method.kind.minimal_brackets:
        cut = order
    return replace(method, coefficients=method.tableau.over(QQ, convert), cutoff=cut)


def defect_of_unit_residual(
    scene: Problem, method: Method, order: int, exact: Sequence[Taylor]
) -> list[float]:
    """Return, for each power of h, the largest defect divided by the largest residual of the conditions."""
    stated = certified_order(method, scene)
    found = [0.0] * (order + 1)
    for seed in range(DRAWS):
        wrong = wrong_coefficients(method, seed, order)
        family = (
            families.get(stated.classical)
            if stated.classical
            else lowering(wrong.family).conditions(wrong, scene)
        )
        residual = largest_residual(wrong.tableau, family, order)
        assert residual, "the wrong coefficients satisfy the conditions"
        defect = difference(interpreted(scene, wrong, start(scene)), exact, order)
        found = [max(a, b / residual) for a, b in zip(found, defect, strict=True)]
    return found


@cache
def explained(scene_name: str, method_name: str, order: int) -> tuple[list[float], list[float]]:
    """Return the defect of a unit residual, and the size of the flow, by power of h."""
    scene = scenes.load(scene_name)
    method = parse(method_name, families_for(scene))
    exact = flow(scene, start(scene), order)
    return defect_of_unit_residual(scene, method, order, exact), sizes(exact, order)


def executed(made: Module, scene: Problem) -> list[Taylor]:
    values = {"state": start(scene), "h": Taylor.step(), "t": time_of(scene)}
    if made.target == "python":
        return emitted_python.step(made.texts[".py"], values)
    return emitted_c.step(made.texts[".h"], made.texts[".c"], values)


def excess(made: Module) -> float:
    """Return the largest defect of a power up to h^p, divided by what the digits explain."""
    scene = scenes.load(made.scene)
    target: Precision = PRECISIONS[made.precision]
    with truncated(made.order):
        unit, scale = explained(made.scene, made.method, made.order)
        defect = difference(executed(made, scene), flow(scene, start(scene), made.order), made.order)
    allowed = [made.bound() * u + target.unit * max(scale[: k + 1]) for k, u in enumerate(unit)]
    return max(d / a for d, a in zip(defect, allowed, strict=True))


@pytest.mark.parametrize("made", [pytest.param(m, id=f"{m.scene}-{m.method}{m.suffix}") for m in generated()])
def test_the_digits_of_generated_files_have_the_stated_order(made: Module) -> None:
    assert excess(made) < SLACK


# A digit that is wrong

WRONG_PLACE = 13
"""The place of the wrong digit among the significant digits of a constant."""


def long_constants(text: str, beginning: str) -> list[re.Match[str]]:
    """Return the constants of a step that have digits beyond :data:`WRONG_PLACE`."""
    return [
        found
        for found in re.finditer(r"(?<![\w.])\d+\.(\d+)(e-\d+)?", text)
        if found.start() > text.index(beginning) and len(found[1].lstrip("0")) > WRONG_PLACE
    ]


@pytest.mark.parametrize(("target", "beginning"), [("c", "_loop(double"), ("python", "def _loop(")])
def test_one_wrong_digit_of_any_constant_is_found(target: str, beginning: str) -> None:
    right = next(m for m in generated() if m.method == "cg:cg3" and m.target == target)
    text = right.texts[right.suffix]
    constants = long_constants(text, beginning)
    assert len(constants) > 10
    for constant in constants:
        place = constant.end() - (len(constant[1].lstrip("0")) - WRONG_PLACE) - len(constant[2] or "") - 1
        digit = str((int(text[place]) + 5) % 10)
        wrong = {right.suffix: text[:place] + digit + text[place + 1 :]}
        assert excess(replace(right, texts={**right.texts, **wrong})) > 4 * SLACK, constant[0]


# Random scenes and methods

PAIRS, QUICK = 40, 4
HIGHEST, LONGEST = 6, 7
"""The highest claimed order and the most stages of a random method: others take minutes to compile."""
VARIANTS = (("c", "double"), ("python", "double"), ("c", "single"), ("python", "double"))
"""The target and the format of random emissions, in turn."""


@cache
def methods() -> dict[str, list[str]]:
    """Return the methods of the library with a claim, by family."""
    found: dict[str, list[str]] = {}
    for name in library.available():
        tableau = Tableau.load(library.find(name))
        for claim in tableau.claims.orders:
            if claim.order <= HIGHEST and stages(tableau) <= LONGEST:
                cut = "" if claim.cutoff is None else f"({claim.cutoff})"
                found.setdefault(claim.family, []).append(f"{claim.family}{cut}:{name}")
    return found


def stages(tableau: Tableau) -> int:
    """Return the number of evaluations of a step, roughly for products of exponentials and flows."""
    numbers: list[object] = []
    tableau.method.map(lambda x: numbers.append(x) or x)
    return len(tableau.method.b) if isinstance(tableau.method, RungeKutta) else len(numbers) // 2


@cache
def drawn() -> list[tuple[str, str]]:
    """Return pairs of a scene and a method: a random scene, then a family that it takes, then a method."""
    draw = random.Random(20)
    pairs: dict[tuple[str, str], None] = {}
    while len(pairs) < PAIRS:
        scene = draw.choice(scenes.names())
        able = [f for f in families_for(scenes.load(scene)) if f in methods()]
        pairs[scene, draw.choice(methods()[draw.choice(able)])] = None
    return list(pairs)


@pytest.mark.parametrize(
    "number", [*range(QUICK), *(pytest.param(n, marks=pytest.mark.slow) for n in range(QUICK, PAIRS))]
)
def test_the_digits_of_random_emissions_have_the_stated_order(number: int) -> None:
    target, precision = VARIANTS[number % len(VARIANTS)]
    made = codegen.emit(*drawn()[number], target, precision=precision)
    assert excess(module(made.manifest, made.files)) < SLACK
