"""Wilson flow of a lattice gauge field: links in SU(3) between the sites of a periodic lattice.

The equation of a link V is V' = -g0^2 (dS(V)) V, where g0 is the coupling constant and S is the Wilson action
(M. Luescher, Properties and uses of the Wilson flow in lattice QCD, JHEP 08 (2010) 071, arXiv:1006.4518,
section 1).

The lattice has links along all axes. A link along an axis leads from a site to the next site in the direction
of the axis. A link V is stored as a real 6 x 3 matrix: Re V above Im V. A plaquette is a square of four
links. For each plaquette that contains V, the product of the other three links is a staple of V. Let X be the
product of V and the sum of the staples of V. The generator -g0^2 dS(V) is the traceless anti-Hermitian part
of -X.

The variable ``energy`` is the density of the action at a site: the sum of 2 Re tr(1 - P) over the plaquettes
P of the site. Each site has one plaquette for each pair of axes.
"""

from collections.abc import Sequence
from itertools import combinations
from random import Random

import numpy as np
from sympy import Matrix, Symbol, eye, symbols, zeros

from codegen.groups import SU, Columns, FactorwiseAction, Product
from codegen.scene import SiteScene, neighbour
from codegen.scene.figure import LatticeMeans, Run
from codegen.scenes.wilson_flow import full, generator, product

DIMENSION = 4
axes = range(DIMENSION)
links = [x for k in axes for x in symbols(f"v{k}_0:6(0:3)", real=True)]


def link(axis: int, *steps: tuple[int, int]) -> Matrix:
    """Return the real 6 x 6 matrix of a link along ``axis``.

    The path ``steps`` leads from the current site to the site where the link begins. Each step is a pair: an
    axis, and a sign for the direction.
    """
    offset = [sum(sign for along, sign in steps if along == e) for e in axes]
    site = neighbour(links, offset) if any(offset) else links
    return full(Matrix(6, 3, site[18 * axis : 18 * axis + 18]))


def staples(a: int) -> Matrix:
    """Return the sum of the staples of the link along axis ``a``, as a real 6 x 3 matrix.

    The upper three rows are the real part of the sum, and the lower three rows are the imaginary part.
    """
    total = zeros(6, 3)
    for b in [b for b in axes if b != a]:
        total += product(link(b, (a, 1)), link(a, (b, 1)).T, link(b).T[:, :3])
        total += product(link(b, (a, 1), (b, -1)).T, link(a, (b, -1)).T, link(b, (b, -1))[:, :3])
    return total


def start(shape: Sequence[int]) -> np.ndarray:
    """Return random links for a lattice of the given shape (n1, ..., nd). The seed is fixed.

    The result has the shape (n1, ..., nd, 18 d).
    """
    draw, count = Random(1006), DIMENSION * int(np.prod(shape))
    parts = np.array([draw.gauss(0, 1) for _ in range(12 * count)]).reshape(count, 2, 2, 3)
    first, second = np.moveaxis(parts[:, 0] + 1j * parts[:, 1], 1, 0)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second -= (first.conj() * second).sum(axis=1, keepdims=True) * first
    second /= np.linalg.norm(second, axis=1, keepdims=True)
    columns = np.stack([first, second, np.cross(first, second).conj()], axis=2)
    return np.concatenate([columns.real, columns.imag], axis=1).reshape(*shape, -1)


# Each entry is a 6 x 3 matrix: the real part of a plaquette, and below it the imaginary part.
plaquettes = [
    product(link(a), link(b, (a, 1)), link(a, (b, 1)).T, link(b).T[:, :3]) for a, b in combinations(axes, 2)
]
energy = sum(6 - 2 * plaquette[:3, :].trace() for plaquette in plaquettes)
scene = SiteScene(
    title=f"Wilson flow of a lattice gauge field in SU(3), dimension {DIMENSION}",
    group=Product(*(SU(3) for _ in axes)),
    action=FactorwiseAction(*(Columns(3) for _ in axes)),
    y=links,
    f=[x for a in axes for x in generator(product(link(a), staples(a)))],
    y0=[*Matrix.vstack(eye(3), zeros(3, 3))] * DIMENSION,
    span=(0, 1),
)
figures = [
    LatticeMeans(
        name="energy",
        title="Density of the action along the Wilson flow",
        axis="t² E(t)",
        quantities={"t² E": Symbol("t") ** 2 * energy},
        shape=(4,) * DIMENSION,
        start=start,
        runs=(Run("cf:luescher3", 0.02, 100, stride=2),),
    )
]
