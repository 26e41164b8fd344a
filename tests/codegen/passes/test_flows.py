"""Flows of one part are gathered across what commutes with them, and across nothing else."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sympy import Matrix, Max, N, Rational, diag, pi

from codegen import scenes
from codegen.flows.kick import Kick
from codegen.groups import Rn
from codegen.ir.values import Coefficient
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.passes import flows, optimise
from codegen.scene import HamiltonianScene, param
from codegen.scene.run_time import with_runtime
from tests.strategies import shipped, top_scene


def spelled(scene, method):
    view = problem_for(scene, method)
    program = lower(scene, method)
    return view, program, flows.run(program, view)


def parts(program):
    return [(letter.part, float(letter.duration.value)) for letter in flows.word(program)]


FAST = Method("splitting", shipped("forest_ruth4"))


def test_the_spin_of_a_top_that_its_potential_does_not_see_is_made_once():
    view, program, gathered = spelled(scenes.load("fast_heavy_top"), FAST)
    names = [name for name, _ in parts(gathered)]
    assert names == ["V", "T.mean"] * 3 + ["T.turn", "V"]
    assert parts(gathered)[-2] == ("T.turn", 1.0)
    commute = flows.commuting(view)
    assert commute("T.turn", "V")
    assert commute("T.turn", "T.mean")
    assert not commute("T.mean", "V")
    assert flows.apart(flows.word(program), commute) == ("T.turn",)


def test_the_spin_of_a_top_without_symmetry_is_not():
    """The potential tells the body's axes apart."""
    view, program, gathered = spelled(top_scene(diag(2, 3, 2)), FAST)
    assert gathered == program
    assert not flows.commuting(view)("T.turn", "V")


def test_neighbours_of_one_part_are_one_and_nothing_is_left_of_flows_that_cancel():
    view, program, _ = spelled(top_scene(diag(2, 3, 2)), Method("splitting", shipped("strang")))
    letters = flows.word(program)
    doubled = flows.with_flows(program, [letters[0], *letters])
    assert [d for p, d in parts(flows.run(doubled, view)) if p == "V"] == [1.0, 0.5]
    back = replace(letters[0], duration=Coefficient(-letters[0].duration.value, 1))
    undone = flows.with_flows(program, [back, *letters])
    assert [p for p, _ in parts(flows.run(undone, view))] == ["T.mean", "T.turn", "V"]


def test_kicks_at_two_times_are_two():
    """Between them stands nothing, but they see different times."""
    view, program, _ = spelled(scenes.load("linear_oscillator"), Method("splitting", shipped("strang")))
    letters = [letter for letter in flows.word(program) if letter.part == "V"]
    assert len({letter.time for letter in letters}) == 2
    assert len(flows.word(flows.run(flows.with_flows(program, letters), view))) == 2


def test_the_pass_is_undone_where_it_changes_what_is_computed(monkeypatch):
    """The control: a pass that takes everything to commute is caught by interpretation."""
    monkeypatch.setattr(flows, "commuting", lambda scene: lambda a, b: True)
    scene = scenes.load("fast_heavy_top")
    with pytest.raises(AssertionError, match="the pass joined flows changed the results"):
        optimise(lower(scene, FAST), problem_for(scene, FAST))


def test_a_program_that_is_no_splitting_is_left_alone():
    scene, method = scenes.load("dipole"), Method("vcg", shipped("midpoint"))
    program = lower(scene, method)
    assert flows.word(program) is None
    assert flows.run(program, scene) is program


def test_flows_of_one_group_commute_where_their_brackets_vanish():
    scene = top_scene(Matrix([[3, 1, 1], [1, 3, 1], [1, 1, 3]]))
    view = problem_for(scene, Method("splitting", shipped("strang")))
    assert isinstance(view.flows["V"], Kick)
    assert flows.commuting(view)("T.mean", "T.turn")


STRANG = Method("splitting", shipped("strang"))


def anharmonic(rate, strength=1, span=2):
    """H = rate (q^2 + p^2) + strength q^4 / 4 on T*R."""
    q, p = Rn(1).point("q"), Rn(1).dual("p")
    A, V = rate * (q[0] ** 2 + p[0] ** 2), strength * q[0] ** 4 / 4
    parts = {"A": A, "V": V}
    return HamiltonianScene(
        group=Rn(1), q=q, mu=p, H=A + V, parts=parts, q0=[1], mu0=Matrix([0]), span=(0, span)
    )


@pytest.mark.parametrize("turns", [1, 2, 3, 12])
@pytest.mark.parametrize("share", flows.SHARES)
def test_a_flow_that_makes_full_turns_in_a_tested_duration_does_not_commute(share, turns):
    """The period of A is 1. The pass joined the two kicks of Strang's splitting."""
    scene = anharmonic(Rational(str(N(pi, 45))), span=flows.TYPICAL_STEPS * turns / share)
    view, program, gathered = spelled(scene, STRANG)
    assert not flows.commuting(view)("A", "V")
    assert gathered == program


@pytest.mark.parametrize(("default", "power"), [(0, 1), (Rational(1, 10**25), 1), (10**25, -1)])
def test_flows_that_commute_for_the_default_of_a_run_time_parameter_only_are_not_joined(default, power):
    scene = anharmonic(Rational(1, 2), strength=param("k", default) ** power)
    assert flows.commuting(problem_for(scene, STRANG))("A", "V")
    assert not flows.commuting(problem_for(with_runtime(scene, ("k",)), STRANG))("A", "V")


def test_flows_that_commute_only_near_the_initial_state_are_not_joined():
    """The force of V is zero for q < 10. Two kicks commute everywhere."""
    q, p = Rn(1).point("q"), Rn(1).dual("p")
    parts = {"T": p[0] ** 2 / 2, "V": Max(q[0] - 10, 0) ** 3, "W": Max(q[0] - 20, 0) ** 3}
    scene = HamiltonianScene(
        group=Rn(1), q=q, mu=p, H=sum(parts.values()), parts=parts, q0=[1], mu0=[0], span=(0, 1)
    )
    commute = flows.commuting(problem_for(scene, STRANG))
    assert not commute("T", "V")
    assert commute("V", "W")
