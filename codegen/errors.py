"""Errors that a user of the compiler can cause.

The module :mod:`orderconds.errors` describes the form of the messages.
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
    """Raised if a tableau is not suitable for the families that are considered.

    Either these families cannot use the format of the tableau, or the tableau file gives no order for these
    families. ``claimed`` contains the families in which the tableau states an order.
    """

    claimed: tuple[str, ...] = ()
