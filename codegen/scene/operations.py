"""The operations that are computed by a group, an action or a coordinate map.

Each table maps the names of operations, for example ``exp``, to the functions that compute the operations. A
call of an operation that the group lacks raises :class:`codegen.errors.SceneError`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import BodyFrame, CayleyMap, Coadjoint
from codegen.ir.domain import Domain, Value

GroupOperation = Callable[..., Value]
"""A function of the group, the number domain and the arguments of an operation.

If the operation truncates a series, the last argument is the truncation order.
"""

ON_GROUP: Mapping[str, GroupOperation] = {
    "identity": lambda group, d: group.identity(d),
    "exp": lambda group, d, x: group.exp(d, x),
    "mul": lambda group, d, g, k: group.mul(d, g, k),
    "ad": lambda group, d, x, y: group.ad(d, x, y),
    "Ad": lambda group, d, g, x: group.require(Coadjoint).Ad(d, g, x),
    "Adt": lambda group, d, g, mu: group.require(Coadjoint).Adt(d, g, mu),
    "Adtinv": lambda group, d, g, mu: group.require(Coadjoint).Adtinv(d, g, mu),
    "adt": lambda group, d, x, mu: group.require(Coadjoint).adt(d, x, mu),
    "dexpt": lambda group, d, x, mu: group.require(Coadjoint).dexpt(d, x, mu),
    "Adinv": lambda group, d, g, x: group.require(BodyFrame).Adinv(d, g, x),
    "cay": lambda group, d, x: group.require(CayleyMap).cay(d, x),
    "sandwich": lambda group, d, x, y: group.require(CayleyMap).sandwich(d, x, y),
    "mulexp": lambda group, d, g, x: group.require(BodyFrame).mulexp(d, g, x),
}

TRUNCATED: Mapping[str, GroupOperation] = {
    "dexpinv": lambda group, d, x, y, order: group.dexpinv(d, x, y, order),
    "dexpinvt": lambda group, d, x, mu, order: group.require(Coadjoint).dexpinvt(d, x, mu, order),
    "P": lambda group, d, x, y, mu, order: group.require(Coadjoint).P(d, x, y, mu, order),
}

ON_COORDINATES: Mapping[str, Callable[..., Value]] = {
    "element_at": lambda coordinates, d, group, x: coordinates.element(d, group, x),
    "inverse_differential": lambda coordinates, d, group, x, y: coordinates.inverse_differential(
        d, group, x, y
    ),
}

BY_ACTION: Mapping[str, Callable[[Action, Domain, LieGroup, Value, Value], Value]] = {
    "act": lambda action, d, group, g, y: action.act(d, group, g, y),
    "actexp": lambda action, d, group, x, y: action.actexp(d, group, x, y),
}
