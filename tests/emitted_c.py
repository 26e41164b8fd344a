"""Emitted C executed over Taylor series in h: the text is parsed, and its digits are used as printed.

pycparser reads the text and a small interpreter executes its subset of C. As in
:mod:`tests.emitted_python`, library functions are exact and a solver stops after a fixed number of sweeps.
"""

from __future__ import annotations

import math
import operator
import re
import struct
from collections.abc import Callable, Mapping, MutableSequence, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from pycparser import c_ast, c_parser

from tests.emitted_python import no_continuation
from tests.taylor_numbers import ELEMENTARY, Real, Taylor, is_finite, quotient, stumpff, sweeps

Value: TypeAlias = "Real | int | Pointer | Record | list[Value] | None"
Frame = dict[str, "Value"]

ARITHMETIC: dict[str, Callable[..., Value]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "%": operator.mod,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}


class _Break(Exception):
    pass


class _Return(Exception):
    def __init__(self, value: Value) -> None:
        super().__init__()
        self.value = value


@dataclass(eq=False)
class Record:
    """A struct."""

    fields: Frame


@dataclass
class Pointer:
    """An element of an array, a variable of a frame, or a field of a struct."""

    base: MutableSequence[Value] | Frame
    key: int | str

    def __add__(self, n: int) -> Pointer:
        assert isinstance(self.key, int)
        return Pointer(self.base, self.key + n)

    def get(self) -> Value:
        """Return what it points to."""
        return self.base[self.key]  # type: ignore[index]

    def put(self, value: Value) -> None:
        """Store a value."""
        self.base[self.key] = value  # type: ignore[index]


@dataclass
class Text:
    """A parsed module: functions, structs, and global names."""

    functions: dict[str, c_ast.FuncDef] = field(default_factory=dict)
    structs: dict[str, c_ast.Struct] = field(default_factory=dict)
    names: Frame = field(default_factory=dict)


def read(header: str, source: str) -> Text:
    """Parse a header and the source that includes it."""
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", header, flags=re.DOTALL) + source
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    text = re.sub(r"^#.*(\\\n.*)*$", "", text, flags=re.MULTILINE)
    found = Text()
    for item in c_parser.CParser().parse("typedef unsigned long size_t;" + text).ext:
        if isinstance(item, c_ast.FuncDef):
            found.functions[item.decl.name] = item
        elif isinstance(item, c_ast.Typedef) and item.name == "size_t":
            continue
        elif isinstance(item, c_ast.Typedef):
            found.structs[item.name] = item.type.type
        elif isinstance(item.type, c_ast.Struct):
            found.structs[item.type.name] = item.type
        elif isinstance(item.type, c_ast.Enum):
            for one in item.type.values.enumerators:
                found.names[one.name] = int(one.value.value)
        elif item.init is not None:
            found.names[item.name] = Machine(found).initial(item.type, item.init, found.names)
    return found


def step(header: str, source: str, values: Mapping[str, Sequence[Real] | Real]) -> list[Taylor]:
    """Return the state after one step; ``values`` has state, h and, if the step takes it, t."""
    text = read(header, source)
    (name,) = (n for n in text.functions if n.endswith("_step") and not n.endswith("_complete_step"))
    given = [p.name for p in text.functions[name].decl.type.args.params]
    state: list[Value] = list(values["state"])  # type: ignore[arg-type]
    arguments = [Pointer(state, 0) if n == "state" else values.get(n) for n in given]
    status = Machine(text).call(name, arguments)  # type: ignore[arg-type]
    assert status == 0, f"status {status}"
    return list(map(Taylor.of, state))  # type: ignore[arg-type]


class Machine:
    """The interpreter of one module."""

    def __init__(self, text: Text) -> None:
        self.text = text
        self.library: dict[str, Callable[..., Value]] = {
            "isfinite": lambda x: int(is_finite(x)),
            "quotient": quotient,
            "continued": no_continuation,
            "memcpy": _copy,
        }
        for name, function in {**ELEMENTARY, "fabs": abs}.items():
            self.library |= {name: function, f"{name}f": function}

    # --- declarations

    def initial(self, kind: c_ast.Node, init: c_ast.Node | None, frame: Frame) -> Value:
        """Return the value of a new variable."""
        if isinstance(kind, c_ast.ArrayDecl):
            size = self.value(kind.dim, frame)
            assert isinstance(size, int)
            given = init.exprs if isinstance(init, c_ast.InitList) else []
            return [self.initial(kind.type, given[i] if i < len(given) else None, frame) for i in range(size)]
        struct = self.struct_of(kind)
        if struct is not None and not isinstance(kind, c_ast.PtrDecl):
            return Record({d.name: self.initial(d.type, None, frame) for d in struct.decls})
        if init is None or isinstance(init, c_ast.InitList):
            return 0
        return self.value(init, frame)

    def struct_of(self, kind: c_ast.Node) -> c_ast.Struct | None:
        """Return the struct that a declared type is, or None."""
        if not isinstance(kind, c_ast.TypeDecl):
            return None
        name = kind.type.name if isinstance(kind.type, c_ast.Struct) else kind.type.names[-1]
        return self.text.structs.get(name)

    # --- statements

    def run(self, node: c_ast.Node | None, frame: Frame) -> None:
        """Execute a statement."""
        if node is not None:
            getattr(self, f"run_{type(node).__name__}", self.value)(node, frame)

    def run_Compound(self, node: c_ast.Compound, frame: Frame) -> None:
        for item in node.block_items or ():
            self.run(item, frame)

    def run_DeclList(self, node: c_ast.DeclList, frame: Frame) -> None:
        for item in node.decls:
            self.run(item, frame)

    def run_Decl(self, node: c_ast.Decl, frame: Frame) -> None:
        value = self.initial(node.type, node.init, frame)
        frame[node.name] = decision(node.name, value, frame)

    def run_If(self, node: c_ast.If, frame: Frame) -> None:
        self.run(node.iftrue if self.value(node.cond, frame) else node.iffalse, frame)

    def run_While(self, node: c_ast.While, frame: Frame) -> None:
        try:
            while self.value(node.cond, frame):
                self.run(node.stmt, frame)
        except _Break:
            pass

    def run_DoWhile(self, node: c_ast.DoWhile, frame: Frame) -> None:
        try:
            self.run(node.stmt, frame)
        except _Break:
            return
        self.run_While(node, frame)  # type: ignore[arg-type]

    def run_For(self, node: c_ast.For, frame: Frame) -> None:
        self.run(node.init, frame)
        while node.cond is None or self.value(node.cond, frame):
            try:
                self.run(node.stmt, frame)
            except _Break:
                return
            self.run(node.next, frame)

    def run_Return(self, node: c_ast.Return, frame: Frame) -> None:
        raise _Return(self.value(node.expr, frame) if node.expr is not None else None)

    def run_Break(self, node: c_ast.Break, frame: Frame) -> None:
        raise _Break

    # --- expressions

    def value(self, node: c_ast.Node, frame: Frame) -> Value:
        """Return the value of an expression."""
        found: Value = getattr(self, f"value_{type(node).__name__}")(node, frame)
        return found

    def value_Constant(self, node: c_ast.Constant, frame: Frame) -> Value:
        return literal(node.value)

    def value_ID(self, node: c_ast.ID, frame: Frame) -> Value:
        if node.name in ("NULL", "NAN"):
            return None if node.name == "NULL" else math.nan
        found = frame[node.name] if node.name in frame else self.text.names[node.name]
        return Pointer(found, 0) if isinstance(found, list) else found

    def value_ArrayRef(self, node: c_ast.ArrayRef, frame: Frame) -> Value:
        return self.loaded(node, frame)

    def value_StructRef(self, node: c_ast.StructRef, frame: Frame) -> Value:
        return self.loaded(node, frame)

    def loaded(self, node: c_ast.Node, frame: Frame) -> Value:
        """Return what is stored at a place; an array becomes a pointer to its first element."""
        found = self.place(node, frame).get()
        return Pointer(found, 0) if isinstance(found, list) else found

    def value_Cast(self, node: c_ast.Cast, frame: Frame) -> Value:
        return self.value(node.expr, frame)

    def value_TernaryOp(self, node: c_ast.TernaryOp, frame: Frame) -> Value:
        return self.value(node.iftrue if self.value(node.cond, frame) else node.iffalse, frame)

    def value_ExprList(self, node: c_ast.ExprList, frame: Frame) -> Value:
        return [self.value(x, frame) for x in node.exprs][-1]

    def value_BinaryOp(self, node: c_ast.BinaryOp, frame: Frame) -> Value:
        if node.op in ("&&", "||"):
            left = bool(self.value(node.left, frame))
            return int(bool(self.value(node.right, frame)) if left == (node.op == "&&") else left)
        a, b = self.value(node.left, frame), self.value(node.right, frame)
        if node.op == "/":
            return a // b if isinstance(a, int) and isinstance(b, int) else a / b  # type: ignore[operator]
        return ARITHMETIC[node.op](a, b)

    def value_UnaryOp(self, node: c_ast.UnaryOp, frame: Frame) -> Value:
        op = node.op
        if op == "sizeof":
            # Sizes are counted in elements, as _copy expects.
            held = frame.get(node.expr.name) if isinstance(node.expr, c_ast.ID) else None
            return len(held) if isinstance(held, list) else 1
        if op == "&":
            place = self.place(node.expr, frame)
            held = place.get()
            return held if isinstance(held, Record) else place
        if op in ("p++", "p--", "++", "--"):
            place = self.place(node.expr, frame)
            old = place.get()
            place.put(old + (1 if "+" in op else -1))  # type: ignore[operator]
            return old if op[0] == "p" else place.get()
        x = self.value(node.expr, frame)
        if op == "*":
            assert isinstance(x, Pointer)
            return x.get()
        return int(not x) if op == "!" else -x if op == "-" else x  # type: ignore[operator]

    def value_Assignment(self, node: c_ast.Assignment, frame: Frame) -> Value:
        value = self.value(node.rvalue, frame)
        place = self.place(node.lvalue, frame)
        if node.op != "=":
            value = ARITHMETIC[node.op[0]](place.get(), value)
        if isinstance(node.lvalue, c_ast.ID):
            value = decision(node.lvalue.name, value, frame)
        place.put(value)
        return value

    def place(self, node: c_ast.Node, frame: Frame) -> Pointer:
        """Return the place of an lvalue."""
        if isinstance(node, c_ast.ID):
            return Pointer(frame if node.name in frame else self.text.names, node.name)
        if isinstance(node, c_ast.ArrayRef):
            base, index = self.value(node.name, frame), self.value(node.subscript, frame)
            assert isinstance(index, int)
            if isinstance(base, Record):  # the first element of an array of structs
                return Pointer([base], index)
            assert isinstance(base, Pointer)
            return base + index
        if isinstance(node, c_ast.StructRef):
            record = self.value(node.name, frame)
            record = record.get() if isinstance(record, Pointer) else record
            assert isinstance(record, Record)
            return Pointer(record.fields, node.field.name)
        assert isinstance(node, c_ast.UnaryOp)
        found = self.value(node.expr, frame)
        assert isinstance(found, Pointer)
        return found

    def value_FuncCall(self, node: c_ast.FuncCall, frame: Frame) -> Value:
        return self.call(
            node.name.name, [self.value(x, frame) for x in (node.args.exprs if node.args else ())]
        )

    def call(self, name: str, arguments: Sequence[Value]) -> Value:
        """Return the result of a function."""
        if (match := re.fullmatch(r"(?:\w+_)?stumpff_(\d+)", name.removesuffix("f"))) is not None:
            return _stumpff(match[1], *arguments)
        if name in self.library:
            return self.library[name](*arguments)
        definition = self.text.functions[name]
        frame: Frame = dict(zip((p.name for p in definition.decl.type.args.params), arguments, strict=True))
        try:
            self.run(definition.body, frame)
        except _Return as result:
            return result.value
        return None


def literal(text: str) -> Real:
    """Return the number that a compiler reads: a double, or a float if the literal ends in f."""
    if re.fullmatch(r"\d+[uUlL]*", text):
        return int(text.rstrip("uUlL"))
    if text.endswith("f"):
        (single,) = struct.unpack("f", struct.pack("f", float(text[:-1])))
        return float(single)
    return float(text)


def decision(name: str, value: Value, frame: Frame) -> Value:
    """Return the flags by which a solver stops as in :data:`tests.emitted_python.DECISIONS`."""
    if name == "astray":
        return 0
    return int(frame["sweep"] >= sweeps()) if name == "converged" else value  # type: ignore[operator]


def _copy(target: Pointer, source: Pointer, size: int) -> None:
    for i in range(size):
        (target + i).put((source + i).get())


def _stumpff(kinds: str, z: Real, *places: Pointer) -> Value:
    found = [stumpff(int(k), z) for k in kinds]
    for place, x in zip(places, found, strict=False):
        place.put(x)
    return None if places else found[0]
