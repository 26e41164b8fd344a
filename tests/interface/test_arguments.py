"""Wrong arguments of functions in Python have one clear message that names the argument, and bounds hold."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import codegen
import orderconds
from orderconds import Tableau, check, construct, convert, derive, refine, solve, trees
from orderconds.checking.limits import Limits
from orderconds.errors import InputError

EULER: tuple[Any, Any] = ([[0]], [1])
RIGID = "free_rigid_body"
Call = Callable[[], object]

WRONG: dict[str, tuple[Call, str]] = {
    "claims as text": (
        lambda: Tableau.rk(*EULER, claims="rk=4"),
        "claims: 'rk=4' of type str; expected the order",
    ),  # type: ignore[arg-type]
    "claims of an unknown family": (lambda: Tableau.rk(*EULER, claims={"foo": 2}), "unknown family 'foo'"),
    "claims as pairs": (lambda: Tableau.rk(*EULER, claims=[("rk", 2)]), "claims: an object of type list"),  # type: ignore[arg-type]
    "claims as float": (lambda: Tableau.rk(*EULER, claims=1.0), "claims: 1.0 of type float"),  # type: ignore[arg-type]
    "claims by number": (lambda: Tableau.rk(*EULER, claims={1: 2}), "claims: 1; expected a family"),  # type: ignore[dict-item]
    "claims of texts": (lambda: Tableau.rk(*EULER, claims={"rk": "2"}), "claims['rk']: '2' of type str"),  # type: ignore[dict-item]
    "starts as list": (
        lambda: Tableau.cf([[], [[1]]], [[0, 1]], starts=[1]),
        "starts: an object of type list",
    ),  # type: ignore[arg-type]
    "starts by text": (lambda: Tableau.cf([[], [[1]]], [[0, 1]], starts={"1": 2}), "starts: '1' of type str"),  # type: ignore[dict-item]
    "load a number": (
        lambda: Tableau.load(3),
        "tableau: 3; expected a Tableau, the name of a tableau in the library, or a path",
    ),  # type: ignore[arg-type]
    "load a long name": (lambda: Tableau.load("x" * 5000), "no tableau 'xxx"),
    "loads bytes": (lambda: Tableau.loads(b""), "text: b'' of type bytes"),  # type: ignore[arg-type]
    "check arrays": (lambda: check([[0], [1]]), "Tableau.rk(A, b) builds a tableau from arrays"),  # type: ignore[arg-type]
    "check an order as text": (lambda: check("rk4", order="4"), "order: '4' of type str"),  # type: ignore[arg-type]
    "check order 0": (lambda: check("rk4", order=0), "order: 0; expected an integer from 1 to 20"),
    "check with negative tolerance": (
        lambda: check("rk4", tolerance=-1),
        "tolerance: -1; expected a number from 0",
    ),
    "check with tolerance NaN": (lambda: check("rk4", tolerance=float("nan")), "tolerance: nan"),
    "check for NaN seconds": (
        lambda: check("rk4", limits=Limits(seconds=float("nan"))),
        "seconds: nan of type float; expected a number from 0",
    ),
    "check with a number of limits": (lambda: check("rk4", limits=3), "limits: 3; expected Limits"),  # type: ignore[arg-type]
    "check a family by number": (lambda: check("rk4", family=3), "family: 3; expected the name"),  # type: ignore[arg-type]
    "derive an order as text": (lambda: derive("rk", "3"), "order: '3' of type str"),  # type: ignore[arg-type]
    "derive a float": (lambda: derive("rk", 3.0), "order: 3.0 of type float"),  # type: ignore[arg-type]
    "derive for no stages": (
        lambda: derive("rk", 3, stages=0),
        "stages: 0; expected an integer from 1 to 12",
    ),
    "derive order 60": (lambda: derive("rk", 60), "order: 60; expected an integer from 1 to 20"),
    "derive many trees": (lambda: derive("rk", 20), "rk: there are 12486 trees of order 13"),
    "stages of a cf": (
        lambda: derive("cf", 2, stages=2),
        "stages: cannot expand the conditions of family cf",
    ),
    "solve with stages as text": (lambda: solve("rk", "2", 2), "stages: '2' of type str"),  # type: ignore[arg-type]
    "solve with one text": (
        lambda: solve("rk", 2, 2, fix="a21=1"),
        'expected a list of strings such as ["a21=1/2"]',
    ),
    "solve with a wrong equation": (
        lambda: solve("rk", 2, 2, fix=["a21"]),
        "fix: 'a21'; expected a linear equation",
    ),
    "solve with no starts": (lambda: solve("rk", 2, 2, starts=-1), "starts: -1; expected an integer from 1"),
    "solve with a size": (lambda: solve("rk", 2, 2, size=float("nan")), "size: nan of type float"),  # type: ignore[arg-type]
    "solve for the least cost": (lambda: solve("rk", 2, 2, minimise="cost"), "minimise: 'cost'"),  # type: ignore[arg-type]
    "refine to -1 digits": (
        lambda: refine("cg4a", digits=-1),
        "digits: -1; expected an integer from 10 to 1000",
    ),
    "convert a dictionary": (lambda: convert({}, "json"), "tableau: an object of type dict"),  # type: ignore[arg-type]
    "construct a float": (lambda: construct("gauss", 2.0), "stages: 2.0 of type float; expected an integer"),  # type: ignore[arg-type]
    "construct a thousand": (
        lambda: construct("gauss", 1000),
        "stages: 1000; expected an integer from 1 to 50",
    ),
    "construct a list": (lambda: construct(["gauss"], 2), "kind: an object of type list"),  # type: ignore[arg-type]
    "trees of a text": (lambda: trees("rooted", "4"), "order: '4' of type str"),  # type: ignore[arg-type]
    "trees of a truth value": (lambda: trees("rooted", True), "order: True of type bool"),
    "trees of order 1000": (lambda: trees("rooted", 1000), "order: 1000; expected an integer from 1 to 40"),
    "too many trees": (
        lambda: trees("rooted", 30),
        "print only the number of trees: orderconds trees --count",
    ),
    "emit nothing": (
        lambda: codegen.emit(RIGID, None),
        "method: an object of type NoneType; expected a Tableau",
    ),  # type: ignore[arg-type]
    "emit no scene": (lambda: codegen.emit(None, "cf4"), "scene: an object of type NoneType"),  # type: ignore[arg-type]
    "emit a prefix": (
        lambda: codegen.emit(RIGID, "cf4", prefix="1a"),
        "prefix: '1a' cannot be the prefix of names",
    ),
    "emit one parameter": (
        lambda: codegen.emit(RIGID, "cf4", parameters="alpha"),
        "parameters: 'alpha' of type str",
    ),
    "emit values": (
        lambda: codegen.emit(RIGID, "cf4", parameters={"alpha": 1}),
        "parameters: an object of type dict",
    ),  # type: ignore[arg-type]
    "emit a wrong cut-off": (
        lambda: codegen.emit(RIGID, Tableau.load("rk4"), family="rkmk(-2)"),
        "family: 'rkmk(-2)'",
    ),
    "load nothing": (lambda: codegen.load(None), "load: an object of type NoneType"),  # type: ignore[arg-type]
    "converge nothing": (lambda: codegen.converge(RIGID), "converge: no method"),
    "converge a list": (lambda: codegen.converge(RIGID, ["cf4"]), "method: an object of type list"),  # type: ignore[arg-type]
    "converge no steps": (
        lambda: codegen.converge(RIGID, "cf4", steps=[0, 1]),
        "steps: 0; expected an integer",
    ),
    "bench with a budget": (
        lambda: codegen.bench(RIGID, "cf4", budget=-1),
        "budget: -1; expected a number from 0",
    ),
    "bench one target": (lambda: codegen.bench(RIGID, "cf4", targets="c"), "targets: 'c' of type str"),
    "solve with a checkpoint 3": (
        lambda: orderconds.solve("rk", 2, 2, checkpoint=3),  # type: ignore[arg-type]
        "checkpoint: 3; expected the path of a file",
    ),
    "solve without a report": (
        lambda: orderconds.solve("rk", 2, 2, report=None),  # type: ignore[arg-type]
        "report: an object of type NoneType; expected a function",
    ),
    "recommend for a text": (lambda: codegen.recommend(RIGID, "x"), "error: 'x' of type str"),  # type: ignore[arg-type]
    "recommend for error 0": (
        lambda: codegen.recommend(RIGID, 0),
        "error: the error 0; expected a number above 0",
    ),
    "recommend backwards": (
        lambda: codegen.recommend(RIGID, 1e-3, span=(1, 0)),
        "span: (1, 0); expected a start time less than the end time",
    ),
    "recommend one tableau": (
        lambda: codegen.recommend(RIGID, 1e-3, tableaux="rk4"),
        "tableaux: 'rk4' of type str",
    ),
}


@pytest.mark.parametrize("call", WRONG)
def test_a_wrong_argument_is_named(call: str) -> None:
    function, message = WRONG[call]
    with pytest.raises(InputError) as error:
        function()
    assert message in str(error.value)
    assert " --" not in str(error.value).replace("orderconds trees --count", "")


def test_integers_of_numpy_are_integers() -> None:
    assert Tableau.rk(*EULER, claims=np.int64(1)).claims == Tableau.rk(*EULER, claims=1).claims  # type: ignore[arg-type]
    assert construct("gauss", np.int64(2)) == construct("gauss", 2)  # type: ignore[arg-type]
    assert derive("rk", np.int64(3)).counts == (1, 1, 2)  # type: ignore[arg-type]
    assert len(trees("rooted", np.int64(4))) == 4  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["rk4", "gauss2", "cf4", "cg4a", "triple_jump"])
def test_equal_tableaux_have_equal_hashes(name: str) -> None:
    assert Tableau.load(name) == Tableau.load(name)
    assert len({Tableau.load(name), Tableau.load(name), Tableau.load("kutta3")}) == 2


def test_the_bounds_of_commands_are_the_bounds_of_functions() -> None:
    from click.testing import CliRunner

    from orderconds.cli import program

    for words in (
        ["derive", "rk", "-p", "21"],
        ["construct", "gauss", "-s", "51"],
        ["trees", "rooted", "-p", "41"],
    ):
        assert CliRunner().invoke(program, words).exit_code == 2
    assert orderconds.derive("magnus", 4).order == 4
