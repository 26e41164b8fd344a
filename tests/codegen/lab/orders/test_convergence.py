"""Observed orders of executed methods: published errors to three digits, and frauds that must be seen."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner
from sympy import Matrix, Rational, cos, sin, symbols

from codegen.certify import CertifiedOrder, certified_order
from codegen.commands.converge import command
from codegen.emitter import Compiled, compile_method
from codegen.errors import MethodError
from codegen.groups import S3, SO3, Product, Rn, Rotation
from codegen.ir.number import Number
from codegen.ir.operations import Advance
from codegen.ir.program import Assign
from codegen.ir.values import Coefficient
from codegen.lab import runner as lab_runner
from codegen.lab.orders import convergence
from codegen.lab.orders.convergence import Convergence, converge
from codegen.lab.orders.scene_convergence import converge as converge_scene
from codegen.lab.reference import Reference, reference
from codegen.lab.runner import Interpreted, runner
from codegen.lower import families_for
from codegen.method import Method, parse
from codegen.scene import FieldScene, HamiltonianScene
from codegen.scene.problem import Problem
from codegen.scenes import load
from orderconds.ring import QQ
from orderconds.tableau import CommutatorFree, RungeKutta, Stage

Exact = Callable[[str], Reference]
TARGETS = ("c", "python", "interpreter")

# scene, method, numbers of steps, errors recomputed independently of the thesis
PUBLISHED = {
    "free_rigid_body rkmk(0):euler": ((20, 40, 80, 160), (4.135e-2, 2.100e-2, 1.058e-2, 5.313e-3)),
    "free_rigid_body rkmk:rk4": ((20, 40, 80, 160), (7.029e-8, 4.493e-9, 2.847e-10, 1.793e-11)),
    "dipole vcg:gauss1": ((5, 10, 20, 40), (3.614e-3, 9.226e-4, 2.319e-4, 5.804e-5)),
    "dipole vrkmk(0):gauss1": ((5, 10, 20, 40), (3.614e-3, 9.226e-4, 2.319e-4, 5.804e-5)),
    "dipole vrkmk(1):kutta3": ((5, 10, 20, 40), (4.282e-4, 1.032e-5, 1.191e-6, 2.948e-7)),
    "dipole vrkmk(2):gauss2": ((5, 10, 20, 40), (1.255e-5, 7.785e-7, 4.854e-8, 3.032e-9)),
    "dipole vcg:triple_jump": ((5, 10, 20, 40), (6.128e-4, 4.173e-5, 2.668e-6, 1.677e-7)),
}

QUICK = {
    "python": ("free_rigid_body rkmk(0):euler", "free_rigid_body rkmk:rk4", "dipole vcg:triple_jump"),
    "interpreter": ("free_rigid_body rkmk(0):euler", "free_rigid_body rkmk:rk4"),
}
"""Explicit and implicit methods that every run executes in other targets than C."""


def parse_for(problem: Problem, spelling: str) -> Method:
    return parse(spelling, families_for(problem))


def measure(
    exact: Exact,
    scene: str,
    method: str | Method,
    stated: int,
    target: str = "c",
    digits: int = 16,
    steps: tuple[int, ...] = (),
) -> Convergence:
    problem = load(scene)
    chosen = method if isinstance(method, Method) else parse_for(problem, method)
    order = CertifiedOrder(stated, "exact")
    return converge(runner(problem, chosen, target, digits, order), order, exact(scene), steps=steps)


@pytest.mark.parametrize(
    ("case", "target"),
    [
        pytest.param(c, t, marks=() if t == "c" or c in QUICK[t] else pytest.mark.slow)
        for c in sorted(PUBLISHED)
        for t in TARGETS
    ],
)
def test_published_errors_are_reproduced_to_three_digits(case: str, target: str, exact: Exact) -> None:
    scene, method = case.split()
    steps, errors = PUBLISHED[case]
    found = measure(exact, scene, method, 0, target, steps=steps)
    for run, printed in zip(found.refinement.runs, errors, strict=True):
        # Three digits as printed: within half a unit of the fourth significant digit.
        assert f"{run.error:.3e}" == f"{printed:.3e}"


ORDERS = {
    "free_rigid_body": {
        "cg:cg3": 3,
        "cg:cg4": 4,
        "cf:cf4": 4,
        "rkmk(2):rk4": 4,
        "rkmk(1):kutta3": 3,
        "cg:rk4": 2,
        "rkmk:kutta3": 3,
    },
    "dipole": {"vcg:gauss1": 2, "vcg:triple_jump": 4, "vcg:triple_jump6": 6, "vcg:gauss2": 2, "cf:cf4": 4}
    | {"vrkmk(2):gauss2": 4, "vrkmk(0):gauss2": 2, "vrkmk_pade(2):gauss2": 4},
}


LONG = ("vcg:triple_jump6", "vrkmk(0):gauss2")
"""Methods of families that others represent."""


@pytest.mark.parametrize(
    ("scene", "method"),
    [
        pytest.param(s, m, marks=pytest.mark.slow if m in LONG else ())
        for s, found in ORDERS.items()
        for m in found
    ],
)
def test_emitted_c_shows_its_order_and_no_other(scene: str, method: str, exact: Exact) -> None:
    order = ORDERS[scene][method]
    found = measure(exact, scene, method, order)
    assert found.verdict == "holds", found.sentence()
    for other in (order - 1, order + 1):
        assert replace(found, stated=CertifiedOrder(other, "exact")).verdict == "fails"


def test_vrkmk6_shows_its_order_on_the_dipole(exact: Exact) -> None:
    found = measure(exact, "dipole", "vrkmk(4):gauss3", 6, steps=(5, 10, 20))
    assert all(5.9 < slope < 6.1 for slope in found.refinement.slopes)


def test_thirty_digits_decide_what_rounding_hides_from_doubles(exact: Exact) -> None:
    steps = (24, 36, 54, 81)
    found = measure(exact, "free_rigid_body", "rkmk(4):gauss3", 6, "interpreter", 30, steps)
    assert found.verdict == "holds", found.sentence()
    assert found.refinement.observed == pytest.approx(6, abs=0.15)


def test_an_order_that_rounding_hides_is_undecided_and_says_how_to_see_it(
    exact: Exact, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(convergence, "order_of_short_steps", lambda *_: None)
    found = measure(exact, "free_rigid_body", "rkmk(4):gauss3", 6)
    assert found.verdict == "undecided"
    assert "--digits 40" in found.sentence()


@pytest.mark.parametrize(
    ("scene", "method", "order"),
    [
        ("dipole", "ambient:dop853", 8),
        ("free_rigid_body", "rkmk(6):dop853", 8),
        ("free_rigid_body", "rkmk(4):gauss3", 6),
    ],
)
def test_very_short_steps_confirm_an_order_that_rounding_hides(
    scene: str, method: str, order: int, exact: Exact
) -> None:
    found = measure(exact, scene, method, order)
    assert found.verdict == "holds", found.sentence()
    assert found.refinement.short == pytest.approx(order, abs=0.01)
    for other in (order - 1, order + 1):
        assert replace(found, stated=CertifiedOrder(other, "exact")).verdict != "holds"


@pytest.mark.parametrize(("method", "order", "seen"), [("cf:cf4", 4, 5.1), ("slgi:euler", 1, 2.0)])
def test_a_small_parameter_that_hides_the_leading_term_is_no_failure(
    method: str, order: int, seen: float, exact: Exact
) -> None:
    """The potential energy of the heavy top is 10^-5 of the kinetic energy."""
    found = measure(exact, "heavy_top", method, order)
    assert found.observed == pytest.approx(seen, abs=0.1)
    assert found.verdict == "holds", found.sentence()
    assert "the leading term is not the largest term of the error" in found.sentence()
    words = ["heavy_top", "-m", method, "--stated", str(order + 1), "--json"]
    (wrong,) = json.loads(CliRunner().invoke(command, words, standalone_mode=False).output)
    assert (wrong["verdict"], wrong["stated_order"]) == ("fails", order + 1), wrong["reason"]


def test_a_method_that_converges_faster_on_a_scene_than_its_order_conditions_is_no_failure() -> None:
    """The Hamiltonian is bi-invariant and quadratic, so the error terms of order 2 of VCG methods vanish."""
    group = Product(S3(), Rn(1))
    q, mu = group.point("q"), group.dual("mu")
    energy = mu.dot(mu) / 2 + q[4] ** 2 / 2 + q[4] * q[1] + q[0] * q[2]
    start = ([1, 0, 0, 0, Rational(1, 2)], [Rational(3, 10), Rational(1, 5), Rational(-1, 2), 0])
    scene = HamiltonianScene(group=group, q=q, mu=mu, H=energy, q0=start[0], mu0=start[1], span=(0, 2))
    (found,) = converge_scene(scene, "vcg:gauss2", target="python")
    assert found.observed == pytest.approx(4, abs=0.05)
    assert (found.stated.order, found.verdict) == (2, "holds"), found.sentence()
    assert "converges faster than the order conditions guarantee" in found.sentence()
    for other in (1, 3):
        assert replace(found, stated=CertifiedOrder(other, "exact")).verdict == "fails"


@pytest.mark.parametrize("certificate", ["stated", "claimed", "exact"])
def test_an_order_stated_too_low_fails(certificate: str, exact: Exact) -> None:
    run = runner(load("free_rigid_body"), parse("ambient:rk4", ("ambient",)), "python")
    found = converge(run, CertifiedOrder(3, certificate), exact("free_rigid_body"))
    assert (found.derived, found.verdict) == (4, "fails")


def test_a_method_that_cannot_be_emitted_is_a_row_and_the_others_run(monkeypatch: pytest.MonkeyPatch) -> None:
    real = lab_runner.compile_method

    def refuse(scene: Problem, method: Method) -> Compiled:
        if method.label == "cf:cf4":
            raise MethodError("no lowering")
        return real(scene, method)

    monkeypatch.setattr(lab_runner, "compile_method", refuse)
    done = CliRunner().invoke(
        command, ["free_rigid_body", "-m", "cf:cf4", "-m", "cg:cg3", "--json"], standalone_mode=False
    )
    assert done.exception is None
    assert done.return_value == 1
    refused, measured = json.loads(done.output)
    assert (refused["method"], refused["verdict"], refused["failure"]) == ("cf:cf4", "fails", "no lowering")
    assert (measured["method"], measured["verdict"], measured["failure"]) == ("cg:cg3", "holds", "")
    assert refused.keys() == measured.keys()


def swapped(method: Method) -> Method:
    """CF4 with the two factors of its update in the wrong order."""
    tableau = method.tableau
    assert isinstance(tableau.method, CommutatorFree)
    rows = tableau.method.update.exponentials[::-1]
    wrong = replace(tableau.method, update=Stage(None, rows))
    return replace(method, coefficients=replace(tableau, method=wrong))


def reversed_rows(method: Method) -> Method:
    """A Crouch-Grossman method whose coefficients are attached to the stages in reverse."""
    tableau = method.tableau
    assert isinstance(tableau.method, RungeKutta)
    rows = tuple(
        tuple(row[i - 1 - j] if j < i else row[j] for j in range(len(row)))
        for i, row in enumerate(tableau.method.A)
    )
    return replace(method, coefficients=replace(tableau, method=RungeKutta(rows, tableau.method.b)))


def late_stage(method: Method) -> Method:
    """RK4 with k1/2 in the place of k2/2 in its third stage."""
    tableau = method.tableau
    assert isinstance(tableau.method, RungeKutta)
    A = [list(row) for row in tableau.method.A]
    A[2][0], A[2][1] = A[2][1], A[2][0]
    rows = tuple(tuple(row) for row in A)
    return replace(method, coefficients=replace(tableau, method=RungeKutta(rows, tableau.method.b)))


FRAUDS = {
    "CF4 with its factors swapped": ("cf:cf4", swapped, 4, 2),
    "CG3 on reversed stages": ("cg:cg3", reversed_rows, 3, 2),
    "RKMK4 with k1/2 in stage 3": ("rkmk(2):rk4", late_stage, 4, 2),
    "RKMK without dexp^-1": ("rkmk(2):rk4", lambda m: replace(m, cutoff=0), 4, 2),
    "dexp^-1 cut too short": ("rkmk(2):rk4", lambda m: replace(m, cutoff=1), 4, 3),
}


@pytest.mark.parametrize("name", sorted(FRAUDS))
def test_a_fraud_is_reported_as_failing_with_the_order_it_has(name: str, exact: Exact) -> None:
    spelling, alter, claimed, real = FRAUDS[name]
    good = parse_for(load("free_rigid_body"), spelling)
    assert measure(exact, "free_rigid_body", good, claimed).verdict == "holds"
    found = measure(exact, "free_rigid_body", alter(good), claimed)
    assert found.verdict == "fails", found.sentence()
    assert replace(found, stated=CertifiedOrder(real, "exact")).verdict == "holds", found.sentence()


def test_a_weight_off_by_5e_11_is_beyond_any_slope_and_left_to_check(exact: Exact) -> None:
    # The slope cannot see it in doubles; the order conditions do: orderconds check reports order 0.
    good = parse_for(load("free_rigid_body"), "rkmk(2):rk4")
    b = list(good.tableau.method.b)  # type: ignore[union-attr]
    b[0] = b[0] + QQ.rational(5, 10**11)
    off = replace(good.tableau, method=RungeKutta(good.tableau.method.A, tuple(b)))  # type: ignore[union-attr]
    found = measure(exact, "free_rigid_body", replace(good, coefficients=off), 4)
    assert found.verdict == "holds"
    # In forty digits and fine steps the same fraud is seen here as well: the error stops falling.
    deep = measure(
        exact, "free_rigid_body", replace(good, coefficients=off), 4, "interpreter", 40, (160, 320, 640, 1280)
    )
    assert deep.observed is not None
    assert deep.observed < 3.5


RK4 = """name = "rounded"
family = "rk"
A = [[], ["1/2"], ["0", "1/2"], ["0", "0", "1"]]
b = ["{sixth}{mark}", "{third}{mark}", "{third}{mark}", "{sixth}{mark}"]
"""


@pytest.mark.parametrize(
    ("digits", "mark", "verdict"),
    [(8, "~", "fails"), (15, "~", "holds"), (17, "~", "holds"), (24, "~", "holds"), (17, "d", "holds")],
)
def test_an_order_of_rounded_coefficients_has_one_verdict_whoever_states_it(
    digits: int, mark: str, verdict: str, exact: Exact, tmp_path: Path
) -> None:
    """Coefficients with few digits have order 2 in very short steps. More digits are as good as doubles."""
    sixth, third = "0." + "1" + "6" * (digits - 2) + "7", "0." + "3" * digits
    path = tmp_path / "rounded.toml"
    path.write_text(RK4.format(sixth=sixth, third=third, mark=mark))
    problem = load("free_rigid_body")
    method = parse(f"ambient:{path}", ("ambient",))
    known = certified_order(method, problem)
    assert (known.order, known.certificate) == (4, {"~": "decimal", "d": "double"}[mark])
    results = [
        converge(runner(problem, method, "c", order=order), order, exact("free_rigid_body"))
        for order in (known, CertifiedOrder(4, "stated"))
    ]
    assert [result.verdict for result in results] == [verdict, verdict], results
    if verdict == "fails":
        assert all("show order 2.00; the coefficients are rounded" in r.sentence() for r in results)


def test_a_library_method_with_decimals_of_many_digits_holds(exact: Exact) -> None:
    method, steps = "magnus:cf_magnus8_11", (8, 12, 16, 24)
    found = measure(exact, "linear_oscillator_sl2", method, 8, "interpreter", 40, steps)
    assert (found.spread, found.verdict) == (0.0, "holds"), found.sentence()


def test_the_json_has_the_documented_fields(exact: Exact) -> None:
    found = measure(exact, "dipole", "vcg:gauss1", 2).as_json()
    documented = {"scene", "method", "target", "stated_order", "h", "error", "observed_order", "verdict"}
    assert documented <= found.keys()
    assert len(found["h"]) == len(found["error"])
    assert found["verdict"] == "holds"


@pytest.fixture(scope="module")
def spin() -> tuple[Problem, Reference]:
    """A field that depends on time and state, does not commute and has a component along the state."""
    t, m, span = symbols("t", real=True), SO3().dual("m"), (Rational(1, 3), 1)
    field = Matrix([cos(t), sin(2 * t) - m[0], m[2]]) + m / 2
    start = Matrix([1, 0, 0])
    scene = FieldScene(group=SO3(), action=Rotation(), y=m, f=field, y0=start, span=span, name="spin")
    return scene, reference(scene)


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(("method", "order"), [("rkmk(2):rk4", 4), ("cg:cg3", 3), ("cf:cf4", 4)])
def test_orders_hold_where_the_field_depends_on_time(
    method: str, order: int, target: str, spin: tuple[Problem, Reference]
) -> None:
    scene, end = spin
    known = CertifiedOrder(order, "exact")
    found = converge(runner(scene, parse_for(scene, method), target, order=known), known, end)
    assert found.verdict == "holds", found.sentence()


def test_stage_times_frozen_at_the_beginning_of_the_step_give_order_one(
    spin: tuple[Problem, Reference],
) -> None:
    scene, end = spin
    compiled = compile_method(scene, "rkmk(2):rk4")
    frozen = tuple(
        replace(s, operation=replace(s.operation, coefficient=Coefficient(Number.rational(0))))
        if isinstance(s, Assign) and isinstance(s.operation, Advance)
        else s
        for s in compiled.program.body
    )
    fraud = Interpreted(replace(compiled, program=replace(compiled.program, body=frozen)))
    found = converge(fraud, CertifiedOrder(4, "exact"), end)
    assert found.verdict == "fails"
    assert replace(found, stated=CertifiedOrder(1, "exact")).verdict == "holds", found.sentence()


def test_a_run_that_fails_is_left_out_with_its_reason(exact: Exact) -> None:
    # A step of 1/2 is too long for the fixed-point iteration.
    found = measure(exact, "dipole", "vcg:triple_jump", 4, steps=(1, 20, 40, 80, 160))
    assert re.search("did not converge|not finite", found.refinement.runs[0].excluded)
    assert found.verdict == "holds", found.sentence()


@pytest.mark.slow
def test_the_slopes_of_a_stiff_scene_settle_with_short_steps(exact: Exact) -> None:
    """The fast rotation needs thousands of steps before the error is proportional to h^3."""
    assert measure(exact, "stiff_driven_spin", "cg:cg3", 3).verdict == "holds"
