"""No module decides by the name of a family, group, scene, tableau or target, except where it is defined.

The test reads the syntax trees of both packages. It looks for strings that equal a name, also
``name(2)``, ``family:tableau`` and ``scene+u``, at each place that can decide something: comparisons,
membership tests, match patterns, tables and sets of a module or class, tables and loops inside functions,
string constants of a module.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

import pytest
from jinja2 import Environment, nodes

import codegen.groups
import codegen.lower
import codegen.printers
import codegen.scenes
from orderconds import families
from orderconds.tableau import library

ROOT = Path(__file__).parents[1]
PACKAGES = ("orderconds", "codegen")

EXCEPTIONS = {
    ("orderconds/families/registry.py", "BUILT_IN"): "the registry of families",
    ("orderconds/families/*.py", "implies"): "theorems: the conditions of another family are among its own",
    ("orderconds/families/*.py", "low_storage"): "a theorem: families in which 2N schemes have one order",
    ("orderconds/families/*.py", "formats"): "the file formats a family reads, some named as families",
    ("orderconds/tableau/formats.py", "FORMATS"): "the registry of file formats, some named as families",
    ("orderconds/tableau/record.py", "READINGS"): "how one file format reads as another",
    ("orderconds/solve/parametrise.py", "LAYOUTS"): "the unknowns of each file format",
    (
        "orderconds/words/lie_series.py",
        "SERIES",
    ): "the registry of Lie series, one named as a family",
    ("codegen/groups/__init__.py", "LISTED"): "the registry of groups and their modules",
    ("codegen/scenes/__init__.py", "GALLERY"): "the registry of scenes",
    ("codegen/scenes/__init__.py", "LATTICES"): "the registry of chains and lattices",
    ("codegen/scenes/__init__.py", "SEMILINEAR"): "the registry of semilinear equations",
    (
        "codegen/lab/default_methods.py",
        "FIELD_METHODS",
    ): "the methods of a measurement if the user names none",
    ("codegen/lab/default_methods.py", "HAMILTONIAN_METHODS"): "the same for Hamiltonian scenes",
    ("codegen/lab/default_methods.py", "REPORT_SCENES"): "the scenes of a report if the user names none",
    ("codegen/lab/default_methods.py", "REPORT_FIELDS"): "the methods of a report if the user names none",
    ("codegen/lab/default_methods.py", "REPORT_HAMILTONIANS"): "the same for Hamiltonian scenes in a report",
    ("codegen/lab/default_methods.py", "REPORT_ADAPTIVE"): "the adaptive methods of a report by default",
    ("codegen/lab/default_methods.py", "README_METHODS"): "the methods of the pictures in the README",
    ("codegen/lab/peers/solve_ivp.py", ""): "SciPy's own names of its solvers",
}
"""Path and variable of a table that may hold names, and why; '' is a table without variable."""

TARGET_EXCEPTIONS = {
    "codegen/printers/registry.py": "the target of commands if the user names none",
    "codegen/lab/peers/__init__.py": "a group of peers",
    "codegen/lab/peers/compiled.py": "the nodes c of a tableau",
    "codegen/groups/se2.py": "the cosine among the coordinates",
}
"""Path of a file of the compiler that contains a string that equals a target's name, and its meaning."""

EXPORTS = ("__all__", "__slots__")

PREFIXES = ("startswith", "endswith", "removeprefix", "removesuffix")
LITERALS = (ast.Tuple, ast.List, ast.Set)
SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)


@dataclass(frozen=True)
class Offence:
    """A name in a decision. ``variable`` is what a module or class assigns it to, '' elsewhere."""

    path: str
    line: int
    name: str
    kind: str
    variable: str = ""

    def __str__(self) -> str:
        to = f" assigned to {self.variable}" if self.variable else ""
        return f"{self.path}:{self.line}: {self.name!r} in a {self.kind}{to}"


def groups() -> frozenset[str]:
    return frozenset(entry["name"] for entry in codegen.groups.listing())


def names() -> dict[str, frozenset[str]]:
    """The names that the program knows, by kind."""
    return {
        "family": frozenset(families.names()) | frozenset(codegen.lower.names()),
        "group": groups(),
        "scene": frozenset(codegen.scenes.every_name()),
        "tableau": frozenset(library.available()),
    }


def mentioned(text: str, known: Collection[str]) -> bool:
    """Return True if a string is a name, alone or as ``name(2)``, ``family:tableau``, ``scene+u``."""
    parts = re.split(r"\(\d+\)|:|\+u$|\s*,\s*", text)
    return any(part in known for part in parts) and re.fullmatch(r"[\w():+, ]+", text) is not None


def strings(node: ast.AST) -> Iterator[ast.Constant]:
    """Yield the strings of a literal: itself, its elements, keys and values, those of unions and set(...)."""
    match node:
        case ast.Constant(value=str()):
            yield node
        case ast.Tuple() | ast.List() | ast.Set():
            for element in node.elts:
                yield from strings(element)
        case ast.Dict():
            for item in (*node.keys, *node.values):
                if item is not None:
                    yield from strings(item)
        case ast.Starred(value=value):
            yield from strings(value)
        case ast.BinOp(left=left, right=right):
            yield from strings(left)
            yield from strings(right)
        case ast.Call(func=ast.Name(id="set" | "frozenset" | "tuple" | "list" | "dict"), args=args):
            for argument in args:
                yield from strings(argument)
        case ast.Call(func=ast.Attribute(value=ast.Constant(value=str(text)), attr="split")):
            for word in text.replace(",", " ").split():
                yield ast.Constant(word, lineno=node.lineno)
        case ast.IfExp(body=body, orelse=orelse):
            yield from strings(body)
            yield from strings(orelse)


def operands(node: ast.AST) -> tuple[str, list[ast.AST]]:
    """Return what a node decides by, and the kind of decision; no operands where it decides nothing."""
    match node:
        case ast.Compare():
            return "comparison", [node.left, *node.comparators]
        case ast.MatchValue(value=value):
            return "match pattern", [value]
        case ast.Call(func=ast.Attribute(attr=attribute), args=args) if attribute in PREFIXES:
            return "comparison", list(args)
        case ast.Subscript(value=ast.Dict() as table):
            return "table", [table]
        case ast.Call(func=ast.Attribute(value=ast.Dict() as table, attr="get")):
            return "table", [table]
        case ast.For(iter=several) | ast.comprehension(iter=several):
            return "loop", [several] if isinstance(several, LITERALS) else []
    return "", []


def offences(path: str, tree: ast.Module, known: Collection[str]) -> list[Offence]:
    """Return the decisions by a name in a syntax tree."""
    result: list[Offence] = []

    def add(node: ast.AST, kind: str, variable: str = "") -> None:
        constants = list(strings(node))
        found = [constant for constant in constants if mentioned(str(constant.value), known)]
        if kind == "loop" and 2 * len(found) < len(constants):
            return  # a list of something else, of attributes say, one of which has the name of a family
        for constant in found:
            result.append(Offence(path, constant.lineno, str(constant.value), kind, variable))

    def visit(node: ast.AST, inside: bool, variable: str) -> None:
        kind, deciding = operands(node)
        for operand in deciding:
            add(operand, kind)
        if not inside and isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            variable = ", ".join(ast.unparse(target) for target in targets)
            if isinstance(node.value, ast.Constant) and variable.isupper():
                add(node.value, "constant", variable)
        tabular = isinstance(node, (*LITERALS, ast.Dict)) or _splits(node)
        if tabular and not inside and not deciding and variable not in EXPORTS:
            add(node, "table", variable)
            return
        for name, value in ast.iter_fields(node):
            within = inside or (isinstance(node, SCOPES) and name == "body")
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST) and not _annotation(node, name):
                    visit(child, within, variable)

    visit(tree, inside=False, variable="")
    return list(dict.fromkeys(result))


def _splits(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "split"


def _annotation(node: ast.AST, name: str) -> bool:
    return name in ("annotation", "returns")


def defines(path: str, name: str) -> bool:
    """Return True if a file defines ``name``: families, lowerings and scenes have files of their name."""
    folder, _, file = path.rpartition("/")
    own = folder in ("orderconds/families", "codegen/lower", "codegen/scenes")
    return own and file == f"{name.partition('(')[0]}.py"


def excused(offence: Offence) -> str | None:
    """Return the reason why an offence is none."""
    if defines(offence.path, offence.name):
        return "its own file"
    for (path, variable), reason in EXCEPTIONS.items():
        held = offence.kind == "table" and offence.variable == variable
        if held and fnmatch(offence.path, path):
            return reason
    return None


@cache
def sources() -> list[tuple[str, ast.Module]]:
    """Return the syntax tree of each module with its path."""
    return [
        (path.relative_to(ROOT).as_posix(), ast.parse(path.read_text(encoding="utf-8")))
        for package in PACKAGES
        for path in sorted((ROOT / package).rglob("*.py"))
    ]


@cache
def all_offences() -> list[Offence]:
    known = frozenset().union(*names().values())
    return [offence for path, tree in sources() for offence in offences(path, tree, known)]


def target_names(path: str, tree: ast.Module, known: Collection[str]) -> list[Offence]:
    """Return the strings that equal a target's name, also in arguments and defaults, outside its package."""
    parts = {id(part) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in node.values}
    return [
        Offence(path, node.lineno, node.value, "string")
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value in known
        if id(node) not in parts and not path.startswith(f"codegen/printers/{node.value}/")
    ]


def type_tests(path: str, tree: ast.Module, classes: Collection[str]) -> list[Offence]:
    """Return the places that ask whether an object is of one of the group classes."""
    result = []
    for node in ast.walk(tree):
        asked: list[ast.AST] = []
        match node:
            case ast.Call(func=ast.Name(id="isinstance" | "issubclass"), args=[_, kinds]):
                asked = [kinds]
            case ast.Compare(ops=[ast.Is() | ast.IsNot() | ast.Eq() | ast.NotEq()], comparators=[other]):
                asked = [other] if isinstance(other, ast.Name | ast.Attribute) else []
            case ast.MatchClass(cls=kind):
                asked = [kind]
        for part in (inner for start in asked for inner in ast.walk(start)):
            name = getattr(part, "id", getattr(part, "attr", ""))
            if name in classes:
                result.append(Offence(path, node.lineno, name, "test of a type"))  # type: ignore[attr-defined]
    return result


def in_template(path: str, text: str, known: Collection[str]) -> list[Offence]:
    """Return the names among the string constants of a template's expressions."""
    constants = Environment().parse(text).find_all(nodes.Const)
    return [
        Offence(path, node.lineno, node.value, "template")
        for node in constants
        if isinstance(node.value, str) and mentioned(node.value, known)
    ]


def test_no_module_decides_by_the_name_of_a_family_group_scene_or_tableau() -> None:
    assert [str(offence) for offence in all_offences() if excused(offence) is None] == []


def test_no_module_outside_the_groups_asks_for_the_class_of_a_group() -> None:
    compiler = [(path, tree) for path, tree in sources() if path.startswith("codegen/")]
    found = [offence for path, tree in compiler for offence in type_tests(path, tree, groups())]
    assert [str(offence) for offence in found if not offence.path.startswith("codegen/groups/")] == []


def test_the_compiler_has_no_name_of_a_target_outside_the_package_of_the_target() -> None:
    known = codegen.printers.names()
    compiler = [(path, tree) for path, tree in sources() if path.startswith("codegen/")]
    found = [offence for path, tree in compiler for offence in target_names(path, tree, known)]
    assert [str(offence) for offence in found if offence.path not in TARGET_EXCEPTIONS] == []
    assert {offence.path for offence in found} == set(TARGET_EXCEPTIONS)


@pytest.mark.parametrize(
    "source",
    [
        "def f(x): return x.target == 'c'",
        "def f(x): return x in ('c', 'other')",
        "def f(x):\n match x:\n  case 'python': pass",
        "def f(target='c'): pass",
        "f(x, 'python')",
        "class A:\n    target: str = 'c'",
        "TABLE = {'python': 1}",
    ],
)
def test_a_name_of_a_target_is_found(source: str) -> None:
    known = codegen.printers.names()
    assert target_names("codegen/lab/example.py", ast.parse(source), known) != []
    own = [target_names(f"codegen/printers/{name}/example.py", ast.parse(source), known) for name in known]
    assert [] in own


def test_no_template_decides_by_a_name() -> None:
    known = frozenset().union(*names().values())
    files = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.j2"))
    assert files
    found = [
        offence
        for path in files
        for offence in in_template(path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8"), known)
    ]
    assert [str(offence) for offence in found] == []


def test_every_exception_is_used() -> None:
    used = {excused(offence) for offence in all_offences()}
    assert set(EXCEPTIONS.values()) <= used


@pytest.mark.parametrize(
    ("source", "kind"),
    [
        ("def f(x): return x.family == 'vcg'", "comparison"),
        ("def f(x): return 'rkmk(2)' != x", "comparison"),
        ("def f(x): return x in ('rk', 'cg3')", "comparison"),
        ("def f(x): return x not in {'heavy_top': 1}", "comparison"),
        ("def f(x): return x in frozenset({'SO3'}) | OTHERS", "comparison"),
        ("def f(x): return x in 'vcg vcf'.split()", "comparison"),
        ("def f(x): return x.startswith('vcg')", "comparison"),
        ("def f(x): return x == 'vcg:midpoint'", "comparison"),
        ("def f(x): return x == 'dipole+u'", "comparison"),
        ("def f(x):\n match x:\n  case 'rk' | 'other': pass", "match pattern"),
        ("def f(x):\n match x:\n  case ['rk', _]: pass", "match pattern"),
        ("def f(x): return {'rk': 1, 'cg': 2}[x]", "table"),
        ("def f(x): return {'rk': 1}.get(x)", "table"),
        ("def f(x):\n for y in ('rk', 'cg'): pass", "loop"),
        ("def f(x): return [g(y) for y, z in (('rk', 1), ('x', 2))]", "loop"),
        ("TABLE = {'rk': 1}", "table"),
        ("TABLE = {1: 'rk'}", "table"),
        ("TABLE: dict = {1: ('x', 'rk')}", "table"),
        ("SOME = frozenset({'vcg'})", "table"),
        ("SOME = 'vcg vcf'.split()", "table"),
        ("@option(Choice(['vcg', 'x']))\ndef f(): pass", "table"),
        ("class A:\n    some = ('SE2',)", "table"),
        ("DEFAULT = 'vcg'", "constant"),
    ],
)
def test_an_offence_is_found(source: str, kind: str) -> None:
    known = frozenset().union(*names().values())
    found = offences("codegen/example.py", ast.parse(source), known)
    assert {offence.kind for offence in found} == {kind}
    assert [excused(offence) for offence in found] == [None] * len(found)


@pytest.mark.parametrize(
    "source",
    [
        '"""A docstring with vcg."""',
        "def f(x): return x == 'other'",
        "def f(x): return x == 'rk of order 2'",
        "def f(x): return g('rk')",
        "def f(x): return {'order': 1, 'stages': 2}",
        "def f(x):\n for y in ('explicit', 'symmetric', 'rkn'): pass",
        "__all__ = ['SO3', 'SE2']",
        "TABLE = {'rk of order 2': 1}",
    ],
)
def test_what_decides_nothing_is_no_offence(source: str) -> None:
    known = frozenset().union(*names().values())
    assert offences("codegen/example.py", ast.parse(source), known) == []


def test_a_name_is_free_in_its_own_file_and_in_an_exception_only() -> None:
    assert excused(Offence("codegen/lower/vcg.py", 1, "vcg", "comparison")) is not None
    assert excused(Offence("codegen/lower/vcf.py", 1, "vcg", "comparison")) is None
    assert excused(Offence("codegen/scenes/__init__.py", 1, "dipole", "table", "GALLERY")) is not None
    assert excused(Offence("codegen/scenes/__init__.py", 1, "dipole", "table", "OTHER")) is None
    assert excused(Offence("codegen/groups/__init__.py", 1, "SO3", "comparison")) is None


@pytest.mark.parametrize(
    "source",
    [
        "isinstance(x, SO3)",
        "isinstance(x, groups.SO3 | Rn)",
        "type(x) is SO3",
        "match x:\n case SO3(): pass",
    ],
)
def test_a_test_of_a_group_class_is_found(source: str) -> None:
    assert type_tests("codegen/example.py", ast.parse(source), groups()) != []


def test_a_name_in_a_template_is_found() -> None:
    known = frozenset().union(*names().values())
    assert in_template("t.j2", "{% if method.family == 'vcg' %}x{% endif %}", known) != []
    assert in_template("t.j2", "the family vcg {{ 'other' }}", known) == []
