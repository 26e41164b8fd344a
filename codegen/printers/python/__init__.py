"""The target Python: one module for each step.

A module needs only the standard library. In single precision and for steps on Fourier modes it needs NumPy.
"""
