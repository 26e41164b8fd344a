"""Proofs that an exact method exists near rounded decimals. An interval Newton method is applied to the order
conditions.

The ``[proof]`` table of a tableau file (:mod:`orderconds.tableau.unknowns`) states which equations the exact
values of the decimals satisfy. Krawczyk's operator proves that exactly one solution lies within one unit of
the last digits of the decimals, and encloses the solution (:mod:`orderconds.proof.krawczyk`). The system of
equations contains every independent condition of a family. If a reduction has been verified, a subset of
these conditions suffices (:mod:`orderconds.proof.equations`). The module :mod:`orderconds.proof.implications`
applies theorems by which an order in one family implies orders in other families.
"""
