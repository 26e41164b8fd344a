"""Artifact of the gallery: what is kept in generated/ against the interpreter and published errors."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from codegen.command_names import bare
from codegen.emitter import emit, emit_compiled
from codegen.errors import MethodError, SceneError
from codegen.integrator import Statistics
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.loader import load
from codegen.lower import families_for, lowering, problem_for
from codegen.lower.flow_words import FlowLowering
from codegen.prefix import default_prefix, prefix_of
from codegen.regenerate import entries
from codegen.scenes import load as load_scene
from orderconds.errors import InputError, UnknownName, ZeroWeight
from tests.compilations import compiled
from tests.promises import COMPILERS

KEPT = [(e.scene, e.method) for e in entries()]

BOTH_COMPILERS = (
    ("free_rigid_body", "rkmk:rk4"),
    ("dipole", "vcg:midpoint"),
    ("duffing_sl2", "cf4"),
    ("fast_heavy_top", "splitting:blanes_moan_rkn4"),
)
"""Explicit and implicit steps, another group, and flows: every run compiles them with clang, too."""


def interpreted(made):
    """One step of a compiled method as a function of (state, h, t), by the interpreter over doubles."""
    view = problem_for(made.scene, made.method)

    def step(state, h, t):
        inputs, start = {"t": t}, 0
        for block in view.state:
            inputs[block.name] = tuple(state[start : start + len(block.symbols)])
            start += len(block.symbols)
        after = interpret(made.program, view, FloatDomain(h), inputs)
        return tuple(x for block in view.state for x in after[block.name])

    return step


@pytest.mark.parametrize(
    ("compiler", "scene", "method"),
    [
        pytest.param(c, *case, marks=() if c == "gcc" or case in BOTH_COMPILERS else pytest.mark.slow)
        for c in COMPILERS
        for case in KEPT
    ],
    indirect=["compiler"],
)
def test_the_gallery_is_emitted_clean_and_agrees_with_the_interpreter(check_codegen, scene, method):
    made = compiled(scene, method)
    c, python = emit_compiled(made, "c"), emit_compiled(made, "python")
    # A fixed point is only as sharp as its stopping rule: 2^-44 of the largest unknown.
    ulps = 64 if c.manifest["interface"]["blocks"] else 16
    # A rotation's third column is the cross product of the others for rotations only.
    on_group = isinstance(lowering(made.method.family), FlowLowering)
    check_codegen(c, python, interpreted(made), tuple(c.manifest["initial"]), 0.05, ulps, on_group)


@pytest.mark.parametrize(("scene", "method"), KEPT)
def test_what_is_stated_is_what_was_computed(scene, method):
    from orderconds.checking import check

    made = compiled(scene, method)
    manifest = emit_compiled(made, "c").manifest
    family = lowering(made.method.family).conditions(made.method, made.scene)
    (found,) = check(made.method.tableau, family=family.label()).orders
    assert (manifest["order"], manifest["certificate"]) == (found.order, found.certificate)


@cache
def dipole_reference():
    """The state at t = 1/2 by an extrapolation code on the ambient equations; (9,) and (3,) entries."""
    from scipy.integrate import solve_ivp

    scene = load_scene("dipole")
    start = [float(x) for x in scene.initial(FloatDomain(0.0))]
    made = solve_ivp(
        lambda t, y: scene.velocity(FloatDomain(0.0), tuple(y)),
        (0, 0.5),
        start,
        method="DOP853",
        rtol=1e-13,
        atol=1e-15,
    )
    return made.y[:, -1]


def test_the_dipoles_reference_is_the_published_one():
    state = dipole_reference()
    assert state[9:] == pytest.approx([-0.5361870181330790305, 0.003780620329717814678, 0], abs=1e-12)
    row = [0.9237505661876837714, 0.3829945723223079841, -0.0002214488339615999]
    assert state[:3] == pytest.approx(row, abs=1e-12)


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize(
    ("method", "errors"),
    [
        ("vcg:midpoint", [3.614e-3, 9.226e-4, 2.319e-4, 5.804e-5]),
        ("vcg:triple_jump", [6.128e-4, 4.173e-5, 2.668e-6, 1.677e-7]),
    ],
)
def test_the_dipoles_errors_are_the_published_ones_to_three_digits(method, errors, target):
    emission = emit_compiled(compiled("dipole", method), target)
    integrator, reference = load(emission), dipole_reference()
    for steps, printed in zip((5, 10, 20, 40), errors, strict=True):
        state = np.array(integrator.run(emission.manifest["initial"], 0.5 / steps, steps))
        difference = (state - reference)[:9].reshape(3, 3)
        error = np.linalg.norm(state[9:] - reference[9:]) + np.linalg.norm(difference, 2)
        assert error == pytest.approx(printed, rel=6e-4)


@pytest.mark.parametrize("target", ["c", "python"])
def test_lie_euler_on_the_sphere_has_the_published_errors_and_stays_on_it(target):
    emission = emit("free_rigid_body", "rkmk(0):euler", target)
    fine = load(emit_compiled(compiled("free_rigid_body", "rkmk(2):rk4"), "c"))
    start = emission.manifest["initial"]
    reference = np.array(fine.run(start, 2 / 4000, 4000))
    integrator = load(emission)
    for steps, printed in ((20, 4.135e-2), (40, 2.100e-2), (80, 1.058e-2), (160, 5.313e-3)):
        state = np.array(integrator.run(start, 2 / steps, steps))
        assert np.linalg.norm(state - reference) == pytest.approx(printed, rel=5e-4)
        assert np.linalg.norm(state) == pytest.approx(1, abs=1e-13)


@pytest.mark.parametrize(
    ("method", "blocks", "solved"), [("vcg:triple_jump", 1, 3), ("vcg:alexander2", 2, 1)]
)
def test_sequential_stages_are_solved_one_by_one(method, blocks, solved):
    """Those of a composition by one block, three times a step."""
    made = compiled("dipole", method)
    manifest = emit_compiled(made, "c").manifest
    assert len(manifest["interface"]["blocks"]) == blocks
    statistics = Statistics()
    load(emit_compiled(made, "c")).run(manifest["initial"], 0.05, 10, statistics=statistics)
    assert all(20 * solved <= sweeps <= 400 * solved for sweeps in statistics.sweeps)


def test_explicit_methods_hold_no_solver():
    for scene, method in KEPT[:3]:
        emission = emit_compiled(compiled(scene, method), "c")
        assert emission.manifest["interface"]["blocks"] == []
        assert "for (size_t sweep" not in "".join(emission.files.values())


def test_a_parameter_is_folded_unless_it_is_asked_for():
    folded = emit("free_rigid_body", "cf4", "python")
    kept = emit("free_rigid_body", "cf4", "python", parameters=["alpha"])
    assert "arguments for constant parameters: alpha = 0" in folded.manifest["left_out"]
    assert kept.manifest["interface"]["parameters"] == ["alpha"]
    assert kept.manifest["defaults"] == {"alpha": 0.0}
    start = folded.manifest["initial"]
    assert load(kept).run(start, 0.1, 5) == pytest.approx(load(folded).run(start, 0.1, 5), abs=1e-14)
    # The isotropy leaves the field as it is but makes another method (thesis 2.19).
    assert load(kept).run(start, 0.1, 5, alpha=3.0) != pytest.approx(
        load(folded).run(start, 0.1, 5), abs=1e-9
    )


def test_the_isotropy_of_the_rigid_body_is_an_option_of_its_scene():
    """f + alpha m gives the same field and another method (thesis 2.19)."""
    kept = emit("free_rigid_body", "cf4", "c", parameters=["alpha"])
    fixed = emit("free_rigid_body", "cf4", "c", parameters=["alpha=3/2"])
    assert "--parameter alpha=3/2 " in fixed.manifest["command"]
    assert fixed.manifest["interface"]["parameters"] == []
    start = kept.manifest["initial"]
    one = load(fixed).run(start, 0.1, 5)
    assert one == pytest.approx(load(kept).run(start, 0.1, 5, alpha=1.5), abs=1e-14)
    assert one != pytest.approx(load(kept).run(start, 0.1, 5), abs=1e-9)
    fine = [load(kept).run(start, 2 / 4000, 4000, alpha=a) for a in (0.0, 1.5)]
    assert fine[0] == pytest.approx(fine[1], abs=1e-11)


def test_no_path_reaches_emitted_text(tmp_path):
    path = tmp_path / "my_top.py"
    path.write_text(
        "from codegen.scenes.free_rigid_body import scene as base\n"
        "from dataclasses import replace\n"
        "scene = replace(base, title='my top')\n"
    )
    emission = emit(str(path), "cf4", "c")
    assert emission.manifest["command"] == "orderconds emit my_top.py --method cf4 --target c -o ."
    assert emission.manifest["module"] == "my_top_cf4"
    assert str(tmp_path) not in repr(emission)
    assert bare("vcg:/a/b/c.toml") == "vcg:c.toml"


def test_families_that_serve_a_scene():
    assert families_for(load_scene("dipole"))[0] == "vcg"
    assert not {"vcg", "rk"} & set(families_for(load_scene("free_rigid_body")))


def test_a_file_whose_name_makes_no_prefix_is_told_what_else_to_type(tmp_path):
    path = tmp_path / "2d.py"
    path.write_text("from codegen.scenes.free_rigid_body import scene\n")
    with pytest.raises(
        InputError, match=r"'2d_cg3' cannot be the prefix .* expected a letter, .* use prefix"
    ):
        emit(str(path), "cg:cg3")
    assert emit(str(path), "cg:cg3", prefix="flat").files


def test_prefixes_name_scene_and_method():
    made = compiled("free_rigid_body", "rkmk(2):rk4")
    assert default_prefix(made.scene, made.method) == "free_rigid_body_rkmk2_rk4_"
    assert prefix_of("mine") == prefix_of("mine_") == "mine_"
    for wrong in ("2x", "a-b", "", "_x", "größe"):
        with pytest.raises(InputError, match="the prefix"):
            prefix_of(wrong)


@pytest.mark.parametrize(
    ("scene", "method", "target", "error", "message"),
    [
        ("nowhere", "cf4", "c", UnknownName, "nowhere"),
        ("free_rigid_body", "nothing", "c", UnknownName, "nothing"),
        ("free_rigid_body", "cf4", "fortran", UnknownName, "unknown target fortran; expected c or python"),
        (
            "free_rigid_body",
            "vcg:midpoint",
            "c",
            MethodError,
            "the family vcg cannot be used on free_rigid_body; expected a Ham",
        ),
        ("dipole", "vcg:heun_zero.toml", "c", InputError, "heun_zero"),
        ("missing.py", "cf4", "c", SceneError, "missing.py"),
    ],
)
def test_bad_input_is_one_message(scene, method, target, error, message):
    with pytest.raises(error, match=message):
        emit(scene, method, target)


def test_a_zero_weight_is_refused_where_the_family_divides_by_it(tmp_path):
    path = tmp_path / "explicit_midpoint.toml"
    path.write_text(
        'name = "explicit_midpoint"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["0", "1"]\nsource = "test"\n'
    )
    with pytest.raises(ZeroWeight, match="b_1 = 0"):
        emit("dipole", f"vcg:{path}")
