"""Series of methods and of exact flows, truncated by order, over any ring.

``b_series``: rooted trees, coloured or not. ``lie_butcher``: ordered forests, for products of exponentials
and the exact flow. ``dexpinv``: the single exponential of a Runge-Kutta-Munthe-Kaas method. ``action``:
variational methods. ``characters``: the group of steps, B-series or Lie-Butcher, over ``cuts``.
``modified_equations``: backward error analysis. ``substitution``: one field in place of another.
"""
