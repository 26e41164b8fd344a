"""Proofs that an exact method exists near rounded decimals. An interval Newton method is applied to the order
conditions.

A file's ``[proof]`` table (:mod:`orderconds.tableau.unknowns`) names equations for the decimals of the file.
Krawczyk's operator proves that exactly one solution lies within one unit of the last digits of the decimals,
and encloses the solution (:mod:`orderconds.proof.krawczyk`). The equations are all independent conditions of
a family, or a subset that a verified reduction allows (:mod:`orderconds.proof.equations`). Theorems on orders
in different families are in :mod:`orderconds.proof.implications`.
"""
