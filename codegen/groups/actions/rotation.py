"""Rotations of spheres about the origin."""

from __future__ import annotations

from codegen.groups.actions.linear import Linear


class Rotation(Linear):
    """Rotations acting on column vectors. SO(3) acts on spheres about the origin of R^3."""

    name = "rotation"
