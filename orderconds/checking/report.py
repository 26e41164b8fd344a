"""The report of a check.

A report contains the properties and claims of a tableau, and the orders of the tableau and of its embedded
method.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from msgspec import Struct

from orderconds.checking.order import FamilyOrder
from orderconds.checking.residuals import Failure
from orderconds.tableau.work import Work

if TYPE_CHECKING:
    from orderconds.proof.certificate import Certificate


UNCLAIMED = "unclaimed"
"""The verdict on a tableau without a claimed or required order."""


class EmbeddedOrder(Struct, frozen=True):
    """The orders of the embedded method.

    The embedded method uses the stages of the main method, but has different weights or exponentials in the
    last update.

    - ``own`` is the label of the family in which the order is claimed: ``rk`` for an update with weights, and
      ``cf`` for an update with exponentials.
    - ``claimed`` is the claimed order in the family ``own``.
    - ``orders`` maps the labels of families to the computed orders of the embedded method.
    - ``certificates`` maps the labels of families to the certificates of the orders in ``orders``.
    - ``failing`` contains the failing conditions of order ``orders[own] + 1`` in the family ``own``.
    """

    claimed: int
    orders: dict[str, int]
    certificates: dict[str, str]
    own: str
    failing: tuple[Failure, ...] = ()

    def as_json(self) -> dict[str, object]:
        """Return the entry of the embedded method in the JSON output of ``orderconds check``."""
        return {"claimed": self.claimed, "orders": self.orders, "certificates": self.certificates}


class ExtensionOrder(Struct, frozen=True):
    """The claimed and the computed order of a continuous extension in the family ``rk``.

    - ``continuous`` states whether the solution is continuous from one step to the next. The solution is
      continuous if the weights b_i(theta) of the extension satisfy b_i(1) = b_i.
    - ``smooth`` states whether the first derivative of the solution is continuous, too.
    - ``continuous`` or ``smooth`` is None if the digits of the coefficients do not decide the question.
    - ``failing`` contains failing conditions of order p + 1, where p is the computed order.
    """

    claimed: int
    order: int
    certificate: str
    continuous: bool | None
    smooth: bool | None
    failing: tuple[Failure, ...] = ()

    def as_json(self) -> dict[str, object]:
        """Return the entry of the continuous extension in the JSON output of ``orderconds check``."""
        return {
            "claimed": self.claimed,
            "order": self.order,
            "certificate": self.certificate,
            "continuous": self.continuous,
            "smooth": self.smooth,
        }


class RegisterForm(Struct, frozen=True):
    """A scheme with two registers K and Y (2N storage) that computes the steps of a method.

    Let F be the vector field. On a group, stage i computes K <- A_i K + F(Y), and then Y <- exp(h B_i K) Y.
    On a vector space, the second update is Y <- Y + h B_i K.

    - ``holds`` states whether the scheme exists. The value is None if the coefficients of the method are
      rounded and have too few digits for a decision.
    - ``space`` is ``group`` or ``vector space`` and selects the second update.
    - ``A`` and ``B`` are the coefficients A_i and B_i as text.
    - ``reason`` states why no scheme is given.
    """

    holds: bool | None
    space: str
    A: tuple[str, ...] = ()
    B: tuple[str, ...] = ()
    reason: str = ""

    def as_json(self) -> dict[str, object]:
        """Return the entry of the scheme in the JSON output of ``orderconds check``."""
        record: dict[str, object] = {"holds": self.holds, "space": self.space}
        if self.reason:
            return {**record, "reason": self.reason}
        return {**record, "A": list(self.A), "B": list(self.B)}


class SymmetryOrder(Struct, frozen=True):
    """The largest order q to which a method is symmetric.

    The composition of a step of size h and a step of size -h differs from the identity by O(h^(q + 1)).

    - ``family`` is ``rk`` for methods on vector spaces and ``cf`` for methods on groups.
    - ``order`` is q, or None if the method is symmetric to every order.
    - ``at_least`` is true if ``order`` is only a lower bound.
    - ``certificate`` is ``exact`` if q is proved, and ``decimal`` if rounded coefficients prevent a proof.
    """

    family: str
    order: int | None
    certificate: str = "exact"
    at_least: bool = False

    def as_json(self) -> dict[str, object]:
        """Return the four attributes in a dictionary, for the JSON output of ``orderconds check``."""
        return {
            "family": self.family,
            "order": self.order,
            "at_least": self.at_least,
            "certificate": self.certificate,
        }


@dataclass(frozen=True, repr=False)
class Report:
    """The result of ``check`` for one tableau.

    ``orders`` contains the orders of the main method, with a verdict on each claimed order. ``broken_claims``
    describes all other failures: for example false claims about properties, or missing claims.
    """

    name: str
    file: str | None
    format: str
    orders: tuple[FamilyOrder, ...]
    properties: dict[str, bool | None]
    broken_claims: tuple[str, ...] = ()
    undecided: dict[str, str] = field(default_factory=dict)
    """Maps each undecided property to the reason why it is undecided."""
    proof: Certificate | None = None
    work: dict[str, Work] = field(default_factory=dict)
    embedded: EmbeddedOrder | None = None
    dense: ExtensionOrder | None = None
    low_storage: RegisterForm | None = None
    symmetry: SymmetryOrder | None = None
    properties_claimed: bool = False
    hint: str = ""
    """A suggestion for the author of the tableau file, or an empty text."""

    @property
    def verdict(self) -> str:
        """The verdict on the tableau, as one of four words.

        - ``fails``: at least one claim fails.
        - ``undecided``: no claim fails, but at least one claim is undecided.
        - ``holds``: all claims hold.
        - ``unclaimed``: no order is claimed or required.
        """
        verdicts = {family.verdict for family in self.orders}
        if self.broken_claims or "fails" in verdicts:
            return "fails"
        return next((v for v in ("undecided", "holds") if v in verdicts), UNCLAIMED)

    @property
    def conclusion(self) -> str:
        """The verdict as text. If no order is claimed or required, the text contains the computed orders."""
        if self.verdict != UNCLAIMED:
            return self.verdict
        several = len(self.orders) > 1
        orders = (family.sentence + (f" ({family.family})" if several else "") for family in self.orders)
        return f"{', '.join(orders)}; {'no order' if self.properties_claimed else 'nothing'} claimed"

    @property
    def effective_symmetry(self) -> int | None:
        """The order of symmetry of an effectively symmetric method. For other methods, the value is None.

        A method of order p is effectively symmetric if its order of symmetry is finite and larger than p + 1.
        """
        if self.symmetry is None or self.symmetry.order is None or self.symmetry.at_least:
            return None
        order = next((f.order for f in self.orders if f.family == self.symmetry.family), None)
        implied = None if order is None else 2 * (order // 2) + 1
        return self.symmetry.order if implied is not None and self.symmetry.order > implied else None

    def __repr__(self) -> str:
        orders = ", ".join(f"{family.family} {family.order}" for family in self.orders)
        claimed = self.verdict != UNCLAIMED
        return f"Report({self.name}: {self.conclusion}{f'; {orders}' if claimed else ''})"

    def _repr_html_(self) -> str:
        from orderconds.checking.report_html import report_html

        return report_html(self)

    def summary(self) -> str:
        """Return a short text about the claims that do not hold.

        For each claimed or required order that does not hold, the text contains the first failing condition.
        """
        lines = [f"{self.name}: {self.conclusion}" + (f"  ({self.file})" if self.file else "")]
        for family in self.orders:
            if family.verdict not in ("holds", UNCLAIMED):
                wanted = family.claimed if family.required is None else f"at least {family.required}"
                lines.append(f"  {family.family}: order {family.order}, claimed {wanted}")
                lines += [f"    {failure}" for failure in family.failing[:1]]
        return "\n".join([*lines, *(f"  claim fails: {broken}" for broken in self.broken_claims)])

    def as_json(self) -> dict[str, object]:
        """Return the entry of the tableau in the JSON output of ``orderconds check``."""
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
        if self.dense is not None:
            record["dense"] = self.dense.as_json()
        if self.low_storage is not None:
            record["low_storage"] = self.low_storage.as_json()
        if self.symmetry is not None:
            record["symmetry"] = self.symmetry.as_json()
        if self.proof is not None:
            record["proof"] = self.proof.as_json()
        if self.undecided:
            record["undecided"] = self.undecided
        if self.hint:
            record["hint"] = self.hint
        return {**record, "broken_claims": list(self.broken_claims)} if self.broken_claims else record
