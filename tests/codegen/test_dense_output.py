"""Output inside steps has its stated order, from below and above, and stays on the group."""

from __future__ import annotations

import math
import random
from functools import cache

import pytest

from codegen.build import Compiler
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.integrator import Integrator
from codegen.loader import load
from orderconds.tableau import Tableau
from tests.codegen.test_tolerances import scene
from tests.promises import clean_c, clean_python

EXTENSIONS = {
    "rkmk(2):rk4": 3,
    "rkmk(2):dormand_prince5": 4,
    "rkmk(1):dormand_prince5": 3,
    "rkmk(1):bogacki_shampine3": 3,
    "rkmk(1):kutta3": 2,
    "rkmk(3):verner6": 4,
}
"""Methods with a continuous extension, and its order."""

SHORTER = {"cf:cf4": 4, "cg:cg3": 3, "rkmk(2):rk4": 4, "rkmk(2):gauss2": 4}
"""Methods whose output inside steps is computed by shorter steps, and their order."""


@cache
def emitted(name: str, method: str, dense: bool) -> Integrator:
    made = compile_method(scene(name), method, integrate=True, dense=dense)
    return load(emit_compiled(made, "c", prefix="dense_"))


@cache
def exact(name: str, times: tuple[float, ...]) -> list[list[float]]:
    made = compile_method(scene(name), "rkmk(5):dop853", adaptive=True)
    integrator = load(emit_compiled(made, "c", prefix="exact_"))
    return list(integrator.adaptive(integrator.initial, 0, 1, rtol=1e-14, atol=1e-14, t_eval=times).states)


def slope(name: str, method: str, dense: bool, steps: tuple[int, int], where: float) -> float:
    """Return the observed order of the largest error at random times inside the step that begins at
    ``where``."""
    integrator, generator, errors = emitted(name, method, dense), random.Random(method), []
    fractions = sorted(generator.uniform(0.1, 0.9) for _ in range(8))
    for n in steps:
        times = tuple(where + x / n for x in fractions)
        found = integrator.integrate(integrator.initial, 0, 1, 1 / n, t_eval=times)
        pairs = zip(found.states, exact(name, times), strict=True)
        errors.append(max(abs(x - y) for a, b in pairs for x, y in zip(a, b, strict=True)))
        assert max(map(off_group, found.states)) < 1e-14
    return math.log(errors[0] / errors[1]) / math.log(steps[1] / steps[0])


def off_group(state: list[float]) -> float:
    """Return the largest deviation of Q Q^T from the identity, for the rotation Q at the beginning of a
    state."""
    rows = [state[3 * i : 3 * i + 3] for i in range(3)]
    products = [(i == j, sum(map(float.__mul__, rows[i], rows[j]))) for i in range(3) for j in range(3)]
    return max(abs(x - same) for same, x in products)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["SO(3)", "SE(3)"])
@pytest.mark.parametrize("method", EXTENSIONS)
def test_an_extension_of_order_q_has_local_errors_of_order_q_plus_1(name: str, method: str) -> None:
    """In the first step the state at the beginning has no error."""
    order = emitted(name, method, True).interface.dense
    assert order == EXTENSIONS[method]
    steps = (64, 128) if order > 3 else (256, 512)
    assert slope(name, method, True, steps, 0.0) == pytest.approx(order + 1, abs=0.3)


@pytest.mark.slow
@pytest.mark.parametrize("method", SHORTER)
def test_output_by_shorter_steps_has_the_order_of_the_method(method: str) -> None:
    for name in ("SO(3)", "SE(3)"):
        steps = (32, 64) if SHORTER[method] > 3 else (128, 256)
        assert slope(name, method, False, steps, 0.75) == pytest.approx(SHORTER[method], abs=0.3)
        assert slope(name, method, False, steps, 0.0) == pytest.approx(SHORTER[method] + 1, abs=0.4)


def test_an_extension_is_continuous_between_steps() -> None:
    integrator, h = emitted("SO(3)", "rkmk(2):dormand_prince5", True), 1 / 16
    times = [h - 1e-9, h, h + 1e-9, 2 * h - 1e-9, 2 * h]
    states = integrator.integrate(integrator.initial, 0, 1, h, t_eval=times).states
    assert states[0] == pytest.approx(states[1], abs=1e-8)
    assert states[2] == pytest.approx(states[1], abs=1e-8)
    assert states[3] == pytest.approx(states[4], abs=1e-8)


@pytest.mark.parametrize("adaptive", [False, True])
def test_c_and_python_agree_and_the_steps_do_not_change(adaptive: bool) -> None:
    results = []
    for target in ("c", "python"):
        made = compile_method(scene("SE(3)"), "rkmk(2):dormand_prince5", adaptive=adaptive, dense=True)
        integrator = load(emit_compiled(made, target, prefix="dense_"))
        times = [0.1, 0.2, 0.21, 0.22, 0.5, 1.0]
        options = {"end": 1.0, "h": 0.0 if adaptive else 0.3}
        found = integrator.integrate(integrator.initial, t_eval=times, **options)
        assert found.state == integrator.integrate(integrator.initial, **options).state
        results.append(found)
    assert results[0].accepted == results[1].accepted
    for a, b in zip(results[0].states, results[1].states, strict=True):
        assert a == pytest.approx(b, abs=1e-12)


@pytest.mark.parametrize("method", ["cf:cf4", "rkmk:rk4", "rkmk(2):gauss2", "rkmk(2):ralston4"])
def test_methods_without_an_extension_are_refused(method: str) -> None:
    with pytest.raises(MethodError, match="has no continuous extension"):
        compile_method(scene("SO(3)"), method, dense=True)


def test_an_extension_of_the_user_is_compiled_and_a_false_one_is_refused() -> None:
    text = 'name = "mine"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["0", "1"]\n[dense]\norder = 2\n'
    good = Tableau.loads(text + 'b = [["1", "-1"], ["0", "1"]]\n')
    assert compile_method(scene("SO(3)"), good, dense=True, family="rkmk(0)").kernel.observed is not None
    for rows in ('[["1", "-1"], ["1/2", "1"]]', '[["1", "-1/2"], ["0", "1/2"]]'):
        with pytest.raises(MethodError, match="has no continuous extension"):
            compile_method(
                scene("SO(3)"), Tableau.loads(text + f"b = {rows}\n"), dense=True, family="rkmk(0)"
            )


@pytest.mark.slow
@pytest.mark.parametrize("precision", ["double", "single"])
def test_modules_with_an_extension_are_clean(precision: str, compiler: Compiler, tmp_path: object) -> None:
    for k, (place, method, adaptive) in enumerate(
        [
            ("driven_spin", "rkmk(1):bogacki_shampine3", True),
            ("linear_oscillator", "rk:dormand_prince5", True),
            ("free_rigid_body", "rkmk(2):rk4", False),
        ]
    ):
        made = compile_method(place, method, adaptive=adaptive, dense=True, events=k % 2)
        folder = tmp_path / f"c{k}"  # type: ignore[operator]
        folder.mkdir()
        clean_c(emit_compiled(made, "c", prefix="dense_", precision=precision), compiler, folder)
        if compiler.command[0] == "gcc" and precision == "double":
            clean_python(emit_compiled(made, "python", prefix="dense_"), folder)
