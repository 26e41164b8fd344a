"""Proofs that rounded decimals stand for a true method: interval Newton on its order conditions.

A file's ``[proof]`` table (:mod:`orderconds.tableau.unknowns`) names equations for its decimals. Krawczyk's
operator proves that exactly one solution lies within a unit of their last digits, and encloses it
(:mod:`orderconds.proof.krawczyk`); the equations are all independent conditions of a family, or what a
verified reduction leaves of them (:mod:`orderconds.proof.equations`); what an order in one family says of
another is in :mod:`orderconds.proof.implications`.
"""
