"""Proofs that the order conditions have an exact solution near rounded decimals. The proofs use an interval
Newton method.

The ``[proof]`` table of a tableau file (:mod:`orderconds.tableau.unknowns`) selects the equations. Each
decimal is the centre of an interval. The radius of the interval is one unit of the last digit. Krawczyk's
operator proves that the equations have exactly one solution in these intervals. The operator also encloses
the solution (:mod:`orderconds.proof.krawczyk`).

In general, the system of equations contains every independent condition of a family. A reduction is a theorem
by which some conditions follow from the others (:mod:`orderconds.proof.equations`). The module
:mod:`orderconds.proof.implications` derives the order in one family from orders in other families.
"""
