"""Run-time inputs: functions of time that the caller supplies, read at the stages' own times."""

from __future__ import annotations

import math
import random
from functools import cache

import numpy as np
import pytest
from sympy import Matrix, Symbol, cos, sin

from codegen.build import Compiler
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError, SceneError
from codegen.groups import SO3, Rotation
from codegen.integrator import Status, StepFailed
from codegen.ir.domain import FloatDomain
from codegen.lab.orders.local_error import local_error, valuation
from codegen.loader import load
from codegen.lower import lower, lowering, problem_for
from codegen.method import Method
from codegen.passes import optimise
from codegen.scene import FieldScene, HamiltonianScene, param, signal
from codegen.scene.run_time import with_inputs
from codegen.scenes import load as gallery
from tests.codegen.family_cases import CASES
from tests.compilations import compiled
from tests.promises import clean_c, clean_python
from tests.strategies import hamiltonian_scene, quadratic, shipped

TORQUES = ("u0", "u1", "u2")
SCENE = "actuated_rigid_body"
METHODS = {
    "rkmk": "rkmk:rk4",
    "cg": "cg:cg3",
    "cf": "cf:cf4",
    "vcg": "vcg:midpoint",
    "vrkmk": "vrkmk(1):kutta3",
    "vcf": "vcf:midpoint",
    "vrkmk_pade": "vrkmk_pade(1):midpoint",
    "slgi": "slgi:midpoint",
    "ambient": "ambient:rk4",
}
ALIKE = ("cg", "vrkmk", "vcf", "vrkmk_pade")
"""Families that read inputs as another of their kind, explicit or variational; for the slow run."""

ELSEWHERE = {
    "rk": "R^n only",
    "splitting": "no parts",
    "composition": "no parts",
    "discrete_gradient": "no energy",
}
"""Families that do not serve the scene."""
METHODS |= {
    family: cases[0].method
    for family, cases in CASES.items()
    if family not in {*METHODS, *ELSEWHERE}
    and lowering(family).objection(with_inputs(gallery(SCENE), TORQUES)) is None
}


def torques(t):
    return [math.sin(t) / 2, 0.1, math.cos(2 * t) / 5]


@cache
def emitted(method, target, inputs=TORQUES):
    return emit_compiled(compiled(SCENE, method, inputs=inputs), target, prefix="driven_")


def start_of(scene):
    return [float(x) for x in gallery(scene).initial(FloatDomain(0.0))]


@pytest.mark.parametrize(
    ("method", "target"),
    [
        # C compilers take seconds for slgi.
        pytest.param(m, t, marks=pytest.mark.slow if f in ALIKE or (f, t) == ("slgi", "c") else ())
        for f, m in METHODS.items()
        for t in ("c", "python")
    ],
)
def test_an_input_is_the_formula_that_it_stands_for(method, target):
    """Read at the stage times: with a formula folded in, or put in by the caller, the steps are the same."""
    folded, driven = (load(emitted(method, target, names)) for names in ((), TORQUES))
    start = emitted(method, target).manifest["initial"]
    found = driven.run(start, 0.1, 10, 0.25, inputs=torques)
    assert found == pytest.approx(folded.run(start, 0.1, 10, 0.25), rel=0, abs=1e-14)
    late = driven.run(start, 0.1, 10, 0.25, inputs=lambda t: torques(t - 0.05))
    assert late != pytest.approx(found, rel=0, abs=1e-4)


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_single_step_holds_its_inputs(target):
    driven, start = (
        load(emitted("vcg:midpoint", target)),
        emitted("vcg:midpoint", "c").manifest["initial"],
    )
    one = driven.step(start, 0.1, inputs=[1.0, 2.0, 3.0])
    assert one == driven.run(start, 0.1, 1, inputs=lambda t: (1.0, 2.0, 3.0))
    assert one != driven.step(start, 0.1, inputs=[1.0, 2.0, 3.5])


def test_the_times_at_which_inputs_are_read_are_in_the_head():
    text = emitted("rkmk:rk4", "c").files["driven_.c".replace("_.", ".")]
    assert " * inputs:     u0, u1, u2, as functions of time, evaluated at t, t + 0.5 * h, h + t\n" in text
    asked = []
    load(emitted("rkmk:rk4", "c")).run(
        emitted("rkmk:rk4", "c").manifest["initial"],
        0.5,
        1,
        2.0,
        inputs=lambda t: asked.append(t) or [0, 0, 0],
    )
    assert asked == [2.0, 2.25, 2.5]


def test_some_inputs_and_the_formulas_of_the_others():
    emission = emitted("cf:cf4", "c", ("u2", "u0"))
    assert emission.manifest["interface"]["inputs"] == ["u2", "u0"]
    assert "inputs for u1 are not needed: the scene contains their formulas" in emission.manifest["left_out"]
    assert "--input u2 --input u0" in emission.manifest["command"]
    start = emission.manifest["initial"]
    both = load(emission).run(start, 0.1, 5, inputs=lambda t: torques(t)[::-2])
    assert both == pytest.approx(load(emitted("cf:cf4", "c", ())).run(start, 0.1, 5), rel=0, abs=1e-14)


def test_driven_modules_are_clean(compiler: Compiler, tmp_path):
    (tmp_path / "c").mkdir()
    zero = clean_c(emitted("vcg:midpoint", "c"), compiler, tmp_path / "c")
    start = emitted("vcg:midpoint", "c").manifest["initial"]
    driven = load(emitted("vcg:midpoint", "c"))
    assert zero == pytest.approx(driven.run(start, 0.05, 100, inputs=lambda t: [0, 0, 0]), abs=1e-12)
    assert clean_python(emitted("vcg:midpoint", "python"), tmp_path) == pytest.approx(zero, abs=1e-12)


@pytest.mark.parametrize("target", ["c", "python"])
def test_what_an_input_raises_is_raised_and_nothing_else(target):
    driven, start = load(emitted("rkmk:rk4", target)), emitted("rkmk:rk4", "c").manifest["initial"]

    def broken(t):
        if t > 0.35:
            raise KeyError("no torque after that")
        return torques(t)

    with pytest.raises(KeyError, match="no torque"):
        driven.run(start, 0.1, 10, inputs=broken)
    with pytest.raises(TypeError, match="expected 3 inputs, found 2"):
        driven.run(start, 0.1, 10, inputs=lambda t: [1, 2])
    with pytest.raises(TypeError, match="expected a function for u0, u1, u2"):
        driven.run(start, 0.1, 10)
    with pytest.raises(TypeError, match="expected no inputs"):
        load(emitted("rkmk:rk4", target, ())).run(start, 0.1, 10, inputs=torques)


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("method", ["rkmk:rk4", "vcg:midpoint"])
@pytest.mark.parametrize("error", [ZeroDivisionError, ValueError])
def test_an_arithmetic_error_of_an_input_is_raised(method, target, error):
    def broken(t):
        raise error("torque")

    driven, start = load(emitted(method, target)), emitted(method, target).manifest["initial"]
    with pytest.raises(error, match="torque"):
        driven.run(start, 0.1, 10, inputs=broken)


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize(
    ("values", "message"),
    [
        (["1", "0", "0"], "expected a real number for inputs, found '1' of type str"),
        ("100", "expected a sequence of numbers for inputs, found '100' of type str"),
        ([np.complex128(1j), 0, 0], "expected a real number for inputs, found 1j of type complex128"),
        (None, "expected a sequence of numbers for inputs, found an object of type NoneType"),
        (np.array(1.0), "expected a sequence of numbers for inputs, found an object of type ndarray"),
    ],
)
def test_values_of_inputs_that_are_no_real_numbers_have_a_message(target, values, message):
    driven, start = load(emitted("rkmk:rk4", target)), emitted("rkmk:rk4", target).manifest["initial"]
    with pytest.raises(TypeError, match=message):
        driven.run(start, 0.1, 10, inputs=lambda t: values)


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_run_through_times_counts_all_steps_before_a_failure(target):
    driven, start = load(emitted("rkmk:rk4", target)), emitted("rkmk:rk4", target).manifest["initial"]
    with pytest.raises(StepFailed, match=r"^step 8: ") as failure:
        driven.trajectory(
            start, 0.1, t_eval=[0.2, 0.5, 1.0], inputs=lambda t: torques(t) if t < 0.71 else [math.nan, 0, 0]
        )
    assert failure.value.step == 7


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("method", ["rkmk:rk4", "vcg:midpoint"])
def test_an_input_that_is_no_number_stops_the_run_at_the_last_good_state(target, method):
    driven, start = load(emitted(method, target)), emitted(method, target).manifest["initial"]
    good = driven.run(start, 0.1, 3, inputs=torques)
    with pytest.raises(StepFailed) as failure:
        driven.run(start, 0.1, 9, inputs=lambda t: torques(t) if t < 0.31 else [math.nan, 0, 0])
    assert (failure.value.status, failure.value.step) == (Status.NOT_FINITE, 3)
    assert list(failure.value.state) == good


def test_without_inputs_a_module_knows_nothing_of_them():
    for target in ("c", "python"):
        text = "".join(emitted("rkmk:rk4", target, ()).files.values())
        assert "inputs" not in text.replace(
            "inputs for u0, u1, u2 are not needed: the scene contains their formulas", ""
        )
        assert "context" not in text


def forced_scene(name):
    """A cubic Hamiltonian on T*G with a quadratic wrench in all its coordinates, and in time."""
    base = hamiltonian_scene(name)
    rng = random.Random(f"wrench {name}")
    group = base.group
    q, mu, t = group.point("q"), group.dual("p"), Symbol("t")
    loads = [quadratic(rng, [*q, *mu]) + signal(f"u{k}", t - k * t**2) for k in range(group.dim)]
    H = quadratic(rng, list(mu)) + quadratic(rng, list(q)) + q[0] * mu[0] * mu[1]
    start = [e for block in base.state for e in block.initial]
    numbers = [x.payload.fraction() for x in start]
    return HamiltonianScene(
        group=group,
        q=q,
        mu=mu,
        H=H,
        q0=numbers[: group.size],
        mu0=numbers[group.size :],
        span=(0, 1),
        wrench=loads,
    )


@pytest.mark.parametrize("group", ["SO(3)", "R^3"])
@pytest.mark.parametrize(
    ("family", "tableau", "cutoff", "order"),
    [
        ("vcg", "midpoint", None, 2),
        ("vcg", "triple_jump", None, 4),
        ("vcf", "cf4", None, 4),
        ("vrkmk", "kutta3", 1, 3),
        ("vrkmk", "gauss2", 2, 4),
        ("vrkmk_pade", "gauss2", 2, 4),
        ("slgi", "midpoint", None, 2),
    ],
)
def test_under_a_wrench_variational_methods_keep_their_order(group, family, tableau, cutoff, order):
    """Forces enter as d'Alembert's principle says, beside -(D_1 H).q^-1: exactly the stated order."""
    scene, method = forced_scene(group), Method(family, shipped(tableau), cutoff)
    view = problem_for(scene, method)
    program, _ = optimise(lower(scene, method), view)
    assert valuation(local_error(program, view, method.ring, order + 1)) == order + 1


def test_a_wrench_changes_the_energy_and_so_it_is_no_invariant():
    assert "energy" not in gallery(SCENE).invariants
    assert "energy" in gallery("free_rigid_body_attitude").invariants


def test_signals_of_a_field_scene_are_inputs_too():
    y = Matrix([Symbol(f"y{k}", real=True) for k in range(3)])
    u, t = signal("wind", sin(Symbol("t")) * param("gust", 2)), Symbol("t")
    scene = FieldScene(
        group=SO3(),
        action=Rotation(),
        y=y,
        f=Matrix([u, cos(t), y[0]]),
        y0=[1, 0, 0],
        span=(0, 1),
        name="vane",
    )
    driven = load(emit_compiled(compile_method(scene, "rkmk:rk4", (), ["wind"]), "c"))
    folded = load(emit_compiled(compile_method(scene, "rkmk:rk4"), "c"))
    found = driven.run([1.0, 0.0, 0.0], 0.1, 10, inputs=lambda t: [2 * math.sin(t)])
    assert found == pytest.approx(folded.run([1.0, 0.0, 0.0], 0.1, 10), abs=1e-14)


def tried(**changes):
    y = Matrix([Symbol(f"y{k}", real=True) for k in range(3)])
    given = {"f": Matrix([y[0], 1, 2]), "y0": [1, 0, 0]} | changes
    return FieldScene(group=SO3(), action=Rotation(), y=y, span=(0, 1), name="vane", **given)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: tried(f=Matrix([signal("u", Symbol("y0", real=True)), 1, 2])), "signal u contains y0"),
        (lambda: tried(f=Matrix([signal("y1", 1), 1, 2])), "signal y1 has the name of a coordinate"),
        (lambda: tried(f=Matrix([signal("u", 1), signal("u", 2), 2])), "u has two formulas"),
        (lambda: tried(y0=[signal("u", 1), 0, 0]), "the symbol u in y0"),
        (lambda: signal("u", "sin("), "the formula 'sin\\('"),
        (lambda: with_inputs(gallery(SCENE), ["u7"]), "unknown signal 'u7'.*u0, u1, u2"),
        (lambda: with_inputs(gallery("dipole"), ["u"]), "the scene has no signal"),
    ],
)
def test_bad_signals_are_one_message(make, message):
    with pytest.raises(SceneError, match=message):
        make()


@pytest.mark.parametrize("family", ["splitting", "composition", "discrete_gradient"])
def test_families_that_need_an_energy_or_its_parts_refuse_a_wrench(family):
    tableau = {"splitting": "strang", "composition": "triple_jump"}.get(family, "midpoint")
    with pytest.raises(MethodError, match=r"driven by a wrench|depends on time"):
        compile_method(gallery(SCENE), Method(family, shipped(tableau)))
