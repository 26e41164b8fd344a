"""The momentum of the time for linear Hamiltonian problems: equation (4.15) of Marthinsen's thesis."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from sympy import Matrix, Rational, Symbol, sin

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.errors import SceneError
from codegen.groups import GL, SL2, Linear
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.lab.invariants import functions
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import cached_reference
from codegen.lab.runner import Emitted, split_state
from codegen.loader import load as loaded
from codegen.scene import LinearScene
from codegen.scenes import load

D = PreciseDomain(Fraction(3, 10), 40)
LINEAR, HAMILTONIAN = "linear_oscillator_sl2+u", "linear_oscillator+u"
CANONICAL = [
    (LINEAR, "step:projection"),
    *((LINEAR, f"magnus:{name}") for name in ("magnus4", "magnus2", "lie_euler")),
    (LINEAR, "magnus:lie_midpoint_triple_jump"),
    *((LINEAR, method) for method in ("cf_magnus:cf_magnus4", "fer:fer4", "cayley:cayley4")),
    *((HAMILTONIAN, method) for method in ("rk:gauss2", "rk:midpoint", "rk:triple_jump", "vcg:euler")),
    (HAMILTONIAN, "splitting:lie_trotter"),
]
NOT_CANONICAL = ["rk:kahan", "rk:lobatto3c2", "rk:radau2a2"]
t = Symbol("t")


def defect(scene: str, method: str) -> float:
    """Return the largest deviation of the form du^dt + dp^dq under one step, in 40 digits."""
    compiled = compile_method(scene, method)
    problem, own = compiled.problem, compiled.scene.carries_momentum
    y = list(problem.initial(D))
    n = len(y) // 2
    start = [*y[:n], D.rational(1, 3), *y[n:]] if own else y

    def step(z):
        time = z[n] if own else D.rational(0)
        values = {"t": time, **split_state(problem, [*z[:n], *z[n + 1 :]] if own else z)}
        inputs = {v.name: values[v.name] for v in compiled.program.inputs}
        out = interpret(compiled.program, problem, D, inputs)
        end = [x for block in problem.state for x in flatten(block.kind, out[block.name])]
        return [*end[:n], time + D.h, *end[n:]] if own else end

    eps, columns = D.rational(1, 10**10), []
    for k in range(len(start)):
        ends = [step([x + s * eps * (i == k) for i, x in enumerate(start)]) for s in (1, -1)]
        columns.append([(a - b) / (2 * eps) for a, b in zip(*ends, strict=True)])
    m = len(start) // 2
    gaps = (
        abs(sum(a[k] * b[m + k] - a[m + k] * b[k] for k in range(m)) - (j == i + m))
        for i, a in enumerate(columns)
        for j, b in enumerate(columns)
        if i < j
    )
    return float(max(gaps))


TRIED = [
    pytest.param(*case, marks=() if case[1] in ("magnus:magnus4", "vcg:euler") else pytest.mark.slow)
    for case in CANONICAL
]


@pytest.mark.parametrize(("scene", "method"), TRIED)
def test_the_extended_step_of_a_canonical_method_is_symplectic(scene, method):
    with mpmath.workdps(45):
        assert defect(scene, method) < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("method", NOT_CANONICAL)
def test_the_extended_step_of_a_method_that_is_not_canonical_is_not_symplectic(method):
    with mpmath.workdps(45):
        assert defect(HAMILTONIAN, method) > 1e-5


def test_u_starts_at_minus_the_energy():
    assert load(LINEAR).initial(FloatDomain(0.0)) == (1, 2, 3, 4, 4, 1, 2, 3, -30)


@pytest.mark.parametrize("target", ["c", pytest.param("python", marks=pytest.mark.slow)])
def test_emitted_code_advances_u_as_the_interpreter_does(target):
    compiled = compile_method(LINEAR, "magnus:magnus4")
    d = FloatDomain(0.3)
    y = compiled.scene.initial(d)
    expected = interpret(compiled.lowered, compiled.problem, d, {"y": y, "t": 1.0})["y"]
    found = loaded(emit(LINEAR, "magnus:magnus4", target)).run(list(y), 0.3, 1, 1.0)
    assert found == pytest.approx(expected, rel=1e-13)


@pytest.mark.slow
def test_u_has_the_order_of_the_method():
    made = compile_method(LINEAR, "magnus:magnus4")
    stated = certified_order(made.method, made.scene)
    found = converge(Emitted(made, "c"), stated, cached_reference(made.scene))
    assert found.verdict == "holds", found.sentence()


def drift(method: str, steps: int) -> tuple[float, float]:
    """Return the largest |H + u| in the first and in the second half of a run with eps = 0.3, alpha = 0.1."""
    scene = load(f"{LINEAR}[eps=3/10,alpha=1/10]")
    energy, module = functions(scene)["energy"], loaded(emit(scene, method, "c"))
    rows = module.trajectory(list(scene.initial(FloatDomain(0.0))), 0.3, steps)
    values = np.array([abs(energy(row, 0.3 * k)[0]) for k, row in enumerate(rows)])
    return float(values[: steps // 2].max()), float(values[steps // 2 :].max())


def test_the_extended_energy_of_lie_gauss_does_not_drift_over_ten_thousand_units_of_time():
    first, second = drift("magnus:magnus4", 33_334)
    assert 1e-7 < first < 1e-4
    assert second < 1.05 * first


def scene(A, group=None, y0=(1, 2)):
    return LinearScene(group=group or SL2(), action=Linear(), A=A, y0=list(y0), span=(0, 1), name="given")


def test_a_generator_outside_of_sp_has_no_momentum():
    from codegen.scene.extended_phase_space import extended

    A = Matrix([[t, 1], [-1 - t, 0]])
    with pytest.raises(SceneError, match=r"A\(t\) is not in sp\(2\)"):
        extended(scene(A, GL(2)))
    kept = extended(scene(Matrix([[t, 1], [-1 - t, -t]]), GL(2)))
    assert kept.symbols == ("y0", "y1", "u")


def test_a_generator_without_time_has_no_momentum():
    from codegen.scene.extended_phase_space import extended

    with pytest.raises(SceneError, match="does not depend on time"):
        extended(scene(Matrix([[0, 1], [-2, 0]])))


def test_an_odd_number_of_coordinates_has_no_momentum():
    from codegen.scene.extended_phase_space import extended

    A = Matrix([[0, t, 0], [0, 0, 0], [0, 0, sin(t)]])
    with pytest.raises(SceneError, match="is odd: 3;"):
        extended(scene(A, GL(3), (1, 2, Rational(1, 2))))


def test_a_wrong_sign_of_the_increment_is_seen():
    compiled = compile_method(LINEAR, "magnus:magnus2")
    d = FloatDomain(0.3)
    y = compiled.scene.initial(d)
    moved = interpret(compiled.lowered, compiled.problem, d, {"y": y, "t": 0.0})["y"]
    energy = functions(compiled.scene)["energy"]
    flipped = (*moved[:-1], 2 * y[-1] - moved[-1])
    assert abs(energy(moved, 0.3)[0]) < 0.1 * abs(energy(flipped, 0.3)[0])
