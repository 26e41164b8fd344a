"""Reserved words of Python: keywords, and each name that an emitted module imports, defines or looks up."""

from __future__ import annotations

import ast
import builtins
import keyword
from pathlib import Path

import pytest

from codegen.printers.python.words import PUBLIC, RESERVED
from codegen.run.identifiers import identify
from codegen.run.language import Assign, Function, Return, Unit
from codegen.run.terms import Kind, number, own

ROOT = Path(__file__).parents[4]
EMITTED = [*sorted((ROOT / "generated").rglob("*.py")), ROOT / "tests" / "golden" / "rigid.py"]
FUNCTIONS = ("step", "run", "run_adaptive", "jacobian")


@pytest.fixture(params=EMITTED, ids=lambda path: path.stem)
def module(request: pytest.FixtureRequest) -> ast.Module:
    path: Path = request.param
    return ast.parse(path.read_text())


@pytest.mark.parametrize("word", sorted(RESERVED | PUBLIC))
def test_no_variable_is_a_reserved_word(word: str) -> None:
    body = (Assign(own(word), number(1.0)), Return(own(word)))
    unit = Unit((), (), (), (Function("f", "", (), body, Kind.REAL),))
    identifier = identify(unit, RESERVED | PUBLIC)["f"].of(own(word))
    assert identifier not in RESERVED | PUBLIC
    assert identifier.isidentifier()
    assert not keyword.iskeyword(identifier)


def test_global_names_of_a_module_are_reserved(module: ast.Module) -> None:
    names: set[str] = set()
    for node in module.body:
        match node:
            case ast.ImportFrom(names=imported):
                names |= {alias.asname or alias.name for alias in imported}
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                names.add(name)
            case ast.Assign(targets=targets):
                names |= {t.id for t in targets if isinstance(t, ast.Name)}
    # Private functions get an underscore; ``differences`` and the other tables are names of the unit.
    public = {name for name in names if not name.startswith("_")} - {"differences", "fraction", "offset"}
    assert public <= RESERVED


def test_builtins_that_a_module_calls_are_reserved(module: ast.Module) -> None:
    functions = [n.func for n in ast.walk(module) if isinstance(n, ast.Call)]
    called = {f.id for f in functions if isinstance(f, ast.Name)}
    assert called & set(dir(builtins)) <= RESERVED | {"super"}


def test_local_names_of_public_functions_are_excluded_for_parameters(module: ast.Module) -> None:
    for function in module.body:
        if not isinstance(function, ast.FunctionDef) or function.name not in FUNCTIONS:
            continue
        assigned = {
            n.id for n in ast.walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
        }
        arguments = {a.arg for a in (*function.args.args, *function.args.kwonlyargs)}
        inner = {n.target.id for n in ast.walk(function) if isinstance(n, ast.comprehension)}  # type: ignore[attr-defined]
        assert assigned - arguments - inner <= RESERVED | PUBLIC
