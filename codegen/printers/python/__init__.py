"""The target Python.

A module needs NumPy if it computes in single precision or with Fourier modes. Other modules need only the
standard library.
"""
