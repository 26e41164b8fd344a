"""Refinement of a tableau: more precise coefficients replace the given ones.

The new coefficients are exact numbers, or decimals with a given number of proved digits.
"""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike

from orderconds.argument import DIGITS, integer
from orderconds.checking.exact_forms import exact_forms
from orderconds.checking.refuted import refuted_claims
from orderconds.proof import refine as newton
from orderconds.proof.certificate import Certificate, certify
from orderconds.proof.krawczyk import NotProved
from orderconds.tableau import Tableau, dumps


@dataclass(frozen=True, repr=False)
class Refinement:
    """The result of :func:`refine`: the refined ``tableau``, and how its coefficients were obtained.

    If the file has a table ``[proof]`` with equations for the coefficients, these fields are set:

    - ``decimals`` maps the names of the changed coefficients to their new decimals.
    - ``pinned`` contains the names of the coefficients whose digits did not change.
    - ``proof`` certifies that the equations have a solution near the new decimals.

    Without this table, ``exact`` maps the name of each replaced coefficient to its exact value.
    """

    tableau: Tableau
    decimals: dict[str, str]
    pinned: tuple[str, ...] = ()
    proof: Certificate | None = None
    exact: dict[str, str] | None = None

    def __repr__(self) -> str:
        if self.proof is None:
            return f"<exact {self.tableau!r}>"
        return f"<refined {self.tableau!r}: {len(self.decimals)} decimals within {self.proof.radius}>"

    def _repr_html_(self) -> str:
        return self.tableau._repr_html_()


def refine(tableau: Tableau | str | PathLike[str], digits: int = 60) -> Refinement:
    """Make the coefficients of a tableau exact or more precise.

    ``tableau`` is a tableau, the path of a file, or the name of a tableau in the library.

    - If the file has a table ``[proof]``, the equations of the table are solved. The solution is returned as
      decimals with ``digits`` correct places. ``digits`` may be 10 to 1000.
    - Without this table, each double or rounded decimal becomes a fraction or a number p + q sqrt(d) with
      rational p and q. The exact method has at least the order of the given method, and ``digits`` has no
      effect.

    Raises :class:`~orderconds.proof.krawczyk.NotProved` in three cases: the equations are not proved to have
    a solution near the given decimals, no exact numbers are found, or a claim of the tableau is wrong.

    >>> refine("cg4a", digits=30)
    <refined Tableau('cg4a', rk, 5 stages): 13 decimals within 4.88e-31>
    >>> refine(Tableau.rk([[0, 0], [2 / 3, 0]], [1 / 4, 3 / 4])).tableau.A[1]
    (Fraction(2, 3), Fraction(0, 1))
    """
    given = tableau if isinstance(tableau, Tableau) else Tableau.load(tableau)
    digits = integer(digits, "digits", DIGITS)
    if given.proof is None:
        forms = exact_forms(given)
        if forms is None:
            raise NotProved(
                "found no exact numbers that agree with the coefficients and preserve the order of the method"
            )
        _require_claims(forms.tableau)
        return Refinement(forms.tableau, {}, exact=forms.texts)
    where = given.path or given.name
    refined = newton.refine(dumps(given), where, digits)
    sharper = Tableau.loads(refined.text, where)
    proof = certify(sharper)
    _require_claims(sharper)
    return Refinement(sharper, refined.decimals, refined.pinned, proof)


def _require_claims(tableau: Tableau) -> None:
    """Raise NotProved if the new coefficients refute a claim of the tableau."""
    if refuted := refuted_claims(tableau):
        raise NotProved(f"a claim of the tableau is wrong: {'; '.join(refuted)}; correct the claim")
