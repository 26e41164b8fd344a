"""Rotations of spheres about the origin."""

from __future__ import annotations

from codegen.groups.actions.linear import Linear


class Rotation(Linear):
    """Rotations acting on column vectors. For example, SO(3) acts on the spheres about the origin of R^3."""

    name = "rotation"
