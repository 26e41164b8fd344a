"""The target Python: one module for each step.

A module in single precision or for a step on Fourier modes needs NumPy. The other modules need only the
standard library.
"""
