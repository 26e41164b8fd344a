"""Families of integration methods.

A family, such as ``rk`` or ``rkmk(1)``, turns a tableau into an integration method and provides the order
conditions of this method. The first use of a family imports its module:

>>> from orderconds import families
>>> families.get("rkmk(1)").label()
'rkmk(1)'
"""

from __future__ import annotations

from orderconds.families.base import Family as Family
from orderconds.families.base import in_ring as in_ring
from orderconds.families.base import require_nonzero_weights as require_nonzero_weights
from orderconds.families.registry import family_class as family_class
from orderconds.families.registry import get as get
from orderconds.families.registry import installed_names as installed_names
from orderconds.families.registry import names as names
from orderconds.families.registry import position as position
from orderconds.families.registry import register as register
from orderconds.families.registry import unregister as unregister
from orderconds.families.registry import with_conditions as with_conditions

__all__ = [
    "Family",
    "family_class",
    "get",
    "in_ring",
    "installed_names",
    "names",
    "position",
    "register",
    "require_nonzero_weights",
    "unregister",
    "with_conditions",
]
