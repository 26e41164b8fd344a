"""Prove that there is a method near rounded decimals, by interval Newton on its order conditions.

A file's ``[proof]`` table (:mod:`orderconds.tableau.unknowns`) names equations for its decimals. Krawczyk's
operator proves that exactly one solution lies within a unit of their last digits, and encloses it
(:mod:`orderconds.proof.krawczyk`); the equations are all independent conditions of a family, or fewer by a
verified reduction (:mod:`orderconds.proof.equations`); theorems on orders in different families are in
:mod:`orderconds.proof.implications`.
"""
