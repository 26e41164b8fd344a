"""``check``: the orders of a tableau in each family that it claims, compared with its claims."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from orderconds import families
from orderconds.checking.limits import Limits, Meter
from orderconds.checking.order import FamilyOrder, family_order, first_failing
from orderconds.checking.report import EmbeddedOrder, Report
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.tableau import Tableau, find
from orderconds.tableau.properties import properties, undecided

if TYPE_CHECKING:
    from orderconds.proof.certificate import Certificate
    from orderconds.proof.implications import Fact


def check(
    tableau: Tableau | str | PathLike[str],
    family: str | None = None,
    order: int | None = None,
    *,
    complete: bool = False,
    certified: bool = False,
    limits: Limits | None = None,
) -> Report:
    """Find the exact order of ``tableau`` (or of the file, or the library name) in each family it claims.

    With ``family`` (``"vcg"``, ``"rkmk(1)"``) that family alone, claimed or not. With ``order`` the order
    must be at least that, in place of the claims. With ``complete`` a claim is missing, and fails, for each
    family that the tableau can claim; with ``certified`` an order that rounded decimals support, and no more,
    fails. A tableau without claims is checked in the family of its format. ``limits`` bound the work; an
    order that they leave open is a lower bound.

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
        from orderconds.checking.claimable import unclaimed

        broken += _missing_claims(enclosed, unclaimed(tableau))
    orders = _orders(enclosed, wanted, facts, order, Meter(limits or Limits()))
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
        work={f.label(): cost for f, _ in wanted if (cost := f.work(tableau)) is not None},
        embedded=embedded,
    )


def _embedded(tableau: Tableau, wanted: Sequence[Family]) -> EmbeddedOrder | None:
    """Return the orders of the embedded row in the families whose stages do not depend on the weights.

    Those of them that are wanted, always the classical one and that of the tableau's format.
    """
    lower = tableau.lower()
    if lower is None or tableau.embedded is None:
        return None
    claimed, own = tableau.embedded.order, lower.family
    asked = {family.label(): family for family in wanted if family.fixed_stages}
    always = (families.get("rk"), families.get(own))
    asked = {family.label(): family for family in always} | asked
    found: dict[str, FamilyOrder] = {}
    for label, family in asked.items():
        known = list(found.values())
        bound = None if label == own else _bound(family, known)
        found[label] = family_order(lower, family, claimed, None, bound, _proved(known), brief=True)
    orders = {label: family.order for label, family in found.items()}
    certificates = {label: family.certificate for label, family in found.items()}
    return EmbeddedOrder(claimed, orders, certificates, own, found[own].failing)


def _proof(tableau: Tableau) -> tuple[Certificate | None, list[str]]:
    """Return the proof that the file's decimals stand for a solution, or why there is none."""
    if tableau.proof is None:
        return None, []
    from orderconds.proof.certificate import certify
    from orderconds.proof.krawczyk import NotProved

    try:
        proof = certify(tableau)
    except NotProved as problem:
        return None, [f"no proof: {problem}"]
    hint = "orderconds refine writes its digits"
    return proof, [f"the decimal {misrounded}; {hint}" for misrounded in proof.misrounded]


def _orders(
    tableau: Tableau,
    wanted: Sequence[tuple[Family, int | None]],
    facts: tuple[Fact, ...],
    required: int | None,
    meter: Meter,
) -> tuple[FamilyOrder, ...]:
    """Return the order in each family, from theorems where evaluating it goes beyond the family's limit."""
    beside = _beside(tableau, wanted, required or 0)
    found: list[FamilyOrder] = []
    for read_as, family, claimed in (*beside, *((tableau, *each) for each in wanted)):
        known = _settled(tableau, family, found, facts)
        if known is None:
            bound = _bound(family, found)
            order = family_order(read_as, family, claimed, required, bound, _proved(found), meter=meter)
            known = _certified(order, family, facts)
            if known.limit is not None and not beside:
                known = _beyond(tableau, family, known, facts, meter)
        else:
            known = replace(known, claimed=claimed, required=required)
        found.append(known)
    return tuple(found[len(beside) :])


Reading = tuple[Tableau, Family, int | None]
"""A tableau in a form that a family reads, the family, and the order that is claimed."""


def _beside(tableau: Tableau, wanted: Sequence[tuple[Family, int | None]], required: int) -> list[Reading]:
    """Return families, beside those wanted, from whose orders a claim beyond a family's limit may follow."""
    if all(max(claimed or 0, required) < family.search_limit for family, claimed in wanted):
        return []
    return _bounding(tableau, {family.label() for family, _ in wanted})


def _bounding(tableau: Tableau, labels: Collection[str]) -> list[Reading]:
    """Return the families that bound the orders of others, but for those named.

    A plain array that is a composition of midpoints is read as one, too.
    """
    from orderconds.checking.claimable import claimable_families
    from orderconds.tableau.recognise import as_composition

    found: dict[str, Reading] = {}
    for read_as in filter(None, (as_composition(tableau), tableau)):
        for family in claimable_families(read_as):
            if family.bounds_others and family.label() not in labels:
                found.setdefault(family.label(), (read_as, family, tableau.claims.order(family.name)))
    return list(found.values())


def _beyond(
    tableau: Tableau, family: Family, ended: FamilyOrder, facts: tuple[Fact, ...], meter: Meter
) -> FamilyOrder:
    """Return the order where theorems decide it beyond the end of the search, else ``ended``.

    They bound it from below; from above, the order in another family does, or one condition that fails.
    """
    bounding = _bounding(tableau, [family.label()])
    found = [family_order(read_as, other, claim, meter=meter) for read_as, other, claim in bounding]
    known = _settled(tableau, family, found, facts)
    if known is not None:
        return replace(known, claimed=ended.claimed, required=ended.required)
    from orderconds.proof.implications import least_order

    orders = _decided(found) if ended.certificate == "decimal" else _proved(found)
    least = least_order((*facts, *orders.items()), family)
    failing = first_failing(tableau, family, least + 1) if least >= ended.order else ()
    return replace(ended, order=least, failing=failing, limit=None, stopped=None) if failing else ended


def _bound(family: Family, found: Sequence[FamilyOrder]) -> FamilyOrder | None:
    """Return, of the families whose conditions are among those of ``family``, the one of least order."""
    if not found:
        return None
    from orderconds.proof.implications import consequences

    among = consequences([(family.label(), 1)])
    bounds = [f for f in found if f.family in among and f.decided and f.failing]
    return min(bounds, key=lambda f: f.order, default=None)


def _decided(found: Sequence[FamilyOrder]) -> dict[str, int]:
    """Return the orders by label, those that rounded decimals support among them."""
    return {f.family: f.order for f in found if f.decided}


def _proved(found: Sequence[FamilyOrder]) -> dict[str, int]:
    """Return the orders, by label, that are more than what rounded decimals support."""
    return _decided([f for f in found if f.certificate != "decimal"])


def _settled(
    tableau: Tableau, family: Family, found: Sequence[FamilyOrder], facts: tuple[Fact, ...]
) -> FamilyOrder | None:
    """Return an order that follows from those found before, where it is at least the family's search limit.

    The conditions that fail are those of the family that bounds it from above. What follows from orders that
    decimals support is supported by decimals.
    """
    proved = [f for f in found if f.certificate != "decimal"]
    settled = _settled_by(tableau, family, proved, facts)
    if settled is None and len(found) > len(proved):
        settled = _settled_by(tableau, family, found, facts)
        return settled and _certified(replace(settled, certificate="decimal"), family, facts)
    return settled


def _settled_by(
    tableau: Tableau, family: Family, found: Sequence[FamilyOrder], facts: tuple[Fact, ...]
) -> FamilyOrder | None:
    known = {f.family: f for f in found if f.decided and f.failing}
    beyond = family.search_limit
    if all(f.order < beyond for f in known.values()):
        return None
    from orderconds.proof.implications import settled

    orders = {label: f.order for label, f in known.items()}
    own = family.order_of_tableau(tableau.method, tableau.ring, orders)
    order = settled((*facts, *_decided(found).items(), (family.label(), own)), orders, family)
    if order is None or order < beyond:
        return None
    bound = min(known.values(), key=lambda f: (f.order != order, f.certificate != "exact"))
    certificate = "ball" if any(f.certificate == "ball" for f in found if f.decided) else "exact"
    return FamilyOrder(family.label(), order, certificate, True, bound.failing, None)


def _certified(found: FamilyOrder, family: Family, facts: tuple[Fact, ...]) -> FamilyOrder:
    """Raise the certificate from ``decimal`` to ``ball`` where proved facts imply the order."""
    if found.certificate != "decimal" or not facts:
        return found
    from orderconds.proof.implications import implied

    return replace(found, certificate="ball") if implied(facts, family, found.order) else found


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
        yield families.get(tableau.family).for_method(tableau.method), None


def _claimed(tableau: Tableau, label: str) -> Family:
    """Return the family of a claim; a name that there is not is an error of the file, at its key."""
    try:
        return families.get(label)
    except InputError as problem:
        problem.where = f"{tableau.path or tableau.name}: claims.{label.partition('(')[0]}"
        raise


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


def _missing_claims(tableau: Tableau, unclaimed: Sequence[Family]) -> Iterator[str]:
    """Yield each of the ``unclaimed`` families with the claim that would hold."""
    for family in unclaimed:
        found = family_order(tableau, family)
        least = " at least" if found.limit is not None or not found.decided else ""
        order = f"its order there is{least} {found.order}"
        yield f"no order is claimed in family {family.label()}, which it can serve: {order}"
