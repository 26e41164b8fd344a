"""Writing a tableau as a file that reads back as the same tableau."""

from __future__ import annotations

import re
from collections.abc import Sequence

from orderconds.ring.protocol import Element
from orderconds.tableau.brackets import Combination, spell
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Embedded,
    EmbeddedUpdate,
    PartitionedRungeKutta,
    Row,
    Stage,
)
from orderconds.tableau.products import AdjointComposition, Magnus, Splitting
from orderconds.tableau.record import Claims, Tableau

WIDTH = 110
"""Matrices on longer lines are broken by rows."""


def dumps(tableau: Tableau) -> str:
    """Return the tableau as TOML text.

    Exact coefficients are written in full, balls with the digits they support (``~``, one unit in the last).

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["1/2"]]\\nb = ["1"]\\n'
    >>> dumps(Tableau.loads(text)) == text
    True
    """
    lines = [f"name = {_quoted(tableau.name)}", f'family = "{tableau.family}"']
    method = tableau.method
    if isinstance(method, Composition):
        lines += [f'base = "{method.base}"', f"gamma = {_full(method.gamma, tableau)}"]
    elif isinstance(method, AdjointComposition | Splitting | Magnus):
        lines += _product(method, tableau)
    elif not isinstance(method, CommutatorFree):
        lines += [_matrix("A", method.A, tableau), f"b = {_full(method.b, tableau)}"]
    if isinstance(method, PartitionedRungeKutta):
        lines += [_matrix("A_hat", method.A_hat, tableau), f"b_hat = {_full(method.b_hat, tableau)}"]
    if isinstance(tableau.embedded, Embedded):
        weights = _row(tableau.embedded.b, tableau)
        lines.append(f"embedded = {{ b = {weights}, order = {tableau.embedded.order} }}")
    lines += [f"{key} = {_quoted(x)}" for key in ("source", "bibtex") if (x := getattr(tableau, key))]
    lines = _named_radicals(lines, tableau)
    lines += _named_roots(tableau)
    if isinstance(method, CommutatorFree):
        for stage in method.stages:
            lines += ["[[stage]]", *_stage(stage, tableau)]
        lines += ["[update]", *_stage(method.update, tableau)]
    if isinstance(tableau.embedded, EmbeddedUpdate):
        lines += ["[embedded]", f"order = {tableau.embedded.order}"]
        lines += _stage(tableau.embedded.update, tableau)
    return "\n".join(lines + _claims(tableau.claims)) + "\n"


def _product(method: AdjointComposition | Splitting | Magnus, tableau: Tableau) -> list[str]:
    if isinstance(method, AdjointComposition):
        rows = [("alpha", method.alpha), ("beta", method.beta)]
        return [f'base = "{method.base}"', *(f"{key} = {_full(row, tableau)}" for key, row in rows)]
    if isinstance(method, Splitting):
        parts = ", ".join(map(_quoted, method.parts))
        steps = ", ".join(_full((x,), tableau, method.parts[part]) for part, x in method.steps)
        kinetic = [] if method.rkn is None else [f"rkn = {_quoted(method.parts[method.rkn])}"]
        return [f"parts = [{parts}]", *kinetic, f"step = [{steps}]"]
    lines = [f"c = {_full(method.c, tableau)}"]
    if method.transform != "exp":
        lines.append(f'map = "{method.transform}"')
    if method.elements:
        named = ", ".join(f"{name} = {_combination(x, tableau)}" for name, x in method.elements)
        lines.append(f"elements = {{ {named} }}")
    exponents = ", ".join(_combination(x, tableau) for x in method.exponents)
    return [*lines, f"exponents = [{exponents}]"]


def _combination(combination: Combination, tableau: Tableau) -> str:
    terms = (f"{_quoted(spell(term))} = {_quoted(tableau.ring.text(x))}" for term, x in combination)
    return f"{{ {', '.join(terms)} }}" if combination else "{}"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in escaped) + '"'


def _full(row: Sequence[Element], tableau: Tableau, *before: str) -> str:
    return "[" + ", ".join(map(_quoted, (*before, *map(tableau.ring.text, row)))) + "]"


def _row(row: Row, tableau: Tableau) -> str:
    """Spell a row without the zeros at its end, which the format supplies."""
    kept = list(row)
    while kept and tableau.ring.is_zero(kept[-1]) is True:
        kept.pop()
    return _full(kept, tableau)


def _matrix(key: str, A: Sequence[Row], tableau: Tableau) -> str:
    """Spell a matrix on one line, or one line a row where that is too long."""
    rows = [_row(row, tableau) for row in A]
    line = f"{key} = [{', '.join(rows)}]"
    if len(line) <= WIDTH:
        return line
    return "\n".join([f"{key} = [", *(f"  {row}," for row in rows), "]"])


def _named_radicals(lines: list[str], tableau: Tableau) -> list[str]:
    """Name square roots where some stand inside others: r1, r2, ... in place of their spellings."""
    generators = getattr(tableau.ring, "generators", ())
    if not any("sqrt" in g.spelling for g in generators) or any(g.index != 2 for g in generators):
        return lines
    names = {g.power(1): f"r{k + 1}" for k, g in enumerate(generators)}
    inside = list(names)

    def named(text: str, known: Sequence[str]) -> str:
        for spelling in reversed(known):
            text = text.replace(spelling, names[spelling])
        return text

    numbers = [
        f'{names[x]} = "sqrt({named(g.spelling, inside[:k])})"'
        for k, (x, g) in enumerate(zip(inside, generators, strict=True))
    ]
    return [*(named(line, inside) for line in lines), "[numbers]", *numbers]


def _stage(stage: Stage, tableau: Tableau) -> list[str]:
    lines = [] if stage.start is None else [f"from = {stage.start + 1}"]
    if stage.exponentials:
        lines.append(f"exp = [{', '.join(_row(row, tableau) for row in stage.exponentials)}]")
    return lines


def _named_roots(tableau: Tableau) -> list[str]:
    """Return the numbers that the field's spelling refers to by name."""
    lines = []
    for name, minpoly, near in getattr(tableau.ring, "named_roots", ()):
        coefficients = ", ".join(_quoted(c) for c in minpoly)
        lines += [f"[numbers.{name}]", f"minpoly = [{coefficients}]", f'near = "{near}"']
    return lines


def _claims(claims: Claims) -> list[str]:
    spelled: dict[str, str] = {}
    for claim in claims.orders:
        if claim.cutoff is None:
            spelled[claim.family] = str(claim.order)
        else:
            before = spelled[claim.family][1:-1] + ", " if claim.family in spelled else ""
            spelled[claim.family] = f"[{before}{{ cutoff = {claim.cutoff}, order = {claim.order} }}]"
    spelled |= {name: str(value).lower() for name, value in claims.properties.items()}
    bare = re.compile(r"[A-Za-z0-9_-]+")
    lines = [f"{k if bare.fullmatch(k) else _quoted(k)} = {value}" for k, value in spelled.items()]
    return ["[claims]", *lines] if lines else []
