"""Products of generators. Each generator has a degree, and the degree of a product is the sum of the degrees
of its factors. In the selection of order conditions, the generators are left-hand sides of conditions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from orderconds.ring.protocol import Element


def products(generators: Sequence[tuple[int, Element]], degree: int) -> Iterator[Element]:
    """Yield the value of every monomial of degree ``degree`` in the generators. Each generator is a pair
    (degree, value).

    >>> list(products([(1, 3), (2, 5)], 3))  # x^3 and x y, where x = 3 and y = 5
    [27, 15]
    """
    yield from _monomials(generators, degree, 0, None)


def _monomials(
    generators: Sequence[tuple[int, Element]], degree: int, start: int, so_far: Element | None
) -> Iterator[Element]:
    if degree == 0:
        if so_far is not None:
            yield so_far
        return
    for place in range(start, len(generators)):
        weight, value = generators[place]
        if weight <= degree:
            term = value if so_far is None else so_far * value
            yield from _monomials(generators, degree - weight, place, term)
