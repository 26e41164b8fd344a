"""A method: a family with a tableau, such as ``vcg:triple_jump`` or ``rkmk(2):rk4``.

The family can be omitted from the label, as in ``cf4``. The label of a method without a tableau contains only
the family, as in ``taylor(12)``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from codegen.errors import MethodError, UnclaimedTableau
from codegen.ir.number import Number
from orderconds.argument import described
from orderconds.errors import InputError
from orderconds.families import Family, family_class, get, names
from orderconds.families.base import all_nonzero
from orderconds.ring import QQ
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau import CommutatorFree, OrderClaim, RungeKutta, Tableau, find
from orderconds.tableau.library import available

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

STEP = "step"
"""The word before the colon in a label such as ``step:NAME``, where NAME is a step that the scene defines."""

ALONE = re.compile(r"(?P<family>[a-z_]+)(?:\((?P<number>\d{1,3})\))?")
"""The label of a method without a tableau: a family, or a family and a number, as in ``taylor(12)``."""

PATTERN = re.compile(r"(?:(?P<family>[a-z_]+)(?:\((?P<cutoff>\d{1,2})\))?:)?(?P<tableau>.+)")


@dataclass(frozen=True)
class Method:
    """A method, given by a family, a tableau and a cut-off. Some families need no tableau or no cut-off.

    - ``coefficients`` is the tableau, or None for a family without tableau.
    - ``cutoff`` is the number of brackets after which the series of dexp^{-1} or dexp is truncated. For a
      family without tableau, ``cutoff`` is the number in the label, for example 12 in ``taylor(12)``.
    - ``adaptive`` is True if the emitted code controls the step size.
    - ``step`` is '' for most methods. A scene can also contain methods of its own, defined by a formula
      y1 = M y0 with a matrix M. For such a method, ``step`` is the name that the scene gives to the method.
    """

    family: str
    coefficients: Tableau | None
    cutoff: int | None = None
    adaptive: bool = False
    step: str = ""

    @property
    def kind(self) -> type[Family]:
        """The class of the family."""
        return family_class(self.family)

    @property
    def tableau(self) -> Tableau:
        """The tableau. :class:`MethodError` is raised for a method without a tableau."""
        if self.coefficients is None:
            raise MethodError(f"{self.family_label} has no tableau", expected="a method with a tableau")
        return self.coefficients

    @property
    def label(self) -> str:
        """The family and the tableau of the method, as in ``rkmk(2):rk4``."""
        if self.step:
            return f"{STEP}:{self.step}"
        return f"{self.family_label}:{self.name}" if self.name else self.family_label

    @property
    def described(self) -> str:
        """Family and tableau in words, for the header of emitted code."""
        if self.step:
            return f"the step {self.step}, which the scene defines"
        return f"family {self.family_label}" + f", tableau {self.name}" * bool(self.name)

    @property
    def name(self) -> str:
        """The name of the tableau or of the scene's step, or '' if the method has neither."""
        return self.step if self.coefficients is None else self.coefficients.name

    @property
    def source(self) -> str:
        """The publication of the tableau, or the publication of the family if there is no tableau."""
        return self.kind.source if self.coefficients is None else self.coefficients.source

    @property
    def family_label(self) -> str:
        """The family with its cut-off, as in ``rkmk(2)``."""
        return self.family if self.cutoff is None else f"{self.family}({self.cutoff})"

    @property
    def ring(self) -> Ring:
        """The ring of the coefficients. For a method without a tableau, it is the rational numbers QQ."""
        return QQ if self.coefficients is None else self.coefficients.ring

    def number(self, x: Element) -> Number:
        """Return the coefficient x as a :class:`Number`. If x is rational, the ring of the result is QQ."""
        number = Number(self.ring, x)
        if self.ring is QQ:
            return number
        text = self.ring.text(x)
        return Number.rational(*Fraction(text).as_integer_ratio()) if _RATIONAL.fullmatch(text) else number

    def runge_kutta(self) -> RungeKutta:
        """Return the tableau as a Runge-Kutta method with the matrix A and the weights b.

        :class:`MethodError` is raised if the tableau does not define a Runge-Kutta method.
        """
        method = self.tableau.read_as(("rk",))
        if not isinstance(method, RungeKutta):
            raise MethodError(
                f"the family {self.family} cannot use {self.tableau.name}, a tableau of format "
                f"{self.tableau.family}",
                expected="a tableau of format rk or composition",
            )
        return method

    def can_reduce_brackets(self) -> bool:
        """Return True if the tableau is explicit and its coefficients are exact.

        The search for the fewest brackets requires such a tableau.
        """
        method = self.tableau.read_as(("rk",))
        if not isinstance(method, RungeKutta):
            return False
        entries = [x for row in method.A for x in row]
        above = (x for i, row in enumerate(method.A) for x in row[i:])
        decided = all(self.ring.is_zero(x - x) is True for x in (*entries, *method.b))
        return decided and all(self.ring.is_zero(x) is True for x in above)

    def commutator_free(self) -> CommutatorFree:
        """Return the tableau as a method with products of exponentials in the stages and in the update.

        A Butcher tableau is read as a Crouch-Grossman method.
        """
        method = self.tableau.read_as(("cf",))
        if isinstance(method, CommutatorFree):
            return method
        return self.runge_kutta().as_crouch_grossman(self.ring)

    def embedded(self) -> Method | None:
        """Return the embedded method, or None if the method needs no embedded method.

        The result is None if ``adaptive`` is False, or if the family controls the step size in another way,
        as ``taylor`` does. An embedded method has the stages of the method, but other weights.
        :class:`MethodError` is raised if a needed embedded method does not exist.
        """
        if not self.adaptive or self.kind.controls_steps:
            return None
        lower = self.tableau.lower()
        if not self.kind.fixed_stages:
            raise MethodError(
                f"no error estimate for {self.label}: embedded methods exist only in families whose stages "
                "do not depend on the weights",
                expected=f"a method of {', '.join(with_estimate())}",
            )
        if self.kind.minimal_brackets and self.cutoff is None:
            raise MethodError(
                f"no error estimate for {self.label}: the embedded method requires a cut-off of the series "
                "of dexp^{-1}",
                expected="a method with a cut-off",
                hint=f"write rkmk(3):{self.tableau.name}",
            )
        if lower is None:
            raise MethodError(
                f"no error estimate for {self.label}: the tableau has no embedded method",
                expected="a tableau with an embedded method",
                hint="use for example dormand_prince5 or cf43",
            )
        return replace(self, coefficients=lower, adaptive=False)

    def abscissae(self) -> tuple[Element, ...]:
        """Return the abscissae c_i of the stages.

        If stage i is a product of exponentials, c_i is the sum of all coefficients in the exponents.
        """
        return self.commutator_free().as_runge_kutta(self.ring).c


def _file(name: str) -> Path:
    """Return the path ``name`` if ``name`` ends in ``.toml``, and otherwise the path of a library tableau."""
    path = Path(name)
    return path if path.suffix == ".toml" else find(name)


def _enclosed(tableau: Tableau) -> Tableau:
    """Return the tableau with balls (small intervals) as coefficients.

    Each ball contains an exact coefficient. If there is no valid proof that exact coefficients exist, the
    result is the tableau itself.
    """
    if tableau.proof is None:
        return tableau
    from orderconds.proof.certificate import certify
    from orderconds.proof.krawczyk import NotProved

    try:
        return certify(tableau).tableau
    except NotProved:
        return tableau


_RATIONAL = re.compile(r"-?\d+(/\d+)?")


def with_estimate() -> tuple[str, ...]:
    """Return the names of the families whose methods can have embedded methods.

    These are the families in which the stages of a method do not depend on the weights of the method.
    """
    return tuple(name for name in names() if family_class(name).fixed_stages)


def _without_tableau(text: str, families: Sequence[str]) -> Method | None:
    """Return the method if ``text`` is a label without a tableau (``taylor(12)``), and None otherwise."""
    match = ALONE.fullmatch(text.strip())
    if match is None or match["family"] not in names() or family_class(match["family"]).has_tableau:
        return None
    if match["family"] not in families:
        raise MethodError(
            f"family {match['family']} cannot be used on this scene",
            where=text,
            expected=f"one of {', '.join(families)}",
        )
    number = None if match["number"] is None else int(match["number"])
    # The next line raises an InputError if the number in the label is missing or out of range.
    get(text.strip()).degree_of_step()
    return Method(match["family"], None, number)


def _unreadable(text: str, tableau: Tableau, families: Sequence[str]) -> UnclaimedTableau:
    """Return the error for a tableau with a format that ``families`` cannot use."""
    formats = sorted({f for name in families for f in family_class(name).formats})
    error = UnclaimedTableau(
        f"the tableau {tableau.name} has the format {tableau.family}, which these families cannot use: "
        f"{', '.join(families)}",
        where=text,
        expected=f"a tableau of format {' or '.join(formats)}",
        hint=f"write for example {_example(families)}",
    )
    error.claimed = _claimed(tableau)
    return error


def _claimed(tableau: Tableau) -> tuple[str, ...]:
    """Return the names of the families for which ``tableau`` contains a claimed order."""
    return tuple(claim.family.partition("(")[0] for claim in tableau.claims.orders)


def _unclaimed(
    match: re.Match[str], tableau: Tableau, text: str, families: Sequence[str], readable: Sequence[str]
) -> UnclaimedTableau:
    family = match["family"]
    fitting = [f for f in readable if _fits(f, tableau)]
    label = _label(fitting[0], match["tableau"]) if fitting else f"for example {_example(families)}"
    error = UnclaimedTableau(
        f"the tableau {tableau.name} claims no order in these families: {family or ', '.join(families)}",
        where=text,
        expected="a cut-off in the name, as in rkmk(2)" if family else "a family in the method's name",
        hint=f"write {label}",
    )
    error.claimed = _claimed(tableau)
    return error


def _fits(family: str, tableau: Tableau) -> bool:
    """Return True if the tableau defines a method of the family."""
    method = tableau.read_as(family_class(family).formats)
    if method is None or _divides_by_zero(family, tableau):
        return False
    try:
        family_class(family)().require(method, tableau.ring)
    except InputError:
        return False
    return True


def _label(family: str, tableau: str) -> str:
    """Return a label such as "cg:rk4" or "rkmk(2):rk4". The 2 is an example of a truncation order."""
    return f"{family}(2):{tableau}" if family_class(family).takes_cutoff else f"{family}:{tableau}"


def _divides_by_zero(family: str, tableau: Tableau) -> bool:
    """Return True if the formulas of the family divide by a weight of the tableau that may be zero."""
    method = tableau.read_as(("rk",))
    if not family_class(family).needs_nonzero_weights or not isinstance(method, RungeKutta):
        return False
    return not all_nonzero(method.b, tableau.ring)


def _example(families: Sequence[str]) -> str:
    """Return the label of a method in one of the families, as an example for an error message."""
    for name in (f for f in families if family_class(f).has_tableau):
        for tableau in _library():
            claims = [c for c in tableau.claims.orders if c.family == name]
            if claims:
                cutoff = max(claims, key=lambda c: c.order).cutoff
                return f"{name}:{tableau.name}" if cutoff is None else f"{name}({cutoff}):{tableau.name}"
        for tableau in _library():
            if _fits(name, tableau):
                return _label(name, tableau.name)
    raise AssertionError(families)


def _library() -> Iterator[Tableau]:
    """Yield the tableaux of the library, loaded one by one."""
    return map(_of_library, available())


@cache
def _of_library(name: str) -> Tableau:
    return Tableau.load(find(name))


def method_of(given: Method | Tableau | str, families: Sequence[str], family: str = "") -> Method:
    """Return the method that ``given`` denotes.

    ``given`` is a method, a tableau, or a text such as ``"rkmk(2):rk4"``.

    ``families`` are the families that accept the user's scene. ``family`` is the family in which the tableau
    is used, for example ``"rkmk(2)"``. If neither ``family`` nor the text names a family, the family with the
    highest claimed order is chosen. If a given :class:`Tableau` claims no order, the orders are computed.
    """
    if isinstance(given, Method):
        return given
    if isinstance(given, str):
        return parse(f"{family}:{given}" if family else given, families)
    if not isinstance(given, Tableau):
        raise MethodError(
            described(given), where="method", expected="a Tableau, or a text such as cf4 or vcg:triple_jump"
        )
    label = f"{family}:{given.name}" if family else given.name
    if not given.claims.orders:
        given = replace(given, claims=replace(given.claims, orders=tuple(_computed(given, family))))
    match = PATTERN.fullmatch(label)
    if match is None or (family and match["family"] is None):
        raise MethodError(
            f"{family!r} is not a family", where="family", expected="a family, such as cg or rkmk(2)"
        )
    return _method(match, _enclosed(given), label, families)


def _computed(tableau: Tableau, family: str) -> Iterator[OrderClaim]:
    """For each family that can use ``tableau``, compute the order and yield it as a claim.

    ``family`` is the name of a family, a name with a cut-off such as ``rkmk(2)``, or ''. If ``family`` is not
    empty, all families with another name are omitted. The cut-off, the number 2 in ``rkmk(2)``, is ignored.
    """
    from orderconds.checking import check, claimable_families

    for member in claimable_families(tableau):
        if family.partition("(")[0] in ("", member.name):
            for variant in member.claimed_variants():
                (order,) = check(tableau, family=variant.label()).orders
                yield variant.claim(order.order)


def family_in(given: object) -> str:
    """Return the family that an argument names, or '' if the argument names no family.

    >>> family_in("rkmk(2):rk4"), family_in("taylor(12)"), family_in("rk4")
    ('rkmk', 'taylor', '')
    """
    if isinstance(given, Method):
        return given.family
    if not isinstance(given, str):
        return ""
    alone, match = ALONE.fullmatch(given.strip()), PATTERN.fullmatch(given.strip())
    if alone is not None and alone["family"] in names() and not family_class(alone["family"]).has_tableau:
        return alone["family"]
    return (match["family"] or "") if match is not None else ""


def parse(text: str, families: Sequence[str]) -> Method:
    """Return the method that a text names. ``families`` are the families that accept the scene.

    If the text names no family, the family with the highest claimed order is chosen. Among families of equal
    order, the first in ``families`` is chosen.

    If the family needs a cut-off and the text contains none, the cut-off with the highest claimed order is
    chosen. Among cut-offs of equal order, the smallest is chosen.

    There is one exception: for some explicit tableaux, the family ``rkmk`` is used without a cut-off. The
    compiler then searches for the fewest brackets that preserve the order.

    :class:`MethodError` is raised if the text cannot be read, or if the scene or the tableau does not fit the
    family. MethodError is also raised if no family or no cut-off can be chosen.
    :class:`orderconds.errors.UnknownName` is raised for an unknown tableau.
    """
    alone = _without_tableau(text, families)
    if alone is not None:
        return alone
    match = PATTERN.fullmatch(text.strip())
    if match is None:
        raise MethodError(
            f"{text!r} is not the name of a method",
            expected="TABLEAU or FAMILY:TABLEAU",
            hint="write for example vcg:triple_jump",
        )
    return _method(match, _enclosed(Tableau.load(_file(match["tableau"]))), text, families)


def _method(match: re.Match[str] | None, tableau: Tableau, text: str, families: Sequence[str]) -> Method:
    """Return the method with the given tableau.

    If ``text`` contains no family, the family with the highest claimed order is chosen.
    """
    assert match is not None
    family, cutoff = match["family"], match["cutoff"]
    if family is not None and family not in families:
        raise MethodError(
            f"family {family} cannot be used on this scene",
            where=text,
            expected=f"one of {', '.join(families)}",
        )
    if family is not None and not family_class(family).has_tableau:
        raise MethodError(
            f"the family {family} has no tableaux", where=text, expected=f"a label such as {family}(12)"
        )
    if cutoff is not None and family is not None and not family_class(family).takes_cutoff:
        cutting = [f for f in families if family_class(f).takes_cutoff]
        raise MethodError(
            f"the family {family} has no cut-off",
            where=text,
            expected=f"no cut-off, or one of the families with a cut-off ({' or '.join(cutting)})",
        )
    # A commutator-free tableau must not be used as a Runge-Kutta tableau.
    exponentials = isinstance(tableau.method, CommutatorFree)
    readable = [f for f in families if not exponentials or tableau.family in family_class(f).formats]
    readable = [f for f in readable if tableau.read_as(family_class(f).formats) is not None]
    if not readable or (family is not None and family not in readable):
        raise _unreadable(text, tableau, families if family is None else (family,))
    # Numbers in the names of families are removed: ``splitting(3)`` becomes ``splitting``.
    claims = [replace(c, family=c.family.partition("(")[0]) for c in tableau.claims.orders]
    wanted = [c for c in claims if c.family == (family or c.family) and c.family in readable]
    if family is not None and cutoff is not None:
        return Method(family, tableau, int(cutoff))
    if family is not None and not family_class(family).takes_cutoff:
        return Method(family, tableau)
    if not wanted:
        raise _unclaimed(match, tableau, text, families, readable if family is None else [family])
    best = min(wanted, key=lambda c: (-c.order, families.index(c.family), c.cutoff or 0))
    uncut = Method(best.family, tableau)
    if best.order <= uncut.kind.minimal_brackets and uncut.can_reduce_brackets():
        return uncut
    return Method(best.family, tableau, best.cutoff)
