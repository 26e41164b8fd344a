"""Series of methods and of exact flows, truncated by order, over any ring.

``b_series``: rooted trees, coloured or not. ``lie_butcher``: ordered forests, for products of exponentials
and for the exact flow. ``dexpinv``: Runge-Kutta-Munthe-Kaas methods. ``action``: variational methods.
``characters``: composition and inverse of steps as B-series or Lie-Butcher series, computed from the
admissible cuts in ``cuts``.
``modified_equations``: backward error analysis. ``substitution``: a step whose field is itself a series.
"""
