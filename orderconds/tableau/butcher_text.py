"""A Butcher tableau as text: the column c, the matrix A, a horizontal line, and below the line the row b."""

from __future__ import annotations

from decimal import Decimal

from orderconds.ring import Ball, Balls, Element
from orderconds.tableau.record import Tableau

SHORT = Balls(64)
"""The ring of 64-bit balls (intervals) for printing coefficients."""

DIGITS = 24
"""A decimal with at most this number of characters is printed unchanged."""


def butcher_text(tableau: Tableau) -> list[str]:
    """Return the lines of the Butcher tableau. Rounded coefficients are printed as decimals that end with "~"
    and have about twenty digits. Embedded weights are not printed.

    For a commutator-free method, the result is the Runge-Kutta tableau to which the method reduces on vector
    spaces. For a composition of a symmetric method of order 2, the result is the tableau of the composition
    of implicit midpoint steps. For a composition of a method and its adjoint, the steps of the method are
    replaced by explicit Euler steps, and the steps of the adjoint are replaced by implicit Euler steps. The
    result is the tableau of this composition of Euler steps.

    Raises :class:`orderconds.errors.TableauError` for splitting methods and Magnus methods.

    >>> from orderconds.tableau import find
    >>> print("\\n".join(butcher_text(Tableau.load(find("gauss2")))))
    1/2 - sqrt(3)/6 | 1/4              1/4 - sqrt(3)/6
    1/2 + sqrt(3)/6 | 1/4 + sqrt(3)/6  1/4
    ----------------+---------------------------------
                    | 1/2              1/2
    """
    method = tableau.abelian()
    rows = [[entry(tableau, x) for x in row] for row in method.A]
    below = [[entry(tableau, x) for x in method.b]]
    nodes = [entry(tableau, x) for x in method.c]
    widths = [max(len(row[k]) for row in [*rows, *below]) for k in range(len(method.b))]
    left = max(map(len, nodes))

    def line(first: str, cells: list[str]) -> str:
        padded = (cell.ljust(width) for cell, width in zip(cells, widths, strict=True))
        return f"{first.ljust(left)} | {'  '.join(padded)}".rstrip()

    rule = "-" * left + "-+-" + "-" * (sum(widths) + 2 * (len(widths) - 1))
    return [*(line(c, row) for c, row in zip(nodes, rows, strict=True)), rule, *(line("", b) for b in below)]


def entry(tableau: Tableau, x: Element) -> str:
    """Return the text of a coefficient. An interval coefficient is printed as a decimal that ends with "~".

    >>> from orderconds.tableau import find
    >>> yoshida = Tableau.load(find("yoshida6"))
    >>> entry(yoshida, yoshida.abelian().b[0])
    '0.784513610477557264~'
    """
    if not isinstance(x, Ball):
        return tableau.ring.text(x)
    text = SHORT.text(SHORT.enclose(x.value) + 0)
    if len(text) <= DIGITS:
        return text
    # For a number near zero, the format ``g`` prints an exponent instead of many leading zeros.
    return f"{Decimal(text.rstrip('~')):.{DIGITS - 2}g}~"
