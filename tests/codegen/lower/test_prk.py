"""Partitioned Runge-Kutta methods on T*R^n: explicit stages, orders, symplecticity, and refused scenes."""

from __future__ import annotations

import numpy as np
import pytest

from codegen import emit, load
from codegen.certify import certified_order
from codegen.emitter import compile_method
from codegen.errors import MethodError
from codegen.groups import Rn
from codegen.lower import lowering, method_for
from codegen.lower.prk import separable
from codegen.scene import HamiltonianScene
from codegen.scenes import load as gallery


def particle(H, **options):
    """Return a particle on a line with a Hamiltonian H(q, p)."""
    G = Rn(1)
    (q,), (p,) = G.point("q"), G.dual("p")
    given = {"group": G, "q": [q], "mu": [p], "H": H(q, p), "q0": [1], "mu0": [0.5], "span": (0, 1)}
    return HamiltonianScene(**(given | options))


def pendulum():
    return particle(lambda q, p: p**2 / 2 + q**4 / 4)


def bent():
    return particle(lambda q, p: p**2 * (1 + q**2) / 2 + q**2 / 2)


def test_stormer_verlet_is_explicit_and_equals_the_printed_formulas():
    scene, h = pendulum(), 0.1
    assert compile_method(scene, "prk:stormer_verlet").kernel.loops == ()
    q, p = 1.0, 0.5
    found = load(emit(scene, "prk:stormer_verlet", target="python")).step([q, p], h)
    p -= h / 2 * q**3
    q += h * p
    p -= h / 2 * q**3
    assert found == pytest.approx([q, p], rel=1e-15)


@pytest.mark.parametrize(("scene", "loops"), [(pendulum, 0), (bent, 1)])
def test_symplectic_euler_is_implicit_only_if_the_energy_is_not_separable(scene, loops):
    assert separable(scene()) is (loops == 0)
    assert len(compile_method(scene(), "prk:symplectic_euler").kernel.loops) == loops


@pytest.mark.parametrize(
    ("name", "scene", "order", "symplectic"),
    [
        ("ruth3_pair", pendulum, 3, True),
        # The weights differ, so the pair has order one and is not symplectic for a Hamiltonian of this form.
        ("ruth3_pair", bent, 1, False),
        ("lobatto3ab3", bent, 4, True),
        ("stormer_verlet", bent, 2, True),
        ("rk4", bent, 4, False),
        ("gauss2", bent, 4, True),
    ],
)
def test_the_order_and_symplecticity_depend_on_the_form_of_the_energy(name, scene, order, symplectic):
    method = method_for(scene(), f"prk:{name}")
    assert certified_order(method, scene()).order == order
    assert lowering("prk").symplectic(scene(), method) is symplectic
    integrator = load(emit(scene(), f"prk:{name}", target="python"))
    exact = np.array(load(emit(scene(), "rk:gauss5", target="python")).run([1.0, 0.5], 1 / 64, 64))
    counts = (64, 128) if order < 4 else (16, 32)
    errors = [np.abs(np.array(integrator.run([1.0, 0.5], 1 / n, n)) - exact).max() for n in counts]
    assert order - 0.15 < np.log2(errors[0] / errors[1]) < order + 0.25


@pytest.mark.parametrize(
    ("scene", "message"),
    [("driven_spin", "expected a Hamiltonian scene"), ("dipole", "whose group is SO\\(3\\)")],
)
def test_other_scenes_are_refused(scene, message):
    with pytest.raises(MethodError, match=message):
        emit(gallery(scene), "prk:stormer_verlet")


def test_tableaux_of_other_formats_are_refused():
    with pytest.raises(MethodError, match="a tableau of format"):
        emit(pendulum(), "prk:cf4")
