"""What emitted steps on T*G keep: the symplectic form, momentum maps, and time's direction."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codegen.loader import load
from codegen.lower import lowering, names
from codegen.lower.flow_words import FlowLowering
from codegen.scenes import load as gallery
from tests.codegen.family_cases import CASES
from tests.compilations import emitted

H = 0.05
WEIGHTS = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
"""Central differences of order 8."""
EPS = 2.0**-9

VARIATIONAL = [
    "vcg:midpoint",
    "vcg:triple_jump",
    "vcg:gauss2",
    "vcf:cf4",
    "vrkmk(0):midpoint",
    "vrkmk(1):kutta3",
    "vrkmk(2):gauss2",
    "vrkmk(4):gauss3",
    "vrkmk_pade(2):gauss2",
    "slgi:euler",
    "slgi:midpoint",
    "slgi:radau2a1",
    "slgi:gauss2",
]

OF_FLOWS = ["splitting:strang", "splitting:ruth3", "splitting:blanes_moan4", "splitting:strang3"]
OF_FLOWS += ["composition:triple_jump", "composition:mclachlan4", "composition:yoshida6"]
"""Splittings of the dipole: a kick, and the two exact flows that its asymmetric inertia is split into."""


def on_dipole(family):
    """Return True for a family of Hamiltonian scenes that accepts the scene of these tests."""
    own = lowering(family)
    return own.hamiltonian and own.objection(gallery("dipole")) is None


TRIED = {method.partition(":")[0].partition("(")[0] for method in (*VARIATIONAL, *OF_FLOWS)}
for family, cases in CASES.items():
    if family not in TRIED and on_dipole(family):
        flows = isinstance(lowering(family), FlowLowering)
        (OF_FLOWS if flows else VARIATIONAL).extend(case.method for case in cases)


LONG = frozenset(
    {
        "vcg:gauss2",
        "vrkmk(2):gauss2",
        "vrkmk(4):gauss3",
        "slgi:radau2a1",
        "slgi:gauss2",
        "splitting:blanes_moan4",
        "composition:mclachlan4",
        "composition:yoshida6",
        "rkmk(2):gauss2",
    }
)
"""Methods that take long to compile, of families that the quick run tries by others."""


def tries(methods):
    """Return the parameters of a test; long methods are left to the slow run."""
    return [pytest.param(m, marks=pytest.mark.slow if m in LONG else ()) for m in methods]


def test_every_family_of_hamiltonian_scenes_is_tried():
    tried = {method.partition(":")[0].partition("(")[0] for method in {*VARIATIONAL, *OF_FLOWS} - LONG}
    assert tried == {family for family in names() if on_dipole(family)}


def hat(x):
    return np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])


def vee(m):
    return np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) / 2


def rotation(x):
    angle = math.sqrt(x @ x)
    k = hat(x / angle) if angle else hat(x)
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


Q = rotation(np.array([1.4, 0.3, -0.2]))
INERTIA = np.array([1.01, 1.0, 0.01])
MU = Q @ (INERTIA * np.array([0.4, 0.9, 0.5]))
"""The momentum of a body that turns about no special axis."""
DIRECTIONS = np.block([[np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), Q * INERTIA]])
"""Tangent vectors (xi, nu) as columns: those of the momentum move the velocity by one."""


def stepper(method):
    integrator = load(emitted("dipole", method))

    def step(q, mu, h=H):
        state = np.array(integrator.step([*q.ravel(), *mu], h))
        return state[:9].reshape(3, 3), state[9:]

    return step


def form(mu):
    """(2.26) as a matrix: <nu2, xi1> - <nu1, xi2> - <mu, [xi1, xi2]>."""
    bracket = np.array([[mu @ np.cross(a, b) for b in np.eye(3)] for a in np.eye(3)])
    return np.block([[-bracket, np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])


def tangent(step):
    """The derivative of one step in right trivialisation along the columns of DIRECTIONS."""
    q1, _ = step(Q, MU)
    columns = []
    for direction in DIRECTIONS.T:
        total = np.zeros(12)
        for k, w in WEIGHTS.items():
            for sign in (1, -1):
                moved = rotation(sign * k * EPS * direction[:3]) @ Q
                q, mu = step(moved, MU + sign * k * EPS * direction[3:])
                total += sign * w / EPS * np.array([*q.ravel(), *mu])
        columns.append([*vee(total[:9].reshape(3, 3) @ q1.T), *total[9:]])
    return np.array(columns).T


def defect(method):
    """Return by how much the form at the end, pulled back, differs from the form at the start."""
    step = stepper(method)
    J = tangent(step)
    return np.abs(J.T @ form(step(Q, MU)[1]) @ J - DIRECTIONS.T @ form(MU) @ DIRECTIONS).max()


@pytest.mark.parametrize("method", tries([*VARIATIONAL, *OF_FLOWS]))
def test_variational_steps_and_compositions_of_flows_are_symplectic(method):
    assert defect(method) < 1e-11


@pytest.mark.parametrize(
    "method", tries(["rkmk(2):rk4", "cf:cf4", "rkmk(2):gauss2", "rkmk(0):euler", "rkmk(0):midpoint"])
)
def test_others_are_not(method):
    assert defect(method) > 1e-7


@pytest.mark.parametrize("method", tries([*VARIATIONAL, *OF_FLOWS]))
def test_the_momentum_of_the_rotations_about_the_vertical_is_kept(method):
    step, q, mu = stepper(method), Q, MU
    for _ in range(40):
        q, mu = step(q, mu, H / 4)
        assert abs(mu[2] - MU[2]) < 1e-13
    assert abs(mu[0] - MU[0]) > 1e-2


SYMMETRIC = ["vcg:midpoint", "vcg:triple_jump", "vrkmk(0):midpoint", "slgi:midpoint"]


@pytest.mark.parametrize("method", tries([*SYMMETRIC, *(m for m in OF_FLOWS if "ruth" not in m)]))
def test_symmetric_compositions_are_reversible(method):
    step = stepper(method)
    q, mu = step(*step(Q, MU), h=-H)
    assert np.abs(q - Q).max() < 1e-13
    assert np.abs(mu - MU).max() < 1e-13


@pytest.mark.parametrize("method", ["vrkmk(1):kutta3", "splitting:ruth3"])
def test_a_method_that_is_not_symmetric_is_not_reversible(method):
    step = stepper(method)
    q, _ = step(*step(Q, MU), h=-H)
    assert np.abs(q - Q).max() > 1e-9


def there_and_back(method):
    """Return how far a step and one back lead from the start, on a sphere with a field that turns in time."""
    integrator = load(emitted("driven_spin", method))
    start = [0.6, 0.0, 0.8]
    back = integrator.step(integrator.step(start, H, 0.25), -H, 0.25 + H)
    return max(abs(a - b) for a, b in zip(start, back, strict=True))


@pytest.mark.parametrize("method", ["cg:gauss1", "cg:triple_jump", "cf:gauss1", "rkmk(0):gauss1"])
def test_symmetric_tableaux_are_reversible_on_the_sphere_too(method):
    assert there_and_back(method) < 1e-14


@pytest.mark.parametrize("method", ["cg:cg3", "cf:cf4", "rkmk(2):rk4", "cg:gauss2"])
def test_others_are_not_and_symmetric_weights_alone_do_not_help(method):
    assert there_and_back(method) > 1e-11
