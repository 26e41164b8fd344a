"""Solutions of a search are refused if the equations do not determine them, or if they exceed a bound."""

from fractions import Fraction

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


@pytest.mark.parametrize(("size", "refused"), [("0.53867513459", True), ("0.5386751346", False)])
def test_no_coefficient_exceeds_the_bound_by_less_than_the_errors_of_the_search(size, refused):
    # The largest coefficient of the only method is 1/4 + sqrt(3)/6 = 0.538675134594...
    problem = find_problem("rk", 4, Spec(stages=2, size=Fraction(size)), "full")
    r = 3**0.5 / 6
    values = {"b1": 0.5, "b2": 0.5, "a11": 0.25, "a12": 0.25 - r, "a21": 0.25 + r, "a22": 0.25}
    point = [values[name] for name in problem.ansatz.free]
    if refused:
        with pytest.raises(NotProved, match="a21 exceeds the bound"):
            module.certify_solution(problem, point, "m", "a test")
    else:
        assert module.certify_solution(problem, point, "m", "a test").certificate == "exact"


def test_a_coefficient_may_equal_the_bound():
    problem = find_problem("rk", 2, Spec(stages=2, size=Fraction(1, 2)), "full")
    values = {"b1": 0.5, "b2": 0.5, "a11": 0.5, "a12": 0.0, "a21": 0.5, "a22": 0.0}
    point = [values[name] for name in problem.ansatz.free]
    assert module.certify_solution(problem, point, "m", "a test").certificate == "exact"


def test_a_weight_that_is_zero_up_to_rounding_errors_is_not_positive():
    problem = find_problem("rk", 1, Spec(stages=2, explicit=True, positive=("b",), fix=("a21=1",)), "full")
    residuals, _ = problem.system(np.array([[1.0, 1e-17]]))
    assert not residuals.any()
    with pytest.raises(NotProved, match="b2 is not positive"):
        module._require_bounds(problem, {0: Fraction(1), 1: Fraction(0)}, {})
