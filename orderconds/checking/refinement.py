"""A tableau with more digits in its rounded decimals, and the proof of these digits."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike

from orderconds.proof import refine as newton
from orderconds.proof.certificate import Certificate, certify
from orderconds.tableau import Tableau, dumps


@dataclass(frozen=True, repr=False)
class Refinement:
    """The ``tableau`` with new digits, the ``decimals`` by name, the names of the decimals that were kept
    fixed (``pinned``), and the ``proof``."""

    tableau: Tableau
    decimals: dict[str, str]
    pinned: tuple[str, ...]
    proof: Certificate

    def __repr__(self) -> str:
        return f"<refined {self.tableau!r}: {len(self.decimals)} decimals within {self.proof.radius}>"

    def _repr_html_(self) -> str:
        return self.tableau._repr_html_()


def refine(tableau: Tableau | str | PathLike[str], digits: int = 60) -> Refinement:
    """Compute ``digits`` places of the decimals of a tableau whose file has a table ``[proof]``, and prove
    them.

    ``tableau`` may also be a file or a name of the library. Raises
    :class:`~orderconds.proof.krawczyk.NotProved` if there is no ``[proof]``, or no solution near the decimals
    is proved.

    >>> refinement = refine("cg4a", digits=30)
    >>> refinement
    <refined Tableau('cg4a', rk, 5 stages): 5 decimals within 1.1e-29>
    """
    given = tableau if isinstance(tableau, Tableau) else Tableau.load(tableau)
    where = given.path or given.name
    refined = newton.refine(dumps(given), where, digits)
    sharper = Tableau.loads(refined.text, where)
    return Refinement(sharper, refined.decimals, refined.pinned, certify(sharper))
