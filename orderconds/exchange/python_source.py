"""Python modules that assign arrays: ``A = np.array([[0, 0], [1/2, 0]])``, ``b = [0, 1]``, ``order = 2``.

The file is parsed, not executed. An assignment may contain lists, tuples, numbers, arithmetic, square roots,
names from earlier assignments, and constructors of arrays and of exact numbers from NumPy, SymPy and
``fractions``. Arithmetic is exact: ``1/3`` is the fraction 1/3 and not a double. Some statements, such as
loops, are not evaluated. If they may change an array of the tableau, the file is refused.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from orderconds.errors import TableauError
from orderconds.exchange.arrays import MATRICES, ROWS, TEXTS, Arrays, from_arrays
from orderconds.exchange.claim_text import json_table
from orderconds.exchange.comments import unescaped
from orderconds.exchange.nested import Cells
from orderconds.exchange.python_values import (
    ARRAY_CALLS,
    LIBRARIES,
    NUMBER_CALLS,
    ROOTS,
    ROUNDED_CALLS,
    Array,
    Computed,
    Values,
    root_of,
    texts,
)
from orderconds.tableau.file_format import Data

ARRAYS = (*MATRICES, *ROWS)
COMPLETE = (("A", "b"), ("exponentials", "count", "start"), ("gamma",), ("alpha", "beta"))
"""A module contains a tableau if it assigns all arrays of one of these groups."""

HINT = "write the values as numbers, or execute the file with 'orderconds check --execute'"
SAFE_FUNCTIONS = ("print", "len", "sum", "abs", "min", "max", "range", "round", "repr", "str")
SAFE_METHODS = ("sum", "mean", "copy", "tolist", "transpose", "all", "any", "allclose", "isclose")
"""A call of a function in SAFE_FUNCTIONS or of a method in SAFE_METHODS changes no variable if the call has
at most two positional arguments. A third positional argument may be changed: ``numpy.all(a, 0, out)`` stores
its result in ``out``. A call of ``print`` changes no variable, even with many positional arguments."""
SAFE_KEYWORDS = ("axis", "dtype", "sep", "end", "precision", "dps")
UNSAFE_NAMES = {
    *("exec", "eval", "compile", "globals", "locals", "vars", "setattr", "delattr"),
    *("builtins", "__builtins__", "__import__", "__dict__", "importlib", "modules"),
}
"""After a statement that contains a name in UNSAFE_NAMES, the values of all variables count as unknown."""
Definition: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
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
    """Return True if no right-hand side of ``A = ...``, ``a = ...`` or ``b = ...`` contains a list or tuple.

    If Python cannot parse the source, the assignments are unknown, and the result is False.

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
    """Return the texts in the comments before the first statement, with their keys. In the comment
    ``# name: heun``, the key is ``name`` and the text is ``heun``."""
    entries: Arrays = {}
    for line in text.split("\n"):
        if line.strip() and not line.startswith("#"):
            break
        if (match := _TEXT.fullmatch(line.rstrip("\r"))) and match[1] in TEXTS:
            entries.setdefault(match[1], unescaped(match[2]))
    return entries


def _assignments(statement: ast.stmt) -> Iterator[tuple[str, ast.expr]]:
    """Yield the variables of an assignment, each with the expression on the right-hand side.

    Nothing is yielded for assignments such as ``A[0] = 1`` and ``a, b = x``.
    """
    pairs: list[tuple[ast.expr, ast.expr]] = []
    if isinstance(statement, ast.Assign):
        for target in statement.targets:
            if not isinstance(target, ast.Tuple | ast.List):
                pairs.append((target, statement.value))
            elif isinstance(statement.value, ast.Tuple) and len(target.elts) == len(statement.value.elts):
                pairs += zip(target.elts, statement.value.elts, strict=True)
            else:
                return
    elif isinstance(statement, ast.AnnAssign) and statement.value:
        pairs.append((statement.target, statement.value))
    if all(isinstance(target, ast.Name) for target, _ in pairs):
        yield from ((target.id, value) for target, value in pairs if isinstance(target, ast.Name))


def _follow(statement: ast.stmt, values: Values) -> None:
    """Evaluate one statement at the top level of the module, and store the new values of its variables.

    Loops and conditions are not evaluated: all variables that they may change become unknown.
    """
    if _unsafe_names(statement):
        _doubt([statement], values)
        values.forget([*values.known], statement.lineno)
    elif isinstance(statement, ast.Import):
        _import_modules(statement, values)
    elif isinstance(statement, ast.ImportFrom):
        _import(statement, values)
    elif isinstance(statement, Definition):
        _define(statement, values)
    elif isinstance(statement, ast.If) and _is_script_part(statement, values):
        _doubt([*statement.orelse], values)
    elif isinstance(statement, ast.Expr | ast.Assert | ast.Pass):
        if _may_change(statement, values):
            _doubt([statement], values)
    elif assigned := list(_assignments(statement)):
        _assign(assigned, values)
    elif not _entry_assigned(statement, values):
        _doubt([statement], values)


def _assign(assigned: Sequence[tuple[str, ast.expr]], values: Values) -> None:
    # As in Python, the right-hand side of ``A = B = [0]`` is evaluated only once. Otherwise A and B would be
    # two lists, and a change of A would not change B.
    evaluated = {id(expression): values.value(expression) for _, expression in assigned}
    for _, expression in assigned:
        if _may_change(expression, values):
            values.forget(_mentioned(expression), expression.lineno)
    for name, expression in assigned:
        values.assign(name, evaluated[id(expression)], _mentioned(expression))
        _activate([name], expression, values)


def _define(statement: Definition, values: Values) -> None:
    """Update ``values`` for ``statement``, the definition of a function or a class."""
    # Python executes the body of a class immediately, but not the bodies of its methods.
    parts: list[ast.AST] = []
    called: list[ast.expr] = []
    waiting: list[ast.stmt] = [statement]
    while waiting:
        match waiting.pop():
            case ast.ClassDef() as inner:
                called += inner.decorator_list
                parts += [*inner.bases, *inner.keywords]
                waiting += inner.body
            case ast.FunctionDef() | ast.AsyncFunctionDef() as inner:
                called += inner.decorator_list
                parts += [*inner.args.defaults, *filter(None, inner.args.kw_defaults)]
            case other:
                parts.append(other)
    if any(_may_change(part, values) for part in parts):
        values.forget(_mentioned(statement), statement.lineno)
    _doubt(parts, values, scoped=True)
    for decorator in called:
        values.forget(_mentioned(decorator), statement.lineno)
    changed = [n for node in ast.walk(statement) if isinstance(node, ast.Global) for n in node.names]
    values.forget(changed, statement.lineno)
    values.assign(statement.name, Computed("a function or class", statement.lineno), _mentioned(statement))
    values.active.add(statement.name)


def _activate(names: Iterable[str], node: ast.AST, values: Values) -> None:
    """Update ``values.active`` after the statement ``node`` has assigned values to the variables ``names``.

    A variable is active if its value may be a function or an instance of a class.
    """
    definitions = ast.Lambda | ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
    if _mentioned(node) & values.active or any(isinstance(x, definitions) for x in ast.walk(node)):
        values.active.update(names)
    else:
        values.active.difference_update(names)


def _doubt(nodes: Sequence[ast.AST], values: Values, scoped: bool = False) -> None:
    """Mark a variable as unknown if ``nodes`` may change its value.

    If ``scoped`` is true, assignments in ``nodes`` define variables of a class, not of the module.
    """
    for node in nodes:
        line = getattr(node, "lineno", 0)
        assigned, changed = _bound(node)
        doubtful = _mentioned(node) if _may_change(node, values) or (scoped and changed) else set()
        if any(isinstance(x, ast.alias) and x.name == "*" for x in ast.walk(node)):
            doubtful |= values.known.keys()
        for name in set() if scoped else assigned:
            values.assign(name, Computed("another statement may change the value", line), _mentioned(node))
        values.change(changed, _mentioned(node), line)
        values.forget(doubtful, line)
        _activate(changed | (set() if scoped else assigned), node, values)


def _mentioned(node: ast.AST) -> set[str]:
    """Return the names of all variables that occur in a part of the module."""
    return {x.id for x in ast.walk(node) if isinstance(x, ast.Name)}


def _bound(node: ast.AST) -> tuple[set[str], set[str]]:
    """Return the variables that a part of the module assigns, and the variables that it modifies in place.

    >>> [sorted(names) for names in _bound(ast.parse("for k in y: np.array = x[0] = 1"))]
    [['k'], ['np', 'x']]
    """
    assigned: set[str] = set()
    changed: set[str] = set()
    for x in ast.walk(node):
        match x:
            case ast.AugAssign():
                changed.add(root_of(x.target))
            case ast.Attribute(ctx=ast.Store() | ast.Del()) | ast.Subscript(ctx=ast.Store() | ast.Del()):
                changed.add(root_of(x))
            case ast.Name(ctx=ast.Store() | ast.Del()):
                assigned.add(x.id)
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                assigned.add(x.name)
            case ast.alias():
                assigned.add(x.asname or x.name.partition(".")[0])
            case ast.ExceptHandler() | ast.MatchAs() | ast.MatchStar():
                assigned.add(x.name or "")
            case ast.MatchMapping():
                assigned.add(x.rest or "")
            case ast.Global() | ast.Nonlocal():
                assigned.update(x.names)
    return assigned - {"", "*"}, changed - {""}


def _unsafe_names(node: ast.AST) -> set[str]:
    """Return the names from :data:`UNSAFE_NAMES` that occur in a part of the module."""
    attributes = {x.attr for x in ast.walk(node) if isinstance(x, ast.Attribute)}
    imported = {x.name.partition(".")[0] for x in ast.walk(node) if isinstance(x, ast.alias)}
    return (_mentioned(node) | attributes | imported) & UNSAFE_NAMES


def _may_change(node: ast.AST, values: Values) -> bool:
    """Return True if the evaluation of an expression may change a variable.

    >>> values = Values("", ())
    >>> [_may_change(ast.parse(x), values) for x in ("len(A) + A.sum(axis=1)", "A.pop()", "f(A)", "(A := 1)")]
    [False, True, True, True]
    """
    # The value of a variable x in ``values.active`` may be an instance of a class that overloads the operator
    # ``+``. Then even ``x + 1`` may change a variable.
    if _mentioned(node) & values.active:
        return True
    for x in ast.walk(node):
        if isinstance(x, ast.NamedExpr | ast.Await | ast.Yield | ast.YieldFrom):
            return True
        if isinstance(x, ast.Call) and not _is_safe(x, values):
            return True
    return False


def _is_safe(call: ast.Call, values: Values) -> bool:
    """Return True if a call changes none of its arguments."""
    if len(call.args) > 2 and not (isinstance(call.func, ast.Name) and call.func.id == "print"):
        return False
    if any(keyword.arg not in SAFE_KEYWORDS for keyword in call.keywords):
        return False
    if any(isinstance(x, ast.Lambda | ast.Starred) for x in call.args):
        return False
    constructors = (*ARRAY_CALLS, *NUMBER_CALLS, *ROUNDED_CALLS, *ROOTS, "zeros")
    if isinstance(call.func, ast.Name):
        name = call.func.id
        if name in values.known:
            return False
        return name in SAFE_FUNCTIONS or values.functions.get(name, name) in constructors
    if not isinstance(call.func, ast.Attribute):
        return False
    known = values.known.get(root_of(call.func))
    return call.func.attr in SAFE_METHODS or (known is None and call.func.attr in constructors)


def _import_modules(statement: ast.Import, values: Values) -> None:
    """Record the names that an import such as ``import numpy as np`` defines."""
    for alias in statement.names:
        root = alias.name.partition(".")[0]
        name = alias.asname or root
        values.forget([name], statement.lineno)
        if root in LIBRARIES:
            values.known.pop(name, None)
        else:
            values.assign(name, Computed(f"the module {alias.name}", statement.lineno))


def _import(statement: ast.ImportFrom, values: Values) -> None:
    """Record the names that an import such as ``from fractions import Fraction as F`` defines."""
    names = [alias.asname or alias.name for alias in statement.names]
    values.forget(list(values.known) if "*" in names else names, statement.lineno)
    root = (statement.module or "").partition(".")[0]
    for alias in statement.names:
        if root in LIBRARIES:
            values.functions[alias.asname or alias.name] = alias.name
        elif alias.name != "*" and root != "__future__":
            unknown = Computed(f"a name imported from the module {statement.module}", statement.lineno)
            values.assign(alias.asname or alias.name, unknown)


def _is_script_part(statement: ast.If, values: Values) -> bool:
    """Return True for ``if __name__ == "__main__":``. An import does not execute this block."""
    return "__name__" not in values.known and ast.unparse(statement.test) in (
        "__name__ == '__main__'",
        "'__main__' == __name__",
    )


def _entry_assigned(statement: ast.stmt, values: Values) -> bool:
    """Evaluate an assignment to one entry, such as ``A[1, 0] = 1/2``, and return True on success."""
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
    value = values.value(statement.value)
    if _may_change(statement.value, values):
        values.forget(_mentioned(statement.value), statement.lineno)
    return values.assign_entry(target.id, place, value, statement.lineno)


def _add(entries: Arrays, values: Values, where: str) -> None:
    """Add to ``entries`` the values that the module assigns: arrays, texts (such as ``name``) and claimed
    orders."""
    for name in ARRAYS:
        value = values.known.get(name)
        if isinstance(value, Array):
            if name in entries:
                raise TableauError(f"two arrays {name}", where=where, expected="one")
            cells = texts(value, f"{where}: {name}")
            entries[name] = _row(cells) if name in ROWS else cells
        elif isinstance(value, Computed) and name != "c":  # c is computed from A.
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
    """Convert a matrix with one row or one column to a list. Return other cells unchanged."""
    if isinstance(cells, list) and cells and isinstance(cells[0], list):
        if len(cells) == 1:
            return cells[0]
        if all(isinstance(cell, list) and len(cell) == 1 for cell in cells):
            return [cell[0] for cell in cells if isinstance(cell, list)]
    return cells
