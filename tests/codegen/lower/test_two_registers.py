"""Low-storage (2N) schemes: the program with two registers computes the step of the general program."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

import codegen
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.program import EMBEDDED
from codegen.ir.site_step import WORK
from codegen.kernel.site_kernel import site_method
from codegen.lower import lowering, names, problem_for
from codegen.lower.cf import products, two_registers
from codegen.method import parse
from codegen.scenes import load
from orderconds.tableau.properties import low_storage

PAIR = "cf:cf5_2n_s10"


@pytest.mark.parametrize("scene", ["free_rigid_body", "driven_spin"])
@pytest.mark.parametrize("name", ["williamson3", "carpenter_kennedy4"])
def test_both_programs_have_one_step(scene: str, name: str) -> None:
    method = parse(f"cf:{name}", names())
    problem = problem_for(load(scene), method)
    registers = two_registers(problem, method, low_storage(method.tableau).scheme)
    general = products(problem, method, method.commutator_free(), None)
    domain = PreciseDomain(Fraction(1, 10), 40)
    values = [
        domain.rational(x.numerator, x.denominator) for x in (Fraction(3, 5), Fraction(0), Fraction(4, 5))
    ]
    inputs = {v.name: tuple(values) if v.name == "y" else domain.rational(1, 3) for v in general.inputs}
    one, two = (interpret(p, problem, domain, inputs) for p in (general, registers))
    assert sorted(one) == sorted(two)
    for key, value in one.items():
        assert all(abs(x - y) < 1e-36 for x, y in zip(value, two[key], strict=True))
    assert any(x != y for x, y in zip(two["y"], values, strict=True))


def test_the_header_states_two_registers_only_where_they_suffice() -> None:
    def header(name: str, **options: bool) -> str:
        files = codegen.emit("free_rigid_body", name, target="python", **options).files
        return " ".join("".join(files.values()).split())

    assert "storage: two registers (2N)" in header("cf:williamson3")
    assert "two registers" not in header("cf:cf4")
    assert "two registers" not in header("cf:luescher3", adaptive=True)
    assert "storage: three registers: the state Y, and two elements" in header(PAIR, adaptive=True)
    assert "storage: two registers (2N)" in header(PAIR)
    assert lowering("cf").storage(parse("cf:cf4", names())) == ""


def test_a_pair_has_the_updates_of_the_general_program() -> None:
    """Three registers: the state, K, and the sum E of all D_i f(Y_i)."""
    method = replace(parse(PAIR, names()), adaptive=True)
    problem = problem_for(load("driven_spin"), method)
    registers = lowering("cf").lower(problem, method)
    general = products(problem, method, method.commutator_free(), method.embedded().commutator_free().update)
    assert sum(op.name.startswith("E") for a in registers.assigns() for op in a.targets) == 10
    domain = PreciseDomain(Fraction(1, 10), 40)
    start = tuple(domain.rational(x, 5) for x in (3, 0, 4))
    inputs = {v.name: start if v.name == "y" else domain.rational(1, 3) for v in general.inputs}
    one, two = (interpret(p, problem, domain, inputs) for p in (general, registers))
    assert sorted(one) == sorted(two)
    assert EMBEDDED in one
    for key, value in one.items():
        assert all(abs(x - y) < 1e-36 for x, y in zip(value, two[key], strict=True))
    assert any(abs(x - y) > 1e-9 for x, y in zip(one["y"], one[EMBEDDED], strict=True))


@pytest.mark.parametrize("name", ["williamson3", "carpenter_kennedy4"])
def test_a_lattice_stores_as_many_numbers_for_any_number_of_stages(name: str) -> None:
    """A step stores one element K of so(3) for each site, and the states before and after a stage."""
    scene = load("spin_lattice")
    step = site_method(scene, parse(f"cf:{name}", names())).kernel.sites
    assert step is not None
    rows = {load.row for sweep in step.sweeps for load in sweep.loads} | {
        row for sweep in step.sweeps for row in sweep.stores
    }
    assert len({row for row in rows if row.array == WORK}) == 9
    assert all(len(sweep.stores) <= 6 for sweep in step.sweeps)
