"""The error norm of a scene: the distance of a computed state from the reference solution.

The error norm is the sum of the norms of the differences of all components (for example, a group element and
a momentum). For group elements given by square matrices, the spectral norm is used. For all other components,
the Euclidean norm is used.

For a momentum mu and a rotation matrix g with reference values mu_ref and g_ref, the error norm is |mu -
mu_ref|_2 + |g - g_ref|_2 (H. Marthinsen, *On symplectic integration in Lie groups and manifolds*, Fig. 3.2).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from codegen.groups import LieGroup
from codegen.groups.capabilities import DirectProduct, MatrixElements
from codegen.ir.values import Kind
from codegen.lab.number_types import Scalar
from codegen.scene.problem import Problem


def distance(scene: Problem, state: Sequence[Scalar], exact: Sequence[Scalar]) -> float:
    """Return the distance of a computed state from the reference ``exact``, in the error norm of a scene.

    ``state`` and ``exact`` list the coordinates in the order of ``scene.symbols``. Differences are computed
    in the precision of ``exact``. If a coordinate of ``state`` is not finite, the result is infinite.
    """
    gap = [float(b - a) for a, b in zip(state, exact, strict=True)]
    if not all(map(math.isfinite, gap)):
        return math.inf
    total, start = 0.0, 0
    for block in scene.state:
        end = start + len(block.symbols)
        own = gap[start:end]
        total += _norm(scene.group, own) if block.kind is Kind.GROUP else euclidean_norm(own)
        start = end
    return total


def _norm(group: LieGroup, gap: Sequence[float]) -> float:
    """Return the norm of the difference ``gap`` of two group elements."""
    product = group.offers(DirectProduct)
    if product is not None:
        return sum(map(_norm, product.factors, product.parts(tuple(gap))))
    return euclidean_norm(gap) if group.offers(MatrixElements) is None else spectral_norm(gap)


def euclidean_norm(vector: Sequence[float]) -> float:
    """Return the Euclidean norm of a vector, without overflow or underflow in the squares.

    >>> euclidean_norm([3e-200, 4e-200])
    5e-200
    """
    return math.hypot(*vector)


def spectral_norm(matrix: Sequence[float]) -> float:
    """Return the spectral norm of a square matrix, or the Frobenius norm of a non-square matrix.

    ``matrix`` lists the entries row by row. If the number of entries is a square number, the matrix is
    assumed to be square.

    >>> round(spectral_norm([0.0, -2.0, 1.0, 0.0]), 12)
    2.0
    """
    import numpy

    n = math.isqrt(len(matrix))
    if n * n != len(matrix):
        return euclidean_norm(matrix)
    return float(numpy.linalg.norm(numpy.reshape(matrix, (n, n)), 2))
