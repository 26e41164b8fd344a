"""The result of ``reaches_orbit`` does not depend on the unit of the state."""

from __future__ import annotations

import pytest
from sympy import Matrix, Rational, diag, symbols

from codegen.groups import GL, SO3, Linear, Rotation
from codegen.scene import FieldScene
from codegen.scene.orbit_projection import orbit_is_open, reaches_orbit

SIZES = [1, Rational(1, 1000), Rational(1, 10**12), 10**12]


@pytest.mark.parametrize("size", SIZES)
def test_the_projection_reaches_spheres_of_all_sizes(size):
    m = Matrix(symbols("m0:3", real=True))
    sphere = FieldScene(
        group=SO3(), action=Rotation(), y=m, f=-diag(1, 2, 3) * m, y0=[0, size, 0], span=(0, 1)
    )
    assert reaches_orbit(sphere)
    assert not orbit_is_open(sphere)


@pytest.mark.parametrize("size", SIZES)
def test_the_punctured_plane_is_open_in_all_units(size):
    y = symbols("y0:2", real=True)
    plane = FieldScene(group=GL(2), action=Linear(), y=y, f=[0, 1, -1, 0], y0=[size, 0], span=(0, 1))
    assert orbit_is_open(plane)
