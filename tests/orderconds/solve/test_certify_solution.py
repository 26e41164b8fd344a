"""A point at which the equations do not determine the unknowns is refused."""

import numpy as np
import pytest

from orderconds.proof.krawczyk import NotProved
from orderconds.solve import certify_solution as module
from orderconds.solve.problem import find_problem
from orderconds.solve.spec import Spec


def test_newtons_method_refuses_fewer_independent_equations_than_unknowns():
    problem = find_problem("rk", 2, Spec(stages=2, explicit=True), "full")
    # At a zero weight the condition b_2 c_2 = 1/2 does not depend on c_2 = a_21.
    point = np.array([0.5 if name.startswith("a") else 0.0 for name in problem.ansatz.free])
    with pytest.raises(NotProved, match="singular"):
        module._newton(problem, point, {}, list(range(len(point))))
