"""Proofs that the order conditions have an exact solution near rounded decimals.

Each decimal in a tableau file is the centre of an interval. The radius of the interval is one unit of the
last digit. Krawczyk's operator proves that the equations have exactly one solution in these intervals
(:mod:`orderconds.proof.krawczyk`). The ``[proof]`` table of the file selects the equations
(:mod:`orderconds.proof.equations`).
"""
