"""The exact order of a tableau in each family that its file claims, with a certificate.

Orders 1, 2, ... are evaluated over the tableau's own ring until the first with a condition that fails. A
claim is an equality: a method that is better than its file says fails the claim as well.

Certificates. ``exact``: every residual up to the order is zero in an exact ring. ``ball``: the file says
which equations its decimals solve, and interval arithmetic proves that they have one solution within the last
digits, which has the order (:mod:`orderconds.proof`). ``decimal``: some residuals are balls that contain
zero, so the order is what the printed digits support, and no more than that is claimed: a ball never
proves zero. A ball too wide to speak (see :data:`orderconds.residuals.RESOLUTION`) leaves the
order ``undecided`` and its certificate ``none``; one that excludes zero proves that the condition fails.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Context, Decimal
from functools import partial
from itertools import chain, islice
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from orderconds import families
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.residuals import Failure, judge
from orderconds.ring import Balls, Ring
from orderconds.served import served, unclaimed
from orderconds.tableau import Magnus, RungeKutta, Splitting, Tableau, find
from orderconds.tableau.properties import properties, undecided
from orderconds.tableau.work import Work, work

if TYPE_CHECKING:
    from orderconds.proof.certificate import Certificate
    from orderconds.proof.implications import Fact
    from orderconds.proof.reductions import Reductions

SEARCH_LIMIT = 8
"""How far to search where a family has no ``search_limit`` of its own; one beyond the claim in any case."""

BOUNDS = ("composition", "rk", "sprk")
"""Families whose orders bound those of others from below or above."""

FREE_STAGES = ("rk", "cg", "cf", "rkmk")
"""Families in which two rows of weights share their stages, so that their difference estimates the error."""

EXHAUSTIVE = 2000
"""An order with more conditions than this is evaluated in batches, the simplest trees first, up to the first
batch in which one fails; those that fail in it are named, and the error norm is left out."""

Tree = tuple[Any, Callable[[], OrderCondition]]
"""A family's own encoding of a tree, and its condition, made where it is evaluated."""


@dataclass(frozen=True)
class FamilyOrder:
    """The order of one tableau in one family, against what was claimed or required.

    ``failing`` are the conditions of order ``order + 1`` that fail, ``error_norm`` the 2-norm of their
    residuals. ``limit`` is the order at which the search stopped without a failing condition, None when
    it found one. ``required`` is a lower bound that was asked for; without it ``claimed`` is an equality.
    """

    family: str
    order: int
    certificate: str
    decided: bool
    failing: tuple[Failure, ...]
    error_norm: float | None
    claimed: int | None = None
    required: int | None = None
    limit: int | None = None

    @property
    def verdict(self) -> str:
        """``holds``, ``fails`` or ``undecided``."""
        if self.required is not None:
            sound = self.order >= self.required
            return "holds" if sound else "fails" if self.decided else "undecided"
        if not self.decided:
            return "undecided"
        return "holds" if self.claimed in (None, self.order) else "fails"

    def as_json(self) -> dict[str, object]:
        """Return the JSON object of one family; ``limit`` only where the search ended there."""
        record: dict[str, object] = {
            "claimed": self.claimed,
            "order": self.order,
            "verdict": self.verdict,
            "certificate": self.certificate,
            "failing": [failure.as_json() for failure in self.failing],
            # JSON has no infinity
            "error_norm": None if self.error_norm == math.inf else self.error_norm,
        }
        return record if self.limit is None else {**record, "limit": self.limit}


class EmbeddedOrder(Struct, frozen=True):
    """The order that the embedded row was said to have in the family ``own``, and its orders by family.

    ``own`` is ``rk`` for weights, ``cf`` for an update of exponentials; ``failing`` are the conditions of the
    next order that fail in it.
    """

    claimed: int
    orders: dict[str, int]
    own: str = "rk"
    failing: tuple[Failure, ...] = ()

    def as_json(self) -> dict[str, object]:
        """Return the JSON object of an embedded row."""
        return {"claimed": self.claimed, "orders": self.orders}


@dataclass(frozen=True)
class Report:
    """What ``check`` found out about one tableau; ``broken_claims`` are property claims that do not hold."""

    name: str
    file: str | None
    format: str
    orders: tuple[FamilyOrder, ...]
    properties: dict[str, bool | None]
    broken_claims: tuple[str, ...] = ()
    undecided: dict[str, str] = field(default_factory=dict)
    """Property to the reason why it is neither true nor false."""
    proof: Certificate | None = None
    work: dict[str, Work] = field(default_factory=dict)
    embedded: EmbeddedOrder | None = None

    @property
    def verdict(self) -> str:
        """``fails`` if any claim fails, else ``undecided`` if any is, else ``holds``."""
        verdicts = {family.verdict for family in self.orders}
        if self.broken_claims or "fails" in verdicts:
            return "fails"
        return "undecided" if "undecided" in verdicts else "holds"

    def summary(self) -> str:
        """Say in a few lines what does not hold: each claim, the first failing condition, its residual."""
        lines = [f"{self.name}: {self.verdict}" + (f"  ({self.file})" if self.file else "")]
        for family in self.orders:
            if family.verdict != "holds":
                wanted = family.claimed if family.required is None else f"at least {family.required}"
                lines.append(f"  {family.family}: order {family.order}, claimed {wanted}")
                lines += [f"    {failure}" for failure in family.failing[:1]]
        return "\n".join([*lines, *(f"  claim fails: {broken}" for broken in self.broken_claims)])

    def as_json(self) -> dict[str, object]:
        """Return the JSON object of one tableau; ``undecided``, ``broken_claims`` where there are any."""
        record: dict[str, object] = {
            "name": self.name,
            "file": self.file,
            "format": self.format,
            "verdict": self.verdict,
            "orders": {family.family: family.as_json() for family in self.orders},
            "properties": self.properties,
            "work": {label: work.as_json() for label, work in self.work.items()},
        }
        if self.embedded is not None:
            record["embedded"] = self.embedded.as_json()
        if self.proof is not None:
            record["proof"] = self.proof.as_json()
        if self.undecided:
            record["undecided"] = self.undecided
        return {**record, "broken_claims": list(self.broken_claims)} if self.broken_claims else record


def check(
    tableau: Tableau | str | PathLike[str],
    family: str | None = None,
    order: int | None = None,
    *,
    complete: bool = False,
    certified: bool = False,
) -> Report:
    """Find the exact order of ``tableau`` (or of the file, or the library name) in each family it claims.

    With ``family`` (``"vcg"``, ``"rkmk(1)"``) that family alone, claimed or not. With ``order`` the order
    must be at least that, in place of the claims. With ``complete`` a claim is missing, and fails, for each
    family that the tableau can serve; with ``certified`` an order that rounded decimals support, and no more,
    fails. A tableau without claims is checked in the family of its format.

    Raises :class:`~orderconds.errors.UnknownName` for an unknown family,
    :class:`~orderconds.errors.ZeroWeight` where a family divides by some b_i = 0,
    :class:`~orderconds.errors.TableauError` for a file that cannot be read, and
    :class:`~orderconds.errors.InputError` for a family that does not read this format.

    >>> report = check("rk4", family="rk")
    >>> report.verdict, [(f.family, f.order, f.certificate) for f in report.orders]
    ('holds', [('rk', 4, 'exact')])
    >>> print(check("kutta3", family="rkmk(0)").orders[0].order)
    2
    """
    if not isinstance(tableau, Tableau):
        tableau = read(tableau)
    wanted = list(_wanted(tableau, family))
    proof, broken = _proof(tableau)
    enclosed = proof.tableau if proof else tableau
    facts = proof.facts if proof else ()
    embedded = _embedded(enclosed, [f for f, _ in wanted])
    computed = properties(tableau)
    if family is None:
        broken += _broken_claims(tableau, computed, embedded)
    if complete:
        broken += _missing_claims(enclosed, unclaimed(tableau))
    orders = _orders(enclosed, wanted, facts, order)
    if certified:
        broken += [f"{f.family}: certificate decimal" for f in orders if f.certificate == "decimal"]
    return Report(
        name=tableau.name,
        file=tableau.path,
        format=tableau.family,
        orders=orders,
        properties=computed,
        broken_claims=tuple(broken),
        undecided=undecided(tableau, computed),
        proof=proof,
        work={f.label(): cost for f, _ in wanted if (cost := _work(tableau, f)) is not None},
        embedded=embedded,
    )


def _work(tableau: Tableau, family: Family) -> Work | None:
    return work(tableau, family.name, getattr(family, "cutoff", None))


def _embedded(tableau: Tableau, wanted: Sequence[Family]) -> EmbeddedOrder | None:
    """Return the orders of the embedded row in the families whose stages do not depend on the weights.

    Those of them that are wanted, always ``rk`` and, of a commutator-free method, ``cf``.
    """
    lower = tableau.lower()
    if lower is None or tableau.embedded is None:
        return None
    claimed, own = tableau.embedded.order, "cf" if lower.family == "cf" else "rk"
    asked = {family.label(): family for family in wanted if family.name in FREE_STAGES}
    asked = {"rk": families.get("rk"), own: families.get(own)} | asked
    found: dict[str, FamilyOrder] = {}
    for label, family in asked.items():
        known = list(found.values())
        bound = None if label == own else _bound(family, known)
        found[label] = family_order(lower, family, claimed, None, bound, _proved(known), brief=True)
    orders = {label: family.order for label, family in found.items()}
    return EmbeddedOrder(claimed, orders, own, found[own].failing)


def _proof(tableau: Tableau) -> tuple[Certificate | None, list[str]]:
    """Return the proof that the file's decimals stand for a solution, or why there is none."""
    if tableau.proof is None:
        return None, []
    from orderconds.proof.certificate import certify
    from orderconds.proof.krawczyk import NotProved

    try:
        return certify(tableau), []
    except NotProved as problem:
        return None, [f"no proof: {problem}"]


def _orders(
    tableau: Tableau,
    wanted: Sequence[tuple[Family, int | None]],
    facts: tuple[Fact, ...],
    required: int | None,
) -> tuple[FamilyOrder, ...]:
    """Return the order in each family, from theorems where evaluating it goes beyond the family's limit."""
    beside = _beside(tableau, wanted, required or 0)
    found: list[FamilyOrder] = []
    for family, claimed in (*beside, *wanted):
        known = _settled(tableau, family, found, facts)
        if known is None:
            bound = _bound(family, found)
            order = family_order(tableau, family, claimed, required, bound, _proved(found))
            known = _certified(order, family, facts)
        else:
            known = replace(known, claimed=claimed, required=required)
        found.append(known)
    return tuple(found[len(beside) :])


def _beside(
    tableau: Tableau, wanted: Sequence[tuple[Family, int | None]], required: int
) -> list[tuple[Family, int | None]]:
    """Return families, beside those wanted, from whose orders a claim beyond a family's limit may follow."""
    if all(max(claimed or 0, required) < _limit(family) for family, claimed in wanted):
        return []
    labels = {family.label() for family, _ in wanted}
    names = [name for name in BOUNDS if name in served(tableau) and name not in labels]
    return [(families.get(name), tableau.claims.order(name)) for name in names]


def _bound(family: Family, found: Sequence[FamilyOrder]) -> FamilyOrder | None:
    """Return, of the families whose conditions are among those of ``family``, the one of least order."""
    from orderconds.proof.implications import consequences

    among = consequences([(family.label(), 1)])
    bounds = [f for f in found if f.family in among and f.decided and f.failing]
    return min(bounds, key=lambda f: f.order, default=None)


def _proved(found: Sequence[FamilyOrder]) -> dict[str, int]:
    """Return the orders, by label, that are more than what rounded decimals support."""
    return {f.family: f.order for f in found if f.decided and f.certificate != "decimal"}


def _limit(family: Family) -> int:
    limit: int = getattr(family, "search_limit", SEARCH_LIMIT)
    return limit


def _settled(
    tableau: Tableau, family: Family, found: Sequence[FamilyOrder], facts: tuple[Fact, ...]
) -> FamilyOrder | None:
    """Return an order that follows from those found before, where it is at least the family's search limit.

    The conditions that fail are those of the family that bounds it from above.
    """
    known = {f.family: f for f in found if f.decided and f.failing and f.certificate != "decimal"}
    beyond = _limit(family)
    if all(f.order < beyond for f in known.values()):
        return None
    from orderconds.proof.implications import settled
    from orderconds.proof.simplifying import simplified_order

    facts += tuple((label, f.order) for label, f in known.items())
    if family.name == "sprk" and "rk" in known and isinstance(tableau.method, RungeKutta):
        facts += (("sprk", simplified_order(tableau.method, tableau.ring, known["rk"].order)),)
    order = settled(facts, {label: f.order for label, f in known.items()}, family)
    if order is None or order < beyond:
        return None
    bound = min(known.values(), key=lambda f: (f.order != order, f.certificate != "exact"))
    certificate = "ball" if any(f.certificate == "ball" for f in known.values()) else "exact"
    return FamilyOrder(family.label(), order, certificate, True, bound.failing, None)


def _certified(found: FamilyOrder, family: Family, facts: tuple[Fact, ...]) -> FamilyOrder:
    """Raise the certificate from ``decimal`` to ``ball`` where proved facts imply the order."""
    if found.certificate != "decimal" or not facts:
        return found
    from orderconds.proof.implications import implied

    return replace(found, certificate="ball") if implied(facts, family, found.order) else found


def family_order(
    tableau: Tableau,
    family: Family,
    claimed: int | None = None,
    required: int | None = None,
    bound: FamilyOrder | None = None,
    proved: Mapping[str, int] | None = None,
    brief: bool = False,
) -> FamilyOrder:
    """Find the order of ``tableau`` in ``family``: evaluate orders 1, 2, ... until a condition fails.

    An order at the family's limit is not exceeded where ``bound``, the order in a family whose conditions
    are among its own, says so, and with ``brief`` no order is: the conditions that fail are then those of
    ``bound``. Conditions that follow from others, and from the orders ``proved`` in other
    families, are not evaluated (:mod:`orderconds.proof.reductions`).

    >>> from orderconds.tableau import find
    >>> kutta3 = Tableau.load(find("kutta3"))
    >>> found = family_order(kutta3, families.get("cg"))
    >>> found.order, found.certificate
    (2, 'exact')
    """
    method = _method(tableau, family)
    if hasattr(family, "require"):
        family.require(method, tableau.ring)
    from orderconds.proof.reductions import reductions

    spared = reductions(family, method, tableau.ring, proved or {})
    return _search(family, method, tableau.ring, spared, claimed, required, bound, brief)


def _search(
    family: Family,
    method: Any,
    ring: Ring,
    spared: Reductions,
    claimed: int | None = None,
    required: int | None = None,
    bound: FamilyOrder | None = None,
    brief: bool = False,
) -> FamilyOrder:
    limit = max(_limit(family), (claimed or 0) + 1, (required or 0) + 1)
    expected = limit if claimed is None else claimed
    certificate = "exact"
    for n in range(1, limit + 1):
        failing: tuple[Failure, ...] = ()
        verdicts: set[str] = set()
        whole = True
        # Of balls a theorem may not say more than they do: that digits support an order.
        known = certificate == "decimal" or not isinstance(ring, Balls)
        for trees, every in () if spared.order_follows(n) else _batches(family, n):
            whole = every
            batch = tuple(condition() for key, condition in trees if not (known and spared.follows(n, key)))
            judged, failing = judge(family, method, ring, batch, n > expected)
            verdicts |= judged
            if failing or (not every and judged == {"zero"} and spared.rest_follows(n)):
                break
        if failing or "undecided" in verdicts:
            decided, norm = bool(failing), None
            certificate = certificate if decided else "none"
            if failing and whole:
                norm = _norm([failure.size for failure in failing])
            return FamilyOrder(family.label(), n - 1, certificate, decided, failing, norm, claimed, required)
        if "supported" in verdicts:
            certificate = "decimal"
        if bound is not None and n == bound.order and (brief or n >= _limit(family)):
            return FamilyOrder(family.label(), n, certificate, True, bound.failing, None, claimed, required)
    return FamilyOrder(family.label(), limit, certificate, True, (), None, claimed, required, limit)


def _batches(family: Family, n: int) -> Iterator[tuple[tuple[Tree, ...], bool]]:
    """Yield what decides order n at once (True), or very much in batches that double, which share an engine's
    work.

    An independent set, or every tree where a set costs more.
    """
    trees = _in_turn(family, n)
    if not hasattr(family, "decisive_count") or family.decisive_count(n) <= EXHAUSTIVE:
        first = tuple(islice(trees, EXHAUSTIVE + 1))
        if len(first) <= EXHAUSTIVE:
            yield first, True
            return
        trees = chain(first, trees)
    size = EXHAUSTIVE // 10
    while batch := tuple(islice(trees, size)):
        yield batch, False
        size *= 2


def _in_turn(family: Family, n: int) -> Iterator[Tree]:
    if hasattr(family, "decisive_in_turn"):
        return ((tree, partial(family.condition, tree)) for tree in family.decisive_in_turn(n))  # type: ignore[attr-defined]
    found: tuple[OrderCondition, ...] = getattr(family, "decisive_conditions", family.conditions)(n)
    return ((condition.key, partial(_made, condition)) for condition in found)


def _made(condition: OrderCondition) -> OrderCondition:
    return condition


def _norm(sizes: list[Decimal]) -> float:
    """Return the 2-norm, to 15 digits."""
    context = Context(prec=30)
    total = Decimal(0)
    for x in sizes:
        total = context.fma(x, x, total)
    return float(f"{context.sqrt(total):.14e}")


def read(given: str | PathLike[str]) -> Tableau:
    """Read a file of any format that :mod:`orderconds.exchange` reads, or the library's tableau of this name.

    >>> read("rk4").name
    'rk4'
    """
    path = Path(given)
    if path.suffix and path.suffix != ".toml":
        from orderconds.exchange import load_foreign

        if (foreign := load_foreign(path)) is not None:
            return foreign
    bare = path.name == str(given) and path.suffix != ".toml"
    return Tableau.load(find(path.name) if bare and not path.exists() else path)


def _wanted(tableau: Tableau, family: str | None) -> Iterator[tuple[Family, int | None]]:
    """Yield the families to check and what is claimed: the one asked for, else all claimed, else the
    format's."""
    claims = {claim.label: claim.order for claim in tableau.claims.orders}
    if family is not None:
        found = families.get(family)
        yield found, claims.get(found.label())
        return
    for label, order in claims.items():
        yield _claimed(tableau, label), order
    if not claims:
        yield families.get(_family_of_format(tableau)), None


def _claimed(tableau: Tableau, label: str) -> Family:
    """Return the family of a claim; a name that there is not is an error of the file, at its key."""
    try:
        return families.get(label)
    except InputError as problem:
        problem.where = f"{tableau.path or tableau.name}: claims.{label.partition('(')[0]}"
        raise


def _family_of_format(tableau: Tableau) -> str:
    """Return the family in which a tableau without claims is checked."""
    method = tableau.method
    if isinstance(method, Splitting) and len(method.parts) > 2:
        return f"splitting({len(method.parts)})"
    return "cayley" if isinstance(method, Magnus) and method.transform == "cay" else tableau.family


def _method(tableau: Tableau, family: Family) -> Any:
    """Read the tableau as the family does; every method is a Runge-Kutta method on an abelian group."""
    method = tableau.read_as(family.formats)
    if method is None and family.name == "rk":
        return tableau.abelian()
    if method is None:
        raise InputError(
            f"a tableau of format {tableau.family} has no reading in family {family.label()}",
            where=tableau.path or tableau.name,
            expected=f"format {' or '.join(family.formats)}",
        )
    return method


def _broken_claims(
    tableau: Tableau, computed: dict[str, bool | None], embedded: EmbeddedOrder | None
) -> Iterator[str]:
    """Yield what the file says of properties and of its embedded row, and what was computed instead."""
    for name, claimed in tableau.claims.properties.items():
        found = computed.get(name)
        if found is not claimed:
            said = "undecided" if found is None else str(found).lower()
            yield f"{name} is {said}, claimed {str(claimed).lower()}"
    if embedded is not None and embedded.orders[embedded.own] != embedded.claimed:
        order = embedded.orders[embedded.own]
        reason = f"; {embedded.failing[0]}" if order < embedded.claimed and embedded.failing else ""
        yield f"the embedded row has order {order} ({embedded.own}), claimed {embedded.claimed}{reason}"


def _missing_claims(tableau: Tableau, names: Sequence[str]) -> Iterator[str]:
    """Yield each family that the tableau can serve without a claim, with the claim that would hold."""
    for name in names:
        found = family_order(tableau, families.get(name))
        least = " at least" if found.limit is not None or not found.decided else ""
        order = f"its order there is{least} {found.order}"
        yield f"no order is claimed in family {name}, which it can serve: {order}"
