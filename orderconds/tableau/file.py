"""Reading of tableau files. A tableau file is a TOML file with fixed keys. An unknown key is an error."""

from __future__ import annotations

import re
import tomllib
from codecs import BOM_UTF8
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import msgspec
from msgspec import Struct

from orderconds.errors import InputError, TableauError
from orderconds.input_file import read_bytes
from orderconds.ring.protocol import Ring
from orderconds.tableau.claims import Claims, OrderClaim
from orderconds.tableau.evaluate import Definition, NamedRoot, evaluate, rounded_and_exact
from orderconds.tableau.extension import Extension
from orderconds.tableau.file_format import Claim, CutoffClaim, Data, Format, Number, ProofEntry, RootEntry
from orderconds.tableau.formats import (
    FORMATS,
    CommutatorFreeFile,
    EmbeddedEntry,
    EmbeddedProduct,
    ExtensionEntry,
    LowStorage,
    StageEntry,
)
from orderconds.tableau.grammar import Chain, Constant, Expression, parse
from orderconds.tableau.method_properties import PROPERTIES
from orderconds.tableau.methods import LowerOrder
from orderconds.tableau.products import Method
from orderconds.tableau.toml_reader import parse_toml
from orderconds.tableau.unknowns import Proof, SymbolicCoefficients

MAX_NAME = 64
KEYS = frozenset(("family", "A", "b", "stage", "update", "low_storage", "gamma", "alpha", "exponents"))
"""A TOML file that contains one of these keys is treated as a tableau file."""
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff]")
"""Characters that ``source`` and ``bibtex`` must not contain: control characters except tab and newline,
Unicode separators of lines and paragraphs, and characters that change the direction of writing."""
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.+-]*")
_NUMBER = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_NESTED: dict[str | tuple[type[Struct], str], type[Struct]] = {
    "embedded": EmbeddedEntry,
    "dense": ExtensionEntry,
    (CommutatorFreeFile, "embedded"): EmbeddedProduct,
    "stage": StageEntry,
    "update": StageEntry,
    "low_storage": LowStorage,
    "proof": ProofEntry,
}


class File(Struct, frozen=True):
    """The content of a tableau file. ``data`` contains the keys and values of the file. ``entry`` is
    ``data``, converted to a :class:`Format` object. All other attributes are computed from ``entry``."""

    data: Mapping[str, object]
    entry: Format
    ring: Ring
    method: Method
    embedded: LowerOrder | None
    claims: Claims
    symbolic: SymbolicCoefficients
    proof: Proof | None
    doubles: bool = False
    """True if a coefficient was given as a binary floating-point number."""
    extension: Extension | None = None


def text_of(path: str | Path) -> str:
    """Return the text of a tableau file. Raises TableauError if the file cannot be read, is too large or
    is not encoded in UTF-8.

    >>> from orderconds.tableau import find
    >>> text_of(find("kutta3")).splitlines()[0]
    'name = "kutta3"'
    """
    try:
        return bytes_of(path).decode("utf-8")
    except UnicodeDecodeError:
        raise TableauError(
            "bytes that are not UTF-8", where=str(path), expected="a tableau file (TOML)"
        ) from None


def bytes_of(path: str | Path) -> bytes:
    """Return the content of a tableau file, without a byte order mark. Raises TableauError if the file is too
    large, is not a regular file or cannot be read.

    >>> from orderconds.tableau import find
    >>> bytes_of(find("kutta3"))[:4]
    b'name'
    """
    content = read_bytes(path, "a tableau file", error=TableauError)
    # Some editors write a byte order mark at the start of a file.
    return content.removeprefix(BOM_UTF8)


def meant_as_tableau(path: str | Path) -> bool:
    """Return True if a TOML file contains one of :data:`KEYS`, the keys of tableau files. The result is also
    True if the file cannot be read or is not valid TOML.

    >>> from orderconds.tableau.library import root
    >>> meant_as_tableau(root().parent / "pyproject.toml"), meant_as_tableau(root() / "rk" / "rk4.toml")
    (False, True)
    """
    try:
        return not KEYS.isdisjoint(parse_toml(text_of(path)))
    except (InputError, ValueError, RecursionError):
        return True


def parsed(text: str, where: str) -> Data:
    """Return the keys and values of TOML text. Error messages contain ``where`` as the name of the text.

    >>> parsed('A = [[]]', "text")
    {'A': [[]]}
    """
    try:
        return parse_toml(text)
    except tomllib.TOMLDecodeError as problem:
        raise TableauError(
            str(problem), where=where, expected="valid TOML, in which each key occurs once"
        ) from None
    except RecursionError:
        raise TableauError(
            "TOML nested too deep", where=where, expected="tables and lists with few levels"
        ) from None
    # Python raises ValueError for an integer with thousands of digits and for a date outside the calendar.
    except ValueError as problem:
        raise TableauError(
            f"a number or a date that cannot be read: {str(problem).partition(';')[0]}",
            where=where,
            expected='numbers in quotation marks, such as "1/2"',
        ) from None


def read(data: Mapping[str, object], where: str) -> File:
    """Return the content of a tableau file, including the method. ``data`` contains the keys and values of
    the file, parsed from TOML or JSON.

    >>> read({"name": "euler", "family": "rk", "A": [[]], "b": ["1"]}, "data").method
    RungeKutta(A=((0,),), b=(1,))
    """
    entry = _converted(data, where)
    _verify_names(entry, where)
    entry.verify(where)
    expressions = {place: _parsed(x, f"{where}: {place}") for place, x in entry.coefficients()}
    numbers = _numbers(entry, where)
    ring, values = evaluate(expressions, numbers, where)
    try:
        method, embedded = entry.build(values, ring)
    except TableauError as problem:
        problem.where = problem.where.replace(entry.name, where, 1)
        raise
    source = SymbolicCoefficients(expressions, numbers, where, entry.build)
    claims, proof = _claims(entry, where), _proof(entry, source)
    constants = (c for x in (*expressions.values(), *numbers.values()) for c in rounded_and_exact(x))
    doubles = any(c.is_double for c in constants)
    extension = entry.extension(values, ring)
    return File(data, entry, ring, method, embedded, claims, source, proof, doubles, extension)


def _converted(data: Mapping[str, object], where: str) -> Format:
    """Convert the keys and values of a file to an object. Raises TableauError if the family is unknown, or if
    a key or a type does not fit the family."""
    family = data.get("family")
    if not isinstance(family, str) or family not in FORMATS:
        given = "no family" if family is None else f"family = {family!r}"
        raise TableauError(given, where=f"{where}: family", expected=f"one of {', '.join(FORMATS)}")
    kind = FORMATS[family]
    try:
        return msgspec.convert(data, kind)
    except msgspec.ValidationError as problem:
        raise _explained(str(problem), kind, "", where) from None


def _each(
    table: Mapping[str, object], kind: Any, struct: type[Struct], key: str, where: str
) -> dict[str, Any]:
    """Convert the entries of a table one by one, so that an error message contains the name of the entry."""
    result = {}
    for name, value in table.items():
        try:
            result[name] = msgspec.convert(value, kind)
        except msgspec.ValidationError as problem:
            raise _explained(str(problem), struct, f"{key}.{name}", where) from None
    return result


def _explained(message: str, kind: type[Struct], prefix: str, where: str) -> TableauError:
    """Convert an error message of the library msgspec to an error that contains the position in the file."""
    summary, _, path = message.partition(" - at `$")
    key = re.sub(r"\[(\d+)\]", lambda m: f"[{int(m[1]) + 1}]", path.rstrip("`"))
    key = (prefix + key).removeprefix(".")
    place = f"{where}: {key}" if key else where
    if unknown := re.fullmatch(r"Object contains unknown field `(.*)`", summary, re.DOTALL):
        inner = re.split(r"[.\[]", key)[0]
        struct = _NESTED.get((kind, inner), _NESTED.get(inner, kind))
        keys = ", ".join(sorted(struct.__struct_encode_fields__))
        return TableauError(f"unknown key {unknown[1]!r}", where=place, expected=f"one of {keys}")
    if missing := re.fullmatch(r"Object missing required field `(.*)`", summary, re.DOTALL):
        return TableauError(f"no {missing[1]}", where=place, expected=f"the key {missing[1]}")
    if wrong := re.fullmatch(r"Expected `(.*)`, got `(.*)`", summary, re.DOTALL):
        hint = ""
        if wrong[2] == "float" and "str" in wrong[1]:
            hint = 'write it in quotation marks: "0.5" is exactly 1/2, "0.81772~" is a rounded decimal'
        problem = f"a value of type {wrong[2]}"
        if wrong[2] == "numpy.ndarray":
            problem = "NumPy arrays are not accepted here"
            hint = "build the tableau with Tableau.rk(A, b), which accepts arrays"
        return TableauError(problem, where=place, expected=wrong[1], hint=hint)
    return TableauError(summary[:1].lower() + summary[1:], where=place)


def verify_name(name: str, where: str) -> None:
    """Raise :class:`TableauError` if ``name`` cannot be the name of a tableau.

    >>> verify_name("two words", "--name")
    Traceback (most recent call last):
        ...
    orderconds.errors.TableauError: --name: name = 'two words'; expected letters, digits, _ . + -
    """
    if len(name) > MAX_NAME:
        raise TableauError(
            f"a name of {len(name)} characters, {name[:20]!r} ...",
            where=where,
            expected=f"at most {MAX_NAME} characters",
        )
    if not _NAME.fullmatch(name):
        raise TableauError(f"name = {name!r}", where=where, expected="letters, digits, _ . + -")


def _verify_names(entry: Format, where: str) -> None:
    inside = (name for key in ("parts", "elements") for name in getattr(entry, key, ()))
    for name in (entry.name, entry.bibtex, *entry.numbers, *entry.claims, *inside):
        if len(name) > MAX_NAME:
            raise TableauError(
                f"a name of {len(name)} characters, {name[:20]!r} ...",
                where=where,
                expected=f"at most {MAX_NAME} characters",
            )
    for key in ("source", "bibtex"):
        if character := _CONTROL.search(getattr(entry, key)):
            raise TableauError(
                f"the control character U+{ord(character[0]):04X}",
                where=f"{where}: {key}",
                expected="text without control characters",
            )
    verify_name(entry.name, f"{where}: name")
    for name in entry.numbers:
        if not _NUMBER.fullmatch(name) or name == "sqrt":
            raise TableauError(
                f"the name {name!r}",
                where=f"{where}: numbers",
                expected="a name of letters, digits and _ that begins with a letter or _; the name sqrt is "
                "reserved for square roots",
            )


def _parsed(x: str | int, where: str) -> Expression:
    return parse(x, where) if isinstance(x, str) else Constant(Fraction(x))


def _numbers(entry: Format, where: str) -> dict[str, Definition]:
    result: dict[str, Definition] = {}
    for name, definition in _each(entry.numbers, Number, RootEntry, "numbers", where).items():
        place = f"{where}: numbers.{name}"
        if isinstance(definition, RootEntry):
            minpoly = tuple(_rational(x, f"{place}.minpoly") for x in definition.minpoly)
            if not 2 <= len(minpoly) <= 25:
                raise TableauError(
                    f"{len(minpoly)} coefficients", where=f"{place}.minpoly", expected="a degree from 1 to 24"
                )
            result[name] = NamedRoot(minpoly, _decimal(definition.near, f"{place}.near"))
        else:
            result[name] = _parsed(definition, place)
    return result


def _rational(x: str | int, where: str) -> Fraction:
    """Return the number ``x``, such as 2 or "-1/2", as a fraction. Raises TableauError if x is not an exact
    rational number."""
    try:
        return _fraction(_parsed(x, where))
    except (TypeError, ZeroDivisionError):
        raise TableauError(f"the coefficient {x!r}", where=where, expected="a rational number") from None


def _fraction(x: Expression) -> Fraction:
    if isinstance(x, Constant) and not x.unit:
        return x.value
    if isinstance(x, Chain) and x.operators in (("-",), ("/",)):
        left, right = (_fraction(operand) for operand in x.operands)
        return left - right if x.operators == ("-",) else left / right
    raise TypeError("not a rational number")


def _decimal(text: str, where: str) -> Constant:
    """Return the decimal ``text`` as a constant. The uncertainty of the constant is one unit of the last
    digit."""
    match = re.fullmatch(r"([+-]?\d{1,200})(?:\.(\d{0,200}))?~?", text, re.ASCII)
    if match is None:
        raise TableauError(f"near = {text!r}", where=where, expected='a decimal such as "1.2599"')
    places = match[2] or ""
    return Constant(Fraction(f"{match[1]}.{places}0"), Fraction(1, 10 ** len(places)))


def _proof(entry: Format, symbolic: SymbolicCoefficients) -> Proof | None:
    """Return the content of the table ``[proof]``, or None if the file has no such table. Raises TableauError
    if the table contradicts itself or the other keys of the file."""
    given = entry.proof
    if given is None:
        return None
    place = f"{symbolic.where}: proof"
    decimals = {u.name: u for u in symbolic.decimals()}
    if not decimals:
        raise TableauError(
            "a table [proof] in a file without rounded decimals",
            where=place,
            expected='decimals with "~"',
        )
    for name in given.pins:
        if name not in decimals:
            raise TableauError(
                f"the unknown name {name!r}", where=f"{place}.pins", expected=f"one of {', '.join(decimals)}"
            )
    if given.reduction == "simplifying" and not given.assumptions:
        raise TableauError(
            'reduction = "simplifying" without assumptions',
            where=place,
            expected="assumptions and their orders, such as assumptions = { B = 6, C = 3, D = 2 }",
        )
    if given.reduction != "simplifying" and given.assumptions:
        raise TableauError(
            f"assumptions with reduction = {given.reduction!r}",
            where=place,
            expected='reduction = "simplifying", or no assumptions',
        )
    known = {*entry.numbers, *symbolic.expressions}
    for name in given.printed:
        if name not in known:
            raise TableauError(
                f"the unknown key {name!r}",
                where=f"{place}.printed",
                expected="the name of a number in this file, such as a21",
            )
    return Proof(
        conditions=given.conditions,
        order=given.order,
        reduction=given.reduction,
        assumptions={str(key): n for key, n in given.assumptions.items()},
        printed={name: _rational(x, f"{place}.printed.{name}") for name, x in given.printed.items()},
        unknowns=tuple(u for u in decimals.values() if u.name not in given.pins),
        pinned=tuple(u for u in decimals.values() if u.name in given.pins),
        symbolic=symbolic,
    )


def _claims(entry: Format, where: str) -> Claims:
    orders = [] if entry.order is None else [OrderClaim(entry.family, None, entry.order)]
    properties: dict[str, bool] = {}
    for key, value in _each(entry.claims, Claim, CutoffClaim, "claims", where).items():
        if isinstance(value, bool):
            if key not in PROPERTIES:
                raise TableauError(
                    f"unknown property {key!r}",
                    where=f"{where}: claims",
                    expected=f"one of {', '.join(PROPERTIES)}, or an order, such as rk = 4",
                )
            properties[key] = value
        elif isinstance(value, int):
            orders.append(OrderClaim(key, None, value))
        else:
            orders += [OrderClaim(key, row.cutoff, row.order) for row in value]
    _refuse_repeats(orders, where)
    return Claims(tuple(orders), properties)


def _refuse_repeats(orders: list[OrderClaim], where: str) -> None:
    labels = [claim.label for claim in orders]
    for label in labels:
        if labels.count(label) > 1:
            raise TableauError(f"two claims for {label}", where=f"{where}: claims", expected="at most one")
