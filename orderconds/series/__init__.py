"""Series of methods and of exact flows. The coefficients are elements of any ring. Each series is truncated
at an order.

- ``b_series``: series over rooted trees, with or without colours.
- ``lie_butcher``: series over ordered forests, for products of exponentials and for the exact flow.
- ``dexpinv``: the series of Runge-Kutta-Munthe-Kaas methods.
- ``action``: the series of variational methods.
- ``characters``: the series of the composition of two steps, and of the inverse of a step.
- ``modified_equations``: the series of the modified equation (backward error analysis).
- ``substitution``: a vector field, given as a series, is inserted into the series of a step.
"""
