"""The order of a method on a scene, observed or exact.

The observed order is computed from the errors at a sequence of step sizes. The exact order is computed from
the local error as a power series in h with rational coefficients.
"""
