"""Series of methods and of exact flows, truncated by order, over any ring.

- ``b_series``: series over rooted trees, with or without colours.
- ``lie_butcher``: series over ordered forests, for products of exponentials and for the exact flow.
- ``dexpinv``: the series of Runge-Kutta-Munthe-Kaas methods.
- ``action``: the series of variational methods.
- ``characters``: composition and inverse of steps, computed from admissible cuts.
- ``modified_equations``: backward error analysis.
- ``substitution``: the series of a step if the vector field is itself a series.
"""
