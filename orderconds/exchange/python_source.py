"""Python modules that assign arrays: ``A = np.array([[0, 0], [1/2, 0]])``, ``b = [0, 1]``, ``order = 2``.

The file is parsed, not executed. The function :func:`read` evaluates the assignments at the top level one
after another. An assignment may contain lists, tuples, numbers, arithmetic, square roots and names from
earlier assignments. It may also contain constructors of arrays and of exact numbers from NumPy, SymPy and
``fractions``. Arithmetic is exact: ``1/3`` is the fraction 1/3 and not a double. Some statements
cannot be evaluated. If such a statement may change an array of the tableau, the file is refused. With the
option ``--execute``, :mod:`orderconds.exchange.python_module` executes the file.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterator

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, from_arrays
from orderconds.exchange.claim_text import json_table
from orderconds.exchange.comments import unescaped
from orderconds.exchange.nested import Cells
from orderconds.exchange.python_values import Array, Computed, Values, texts
from orderconds.tableau.file_format import Data

ARRAYS = (*MATRICES, *ROWS)
COMPLETE = (("A", "b"), ("exponentials", "count", "start"), ("gamma",), ("alpha", "beta"))
"""Groups of names of arrays. A module contains a tableau if it assigns all arrays of one group."""

HINT = "write the numbers themselves, or execute the file with 'orderconds check --execute'"
HARMLESS = ("print",)
MODULES = ("fractions", "decimal", "math", "numpy", "sympy")
"""Modules whose functions may occur in expressions, such as ``sqrt`` or ``Fraction``."""
_TEXT = re.compile(r"# (\w{1,64}): (.*)")


def read(content: bytes, where: str) -> Data:
    """Read a tableau from Python source, and return a dictionary with the keys of a tableau file.

    The source is not executed.

    >>> read(b"import numpy as np\\nh = 1/2\\nA = np.array([[0, 0], [h, 0.]])\\nb = [0, 1]", "m.py")["A"]
    [['0', '0'], ['1/2', '0']]
    """
    text = _decoded(content, where)
    entries = _header(text)
    numbers = json_table(entries.get("numbers", "{}"), f"{where}: numbers")
    values = Values(text, numbers.keys())
    try:
        for statement in _parsed(text, where).body:
            _follow(statement, values)
        _add(entries, values, where)
    except RecursionError:
        raise TableauError("an expression nested too deep", where=where, expected="rows of numbers") from None
    if not entries.keys() & set(ARRAYS):
        raise TableauError(
            "no arrays", where=where, expected="assignments such as  A = [[0, 0], [1, 0]]  and  b = [0, 1]"
        )
    return from_arrays(entries, where)


def reason_to_skip(content: bytes) -> str:
    """Return the reason to skip a module, or an empty text if the module assigns the arrays of a tableau.

    >>> reason_to_skip(b"import os"), reason_to_skip(b"A = [[0]]\\nb = [1]")
    ('assigns no arrays of a tableau, such as A and b', '')
    """
    try:
        tree = _parsed(_decoded(content, ""), "")
    except TableauError:
        return "not valid Python"
    assigned = {
        name
        for statement in tree.body
        for name, value in _assignments(statement)
        if isinstance(value, ast.List | ast.Tuple | ast.Call | ast.BinOp | ast.Name | ast.Subscript)
    }
    complete = any(assigned.issuperset(names) for names in COMPLETE)
    return "" if complete else "assigns no arrays of a tableau, such as A and b"


def is_plainly_other(content: bytes) -> bool:
    """Return True if no assignment in a module resembles a tableau.

    An assignment to A, a or b resembles a tableau if its right-hand side contains a list or a tuple.
    Return False for invalid source, because it may contain a tableau.

    >>> [is_plainly_other(x) for x in (b"import os", b"a = [[0, 0], [1, 0]]", b"a = f(1)")]
    [True, False, True]
    """
    try:
        tree = _parsed(_decoded(content, ""), "")
    except TableauError:
        return False
    return not any(
        name in ("A", "a", "b") and any(isinstance(node, ast.List | ast.Tuple) for node in ast.walk(value))
        for statement in tree.body
        for name, value in _assignments(statement)
    )


def _decoded(content: bytes, where: str) -> str:
    try:
        return content.decode()
    except UnicodeDecodeError:
        raise TableauError("bytes that are not UTF-8", where=where, expected="Python source") from None


def _parsed(text: str, where: str) -> ast.Module:
    try:
        with warnings.catch_warnings():
            # Without this filter, Python would print warnings about literals in the user's module.
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as problem:
        line = getattr(problem, "lineno", None)
        place = f"{where}: line {line}" if line else where
        raise TableauError("invalid Python source", where=place, expected="a Python module") from None


def _header(text: str) -> Arrays:
    """Return the names and texts in the comments before the first statement, such as ``# name: heun``."""
    entries: Arrays = {}
    for line in text.split("\n"):
        if line.strip() and not line.startswith("#"):
            break
        if (match := _TEXT.fullmatch(line.rstrip("\r"))) and match[1] in TEXTS:
            entries.setdefault(match[1], unescaped(match[2]))
    return entries


def _assignments(statement: ast.stmt) -> Iterator[tuple[str, ast.expr]]:
    """Yield the variables of an assignment, each with the expression on the right-hand side."""
    if isinstance(statement, ast.Assign):
        for target in statement.targets:
            if isinstance(target, ast.Name):
                yield target.id, statement.value
            elif isinstance(target, ast.Tuple | ast.List) and isinstance(statement.value, ast.Tuple):
                for name, value in zip(target.elts, statement.value.elts, strict=False):
                    if isinstance(name, ast.Name):
                        yield name.id, value
    elif isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name) and statement.value:
        yield statement.target.id, statement.value


def _follow(statement: ast.stmt, values: Values) -> None:
    """Evaluate one statement at the top level of the module, and store the new values of its variables.

    If the right-hand side of an assignment cannot be evaluated, the variable becomes unknown. Loops are not
    evaluated: all variables in a loop become unknown.
    """
    if isinstance(statement, ast.Import) or (isinstance(statement, ast.Expr) and _is_harmless(statement)):
        return
    if isinstance(statement, ast.ImportFrom):
        _import(statement, values)
        return
    if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        changed = [n for node in ast.walk(statement) if isinstance(node, ast.Global) for n in node.names]
        values.forget(changed, statement.lineno)
        values.assign(statement.name, Computed("a function or class", statement.lineno))
        return
    if isinstance(statement, ast.If) and _is_script_part(statement):
        return
    assigned = list(_assignments(statement))
    if assigned and _targets_are_names(statement):
        pairs = [(name, values.value(expression)) for name, expression in assigned]
        for name, value in pairs:
            values.assign(name, value)
    elif not _entry_assigned(statement, values):
        mentioned = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
        values.forget(sorted(mentioned), statement.lineno)


def _import(statement: ast.ImportFrom, values: Values) -> None:
    """Record the names that an import such as ``from fractions import Fraction as F`` defines."""
    names = [alias.asname or alias.name for alias in statement.names]
    values.forget(list(values.known) if "*" in names else names, statement.lineno)
    root = (statement.module or "").partition(".")[0]
    for alias in statement.names:
        if root in MODULES:
            values.functions[alias.asname or alias.name] = alias.name
        elif alias.name != "*" and root != "__future__":
            unknown = Computed(f"a name imported from the module {statement.module}", statement.lineno)
            values.assign(alias.asname or alias.name, unknown)


def _is_harmless(statement: ast.Expr) -> bool:
    """Return True if a statement is a constant, such as a docstring, or a call of ``print``."""
    value = statement.value
    if isinstance(value, ast.Call):
        return isinstance(value.func, ast.Name) and value.func.id in HARMLESS
    return isinstance(value, ast.Constant)


def _is_script_part(statement: ast.If) -> bool:
    """Return True for statements like ``if __name__ == "__main__":``. Imports usually skip their bodies."""
    return any(isinstance(node, ast.Name) and node.id == "__name__" for node in ast.walk(statement.test))


def _targets_are_names(statement: ast.stmt) -> bool:
    """Return True if a statement assigns only to variables. Return False for ``A[0] = 1`` and ``x.y = 1``."""
    if isinstance(statement, ast.AnnAssign):
        return True
    return isinstance(statement, ast.Assign) and all(
        isinstance(node, ast.Name | ast.Tuple | ast.List | ast.expr_context)
        for target in statement.targets
        for node in ast.walk(target)
    )


def _entry_assigned(statement: ast.stmt, values: Values) -> bool:
    """Evaluate an assignment to one entry, such as ``A[1, 0] = 1/2``. Return True on success, and False
    otherwise."""
    if not isinstance(statement, ast.Assign) or len(statement.targets) != 1:
        return False
    place: list[int] = []
    target: ast.expr = statement.targets[0]
    while isinstance(target, ast.Subscript):
        index = target.slice
        indices = index.elts if isinstance(index, ast.Tuple) else [index]
        constants = [x.value for x in indices if isinstance(x, ast.Constant) and type(x.value) is int]
        if len(constants) != len(indices):
            return False
        place = [*constants, *place]
        target = target.value
    if not place or not isinstance(target, ast.Name):
        return False
    return values.assign_entry(target.id, place, values.value(statement.value))


def _add(entries: Arrays, values: Values, where: str) -> None:
    """Add to ``entries`` the arrays, texts and claims that the module assigns."""
    for name in ARRAYS:
        value = values.known.get(name)
        if isinstance(value, Array):
            if name in entries:
                raise TableauError(f"two arrays {name}", where=where, expected="one")
            cells = texts(value, f"{where}: {name}")
            entries[name] = _row(cells) if name in ROWS else cells
        elif isinstance(value, Computed) and name != "c":  # c may be unknown, because A determines c.
            raise TableauError(
                f"the value is not known without executing the file: {value.reason}",
                where=f"{where}: {name}: line {value.line}",
                expected="rows of numbers",
                hint=HINT,
            )
    for name in ("name", "family", "source", "base", "claims"):
        value = values.known.get(name)
        if isinstance(value, str):
            entries.setdefault(name, value)
        elif name == "claims" and value is not None:
            raise TableauError(
                "the claims are not known without executing the file",
                where=f"{where}: claims",
                expected='claims = "rk=4" or {"rk": 4}',
            )
    for name in ("order", "embedded_order"):
        value = values.known.get(name)
        if value is not None and not isinstance(value, Array | Computed | str):
            entries.setdefault(name, texts(value, where))


def _row(cells: Cells) -> Cells:
    """Convert a matrix with one row or one column to a list of numbers. Return other cells unchanged."""
    if isinstance(cells, list) and cells and isinstance(cells[0], list):
        if len(cells) == 1:
            return cells[0]
        if all(isinstance(cell, list) and len(cell) == 1 for cell in cells):
            return [cell[0] for cell in cells if isinstance(cell, list)]
    return cells
