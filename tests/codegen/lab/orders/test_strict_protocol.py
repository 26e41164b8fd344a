"""The strict protocol passes what has its order and catches every fault that has fooled others."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from click.testing import CliRunner

from codegen.commands.converge import command
from codegen.emitter import Optimised
from codegen.groups.capabilities import Coadjoint
from codegen.ir.domain import Domain
from codegen.ir.number import Number
from codegen.ir.operations import Advance, Bracket, Values
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import FlowOf
from codegen.ir.values import Coefficient
from codegen.lab.orders.strict_protocol import stated_order, strict
from codegen.lab.orders.strict_scenes import fields, hamiltonians, linear_fields, split_hamiltonians
from codegen.lower import names
from codegen.method import Method, parse
from codegen.scene.problem import Problem

INVALID = Path(__file__).parents[3] / "invalid"


def method(spelling: str) -> Method:
    return parse(spelling, names())


def verdicts(spelling: str, stated: int | None = None, alter: Callable[[Optimised], Optimised] = lambda c: c):
    chosen = method(spelling)
    return {c.scene: c for c in strict(chosen, stated_order(chosen, stated), alter=alter)}


@pytest.mark.parametrize("spelling", ["rkmk(2):rk4", "rkmk:rk4", "cg:cg3", "cf:cf4", "rkmk(0):euler"])
def test_what_has_its_order_passes_on_every_scene(spelling):
    found = verdicts(spelling)
    assert sorted(found) == sorted(scene.name for scene in fields())
    assert [c.sentence() for c in found.values() if c.verdict != "holds"] == []


@pytest.mark.slow
@pytest.mark.parametrize("spelling", ["vcg:gauss1", "vrkmk(1):kutta3", "vcf:cf4"])
def test_variational_methods_pass_on_every_hamiltonian(spelling):
    found = verdicts(spelling)
    assert sorted(found) == sorted(scene.name for scene in hamiltonians())
    assert [c.sentence() for c in found.values() if c.verdict != "holds"] == []


LINEAR = [
    *("magnus:magnus4", "magnus:magnus6", "cf_magnus:cf_magnus4", "cf_magnus:cf_magnus6"),
    *("fer:fer4", "fer:fer6", "cayley:cayley4", "cayley:cayley6"),
    *(pytest.param(m, marks=pytest.mark.slow) for m in ("magnus:magnus8", "cf_magnus:cf_magnus8")),
]


@pytest.mark.parametrize("spelling", LINEAR)
def test_methods_for_linear_problems_pass_under_left_and_right_actions(spelling):
    found = verdicts(spelling)
    assert sorted(found) == sorted(scene.name for scene in linear_fields())
    assert [c.sentence() for c in found.values() if c.verdict != "holds"] == []


@pytest.mark.parametrize("spelling", ["splitting:strang", "splitting:blanes_moan4"])
def test_splittings_pass_on_every_scene_with_exact_flows(spelling):
    found = verdicts(spelling)
    assert sorted(found) == sorted(scene.name for scene in split_hamiltonians())
    assert [c.sentence() for c in found.values() if c.verdict != "holds"] == []


def altered(change: Callable[[Assign], Assign]) -> Callable[[Optimised], Optimised]:
    def alter(made: Optimised) -> Optimised:
        body = tuple(change(s) if isinstance(s, Assign) else s for s in made.program.body)
        program: Program = replace(made.program, body=body)
        assert program != made.program
        return replace(made, program=program)

    return alter


def frozen(assign: Assign) -> Assign:
    """Stage times stand still at the beginning of the step."""
    if not isinstance(assign.operation, Advance):
        return assign
    still = Coefficient(Number.rational(0))
    return replace(assign, operation=replace(assign.operation, coefficient=still))


def opposite(assign: Assign) -> Assign:
    """Brackets have the other sign."""
    return replace(assign, args=assign.args[::-1]) if isinstance(assign.operation, Bracket) else assign


def reversed_factors(made: Optimised) -> Optimised:
    """The exponentials of a product act in the opposite order."""
    body = made.program.body
    moves = [k for k, s in enumerate(body) if isinstance(s, Assign) and s.operation.exponentials]
    exponents = {k: body[j].args[0] for k, j in zip(moves, reversed(moves), strict=True)}
    last = [s for k, s in enumerate(body) if k not in exponents]
    moved = [replace(body[k], args=(x, *body[k].args[1:])) for k, x in exponents.items()]
    return replace(made, program=replace(made.program, body=(*last, *moved)))


@dataclass(frozen=True)
class FrozenFlow(FlowOf):
    """A flow whose momentum moves with the torque at the start of the flow; the position moves exactly."""

    def evaluate(self, problem: Problem, domain: Domain, args: Values) -> Values:
        q, mu = args
        group, flow = problem.group.require(Coadjoint), problem.flows[self.part]
        tau = self.duration.evaluate(domain)
        xi, n = flow.field(domain, group, problem.values(domain, (*q, *mu)), q, mu)
        end, _ = super().evaluate(problem, domain, args)
        rate = [a - b for a, b in zip(n, group.adt(domain, xi, mu), strict=True)]
        return end, tuple(m + tau * x for m, x in zip(mu, rate, strict=True))


def frozen_gyroscope(assign: Assign) -> Assign:
    """The gyroscopic term G of a splitting stands still at the beginning of its flow."""
    operation = assign.operation
    if not isinstance(operation, FlowOf) or operation.part != "G":
        return assign
    return replace(assign, operation=FrozenFlow(operation.part, operation.duration, operation.timed))


CONTROLS = {
    "no dexp^-1": (f"rkmk(0):{INVALID / 'rkmk4_no_brackets.toml'}", None, 2, None),
    "dexp^-1 cut too short": (f"rkmk(1):{INVALID / 'rkmk4_one_bracket.toml'}", None, 3, None),
    "CG coefficients on reversed stages": (f"cg:{INVALID / 'cg3_rows_reversed.toml'}", None, 2, None),
    "CF4 factors swapped": (f"cf:{INVALID / 'cf4_factors_swapped.toml'}", None, 2, None),
    "k1/2 in stage 3": (f"rkmk(2):{INVALID / 'rkmk4_first_stage_again.toml'}", None, 2, None),
    "stage times frozen": ("rkmk(2):rk4", None, 1, altered(frozen)),
    "nodes of a Magnus method frozen": ("magnus:magnus4", None, 1, altered(frozen)),
    "nodes of a Magnus product frozen": ("cf_magnus:cf_magnus4", None, 1, altered(frozen)),
    "nodes of a Fer method frozen": ("fer:fer4", None, 1, altered(frozen)),
    "nodes of a Cayley method frozen": ("cayley:cayley4", None, 1, altered(frozen)),
    "other sign in a tableau": (f"magnus:{INVALID / 'magnus4_bracket_sign.toml'}", None, 2, None),
    "other sign of the bracket, Magnus": ("magnus:magnus4", None, 2, altered(opposite)),
    "other sign of the bracket, Fer": ("fer:fer4", None, 2, altered(opposite)),
    "other sign of the bracket, Cayley": ("cayley:cayley4", None, 2, altered(opposite)),
    "factors of a Magnus product reversed": ("cf_magnus:cf_magnus4", None, 2, reversed_factors),
    "gyroscopic term of a splitting frozen": ("splitting:strang", None, 1, altered(frozen_gyroscope)),
}
"""Fault -> method, the order stated for it where its file claims none, the order it has, a fault put in."""


@pytest.mark.parametrize("fault", CONTROLS)
def test_every_fault_is_caught_on_every_scene_with_the_order_it_has(fault):
    spelling, stated, real, alter = CONTROLS[fault]
    found = verdicts(spelling, stated, alter or (lambda c: c))
    for scene, result in found.items():
        assert result.verdict == "fails", (fault, scene, result.sentence())
        assert result.stated.order > real
        assert result.observed == pytest.approx(real, abs=0.25), (fault, scene, result.sentence())


def test_better_than_stated_fails_as_well():
    assert {c.verdict for c in verdicts("cf:cf4", 3).values()} == {"fails"}


def test_the_command_reads_claims_from_a_file_and_exits_with_one():
    path = str(INVALID / "cf4_factors_swapped.toml")
    done = CliRunner().invoke(
        command, ["--protocol", "strict", "--method", f"cf:{path}", "--json"], standalone_mode=False
    )
    assert done.exception is None
    assert done.return_value == 1
    found = json.loads(done.output)
    assert {r["verdict"] for r in found} == {"fails"}
    assert {r["stated_order"] for r in found} == {4}
    assert {r["certificate"] for r in found} == {"claimed"}
    assert len(found) == len(fields())


@pytest.mark.parametrize("arguments", [["-m", "cf4"], ["dipole", "-m", "cf4", "--protocol", "strict"]])
def test_a_scene_or_the_protocol_is_needed_and_not_both(arguments):
    assert CliRunner().invoke(command, arguments).exit_code == 2
