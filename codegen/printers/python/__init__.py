"""The target Python: one module for each step. It needs only the standard library, except in single precision
and for steps on Fourier modes, which need NumPy."""
