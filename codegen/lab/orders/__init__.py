"""Determines the order of a method on a scene, from runs or in exact arithmetic.

The observed order is computed from the errors of runs with a sequence of step sizes. The exact order is
computed from the local error, a power series in the step size h with exact coefficients.
"""
