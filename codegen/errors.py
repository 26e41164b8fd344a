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
    """Raised if none of the families of a tableau accepts the scene.

    ``claimed`` are the families in which the tableau claims an order.
    """

    claimed: tuple[str, ...] = ()
