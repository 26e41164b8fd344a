"""Operations: their types, their texts, and the laws that the passes use."""

from __future__ import annotations

from dataclasses import replace

import pytest

from codegen.groups.coordinate_maps import Cayley
from codegen.ir.ad_series import Factor
from codegen.ir.domain import FloatDomain
from codegen.ir.number import Number
from codegen.ir.operations import (
    UNIT,
    Act,
    ActExp,
    Adjoint,
    AdSeries,
    Advance,
    Bracket,
    DualDexp,
    ElementAt,
    Exp,
    Identity,
    InverseDexp,
    InverseDexpSlope,
    InverseDifferential,
    Linear,
    Multiply,
    MultiplyExp,
    Operation,
    Zero,
)
from codegen.ir.program import Program
from codegen.ir.scene_operations import (
    Bivector,
    BodyForce,
    BodyVelocity,
    CayleyElement,
    Differential,
    Energy,
    Field,
    FlowFor,
    FlowOf,
    HamiltonianDerivatives,
    Legendre,
    Sandwich,
    Secant,
    SiteFlowOf,
    TaylorStep,
    ToOrbit,
)
from codegen.ir.site_operations import Corrected, Excess, InnerProduct, Total, Wedge
from codegen.ir.stated_step import StatedStep
from codegen.ir.time_momentum import TimeMomentum
from codegen.ir.values import MINUS_ONE, ONE, Coefficient, Kind
from tests.strategies import hamiltonian_scene

D = FloatDomain(0.25)
SCENE = replace(hamiltonian_scene("SO(3)"), coordinates=Cayley())
HALF_H = Coefficient(Number.rational(1, 2), 1)
WORD = (Factor("dexp", UNIT), Factor("exp", -UNIT / 2))
BOTH = (False, True)
ALL = [
    *(Zero(Kind.ALG), Linear((ONE,)), Advance(HALF_H), Identity(), Exp(), Multiply(), MultiplyExp()),
    *(ElementAt(), InverseDifferential()),
    *(Act(), ActExp(), InverseDexpSlope(2), DualDexp(), Legendre(), Energy(), Differential(), Secant()),
    *(CayleyElement(), Sandwich(), StatedStep("projection"), TimeMomentum(Program("step", (), (), ()))),
    *(
        Bivector(),
        FlowOf("V", HALF_H),
        FlowOf("V", HALF_H, timed=True),
        SiteFlowOf("bonds", HALF_H),
        FlowFor("V"),
        FlowFor("V", timed=True),
    ),
    *(Adjoint(dual, inverse) for dual in BOTH for inverse in BOTH),
    *(Bracket(dual) for dual in BOTH),
    *(InverseDexp(2, dual) for dual in BOTH),
    *(AdSeries(WORD, dual) for dual in BOTH),
    *(ToOrbit(), *(TaylorStep(3, timed) for timed in BOTH)),
    *(Total(), InnerProduct(Kind.DUAL, Kind.ALG), Excess(), Corrected(), Wedge()),
    *(make(timed) for make in (Field, HamiltonianDerivatives, BodyVelocity, BodyForce) for timed in BOTH),
]
VALUES = {
    Kind.ALG: (0.25, -0.5, 0.125),
    Kind.DUAL: (0.5, 0.75, -0.25),
    Kind.GROUP: SCENE.group.exp(D, (0.5, -0.25, 1.0)),
}


def every(kind):
    return [kind, *(k for sub in kind.__subclasses__() for k in every(sub))]


def name_of(operation):
    return f"{operation.text()}{'t' if getattr(operation, 'timed', False) else ''}"


def test_every_operation_is_looked_at():
    abstract = {"Operation", "OfGroup", "OfScene"}
    # The operations of predictions are compiled from these operations, and a test compares the two.
    defined = {
        k.__name__ for k in every(Operation) if k.__module__.startswith(("codegen.ir", "codegen.pass"))
    }
    assert {type(x).__name__ for x in ALL} == defined - abstract


@pytest.mark.parametrize("operation", ALL, ids=name_of)
def test_an_operation_accepts_its_own_signature_and_no_other(operation):
    takes, gives = operation.signature()
    assert operation.accepts(takes, gives)
    assert not operation.accepts((*takes, Kind.POINT), gives)
    assert not operation.accepts(takes, (*gives, Kind.REAL))
    wrong = Kind.REAL if gives[0] is not Kind.REAL else Kind.GROUP
    assert not operation.accepts(takes, (wrong, *gives[1:]))


@pytest.mark.parametrize("operation", [x for x in ALL if x.linear_in_last], ids=name_of)
def test_operations_that_say_so_are_linear_in_their_last_argument(operation):
    if isinstance(operation, Bivector):
        pytest.skip("it needs a point of a scene with an energy: tested with discrete gradients")
    *first, last = (VALUES[kind] for kind in operation.signature()[0])
    other = (1.0, -0.5, 2.0)

    def at(x):
        (value,) = operation.evaluate(SCENE, D, (*first, x))
        return value

    combined = at(tuple(2 * a - 3 * b for a, b in zip(last, other, strict=True)))
    assert combined == pytest.approx(
        [2 * a - 3 * b for a, b in zip(at(last), at(other), strict=True)], abs=1e-14
    )


@pytest.mark.parametrize("dual", BOTH)
@pytest.mark.parametrize("inverse", BOTH)
def test_the_opposite_of_an_adjoint_map_undoes_it(dual, inverse):
    operation = Adjoint(dual, inverse)
    g, v = (VALUES[kind] for kind in operation.signature()[0])
    (moved,) = operation.evaluate(SCENE, D, (g, v))
    (back,) = operation.opposite().evaluate(SCENE, D, (g, moved))
    assert back == pytest.approx(v, abs=1e-15)
    assert moved != pytest.approx(v, abs=1e-2)


@pytest.mark.parametrize("operation", [InverseDexp(2), InverseDexp(4, dual=True), DualDexp()], ids=name_of)
def test_the_word_of_a_function_of_ad_is_that_function(operation):
    args = tuple(VALUES[kind] for kind in operation.signature()[0])
    series = AdSeries(operation.word, operation.signature()[1] == (Kind.DUAL,))
    (expected,) = operation.evaluate(SCENE, D, args)
    assert series.evaluate(SCENE, D, args)[0] == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize("operation", [x for x in ALL if x.noun], ids=name_of)
def test_nouns_have_a_plural(operation):
    assert operation.noun.format(s="") != operation.noun.format(s="s")


@pytest.mark.parametrize(
    ("operation", "args", "text"),
    [
        (Adjoint(dual=True, inverse=True), ["g", "mu"], "Ad*^-1(g, mu)"),
        (InverseDexp(2, dual=True), ["x", "mu"], "dexpinv*(2)(x, mu)"),
        (AdSeries(WORD), ["x", "y"], "series[dexp(t) exp(-1/2t)](x, y)"),
        (FlowOf("V", HALF_H), ["q", "mu"], "flow[V](q, mu, 1/2 h)"),
        (SiteFlowOf("V", HALF_H), ["y"], "flow[V](y, 1/2 h)"),
        (Advance(HALF_H), ["t"], "advance(t, 1/2 h)"),
        (Linear((ONE, MINUS_ONE)), ["x", "y"], "(1) x + (-1) y"),
        (Linear((ONE,)), ["x", "y"], "(1) x + ? y"),
    ],
)
def test_an_operation_is_printed_with_its_parameters(operation, args, text):
    assert operation.applied(args) == text
