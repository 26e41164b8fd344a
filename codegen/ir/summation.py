"""The order of additions in a sum of one large term and two small corrections."""

from __future__ import annotations

from codegen.ir.domain import Domain, Scalar


class ShortChains:
    """Base class of domains in which :func:`corrected` computes (x + a) + b instead of x + (a + b).

    Often b is computed last. Then (x + a) + b is ready one addition after b, and x + (a + b) two additions
    after b.
    """


def corrected(d: Domain, base: Scalar, first: tuple[Scalar, Scalar], second: tuple[Scalar, Scalar]) -> Scalar:
    """Return ``base`` plus two small corrections. Each correction is the product of a pair of factors.

    The corrections are added first, because the sum of two small terms has a small rounding error. But in a
    domain of the class :class:`ShortChains`, ``base`` and the first correction are added first, because a
    processor can execute this addition before the second correction is known.
    """
    # The order of the operations also determines the order of the assignments in emitted code.
    if isinstance(d, ShortChains):
        return base + first[0] * first[1] + second[0] * second[1]
    return base + (first[0] * first[1] + second[0] * second[1])
