"""Errors that a user of the compiler can cause.

The module :mod:`orderconds.errors` describes the form of their messages.
"""

from __future__ import annotations

from orderconds.errors import InputError


class SceneError(InputError):
    """Raised if a scene cannot be used.

    Possible reasons are wrong shapes, unknown symbols and unsupported functions.
    """


class MethodError(InputError):
    """Raised if a method cannot be used on a scene, or if the name of a method cannot be read."""


class UnclaimedTableau(MethodError):
    """Raised if the tableau claims no order in the families that accept the scene.

    ``claimed`` are the families in which the tableau claims an order.
    """

    claimed: tuple[str, ...] = ()
