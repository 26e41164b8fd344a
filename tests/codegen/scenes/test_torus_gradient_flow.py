"""The gradient flow on the torus: its limit, and the descent of the cost."""

from __future__ import annotations

import numpy as np

from codegen import emit, load


def cost(y) -> float:
    return float(((1 + y[0]) * y[3] - 8) ** 2)


def test_the_flow_ends_at_the_nearest_point_of_the_plane():
    module = load(emit("torus_gradient_flow", "rkmk(0):euler", "c"))
    y, costs = module.initial, []
    for _ in range(20):
        y = module.run(y, 0.01, 100)
        costs.append(cost(y))
    assert np.abs(np.array(y) - (1, 0, 0, 1)).max() < 1e-12  # theta = 0 and varphi = pi/2
    assert abs(costs[-1] - 36) < 1e-12
    assert all(a >= b - 1e-12 for a, b in zip([cost(module.initial), *costs], costs, strict=False))
    assert cost(module.initial) > 70
