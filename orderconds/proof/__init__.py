"""Proofs that an exact method exists near rounded decimals. An interval Newton method is applied to the order
conditions.

A file's ``[proof]`` table (:mod:`orderconds.tableau.unknowns`) names equations for the decimals of the file.
Krawczyk's operator proves that exactly one solution lies within one unit of the last digits of the decimals,
and encloses the solution (:mod:`orderconds.proof.krawczyk`). The system of equations contains every
independent condition of a family, or a subset of these conditions that a verified reduction allows
(:mod:`orderconds.proof.equations`). Theorems on orders in different families are in
:mod:`orderconds.proof.implications`.
"""
