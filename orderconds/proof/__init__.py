"""Proofs that an exact method exists near rounded decimals. An interval Newton method is applied to the order
conditions.

The ``[proof]`` table of a tableau file (:mod:`orderconds.tableau.unknowns`) selects the equations. Krawczyk's
operator proves that the equations have exactly one solution within one unit of the last digit of each
decimal. The operator also encloses the solution (:mod:`orderconds.proof.krawczyk`).

In general, the system of equations contains every independent condition of a family. A reduction is a theorem
by which a smaller system is sufficient (:mod:`orderconds.proof.equations`). The module
:mod:`orderconds.proof.implications` derives the order in one family from orders in other families.
"""
