"""Linear constraints on the coefficients of a tableau, and their exact elimination. After the elimination,
each coefficient is either free or an affine function of free coefficients."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from orderconds.errors import InputError, TableauError
from orderconds.tableau.grammar import Chain, Constant, Expression, Name, parse

Affine = Mapping[str, Fraction]
"""An affine function, as a map from variable name to factor. The key of the constant term is the empty
string."""


@dataclass(frozen=True)
class Constraint:
    """The equation ``form`` = 0. ``text`` is the reason for the constraint, for example ``"--fix b1=1/2"``.
    Error messages quote ``text``."""

    text: str
    form: Affine

    def expanded(self, sums: Mapping[str, Sequence[str]]) -> Constraint:
        """Return a copy in which some variables are replaced by sums. ``sums`` maps the name of a replaced
        variable to the names of its summands."""
        form: dict[str, Fraction] = {}
        for name, factor in self.form.items():
            for summand in sums.get(name, (name,)):
                form[summand] = form.get(summand, Fraction(0)) + factor
        return replace(self, form={name: factor for name, factor in form.items() if factor})


@dataclass
class Elimination:
    """Gaussian elimination for the coefficients ``names``. Each constraint expresses one coefficient in terms
    of other coefficients.

    >>> elimination = Elimination(("a", "b", "c"))
    >>> elimination.impose([equality("c = a + 1/2"), equality("b = a")])
    >>> elimination.free, spell(elimination.cell("c"))
    (('a',), '1/2 + a')
    """

    names: Sequence[str]
    solved: dict[str, dict[str, Fraction]] = field(default_factory=dict)
    imposed: list[Constraint] = field(default_factory=list)
    """The constraints that eliminated a coefficient. They are linearly independent."""

    @property
    def free(self) -> tuple[str, ...]:
        """The names of the free coefficients, in the order of ``names``."""
        return tuple(name for name in self.names if name not in self.solved)

    def cell(self, name: str) -> Affine:
        """Return a coefficient as an affine function of the free coefficients."""
        return self.solved.get(name, {name: Fraction(1)})

    def impose(self, constraints: Iterable[Constraint]) -> None:
        """Add constraints. Raises :class:`~orderconds.errors.InputError` for a constraint that contradicts
        earlier constraints. The message names the constraints that contradict each other.
        """
        rank = {name: place for place, name in enumerate(self.names)}
        for constraint in constraints:
            form = self._reduced(constraint.form)
            unknown = [name for name in form if name]
            if not unknown:
                if form:
                    raise _contradiction(constraint, self._contradicted(constraint))
                continue
            self.imposed.append(constraint)
            pivot = max(unknown, key=rank.__getitem__)
            scale = -1 / form.pop(pivot)
            row = {name: scale * x for name, x in form.items()}
            for name, other in self.solved.items():
                self.solved[name] = _substituted(other, pivot, row)
            self.solved[pivot] = row

    def _contradicted(self, constraint: Constraint) -> list[str]:
        """Return the texts of the earlier constraints that contradict ``constraint``.

        A linear combination of these constraints differs from ``constraint`` only in the constant term. For
        example, the sum of a + b = 1 and b = 2 is a + 2*b = 3 and contradicts a + 2*b = 4. The earlier
        constraints are linearly independent, so there is only one such combination.
        """
        # The variable ``#k`` is added to the earlier constraint k. In the example above, the constraints
        # become a + b + #0 = 1 and b + #1 = 2. They give a + 2*b = 3 - #0 - #1. Because this expression
        # contains #0 and #1, the constraints 0 and 1 together contradict a + 2*b = 4.
        texts = {f"#{k}": x.text for k, x in enumerate(self.imposed)}
        marked = Elimination((*texts, *self.names))
        marked.impose(
            replace(x, form={**x.form, name: Fraction(1)})
            for name, x in zip(texts, self.imposed, strict=True)
        )
        remaining = marked._reduced(constraint.form)
        return list(dict.fromkeys(text for name, text in texts.items() if name in remaining))

    def _reduced(self, form: Affine) -> dict[str, Fraction]:
        result = dict(form)
        for name in form:
            if name in self.solved:
                result = _substituted(result, name, self.solved[name])
        return {name: x for name, x in result.items() if x}


def _contradiction(constraint: Constraint, others: Sequence[str]) -> InputError:
    if not others:
        return InputError(
            f"{constraint.text!r} does not hold for any coefficients",
            where="constraints",
            expected="an equation with a solution",
        )
    return InputError(
        f"{constraint.text!r} contradicts {', '.join(map(repr, others))}",
        where="constraints",
        expected="constraints that have a common solution",
    )


def _substituted(form: Affine, name: str, by: Affine) -> dict[str, Fraction]:
    result = dict(form)
    scale = result.pop(name, Fraction(0))
    for other, x in by.items():
        result[other] = result.get(other, Fraction(0)) + scale * x
    return {key: x for key, x in result.items() if x}


def equality(text: str, where: str = "--fix") -> Constraint:
    """Parse a linear constraint, such as ``"a21 = 1/2"`` or ``"b3 = 1 - b1 - b2"``. Error messages name the
    option ``where``.

    Raises :class:`~orderconds.errors.InputError` if ``text`` is not a linear equation.

    >>> {name: str(x) for name, x in equality("a21 = 1/2 - b1").form.items()}
    {'a21': '1', '': '-1/2', 'b1': '1'}
    """
    left, sign, right = text.partition("=")
    expected = "a linear equation such as a21=1/2 or b3=1-b1-b2"
    if not sign:
        raise InputError(repr(text), where=where, expected=expected)
    try:
        sides = [_affine(parse(side.strip(), where)) for side in (left, right)]
    except TableauError as problem:
        raise InputError(problem.found, where=where, expected=expected) from None
    except (TypeError, ZeroDivisionError):
        raise InputError(f"{text!r} is not linear", where=where, expected=expected) from None
    form = dict(sides[0])
    for name, x in sides[1].items():
        form[name] = form.get(name, Fraction(0)) - x
    return Constraint(f"{where} {text}", {name: x for name, x in form.items() if x})


def _affine(x: Expression) -> Affine:
    if isinstance(x, Constant) and not x.unit:
        return {"": x.value} if x.value else {}
    if isinstance(x, Name):
        return {x.name: Fraction(1)}
    if not isinstance(x, Chain):
        raise TypeError("not linear")
    result = dict(_affine(x.operands[0]))
    for sign, operand in zip(x.operators, map(_affine, x.operands[1:]), strict=True):
        if sign in "+-":
            for name, value in operand.items():
                result[name] = result.get(name, Fraction(0)) + (value if sign == "+" else -value)
            continue
        if set(result) <= {""} and sign == "*":
            result, operand = dict(operand), result
        if not set(operand) <= {""}:
            raise TypeError("not linear")
        scale = operand.get("", Fraction(0))
        result = {name: value * scale if sign == "*" else value / scale for name, value in result.items()}
    return result


def zero(name: str, why: str) -> Constraint:
    """Return the constraint that a coefficient is zero. Error messages quote the reason ``why``.

    >>> zero("a11", "--explicit").text
    '--explicit (a11 = 0)'
    """
    return Constraint(f"{why} ({name} = 0)", {name: Fraction(1)})


def equal(why: str, *terms: tuple[int, str]) -> Constraint:
    """Return the constraint that a linear combination of coefficients is zero. Error messages quote the
    reason ``why``.

    >>> {name: str(x) for name, x in equal("--symmetric", (1, "b1"), (-1, "b3")).form.items()}
    {'b1': '1', 'b3': '-1'}
    """
    form: dict[str, Fraction] = {}
    for scale, name in terms:
        form[name] = form.get(name, Fraction(0)) + scale
    return Constraint(why, {name: x for name, x in form.items() if x})


def sum_to_one(names: Sequence[str]) -> Constraint:
    """Return the constraint that the weights ``names`` sum to 1.

    >>> sum_to_one(["b1"]).form
    {'b1': Fraction(1, 1), '': Fraction(-1, 1)}
    """
    return Constraint("the weights sum to 1", {**dict.fromkeys(names, Fraction(1)), "": Fraction(-1)})


def spell(form: Affine) -> str:
    """Return an affine function as text in the grammar of tableau files.

    >>> spell({"": Fraction(1, 2), "b1": Fraction(-1), "b2": Fraction(3, 2)})
    '1/2 - b1 + 3/2*b2'
    """
    text = ""
    for name in sorted(form, key=lambda key: (key != "", key)):
        x = form[name]
        sign = ("-" if x < 0 else "") if not text else (" - " if x < 0 else " + ")
        size = abs(x)
        text += sign + (str(size) if not name else name if size == 1 else f"{size}*{name}")
    return text or "0"


def divisor(text: str) -> str:
    """Return ``text`` in a form that can follow ``/``. A name or a nonnegative integer gets no
    parentheses, and all other texts get parentheses.

    >>> divisor("b1"), divisor("2"), divisor("2/3"), divisor("-2")
    ('b1', '2', '(2/3)', '(-2)')
    """
    return text if text.isidentifier() or text.isdecimal() else f"({text})"


def named(letter: str, *indices: int) -> str:
    """Return the name of a coefficient: the letter and the indices, as in a21. If there are more than two
    indices, or if an index is above 9, the indices are separated by ``_``, as in a10_1.

    >>> named("a", 2, 1), named("a", 10, 1)
    ('a21', 'a10_1')
    """
    separator = "" if all(i < 10 for i in indices) and len(indices) < 3 else "_"
    return letter + separator.join(map(str, indices))
