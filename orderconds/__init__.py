"""Derive, prove and compile Lie group integrators.

A method is given by a tableau and a family. A comparison of the series of the method with the series of the
exact flow gives the order conditions.

Conventions
-----------
*Action and trivialisation.* A Lie group G acts from the left and is trivialised from the right: the equation
is y' = f(y).y, where f maps the manifold M to the Lie algebra g. In exp(h b_s k_s) ... exp(h b_1 k_1).y0 with
weights b_i and stage values k_i, **the first stage acts first**. For a right action, every bracket in a
method has the opposite sign.

*Brackets.* The bracket of matrices is [A, B] = AB - BA, and ad_x y = [x, y]. The adjoint map Ad_g
is the derivative of the map x -> g x g^-1 at the identity. Ad*_g is the dual map of Ad_g (not of Ad_{g^-1}),
so Ad*_{gh} = Ad*_h Ad*_g. ad*_x is the dual map of ad_x. For the group SO(3), the Lie algebra and its dual
are identified with R^3. Then Ad*_g mu = g^T mu, and ad*_x mu is the negative cross product of x and mu.

*The derivative of exp.* dexp_x = sum_k ad_x^k/(k+1)! and dexp^{-1}_x = sum_k B_k/k! ad_x^k, where B_k are the
Bernoulli numbers with B_1 = -1/2. The truncated series dexp^{-1}_{(r),x} is the sum of the terms k <= r.
Because B_3 = 0, the series for r = 2 and r = 3 are equal. On every group, dexp_x o dexp^{-1}_{-x} = Ad_{exp
x}. On SO(3), dexp*_x = dexp_{-x}.

*Phase space.* T*G is the group G x g* with the product (g, mu)(h, nu) = (gh, mu + Ad*_{g^-1} nu). A
Hamiltonian H(q, mu) gives f(q, mu) = (xi, n) = (D_2 H, -(D_1 H).q^{-1}), where D_1 and D_2 are derivatives
with respect to q and mu. The equations of motion are q' = xi.q and mu' = n - ad*_xi mu.

*Symplectic partitioned tableaux.* The first tableau has the weights b_i and the entries a_ij. The second
tableau has the weights bhat_i = b_i and the entries ahat_ij = b_j - b_j a_ji/b_i. All b_i must be
non-zero. The nodes are c_i = sum_j a_ij and chat_i = sum_j ahat_ij.

*Order.* A method has order p when its series agrees with the series of the exact flow through the power h^p.
A word is a sequence t_1 ... t_k of letters, such as trees or vector fields. The letter t_1 acts first.

>>> import orderconds
>>> sorted(orderconds.__all__)
['Tableau', 'check', 'construct', 'convert', 'derive', 'refine', 'solve', 'trees']
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orderconds.lazy import lazy

if TYPE_CHECKING:
    from orderconds.checking.refinement import refine as refine
    from orderconds.checking.verdict import check as check
    from orderconds.derivation import derive as derive
    from orderconds.exchange.conversion import convert as convert
    from orderconds.explain.enumeration import trees as trees
    from orderconds.solve.request import solve as solve
    from orderconds.tableau import Tableau as Tableau
    from orderconds.tableau.collocation import construct as construct

__version__ = "0.1.0"
__all__ = ["Tableau", "check", "construct", "convert", "derive", "refine", "solve", "trees"]

lazy(
    __name__,
    derivation=("derive",),
    tableau=("Tableau",),
    **{
        "checking.verdict": ("check",),
        "exchange.conversion": ("convert",),
        "explain.enumeration": ("trees",),
        "checking.refinement": ("refine",),
        "solve.request": ("solve",),
        "tableau.collocation": ("construct",),
    },
)
