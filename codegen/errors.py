"""Errors that a user of the compiler can cause. :mod:`orderconds.errors` describes the form of the
message.
"""

from __future__ import annotations

from orderconds.errors import InputError


class SceneError(InputError):
    """A scene that cannot be used: its file fails, or it has wrong shapes, unknown symbols or unsupported
    functions."""


class MethodError(InputError):
    """A method that cannot be used on a scene, or a method name that cannot be read."""


class UnclaimedTableau(MethodError):
    """A tableau that claims no order in any family that accepts the scene.

    ``claimed`` are the families in which the tableau claims an order. None of these families accepts the
    scene.
    """

    claimed: tuple[str, ...] = ()
