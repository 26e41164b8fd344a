"""Compositions as substeps: the same step exactly, found in the tableau, one function for all parts."""

from __future__ import annotations

from dataclasses import replace

import pytest

from codegen import scenes
from codegen.emitter import compile_method, emit_compiled
from codegen.ir.number import Number
from codegen.ir.verify import IllFormed
from codegen.loader import load
from codegen.lower import lower, lower_composed, problem_for
from codegen.lower.substeps import substeps
from codegen.method import Method
from codegen.passes import optimise
from tests.strategies import butcher, field_scene, hamiltonian_scene, same, shipped

THIRDS = butcher("thirds", [["1/6", 0], ["1/3", "1/3"]], ["1/3", "2/3"])
TWICE = butcher(
    "a third and two thirds of Radau IIA",
    [
        ["5/36", "-1/36", 0, 0],
        ["1/4", "1/12", 0, 0],
        ["1/4", "1/12", "5/18", "-1/18"],
        ["1/4", "1/12", "1/2", "1/6"],
    ],
    ["1/4", "1/12", "1/2", "1/6"],
)
SCENES = [
    ("vcg", hamiltonian_scene("SO(3)", time=True)),
    ("vcg", hamiltonian_scene("GL(2)")),
    ("cg", field_scene("GL(2)", time=True)),
    ("cf", field_scene("S^2")),
    ("rk", field_scene("R^3")),
]


@pytest.mark.parametrize("tableau", [THIRDS, TWICE], ids=["midpoints", "Radau"])
@pytest.mark.parametrize(("family", "scene"), SCENES, ids=lambda x: getattr(x, "name", x))
def test_a_composition_of_substeps_is_the_step_exactly(family, scene, tableau):
    method = Method(family, tableau)
    composed = lower_composed(scene, method)
    assert [float(step.fraction) for step in composed.substeps] == pytest.approx([1 / 3, 2 / 3])
    assert [float(step.offset) for step in composed.substeps] == pytest.approx([0, 1 / 3])
    assert same(problem_for(scene, method), lower(scene, method), composed, order=3)


@pytest.mark.parametrize(
    ("tableau", "stages", "parts"),
    [
        ("triple_jump", 1, 3),
        ("triple_jump6", 1, 9),
        ("suzuki4", 1, 5),
        ("kahan_li8", 1, 17),
        ("qin_zhang2", 1, 2),
    ],
)
def test_compositions_of_one_method_are_found(tableau, stages, parts):
    base, found = substeps(Method("vcg", shipped(tableau)))
    assert (base.runge_kutta().s, len(found)) == (stages, parts)
    assert sum(float(step.fraction) for step in found) == pytest.approx(1, abs=1e-14)


@pytest.mark.parametrize(
    ("family", "tableau"),
    [
        ("vcg", "gauss2"),
        ("vcg", "midpoint"),
        ("vcg", "alexander2"),
        ("vcg", "mclachlan4"),
        ("cg", "rk4"),
        ("vcg", butcher("spoilt", [["1/6", 0], ["1/3", "1/3"]], ["1/4", "3/4"])),
        ("vcg", butcher("two methods", [["1/6", 0], ["1/3", "2/3"]], ["1/3", "2/3"])),
    ],
    ids=str,
)
def test_what_is_no_composition_of_one_implicit_method_is_left_alone(family, tableau):
    method = Method(family, shipped(tableau) if isinstance(tableau, str) else tableau, 2)
    assert substeps(method) is None


@pytest.mark.parametrize("family", ["rkmk", "vrkmk"])
def test_a_family_that_expands_the_inverse_of_dexp_over_the_step_has_no_substeps(family):
    scene = hamiltonian_scene("SO(3)")
    assert lower_composed(scene, Method(family, shipped("triple_jump"), 2)) is None
    assert lower_composed(scene, Method("vcg", shipped("triple_jump"))) is not None


@pytest.mark.parametrize("wrong", ["fraction", "offset"])
def test_wrong_substeps_are_caught(wrong):
    scene = hamiltonian_scene("SO(3)", time=True)
    method = Method("vcg", THIRDS)
    composed = lower_composed(scene, method)
    first, second = composed.substeps
    spoilt = replace(second, **{wrong: getattr(second, wrong) + Number.rational(1, 2**20)})
    with pytest.raises(IllFormed, match="the pass substeps changed the results"):
        optimise(
            lower(scene, method),
            problem_for(scene, method),
            composed=replace(composed, substeps=(first, spoilt)),
        )


@pytest.mark.parametrize(
    "driven", [pytest.param(False, id="closed", marks=pytest.mark.slow), pytest.param(True, id="driven")]
)
def test_one_function_serves_all_parts_of_a_step(driven):
    """The step of the composition is what steps of its base make, at the times that they begin at."""
    scene = scenes.load("actuated_rigid_body")
    inputs = tuple(scene.signals) if driven else ()
    made = compile_method(scene, Method("vcg", THIRDS), inputs=inputs)
    base = load(emit_compiled(compile_method(scene, Method("vcg", shipped("midpoint")), inputs=inputs), "c"))
    signals = {"inputs": lambda t: [0.1 + t, -t, t * t]} if driven else {}
    emissions = {target: emit_compiled(made, target) for target in ("c", "python")}
    state = start = emissions["c"].manifest["initial"]
    for t, h in ((0.5, 0.1), (0.6, 0.2), (0.8, 0.1), (0.9, 0.2)):
        state = base.run(state, h, 1, t=t, **signals)
    for target, loop in (("c", "sweep++;"), ("python", "sweep += 1")):
        emission = emissions[target]
        assert "".join(emission.files.values()).count(loop) == 1
        whole = load(emission).run(start, 0.3, 2, t=0.5, **signals)
        assert whole == pytest.approx(state, abs=1e-13)
