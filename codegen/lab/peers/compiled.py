"""Two classical integrators in C: DOP853 with step-size control, and RK4 with projection after each step.

The error estimate of DOP853 uses an embedded method of order 5, and a quadrature rule of order 3. The nodes
of the quadrature rule are the nodes of stages 1, 9 and 12. The sources are Hairer, Norsett and Wanner I,
sections II.10 (DOP853) and II.4 (step-size control).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import cffi
from jinja2 import Environment, PackageLoader, StrictUndefined

from codegen.build import build
from codegen.ir.domain import FloatDomain
from codegen.lab.number_types import Scalar
from codegen.lab.peers import Outcome, Peer, PeerFailed, Prepared
from codegen.lab.peers.projection import projection_lines
from codegen.lab.straight_line_field import velocity
from codegen.printers.c.module import helper_texts
from codegen.scene.problem import Problem
from orderconds.tableau import Embedded, RungeKutta, Tableau, find

DECLARATION = (
    "int peer(double *y, double first, double last, double control, size_t *steps, size_t *evaluations);"
)
REASONS = {1: "the step became too small", 2: "a number is not finite", 3: "too many steps"}


def peer(name: str) -> Peer:
    """Return the peer (an integrator for comparison) ``c-dop853`` or ``c-rk4-projected``.

    The user chooses a tolerance for ``c-dop853``, and a number of steps for ``c-rk4-projected``.
    """
    controlled = "tolerance" if name == "c-dop853" else "steps"
    template = "dop853.c.j2" if name == "c-dop853" else "rk4.c.j2"
    return Peer(name, controlled, partial(_prepare, template), "generated C", controlled == "steps")


def source(template: str, scene: Problem) -> str:
    """Return the C source code of a peer (an integrator for comparison) for the equation of a scene.

    ``template`` is the name of the template file of the peer, ``dop853.c.j2`` or ``rk4.c.j2``.

    Raises :class:`codegen.errors.SceneError` if the template needs a projection onto the manifold of the
    scene, and none is known.
    """
    environment = Environment(
        loader=PackageLoader("codegen.templates", "peers"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    field = velocity(scene)
    values: dict[str, object] = {
        "size": len(scene.symbols),
        "field": field.c(),
        "helpers": helper_texts(field.functions),
    }
    values["time"] = not scene.autonomous
    if template == "rk4.c.j2":
        values["projection"] = projection_lines(scene).c("z")
    else:
        values |= dop853()
    return environment.get_template(template).render(values)


def dop853() -> dict[str, object]:
    """Return a dictionary with the coefficients of DOP853 in double precision.

    - ``rows``: the rows of the matrix A of the Butcher tableau.
    - ``b``, ``c``: the weights and the nodes of the tableau.
    - ``fifth``: the difference between ``b`` and the weights of an embedded method of order 5.
    - ``third``: the difference between ``b`` and the weights of a quadrature rule of order 3.
    """
    tableau = Tableau.load(find("dop853"))

    def doubles(row: Sequence[Scalar]) -> list[float]:
        return [float(tableau.ring.approximate(x, 20)) for x in row]

    method, embedded = tableau.method, tableau.embedded
    assert isinstance(method, RungeKutta)
    assert isinstance(embedded, Embedded)
    rows, b, c = [doubles(row) for row in method.A], doubles(method.b), doubles(method.c)
    fifth = [x - y for x, y in zip(b, doubles(embedded.b), strict=True)]
    low = [0.0] * len(b)
    for i, w in zip((0, 8, 11), third_order([c[0], c[8], c[11]]), strict=True):
        low[i] = w
    third = [x - y for x, y in zip(b, low, strict=True)]
    return {"rows": rows, "b": b, "c": c, "fifth": fifth, "third": third}


def third_order(nodes: Sequence[float]) -> list[float]:
    """Return the weights of the quadrature rule on [0, 1] with three given nodes.

    The rule is exact for polynomials of degree 2, so its order is at least 3.

    >>> [round(6 * w, 12) for w in third_order([0.0, 0.5, 1.0])]
    [1.0, 4.0, 1.0]
    """
    weights = []
    for i, x in enumerate(nodes):
        p, q = (y for j, y in enumerate(nodes) if j != i)
        weights.append((1 / 3 - (p + q) / 2 + p * q) / ((x - p) * (x - q)))
    return weights


def _prepare(template: str, scene: Problem, control: float) -> Prepared:
    ffi, library = _library(source(template, scene))
    start = [float(x) for x in scene.initial(FloatDomain(0.0))]
    first, last = map(float, scene.span)
    counts, adaptive = ffi.new("size_t[2]"), template == "dop853.c.j2"

    def run(spans: int = 1) -> Outcome:
        state, end = ffi.new("double[]", start), first + spans * (last - first)
        scale = 1 if adaptive else spans
        status = library.peer(state, first, end, scale * control, counts, counts + 1)
        final = tuple(ffi.unpack(state, len(start)))
        if status or not all(map(math.isfinite, final)):
            raise PeerFailed(REASONS.get(status, REASONS[2]))
        return Outcome(final, int(counts[0]), int(counts[1]))

    return Prepared(run, lambda: run(0))


def _library(text: str) -> tuple[cffi.FFI, Scalar]:
    ffi = cffi.FFI()
    ffi.cdef(DECLARATION)
    return ffi, ffi.dlopen(str(build({"peer.c": text})))
