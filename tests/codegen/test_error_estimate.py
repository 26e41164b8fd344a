"""An error estimate sees the error of the method, or it is refused with a cut-off that works."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

from codegen.emitter import compile_method
from codegen.errors import MethodError
from codegen.lab.distance import distance
from codegen.lab.reference import cached_reference
from codegen.lab.runner import Emitted
from orderconds.cli import program


@pytest.mark.parametrize(
    ("method", "works"),
    [
        ("rkmk(0):dormand_prince5", "rkmk(2):dormand_prince5"),
        ("rkmk(1):dormand_prince5", "rkmk(2):dormand_prince5"),
        ("rkmk(0):cg43", "rkmk(1):cg43"),
    ],
)
def test_rows_that_miss_the_same_brackets_are_refused_and_a_cutoff_that_works_is_named(
    method: str, works: str
) -> None:
    with pytest.raises(MethodError, match="same leading error") as refused:
        compile_method("driven_spin", method, adaptive=True)
    assert refused.value.hint == f"write {works}"
    assert compile_method("driven_spin", works, adaptive=True).kernel.estimate is not None


@pytest.mark.parametrize(
    "method", ["cg:dormand_prince5", "rkmk(2):dop853", "cf:cf43", "cf:cf5_2n_s10", "ambient:dop853"]
)
def test_rows_with_different_leading_errors_are_accepted(method: str) -> None:
    assert compile_method("free_rigid_body", method, adaptive=True).kernel.estimate is not None


def test_the_cutoff_that_is_named_meets_the_tolerance() -> None:
    compiled = compile_method("driven_spin", "rkmk(2):dormand_prince5", adaptive=True)
    runner, (first, last) = Emitted(compiled), map(float, compiled.scene.span)
    arrival = runner.integrator.adaptive(runner.initial, first, last, rtol=1e-9, atol=1e-9)
    assert distance(compiled.scene, arrival.state, cached_reference(compiled.scene).state) < 1e-7


@pytest.mark.parametrize("method", ["cf:cf43", "cg:cg43"])
def test_rows_that_are_equal_on_a_problem_linear_in_time_are_refused(method: str) -> None:
    # The stages at the same time have the same values, so both rows have the same result.
    with pytest.raises(MethodError, match="does not depend on the state") as refused:
        compile_method("four_level_system", method, adaptive=True)
    assert "cf:cf3" in refused.value.hint
    assert compile_method("four_level_system", "cf:cf3", adaptive=True).kernel.estimate is not None


def test_emit_refuses_with_one_message() -> None:
    words = ["emit", "driven_spin", "--method", "rkmk(0):dormand_prince5", "--adaptive", "--json"]
    done = CliRunner().invoke(program, words)
    assert done.exit_code == 2
    assert "rkmk(2):dormand_prince5" in done.stderr
    assert "Traceback" not in done.stderr
