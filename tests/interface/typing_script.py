"""A script of a user; mypy --strict accepts it and sees the types."""

from __future__ import annotations

from typing import assert_type

import numpy as np

import codegen
import orderconds
from codegen.artifact import Artifact
from codegen.integrator import Arrival, Integrator
from codegen.lab.efficiency.advice import Advice
from codegen.lab.efficiency.bench import Result
from codegen.lab.orders.scene_convergence import Convergences
from orderconds import Tableau
from orderconds.checking import Report
from orderconds.conditions import OrderCondition
from orderconds.derivation import Derivation
from orderconds.explain.enumeration import ShownTrees
from orderconds.solve.request import SearchResult


def script() -> None:
    tableau = Tableau.rk(np.zeros((1, 1)), [1], claims={"rk": 1})
    assert_type(tableau, Tableau)
    assert_type(tableau.orders, dict[str, int])
    assert_type(tableau.name, str)
    assert_type(orderconds.check(tableau), Report)
    derivation = orderconds.derive("rk", order=3, stages=3)
    assert_type(derivation, Derivation)
    assert_type(list(derivation), list[OrderCondition])
    assert_type(orderconds.trees("rooted", 4), ShownTrees)
    assert_type(orderconds.solve("rk", stages=2, order=2, explicit=True), SearchResult)
    assert_type(orderconds.convert(tableau, "json"), str | bytes)
    assert_type(orderconds.construct("gauss", 2), Tableau)
    artifact = codegen.emit("free_rigid_body", tableau, target="python")
    assert_type(artifact, Artifact)
    integrator = codegen.load(artifact)
    assert_type(integrator, Integrator)
    assert_type(integrator.adaptive([1.0, 0.0, 0.0], end=1.0), Arrival)
    assert_type(codegen.converge("free_rigid_body", tableau, "cf4"), Convergences)
    assert_type(codegen.bench("free_rigid_body", tableau), Result)
    assert_type(codegen.recommend("free_rigid_body", 1e-6, needs=["explicit"]), Advice)
