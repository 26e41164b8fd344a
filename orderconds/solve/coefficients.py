"""Elimination of coefficients by linear constraints, and the text of each coefficient in a tableau file.

After the elimination, some coefficients are constants, some are free, and the others are functions of the
free coefficients. The text of a constant is a number, and the text of every other coefficient is its name. If
a coefficient is a function of the free coefficients, the file also contains the formula of this function.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from orderconds.errors import InputError
from orderconds.solve.linear import Constraint, Elimination, equality, spell
from orderconds.solve.spec import Spec

Nodes = Mapping[str, Sequence[str]]
"""Maps the name of a node (abscissa), for example c2, to the names of the coefficients whose sum is the
node."""

DIVIDES = "the formulas of the family divide by the weights"
"""A reason for :func:`require_nonzero`."""


def eliminated(
    names: Sequence[str], spec: Spec, constraints: Sequence[Constraint], nodes: Nodes | None = None
) -> Elimination:
    """Eliminate coefficients by the linear ``constraints`` and the constraints of the option ``--fix``.

    A constraint of ``--fix`` may contain names of nodes (for example c2). Raises InputError if a constraint
    of ``--fix`` contains an unknown name, if constraints contradict each other, or if a constant exceeds the
    bound of the option ``--size``.

    >>> from orderconds.solve.linear import Constraint, equality
    >>> from orderconds.solve.spec import Spec
    >>> elimination = eliminated(["b1", "b2"], Spec(2, fix=("b1=1/4",)), [equality("b1 + b2 = 1")])
    >>> Cells(elimination).written("b2")
    '3/4'
    """
    elimination = Elimination(tuple(names))
    fixed = [equality(text).expanded(nodes or {}) for text in spec.fix]
    for text, constraint in zip(spec.fix, fixed, strict=True):
        for name in constraint.form:
            if name and name not in names:
                raise InputError(
                    f"unknown coefficient {name!r} in {text!r}",
                    where="--fix",
                    expected=f"one of {', '.join([*names, *(nodes or {})])}",
                )
    elimination.impose([*constraints, *fixed])
    for name in names:
        form = elimination.cell(name)
        # Constant coefficients are checked here, because the search bounds only the other coefficients.
        if spec.size is not None and set(form) <= {""} and abs(form.get("", Fraction(0))) > spec.size:
            raise InputError(
                f"the constraints imply {name} = {spell(form)}",
                where="--size",
                expected=f"an absolute value of at most {spec.size}",
            )
    return elimination


def require_nonzero(elimination: Elimination, weights: Nodes, why: str) -> None:
    """Raise :class:`~orderconds.errors.InputError` if the constraints imply that a weight is zero.

    ``weights`` maps the name of a weight to the names of the coefficients whose sum is the weight. The
    message contains the reason ``why``.

    >>> from orderconds.solve.spec import Spec
    >>> require_nonzero(eliminated(["b1"], Spec(1), []), {"b1": ["b1"]}, "formulas divide by b1")
    """
    for weight, names in weights.items():
        total: dict[str, Fraction] = {}
        for name in names:
            for key, x in elimination.cell(name).items():
                total[key] = total.get(key, Fraction(0)) + x
        if not any(total.values()):
            raise InputError(
                f"the constraints imply {weight} = 0",
                where="constraints",
                expected=f"nonzero weights, because {why}",
            )


@dataclass(frozen=True)
class Cells:
    """The texts of coefficients in a tableau file. Each text is a number or a name. ``extra`` maps
    names to formulas."""

    elimination: Elimination
    extra: Mapping[str, str] | None = None

    def written(self, name: str) -> str:
        """Return the text of the coefficient ``name`` in a matrix of the tableau file: its value if it is a
        constant, otherwise ``name``."""
        form = self.elimination.cell(name)
        if self.extra and name in self.extra:
            return name
        return spell(form) if set(form) <= {""} else name

    def numbers(self, names: Sequence[str]) -> dict[str, str]:
        """Return a map from names to formulas. The map contains all formulas in ``extra``. If a coefficient
        in ``names`` depends on other coefficients, the map contains its formula, too."""
        texts = {}
        for name in names:
            form = self.elimination.cell(name)
            if name in self.elimination.solved and not set(form) <= {""}:
                texts[name] = spell(form)
        return {**texts, **(self.extra or {})}

    def unknown(self, names: Sequence[str]) -> tuple[str, ...]:
        """Return ``names`` without the names of constants."""
        return tuple(name for name in names if self.written(name) == name)


def row_text(cells: Cells, names: Sequence[str], full: bool = False) -> str:
    """Return the text of a row of coefficients. If ``full`` is false, zeros at the end of the row are
    omitted.

    >>> from orderconds.solve.linear import equality
    >>> cells = Cells(eliminated(["a", "b"], Spec(1), [equality("a = 1/2"), equality("b = 0")]))
    >>> row_text(cells, ["a", "b"]), row_text(cells, ["a", "b"], full=True)
    ('["1/2"]', '["1/2", "0"]')
    """
    texts = [cells.written(name) for name in names]
    while not full and texts and texts[-1] == "0":
        texts.pop()
    return "[" + ", ".join(f'"{x}"' for x in texts) + "]"
