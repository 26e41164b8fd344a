"""The figures of a scene. A figure shows values of formulas along numerical solutions of emitted code.

A scene file lists its figures in the variable ``figures``. Formulas are sympy formulas in the symbols of the
scene, in its parameters and in the time ``t``. The name of an invariant
can replace a formula.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar, TypeAlias

from codegen.errors import SceneError
from orderconds.argument import described

if TYPE_CHECKING:
    import numpy
    import sympy

Quantity: TypeAlias = "sympy.Expr | str"
"""A formula in the symbols of the state, or the name of an invariant."""

STEP = "h"
"""The name of the step size in a :class:`Sweep`."""


@dataclass(frozen=True)
class Sweep:
    """Values of a parameter of the scene, or of the step size ``h``: ``count`` equally spaced values from
    ``first`` to ``last``.
    """

    name: str
    first: float
    last: float
    count: int = 200


@dataclass(frozen=True)
class Run:
    """A run of emitted code from the initial state of a scene.

    The run makes ``steps`` steps of size ``h`` with a method, and the figure shows every ``stride``-th state.

    - ``label``: the name of the run in the figure, by default the method.
    - ``scene``: the name of the scene, by default the scene of the figure. The value ``"+u"`` means the scene
      of the figure on the extended phase space (:mod:`codegen.scene.extended_phase_space`).
    - ``tolerance``: the relative and absolute tolerance. If the tolerance is positive, the method chooses its
      own step sizes, and the states at every ``stride``-th multiple of ``h`` are shown.
    - ``sweep``: the parameter values or step sizes for which the run is repeated, or None. The figure shows
      the final state of each repetition.
    """

    method: str
    h: float
    steps: int
    label: str = ""
    scene: str = ""
    stride: int = 1
    tolerance: float = 0.0
    sweep: Sweep | None = None

    @property
    def name(self) -> str:
        """The name of the run in the figure."""
        return self.label or self.method


@dataclass(frozen=True, kw_only=True)
class Figure:
    """A figure: its name, its title, its caption, and the runs that it shows.

    ``source`` is the published figure that is reproduced, for example "Fig. 2.6 of Marthinsen's thesis".
    Some figures compare each run in ``runs`` with the run ``reference``. Other figures draw ``reference`` as
    a thin line.
    """

    shows_lattices: ClassVar[bool] = False

    name: str
    title: str
    caption: str = ""
    source: str = ""
    runs: tuple[Run, ...]
    reference: Run | None = None


@dataclass(frozen=True, kw_only=True)
class PlaneCurves(Figure):
    """Curves in a plane.

    - ``panels``: True if each run has a panel of its own.
    - ``bounds``: the limits (left, right, bottom, top) of the axes. By default they include all points.
    - ``marked``: True if markers are drawn at every state.
    - ``dots``: True if the states are drawn as dots without lines between them.
    """

    point: tuple[Quantity, Quantity]
    axes: tuple[str, str] = ("x", "y")
    panels: bool = False
    bounds: tuple[float, float, float, float] | None = None
    marked: bool = False
    dots: bool = False


@dataclass(frozen=True, kw_only=True)
class SphereCurves(Figure):
    """Curves on a sphere about the origin, in orthogonal projection.

    - ``direction``: the direction from the origin to the viewer, as (azimuth, elevation) in degrees.
    - ``panels``: True if each run has a panel of its own.
    - ``dots``: True if the states are drawn as dots without lines between them.
    """

    point: tuple[Quantity, Quantity, Quantity]
    axes: tuple[str, str, str] = ("x", "y", "z")
    direction: tuple[float, float] = (30.0, 25.0)
    panels: bool = True
    dots: bool = False


@dataclass(frozen=True, kw_only=True)
class SpaceCurves(Figure):
    """Curves in space, in orthogonal projection.

    - ``point``: formulas for the three coordinates of the points of a curve.
    - ``direction``: the direction from the origin to the viewer, as (azimuth, elevation) in degrees.
    """

    point: tuple[Quantity, Quantity, Quantity]
    axes: tuple[str, str, str] = ("x", "y", "z")
    direction: tuple[float, float] = (30.0, 25.0)


Place: TypeAlias = tuple[Quantity, Quantity, Quantity]
"""Formulas of the three coordinates of a point in space."""


@dataclass(frozen=True, kw_only=True)
class Motion(Figure):
    """The motion of a body that consists of bars, as an animation, in orthogonal projection.

    - ``bars``: a map from the label of each bar to the two ends of the bar.
    - ``trace``: a point whose path is shown.
    - ``fixed``: a map from labels to points that do not move.
    - ``stills``: the number of additional still images of the bars, at equally spaced times.
    - ``seconds``: the duration of one cycle of the animation.
    - ``direction``: the direction from the origin to the viewer, as (azimuth, elevation) in degrees.

    The figure shows only one run.
    """

    bars: Mapping[str, tuple[Place, Place]]
    trace: Place
    fixed: Mapping[str, tuple[float, float, float]] = field(default_factory=dict)
    stills: int = 4
    seconds: float = 8.0
    direction: tuple[float, float] = (30.0, 20.0)


@dataclass(frozen=True, kw_only=True)
class TorusCurves(Figure):
    """Curves on a torus, drawn in the plane of its two angles.

    - ``angles``: formulas for the two angles in radians.
    - ``axes``: the labels of the two angles.
    - ``variables``: two symbols that denote the angles in the formulas of ``state``.
    - ``state``: a formula for each coordinate of the state, as a function of the two angles.
    - ``directions``: formulas for the time derivatives of the angles, drawn as arrows.
    - ``levels``: a formula that is drawn as level lines.

    ``directions`` and ``levels`` are evaluated at the states that ``state`` gives on a grid of angles.
    """

    angles: tuple[Quantity, Quantity]
    axes: tuple[str, str] = ("θ", "φ")
    variables: tuple[sympy.Symbol, ...] = ()
    state: tuple[sympy.Expr, ...] = ()
    directions: tuple[Quantity, ...] = ()
    levels: Quantity | None = None


@dataclass(frozen=True, kw_only=True)
class TimeSeries(Figure):
    """Quantities, plotted against time, with one panel for each run.

    The reference curve is the first entry of ``quantities``, evaluated along the run ``reference``. If
    ``difference`` is True, the reference curve is subtracted from all quantities. ``window`` is the interval
    of time that is shown.
    """

    quantities: Mapping[str, Quantity] = field(default_factory=dict)
    axis: str = ""
    difference: bool = False
    reference_label: str = "reference"
    window: tuple[float, float] | None = None


@dataclass(frozen=True, kw_only=True)
class LatticeMeans(Figure):
    """Means over all sites of a lattice, plotted against time.

    The formulas contain the coordinates of a site and, on a periodic lattice, of its neighbours. ``shape`` =
    (n1, ..., nd) contains the number of sites in each dimension. ``start(shape)`` returns the initial states
    as an array of shape (n1, ..., nd, m), where m is the number of coordinates of a site.
    """

    shows_lattices: ClassVar[bool] = True
    quantities: Mapping[str, Quantity] = field(default_factory=dict)
    axis: str = ""
    shape: tuple[int, ...]
    start: Callable[[tuple[int, ...]], numpy.ndarray]


@dataclass(frozen=True, kw_only=True)
class Deviation(Figure):
    """The largest deviation of a quantity, plotted against time on a logarithmic axis.

    The deviation is the difference from the value along the reference run, or from the initial value if there
    is no reference run. If ``window`` is 0, the figure shows at each time t the maximum up to t. Otherwise
    the figure shows the maximum over each group of ``window`` consecutive states.
    """

    quantity: Quantity
    axis: str = ""
    window: int = 0


@dataclass(frozen=True, kw_only=True)
class Scan(Figure):
    """The distance between the final states of a run and of the reference run, plotted against a parameter.

    The values of the parameter are in the attribute ``sweep`` of the runs. The least distance is computed by
    minimisation and marked in the figure.
    """

    axis: str = ""


@dataclass(frozen=True, kw_only=True)
class Orders(Figure):
    """The error at the end of the time span, plotted against the step size, with one curve for each run.

    Each run is repeated ``halvings`` times, each time with half the previous step size. The error is the
    distance from the reference solution of the scene (``codegen.lab.distance``). For each number p in
    ``orders``, the figure also shows a dashed line of slope p.
    """

    halvings: int = 4
    orders: tuple[int, ...] = ()
    axis: str = "error"


def read_figures(scene: str, value: object) -> tuple[Figure, ...]:
    """Return the value of the variable ``figures`` of a scene file as a tuple.

    Raises :class:`codegen.errors.SceneError` for an object that is not a figure, and for two figures with
    the same name.
    """
    figures: list[Figure] = []
    for figure in value if isinstance(value, Iterable) else [value]:
        if not isinstance(figure, Figure):
            raise SceneError(
                f"{described(figure)} in the variable `figures`",
                where=scene,
                expected="figures, such as PlaneCurves(...) of codegen.scene.figure",
            )
        if any(figure.name == other.name for other in figures):
            raise SceneError(
                f"two figures with the name {figure.name!r}", where=scene, expected="distinct names"
            )
        figures.append(figure)
    return tuple(figures)
