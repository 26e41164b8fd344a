"""The ambient equation of a scene."""

import random

import pytest

from codegen import scenes
from codegen.emitter import compile_method
from codegen.ir.domain import ExprDomain, FloatDomain
from codegen.ir.expr import evaluate, walk
from codegen.lab.long_runs.long_run import long_run
from codegen.lower import lowering
from codegen.scene.ambient import ambient


def test_the_field_of_a_matrix_scene_is_its_velocity_and_not_its_generator_times_the_matrix():
    scene = scenes.load("principal_components")
    field, domain, draw = ambient(scene), FloatDomain(0.0), random.Random(1)
    # On the manifold the velocity is the generator times the matrix; elsewhere they differ.
    for state, bound in ((scene.initial(domain), 1e-14), ([draw.random() for _ in scene.symbols], None)):
        given = evaluate(field.roots, domain, field.values(domain, tuple(state), 0.0))
        stated = scene.velocity(domain, tuple(state), 0.0)
        assert max(abs(x - y) for x, y in zip(given, stated, strict=True)) < 1e-13
        f = evaluate(scene.roots, domain, scene.values(domain, tuple(state), 0.0))
        moved = scene.action.velocity(domain, scene.group, f, tuple(state))
        gap = max(abs(x - y) for x, y in zip(given, moved, strict=True))
        assert gap < bound if bound else gap > 1e-3


def test_a_step_has_as_many_operations_as_the_velocity_needs():
    scene = scenes.load("principal_components")
    domain = ExprDomain(scene.roots[0].space)
    symbols = tuple(map(domain.space.sym, scene.symbols))
    velocity = sum(n.op not in ("const", "sym") for n in walk(scene.velocity(domain, symbols)))
    step = compile_method("principal_components", "ambient:euler").kernel
    operations = sum(n.op not in ("const", "sym") for n in walk(tuple(step.expressions())))
    # Euler's step adds one product and one sum for each coordinate.
    assert operations <= velocity + 2 * len(symbols) + 2


@pytest.mark.parametrize(
    ("scene", "kept"),
    [
        ("duffing", True),
        ("duffing_sl2", True),
        ("free_rigid_body", False),
        ("circle", False),
        ("torus_gradient_flow", False),
    ],
)
def test_runge_kutta_in_coordinates_keeps_open_manifolds_only(scene, kept):
    """The groups of the circle and of the torus are abelian, but steps in coordinates leave both."""
    assert lowering("ambient").keeps_manifold(scenes.load(scene)) is kept


def test_a_step_in_coordinates_leaves_the_circle():
    run = long_run(compile_method("circle", "ambient:rk4"), 0.2, 200, back=False)
    (manifold,) = [kept.drift.largest for kept in run.kept if kept.name == "manifold"]
    assert manifold > 1e-8
