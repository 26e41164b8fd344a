"""Errors that a user of the compiler can cause. :mod:`orderconds.errors` describes the form of the error
messages.
"""

from __future__ import annotations

from orderconds.errors import InputError


class SceneError(InputError):
    """Raised if a scene cannot be used, for example because of wrong shapes, unknown symbols or unsupported
    functions.
    """


class MethodError(InputError):
    """Raised if a method cannot be used on a scene, or if the name of a method cannot be read."""


class UnclaimedTableau(MethodError):
    """Raised if none of the families of a tableau accepts the scene.

    ``claimed`` are the families in which the tableau claims an order.
    """

    claimed: tuple[str, ...] = ()
