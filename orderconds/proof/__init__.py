"""Proofs that an exact method exists near rounded decimals. An interval Newton method is applied to the order
conditions.

The ``[proof]`` table of a tableau file (:mod:`orderconds.tableau.unknowns`) states which equations the exact
values of the decimals satisfy. Krawczyk's operator proves that these equations have exactly one solution
within one unit of the last digit of each decimal. It also encloses the solution
(:mod:`orderconds.proof.krawczyk`). The system contains every independent condition of a family. A reduction
is a theorem by which some of these conditions follow from the others. If its assumptions have been verified,
the system contains only the others (:mod:`orderconds.proof.equations`). The module
:mod:`orderconds.proof.implications` applies theorems by which an order in one family implies orders in other
families.
"""
