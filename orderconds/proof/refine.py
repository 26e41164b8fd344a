"""Newton's method in high precision, starting from the digits in a tableau file.

If there are more unknowns than equations, Newton's method changes only some of the unknowns. Gaussian
elimination with complete pivoting, applied to the Jacobian matrix, selects these unknowns.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import cast

from flint import arb, arb_mat, fmpq

from orderconds.proof.equations import equations, independent
from orderconds.proof.krawczyk import NotProved, jets
from orderconds.ring import QQ
from orderconds.ring.decimals import endpoints
from orderconds.ring.jets import Jets
from orderconds.ring.precision import precision
from orderconds.tableau import Tableau
from orderconds.tableau.unknowns import Proof, RootedRing

MAX_STEPS = 60
TOLERANCE = fmpq(1, 100)
"""Newton's method is stopped with an error if an unknown differs from its decimal in the tableau file by
``TOLERANCE`` or more."""


@dataclass(frozen=True)
class Refined:
    """The result of :func:`refine`.

    - ``decimals``: a map from the names of the changed decimals to their new digits.
    - ``pinned``: the names of the decimals that did not change.
    - ``text``: the text of the new tableau file.
    """

    decimals: dict[str, str]
    pinned: tuple[str, ...]
    text: str


def refine(text: str, where: str = "<text>", digits: int = 60) -> Refined:
    """Compute the unknowns of the ``[proof]`` table of a tableau file to ``digits`` decimal places.

    If the equations do not determine all unknowns, some unknowns keep the digits that they have in ``text``.
    The list ``pins`` of the resulting file contains the names of these unknowns. The table
    ``[proof.printed]`` contains the original digits of the other unknowns.

    Raises :class:`~orderconds.proof.krawczyk.NotProved` if Newton's method finds no solution near the digits
    in ``text``.

    >>> from orderconds.tableau import find
    >>> from orderconds.tableau.file import text_of
    >>> refinement = refine(text_of(find("cg4a")), digits=30)
    >>> {len(decimal.partition(".")[2]) for decimal in refinement.decimals.values()}
    {30}
    """
    tableau = Tableau.loads(text, where)
    if tableau.proof is None:
        raise NotProved("the file specifies no equations; add a table [proof]")
    proof = tableau.proof
    with precision(64 + 4 * digits):
        start = [arb(_rational(u.constant.value)) for u in proof.unknowns]
        ring = Jets(len(start))
        at = [ring.variable(i, x) for i, x in enumerate(start)]
        system = equations(tableau)
        # ``wide`` represents a box: each unknown varies by at most 1e-6.
        wide = [ring.variable(i, x + arb(0, 1e-6)) for i, x in enumerate(start)]
        kept = independent(system, system(wide, ring))
        values = system(at, ring)
        free = determined([[values[i].gradient[j] for j in range(len(start))] for i in kept])
        solved = _newton(tableau, kept, free, start, digits)
    decimals = {proof.unknowns[j].name: x for j, x in zip(free, solved, strict=True)}
    pinned = (
        *(u.name for u in proof.pinned),
        *(u.name for j, u in enumerate(proof.unknowns) if j not in free),
    )
    return Refined(decimals, pinned, _rewritten(text, proof, decimals, pinned))


def determined(jacobian: Sequence[Sequence[arb]]) -> list[int]:
    """Select one unknown for each equation. Return the indices of the selected unknowns in ascending order.

    Each row of ``jacobian`` contains the derivatives of one equation. Each row is divided by its largest
    entry. Then Gaussian elimination with complete pivoting selects the unknowns. Raises
    :class:`~orderconds.proof.krawczyk.NotProved` if a pivot is smaller than 1e-8.

    >>> determined([[arb(0), arb(2), arb(1)]])
    [1]
    """
    rows = [[x.mid() for x in row] for row in jacobian]
    units = [max(row, key=lambda x: float(abs(x))) for row in rows]
    rows = [[x / unit if unit else x for x in row] for row, unit in zip(rows, units, strict=True)]
    chosen: list[int] = []
    while rows:
        entries = (
            (float(abs(x)), i, j) for i, row in enumerate(rows) for j, x in enumerate(row) if j not in chosen
        )
        size, i, j = max(entries, default=(0.0, 0, 0))
        if size < 1e-8:
            raise NotProved(
                f"only {len(jacobian) - len(rows)} of the {len(jacobian)} conditions are independent near "
                "the decimals in the file, so Newton's method cannot be used; to check the file exactly, "
                'write the coefficients in closed form, such as "1/4 - sqrt(3)/6"'
            )
        pivot = rows.pop(i)
        chosen.append(j)
        rows = [[x - row[j] / pivot[j] * y for x, y in zip(row, pivot, strict=True)] for row in rows]
    return sorted(chosen)


def _newton(
    tableau: Tableau, kept: Sequence[int], free: Sequence[int], start: Sequence[arb], digits: int
) -> list[str]:
    system = equations(tableau)
    point = list(start)
    for _ in range(MAX_STEPS):
        values = jets(system, point)
        jacobian = arb_mat(len(kept), len(free), [values[i].gradient[j] for i in kept for j in free]).mid()
        try:
            step = jacobian.solve(arb_mat(len(kept), 1, [values[i].value.mid() for i in kept]))
        except ZeroDivisionError:
            raise NotProved("Newton's method failed: the Jacobian is singular") from None
        for place, j in enumerate(free):
            point[j] = (point[j] - step[place, 0]).mid()
            if not abs(point[j] - start[j]) < arb(TOLERANCE):
                raise NotProved("Newton's method failed: a value moved too far from the decimal in the file")
        if all(abs(step[place, 0]).upper() < arb(10) ** -(digits + 5) for place in range(len(free))):
            return [decimal_places(point[j], digits) for j in free]
    raise NotProved("Newton's method, started at the decimals, does not converge")


def decimal_places(x: arb, digits: int) -> str:
    """Return a positive number in decimal notation, with ``digits`` digits after the decimal point.

    >>> decimal_places(arb(2.5), 3)
    '2.500'
    """
    low, high = endpoints(x)
    figures = str(int(((low + high) / 2 * fmpq(10) ** digits).round())).rjust(digits + 1, "0")
    return f"{figures[:-digits]}.{figures[-digits:]}"


def _rational(x: Fraction) -> fmpq:
    return fmpq(*x.as_integer_ratio())


def _rewritten(text: str, proof: Proof, decimals: dict[str, str], pinned: Sequence[str]) -> str:
    """Return the text of the tableau file with the new digits ``decimals``. The key ``pins`` in the table
    ``[proof]`` gets the value ``pinned``. The table ``[proof.printed]`` contains the original digits."""
    record = dict[str, str]()
    for unknown in proof.unknowns:
        if unknown.name not in decimals:
            continue
        value, unit = unknown.constant.value, unknown.constant.unit
        places = len(str(unit.denominator)) - 1
        old = re.compile(rf"(?<![\d.])0*{_figures(value, places)}~")
        text, count = old.subn(decimals[unknown.name] + "~", text)
        if count == 0:
            raise NotProved(f"cannot find the digits of {unknown.name} in the text of the file")
        record[unknown.name] = _printed(proof, unknown.name)
    kept = {name: _decimal_text(value) for name, value in proof.printed.items()} or record
    lines, skipping = list[str](), False
    for line in text.splitlines():
        if line.lstrip().startswith("["):
            skipping = _header(line) == "proof.printed"
        if not skipping and not re.match(r"(pins|printed)\s*=", line):
            lines.append(line)
    at = next((i for i, line in enumerate(lines) if _header(line) == "proof"), None)
    if at is None:
        raise NotProved('the key "proof" is an inline table; write it as a table under the line "[proof]"')
    end = next((i for i in range(at + 1, len(lines)) if _header(lines[i])), len(lines))
    while not lines[end - 1].strip():
        end -= 1
    added = [f"pins = [{', '.join(_quoted(name) for name in pinned)}]"] if pinned else []
    added += ["", "[proof.printed]", *(f"{_key(name)} = {_quoted(x)}" for name, x in kept.items())]
    return "\n".join([*lines[:end], *added, *lines[end:]]) + "\n"


def _header(line: str) -> str:
    """Return the name of the table in a TOML header line, or an empty text for other lines.

    >>> _header("[ proof . printed ]  # as the source has them"), _header('pins = ["a"]')
    ('proof.printed', '')
    """
    header = re.match(r"\s*\[\[?([^\[\]#]*)\]", line)
    if header is None:
        return ""
    return ".".join(part.strip().strip("\"'") for part in header[1].split("."))


def _figures(value: Fraction, places: int) -> str:
    scaled = int(value * 10**places)
    figures = str(scaled).rjust(places + 1, "0")
    whole = figures[: len(figures) - places].lstrip("0")
    part = figures[len(figures) - places :]
    return (whole or "0?") + (rf"\.{part}" if places else r"\.?")


def _printed(proof: Proof, name: str) -> str:
    at = replace(proof, pinned=(*proof.pinned, *proof.unknowns), unknowns=())
    # QQ cannot compute roots, but no root is needed here.
    value = at.number(name, cast("RootedRing", QQ), {})
    return _decimal_text(Fraction(int(value.p), int(value.q)))


def _decimal_text(x: Fraction) -> str:
    """Return a rational number as a decimal if the expansion is finite, else as a fraction.

    >>> _decimal_text(Fraction(-1, 8)), _decimal_text(Fraction(1, 3))
    ('-0.125', '1/3')
    """
    places = next((n for n in range(60) if 10**n % x.denominator == 0), None)
    if not places:
        return str(x)
    figures = str(abs(x.numerator) * 10**places // x.denominator).rjust(places + 1, "0")
    return f"{'-' if x < 0 else ''}{figures[:-places]}.{figures[-places:]}"


def _quoted(x: str) -> str:
    return f'"{x}"'


def _key(x: str) -> str:
    return x if re.fullmatch(r"[A-Za-z0-9_-]+", x) else _quoted(x)
