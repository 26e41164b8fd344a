from __future__ import annotations

import math
from fractions import Fraction

import pytest
from sympy import Matrix, Rational, symbols

from codegen.groups import LeftMultiplication, Rn
from codegen.ir.ball_domain import BallDomain
from codegen.ir.domain import FloatDomain, NotConverged, PreciseDomain, SeriesDomain
from codegen.ir.interpret import _solved, interpret
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.passes import optimise
from codegen.scene import FieldScene
from orderconds.ring import QQ
from tests.strategies import butcher, field_scene, hamiltonian_scene, shipped


def start(scene, domain):
    """The initial state, block by block."""
    values, first, coordinates = {}, 0, scene.initial(domain)
    for block in scene.state:
        values[block.name] = coordinates[first : first + len(block.symbols)]
        first += len(block.symbols)
    return values


def test_euler_on_a_vector_space_is_y_plus_h_f():
    scene = field_scene("R^3")
    method = Method("rk", shipped("euler"))
    d = SeriesDomain(QQ, 3)
    (y,) = start(scene, d).values()
    slope = scene.velocity(d, y)
    found = interpret(lower(scene, method), scene, d, {"y": y})["y"]
    assert all(d.ring.is_zero(a - (b + d.h * v)) is True for a, b, v in zip(found, y, slope, strict=True))


@pytest.mark.parametrize("family", ["vcg", "rkmk"])
def test_doubles_and_forty_digits_agree_to_rounding(family):
    scene = hamiltonian_scene("SO(3)")
    method = Method(family, shipped("gauss2"), 2 if family == "rkmk" else None)
    view = problem_for(scene, method)
    program, _ = optimise(lower(scene, method), view)
    results = []
    for domain in (FloatDomain(2.0**-7), PreciseDomain(Fraction(1, 128), 40)):
        found = interpret(program, view, domain, start(view, domain))
        results.append([x for name in sorted(found) for x in found[name]])
    assert max(abs(float(b) - a) for a, b in zip(*results, strict=True)) < 1e-14


def test_the_exact_series_evaluated_at_h_is_the_step_up_to_the_truncation():
    scene, method, h = field_scene("GL(2)"), Method("rkmk", shipped("rk4"), 2), Fraction(1, 10**5)
    program = lower(scene, method)
    d, exact = PreciseDomain(h, 40), SeriesDomain(QQ, 8)
    found = interpret(program, scene, d, start(scene, d))["y"]
    series = interpret(program, scene, exact, start(scene, exact))["y"]
    for a, s in zip(found, series, strict=True):
        total = sum(Fraction(int(c.p), int(c.q)) * h**k for k, c in enumerate(s.coefficients))
        assert abs(a - d.rational(total.numerator, total.denominator)) < 1e-30


def test_a_block_that_does_not_settle_is_named():
    scene = field_scene("S^2")
    method = Method("cg", butcher("stiff", [[1]], [1]))
    program = lower(scene, method)
    with pytest.raises(NotConverged, match=r"^stages did not converge in 30 sweeps"):
        interpret(program, scene, FloatDomain(5.0), start(scene, FloatDomain(5.0)), limit=30, newton=False)


def test_newtons_method_in_doubles_does_not_depend_on_the_units_of_the_state():
    x, y = symbols("x y", real=True)

    def end(unit):
        f = Matrix([y, -20 * x - 30 * y - 20 * x**3 / unit**2])
        y0 = [unit, unit / 2]
        scene = FieldScene(
            group=Rn(2), action=LeftMultiplication(), y=Matrix([x, y]), f=f, y0=y0, span=(0, 1)
        )
        domain = FloatDomain(0.2)
        program = lower(scene, Method("rk", shipped("gauss2")))
        return [float(x / float(unit)) for x in interpret(program, scene, domain, start(scene, domain))["y"]]

    assert end(Rational(1, 2**40)) == pytest.approx(end(Rational(1)), rel=1e-13)


def test_the_last_change_of_a_ball_is_written_with_two_digits():
    scene = field_scene("S^2")
    program = lower(scene, Method("cg", butcher("stiff", [[1]], [1])))
    domain = BallDomain(5.0)
    with pytest.raises(NotConverged, match=r"the last change was \d\.\de[+-]\d\d$"):
        interpret(program, scene, domain, start(scene, domain), limit=3, newton=False)


def test_a_block_that_leaves_the_numbers_is_an_arithmetic_error():
    scene = field_scene("R^3")
    program = lower(scene, Method("rk", butcher("stiff", [[1]], [1])))
    with pytest.raises(ArithmeticError):
        interpret(program, scene, FloatDomain(1e5), start(scene, FloatDomain(1e5)), newton=False)


@pytest.mark.parametrize("columns", [[[math.inf]], [[1.0, 0.0], [0.0, -math.inf]], [[math.nan]], [[0.0]]])
def test_a_matrix_that_is_singular_or_not_finite_has_no_solution(columns):
    """A division by an infinite pivot would give the change 0, as if the iteration had converged."""
    with pytest.raises(NotConverged, match="singular or not finite"):
        _solved(columns, [1.0] * len(columns))
