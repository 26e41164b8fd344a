"""The same controller in Python."""

import sys
from math import hypot

sys.path.insert(0, "out")  # before this folder, which contains the scene satellite.py
import satellite

INERTIA = (1.2, 1.0, 0.8)


def rates(state):
    """Return the rates of the body relative to the orbit, in the body frame: I^-1 q^T mu - q^T e3."""
    q, mu = state[:9], state[9:]
    return [sum(q[3 * j + i] * mu[j] for j in range(3)) / INERTIA[i] - q[6 + i] for i in range(3)]


state, h = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, -0.25, 1], 0.05
for n in range(601):
    w = rates(state)
    if n % 150 == 0:
        print(f"t = {n * h:4.1f}  rate {hypot(*w):.6f}")
    state = satellite.step(state, n * h, h, [-x / 2 for x in w])
