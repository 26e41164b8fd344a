"""Heisenberg spins on a plane lattice: the Landau-Lifshitz equation with exchange, anisotropy and a field.

Each site has a spin S of length one. The spin turns about the effective field H: S' = H x S. The scene omits
the damping term in the equation of L. D. Landau and E. M. Lifshitz (Phys. Z. Sowjetunion 8 (1935) 153-169). H
is the sum of three terms: the exchange field, the anisotropy field and an external field. The exchange field
is J times the sum of the four neighbouring spins. The lattice is periodic.

As in J. Frank, W. Huang and B. Leimkuhler (J. Comput. Phys. 133 (1997) 160-172), the energy is split into the
energies of pairs of neighbours and the energies of single spins. The exact flow of the energy of a pair turns
the two spins about their sum. The exact flow of the energy of a single spin turns the spin about the third
axis.
"""

from sympy import Matrix, Rational, symbols, zeros

from codegen.groups import SO3, Rotation
from codegen.scene import Bond, Pair, SiteScene, neighbour, param

S = Matrix(symbols("S0:3", real=True))
J, K, B = param("J", 1), param("K", Rational(1, 2)), param("B", Rational(1, 5))
offsets = [(1, 0), (0, 1)]
around = [neighbour(S, (x * i, x * j)) for i, j in offsets for x in (1, -1)]
single = Matrix([0, 0, K * S[2] + B])
# The spins S and T of a pair turn about J (S + T), because S' = J T x S = J (S + T) x S.
sums = [J * (S + neighbour(S, offset)) for offset in offsets]

scene = SiteScene(
    title="Heisenberg spins on a plane lattice: the Landau-Lifshitz equation",
    group=SO3(),
    action=Rotation(),
    y=S,
    f=J * sum(around, zeros(3, 1)) + single,
    y0=[Rational(3, 5), 0, Rational(4, 5)],
    span=(0, 10),
    parts={
        "single": single,
        "rows": Pair(offsets[0], sums[0], sums[0]),
        "columns": Pair(offsets[1], sums[1], sums[1]),
    },
    energy=-K * S[2] ** 2 / 2 - B * S[2],
    bonds=[Bond(offset, -J * S.dot(neighbour(S, offset))) for offset in offsets],
    invariants={"length": S.dot(S)},
)
