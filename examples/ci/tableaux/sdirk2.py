"""A singly diagonally implicit method, L-stable."""

import numpy as np

gamma0 = 1 - np.sqrt(2) / 2
A = np.array([[gamma0, 0], [1 - gamma0, gamma0]])
b = np.array([1 - gamma0, gamma0])
order = 2
