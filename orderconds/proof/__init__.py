"""Proofs that the order conditions have an exact solution near rounded decimals. The proofs use an interval
Newton method.

The ``[proof]`` table of a tableau file (:mod:`orderconds.tableau.unknowns`) selects the equations. Each
decimal is the centre of an interval. The radius of the interval is one unit of the last digit. Krawczyk's
operator proves that the equations have exactly one solution in these intervals. The operator also encloses
the solution (:mod:`orderconds.proof.krawczyk`).

By default, the equations are all independent conditions of a family. The ``[proof]`` table can also select a
reduction: a theorem by which fewer equations are sufficient (:mod:`orderconds.proof.equations`). The module
:mod:`orderconds.proof.implications` derives the order in one family from orders in other families.
"""
