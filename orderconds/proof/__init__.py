"""Proofs that an exact method exists near rounded decimals. An interval Newton method is applied to the order
conditions.

The ``[proof]`` table of a tableau file (:mod:`orderconds.tableau.unknowns`) states which equations the exact
values of the decimals satisfy. Krawczyk's operator proves that these equations have exactly one solution
within one unit of the last digit of each decimal. The operator also encloses the solution
(:mod:`orderconds.proof.krawczyk`).

The system of equations contains every independent condition of a family. A reduction is a theorem by which
some conditions follow from others. If the assumptions of a reduction have been verified, the system does not
contain the conditions that follow (:mod:`orderconds.proof.equations`). The module
:mod:`orderconds.proof.implications` applies theorems by which an order in one family implies orders in other
families.
"""
