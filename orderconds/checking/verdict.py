"""``check``: compute the orders of a tableau and compare them with the orders that its file claims."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from orderconds import families
from orderconds.argument import CONDITION_ORDER, TOLERANCE, described, integer, real
from orderconds.checking.continuous import extension_order
from orderconds.checking.limits import Limits, Meter
from orderconds.checking.order import DOUBLE, FamilyOrder, family_order, first_failing
from orderconds.checking.report import EmbeddedOrder, ExtensionOrder, RegisterForm, Report
from orderconds.checking.symmetry import symmetry_order
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.tableau import RungeKutta, Tableau
from orderconds.tableau.properties import low_storage, properties, undecided
from orderconds.tableau.tolerance import with_tolerance

if TYPE_CHECKING:
    from orderconds.proof.certificate import Certificate
    from orderconds.proof.implications import Fact


NOT_PROVED = ("decimal", DOUBLE)
"""The certificates that do not prove an order: the conditions hold to the precision of the given
coefficients, but perhaps not exactly."""


def check(
    tableau: Tableau | str | PathLike[str],
    family: str | None = None,
    order: int | None = None,
    *,
    complete: bool = False,
    certified: bool = False,
    limits: Limits | None = None,
    tolerance: float | None = None,
) -> Report:
    """Compute the order of ``tableau`` in each family in which its file claims an order.

    - ``tableau``: a tableau, a file, or the name of a tableau in the library.
    - ``family``: the label of the only family to check, for example ``"rkmk(1)"``.
    - ``order``: the least acceptable order. If ``order`` is given, the claimed orders are ignored.
    - ``complete``: the file must claim an order in each family of ``claimable_families(tableau)``.
    - ``certified``: every order must be proved.
    - ``limits``: limits on work, time and memory. If a limit is reached, the computed order is a lower bound.
    - ``tolerance``: a number t. Each coefficient x that is a double has the uncertainty t 2^-53 max(1, |x|).

    If the file claims no order, the family in its key ``family`` is checked. The verdict is ``unclaimed``.
    Raises subclasses of :class:`~orderconds.errors.InputError`: UnknownName for an unknown family, ZeroWeight
    if a formula divides by a weight b_i = 0, and TableauError for a file that cannot be read.

    >>> report = check("rk4", family="rk")
    >>> report.verdict, [(f.family, f.order, f.certificate) for f in report.orders]
    ('holds', [('rk', 4, 'exact')])
    >>> check("rk4", family="rk", order=3).verdict, check("rk4", family="rkmk(3)").conclusion
    ('holds', 'order 4; no order claimed')
    """
    order, tolerance = _bounds(order, tolerance, limits)
    tableau = tableau if isinstance(tableau, Tableau) else read(tableau)
    given, tableau = tableau, with_tolerance(tableau, tolerance)
    wanted, outside = _members(tableau, family)
    proof, broken = _proof(tableau)
    enclosed, facts = (proof.tableau, proof.facts) if proof else (tableau, ())
    embedded = _embedded(enclosed, [f for f, _ in wanted], proof.lower_facts if proof else ())
    computed, dense = properties(tableau), extension_order(tableau)
    if family is None:
        broken += (*outside, *_broken_claims(tableau, computed, embedded), *_broken_extension(dense))
    broken += _missing_claims(enclosed, tableau) if complete else []
    orders = _named(_orders(enclosed, wanted, facts, order, Meter(limits or Limits())), tableau)
    broken += [f"{f.family}: certificate {f.certificate}" for f in _not_proved(orders) if certified]
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
        dense=dense,
        low_storage=_register_form(tableau),
        symmetry=symmetry_order(enclosed, computed.get("symmetric")),
        properties_claimed=bool(tableau.claims.properties),
        hint=_hint(given, orders),
    )


def _register_form(tableau: Tableau) -> RegisterForm | None:
    """Rewrite the method as a low-storage scheme with two registers.

    If no scheme is found, the result contains the reason. Return None if the method is neither a Runge-Kutta
    method nor a commutator-free method.
    """
    rewriting = low_storage(tableau)
    if rewriting is None:
        return None
    space = "vector space" if isinstance(tableau.method, RungeKutta) else "group"
    if rewriting.scheme is None:
        return RegisterForm(rewriting.holds, space, reason=rewriting.reason)
    A, B = (tuple(map(tableau.ring.text, row)) for row in (rewriting.scheme.A, rewriting.scheme.B))
    return RegisterForm(rewriting.holds, space, A, B)


def _not_proved(orders: Iterable[FamilyOrder]) -> list[FamilyOrder]:
    """Return the orders that are not proved."""
    return [x for x in orders if x.certificate in NOT_PROVED]


def _bounds(order: object, tolerance: object, limits: object) -> tuple[int | None, float | None]:
    """Return ``order`` and ``tolerance`` as numbers. Raise InputError if an argument is not valid."""
    if limits is not None and not isinstance(limits, Limits):
        raise InputError(described(limits), where="limits", expected="Limits")
    if isinstance(limits, Limits) and limits.seconds is not None:
        real(limits.seconds, "seconds", (0, math.inf))
    return (
        None if order is None else integer(order, "order", CONDITION_ORDER),
        None if tolerance is None else real(tolerance, "tolerance", TOLERANCE),
    )


def _named(orders: tuple[FamilyOrder, ...], tableau: Tableau) -> tuple[FamilyOrder, ...]:
    """Return ``orders``. For coefficients that are doubles, rename the certificate ``decimal`` to ``double``.

    Each entry of ``orders`` has a certificate. A certificate is a word that states how the order was
    established. The words ``decimal`` and ``double`` denote an order that holds to the accuracy of the
    coefficients, but is not proved.
    """
    if not tableau.doubles:
        return orders
    return tuple(replace(f, certificate=_of_doubles(f.certificate)) for f in orders)


def _of_doubles(certificate: str) -> str:
    return DOUBLE if certificate == "decimal" else certificate


def _hint(tableau: Tableau, orders: Sequence[FamilyOrder]) -> str:
    if not tableau.doubles or any(family.verdict == "fails" for family in orders):
        return ""
    from orderconds.checking.exact_forms import exact_forms

    forms = exact_forms(tableau)
    if forms is None:
        return ""
    name, text = max(forms.texts.items(), key=lambda form: ("sqrt" in form[1], -len(form[1])))
    return (
        f"the coefficients agree with exact numbers, such as {name} = {text}; "
        "to print the exact numbers, type: orderconds refine FILE"
    )


def _embedded(tableau: Tableau, wanted: Sequence[Family], facts: tuple[Fact, ...]) -> EmbeddedOrder | None:
    """Return the orders of the embedded method, or None if the tableau has no embedded method.

    A family in ``wanted`` is ignored if its attribute ``fixed_stages`` is false.
    """
    lower = tableau.lower()
    if lower is None or tableau.embedded is None:
        return None
    claimed, own = tableau.embedded.order, lower.family
    asked = {family.label(): family for family in wanted if family.fixed_stages}
    always = (families.get("rk"), families.get(own))
    asked = {family.label(): family for family in always} | asked
    computed: dict[str, FamilyOrder] = {}
    for label, family in asked.items():
        known = list(computed.values())
        bound = None if label == own else _bound(family, known)
        order = family_order(lower, family, claimed, None, bound, _proved(known), brief=True)
        computed[label] = _certified(order, family, facts)
    orders = {label: family.order for label, family in computed.items()}
    certificates = {label: family.certificate for label, family in computed.items()}
    if tableau.doubles:
        certificates = {label: _of_doubles(name) for label, name in certificates.items()}
    return EmbeddedOrder(claimed, orders, certificates, own, computed[own].failing)


def _proof(tableau: Tableau) -> tuple[Certificate | None, list[str]]:
    """Prove that the equations in the table ``[proof]`` have a solution near the rounded coefficients.

    Return the proof and a list of error messages.
    """
    if tableau.proof is None:
        return None, []
    from orderconds.proof.certificate import certify
    from orderconds.proof.krawczyk import NotProved

    try:
        proof = certify(tableau)
    except NotProved as problem:
        return None, [f"no proof: {problem}"]
    hint = "to print the correct digits, type: orderconds refine FILE"
    return proof, [f"the decimal {misrounded}; {hint}" for misrounded in proof.misrounded]


def _orders(
    tableau: Tableau,
    wanted: Sequence[tuple[Family, int | None]],
    facts: tuple[Fact, ...],
    required: int | None,
    meter: Meter,
) -> tuple[FamilyOrder, ...]:
    """Return the order in each family of ``wanted``."""
    beside = _beside(tableau, wanted, required or 0)
    known_orders: list[FamilyOrder] = []
    for read_as, family, claimed in (*beside, *((tableau, *each) for each in wanted)):
        known = _settled(tableau, family, known_orders, facts)
        if known is None:
            bound = _bound(family, known_orders)
            order = family_order(
                read_as, family, claimed, required, bound, _proved(known_orders), meter=meter
            )
            known = _certified(order, family, facts)
            if known.limit is not None and not beside:
                known = _beyond(tableau, family, known, facts, meter)
        else:
            known = replace(known, claimed=claimed, required=required)
        known_orders.append(known)
    return tuple(known_orders[len(beside) :])


Reading = tuple[Tableau, Family, int | None]
"""A tableau, a family that accepts the tableau, and the claimed order in this family."""


def _beside(tableau: Tableau, wanted: Sequence[tuple[Family, int | None]], required: int) -> list[Reading]:
    if all(max(claimed or 0, required) < family.search_limit for family, claimed in wanted):
        return []
    return _bounding(tableau, {family.label() for family, _ in wanted})


def _bounding(tableau: Tableau, labels: Collection[str]) -> list[Reading]:
    """Return one tuple for each family of ``tableau`` whose attribute ``bounds_others`` is true.

    For example, the order in ``rk`` is an upper bound of the order in ``cg``.

    The first entry of each tuple is ``tableau``, or ``tableau`` as a composition. The second entry is a
    family that accepts the first entry. The third entry is the claimed order in this family. Families with a
    label in ``labels`` are omitted.
    """
    from orderconds.checking.claimable import claimable_families
    from orderconds.tableau.recognise import as_composition

    readings: dict[str, Reading] = {}
    for read_as in filter(None, (as_composition(tableau), tableau)):
        for family in claimable_families(read_as):
            if family.bounds_others and family.label() not in labels:
                readings.setdefault(family.label(), (read_as, family, tableau.claims.order(family.name)))
    return list(readings.values())


def _beyond(
    tableau: Tableau, family: Family, ended: FamilyOrder, facts: tuple[Fact, ...], meter: Meter
) -> FamilyOrder:
    """Derive the order in ``family`` from the orders in other families.

    ``ended`` is the result of a search in ``family`` that reached a limit, so ``ended.order`` is only a lower
    bound. If the orders in other families do not determine the order in ``family``, return ``ended``.
    """
    bounding = _bounding(tableau, [family.label()])
    bounding_orders = [family_order(read_as, other, claim, meter=meter) for read_as, other, claim in bounding]
    known = _settled(tableau, family, bounding_orders, facts)
    if known is not None:
        return replace(known, claimed=ended.claimed, required=ended.required)
    from orderconds.proof.implications import least_order

    orders = _decided(bounding_orders) if ended.certificate == "decimal" else _proved(bounding_orders)
    least = least_order((*facts, *orders.items()), family)
    failing = first_failing(tableau, family, least + 1) if least >= ended.order else ()
    return replace(ended, order=least, failing=failing, limit=None, stopped=None) if failing else ended


def _bound(family: Family, computed: Sequence[FamilyOrder]) -> FamilyOrder | None:
    """Return the entry of ``computed`` that gives the smallest upper bound of the order in ``family``.

    Each entry contains the order of the tableau in one family. For example, the order in ``rk`` is an upper
    bound of the order in ``cg``, because order n in ``cg`` implies order n in ``rk``. If no entry gives a
    bound, return None.
    """
    if not computed:
        return None
    from orderconds.proof.implications import consequences

    among = consequences([(family.label(), 1)])
    bounds = [f for f in computed if f.family in among and f.decided and f.failing]
    return min(bounds, key=lambda f: f.order, default=None)


def _decided(computed: Sequence[FamilyOrder]) -> dict[str, int]:
    """Map the labels of families to computed orders. Undecided orders are omitted."""
    return {f.family: f.order for f in computed if f.decided}


def _proved(computed: Sequence[FamilyOrder]) -> dict[str, int]:
    """Map the labels of families to proved orders."""
    return _decided([f for f in computed if f.certificate != "decimal"])


def _settled(
    tableau: Tableau, family: Family, computed: Sequence[FamilyOrder], facts: tuple[Fact, ...]
) -> FamilyOrder | None:
    """Derive the order in ``family`` from the orders in other families.

    Return None if no order follows, or if the order is below ``family.search_limit``.
    """
    proved = [f for f in computed if f.certificate != "decimal"]
    settled = _settled_by(tableau, family, proved, facts)
    if settled is None and len(computed) > len(proved):
        settled = _settled_by(tableau, family, computed, facts)
        return settled and _certified(replace(settled, certificate="decimal"), family, facts)
    return settled


def _settled_by(
    tableau: Tableau, family: Family, computed: Sequence[FamilyOrder], facts: tuple[Fact, ...]
) -> FamilyOrder | None:
    known = {f.family: f for f in computed if f.decided and f.failing}
    beyond = family.search_limit
    if all(f.order < beyond for f in known.values()):
        return None
    from orderconds.proof.implications import settled

    orders = {label: f.order for label, f in known.items()}
    own = family.order_of_tableau(tableau.method, tableau.ring, orders)
    order = settled((*facts, *_decided(computed).items(), (family.label(), own)), orders, family)
    if order is None or order < beyond:
        return None
    bound = min(known.values(), key=lambda f: (f.order != order, f.certificate != "exact"))
    certificate = "ball" if any(f.certificate == "ball" for f in computed if f.decided) else "exact"
    return FamilyOrder(family.label(), order, certificate, True, bound.failing, None)


def _certified(computed: FamilyOrder, family: Family, facts: tuple[Fact, ...]) -> FamilyOrder:
    """Replace the certificate ``decimal`` (not proved) by ``ball`` (proved) if ``facts`` imply the order.

    ``facts`` contains proved pairs (family, order).
    """
    if computed.certificate != "decimal" or not facts:
        return computed
    from orderconds.proof.implications import implied

    return replace(computed, certificate="ball") if implied(facts, family, computed.order) else computed


def read(given: str | PathLike[str], *, execute: bool = False) -> Tableau:
    """Read a tableau from a file of any format, or from the library if ``given`` is a name.

    A Python module is executed if ``execute`` is true, and otherwise only parsed.

    >>> read("rk4").name
    'rk4'
    """
    if execute and Path(given).suffix == ".py":
        from orderconds.exchange import load_foreign

        if (foreign := load_foreign(Path(given), execute=True)) is not None:
            return foreign
    return Tableau.load(given)


def _wanted(tableau: Tableau, family: str | None) -> Iterator[tuple[Family, int | None]]:
    """Yield pairs (family to check, claimed order)."""
    claims = {claim.label: claim.order for claim in tableau.claims.orders}
    if family is not None:
        member = families.get(family)
        yield member, claims.get(member.label())
        return
    for label, order in claims.items():
        yield _claimed(tableau, label), order
    if not claims:
        yield families.get(tableau.family).for_method(tableau.method), None


def _members(tableau: Tableau, family: str | None) -> tuple[list[tuple[Family, int | None]], list[str]]:
    """Return pairs (family to check, claimed order). Also return a message for each claimed family to which
    the method does not belong."""
    wanted = [*_wanted(tableau, family)]
    if family is not None or not tableau.claims.orders:
        return wanted, []
    members, messages = [], []
    for member, claimed in wanted:
        method = member.read(tableau)
        try:
            if method is not None:
                member.require(method, tableau.ring)
        except InputError as problem:
            messages.append(
                f"{member.label()}: the method is not in this family, because {problem.found}; "
                f"expected {problem.expected}"
            )
        else:
            members.append((member, claimed))
    return members, messages


def _claimed(tableau: Tableau, label: str) -> Family:
    """Return the family with the label ``label``.

    Raise an InputError if the family does not exist, or does not accept the format of the tableau.
    """
    where = f"{tableau.path or tableau.name}: claims.{label.partition('(')[0]}"
    try:
        family = families.get(label)
    except InputError as problem:
        problem.where = where
        raise
    if tableau.family not in family.formats and family.read(tableau) is None:
        from orderconds.checking.claimable import claimable_families

        readers = ", ".join(member.label() for member in claimable_families(tableau))
        raise InputError(
            f"the tableau claims an order in family {label}, but this family does not accept tableaux of "
            f"format {tableau.family}",
            where=where,
            expected=f"a family that accepts this format, such as {readers}",
        )
    return family


def _broken_claims(
    tableau: Tableau, computed: dict[str, bool | None], embedded: EmbeddedOrder | None
) -> Iterator[str]:
    """Yield messages about failing claims: claims about properties and about the embedded method."""
    for name, claimed in tableau.claims.properties.items():
        holds = computed.get(name)
        if holds is not claimed:
            said = "undecided" if holds is None else str(holds).lower()
            yield f"property {name}: claimed {str(claimed).lower()}, computed {said}"
    if embedded is not None and embedded.orders[embedded.own] != embedded.claimed:
        order = embedded.orders[embedded.own]
        reason = f"; {embedded.failing[0]}" if order < embedded.claimed and embedded.failing else ""
        yield (
            f"the embedded method has order {order} ({embedded.own}), "
            f"not {embedded.claimed} as claimed{reason}"
        )


def _broken_extension(dense: ExtensionOrder | None) -> Iterator[str]:
    """Yield a message if the continuous extension is not continuous or does not have the claimed order."""
    if dense is None:
        return
    if dense.order != dense.claimed:
        reason = f"; {dense.failing[0]}" if dense.failing else ""
        yield f"the continuous extension has order {dense.order}, not {dense.claimed} as claimed{reason}"
    if dense.continuous is False:
        yield "the continuous extension does not end at the new state: some b_i(1) differs from b_i"


def _missing_claims(enclosed: Tableau, tableau: Tableau) -> Iterator[str]:
    """Yield a message for each family in which the file should claim an order, but does not.

    The order in the message is the order of ``enclosed``. If :func:`_proof` proves that the equations in the
    table ``[proof]`` have a solution, ``enclosed`` contains this solution as intervals. Otherwise,
    ``enclosed`` is ``tableau``.
    """
    from orderconds.checking.claimable import unclaimed

    for family in unclaimed(tableau):
        computed = family_order(enclosed, family)
        least = " at least" if computed.limit is not None or not computed.decided else ""
        order = f"order{least} {computed.order}"
        yield f"no claim in family {family.label()}; the method has {order} in this family"
