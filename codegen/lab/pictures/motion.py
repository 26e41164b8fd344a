"""Draws the motion of a body that consists of bars, as an SVG element with an animation.

The animation consists of CSS keyframes in a style element, and needs no script. Where no animation is
possible, for example on paper, the picture shows the path of one point, and the bars at a few times.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

import numpy
from markupsafe import Markup

from codegen.errors import SceneError
from codegen.lab.page.series_style import COLOURS
from codegen.lab.pictures.canvas import failures
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.lab.pictures.sphere import projection
from codegen.scene.figure import Motion

WIDTH, MARGIN = 338.0, 26.0
"""The width of the picture, and the width of its empty border, in printer's points (units of 1/72 inch)."""

LINE = 14.0
"""The height of a line of the legend, in printer's points."""

FAINT = 0.4
"""The opacity of the still images. Each still image shows the body at one time after the initial time."""

FRAMES = 150
"""The largest number of keyframes of the animation."""


@dataclass(frozen=True)
class _Sheet:
    """The map from points in space to points of the picture: a projection, then a scaling and a shift.

    - ``frame``: the rotation matrix that maps a point to its horizontal, vertical and depth coordinates.
    - ``left``: the least horizontal coordinate of the drawn points.
    - ``high``, ``low``: the largest and the least vertical coordinate of the drawn points.
    - ``unit``: the scale factor from projected coordinates to printer's points.
    - ``top``: the height of the space for the legend above the drawing, in printer's points.
    - ``axis``: the length of each drawn coordinate axis before the projection.
    """

    frame: numpy.ndarray
    left: float
    high: float
    low: float
    unit: float
    top: float
    axis: float

    @classmethod
    def of(cls, frame: numpy.ndarray, points: numpy.ndarray, top: float) -> _Sheet:
        """Return the map from space to a picture. The picture shows the coordinate axes and the given points.

        The points are the columns of ``points``.
        """
        axis = 0.55 * float(numpy.linalg.norm(points, axis=0).max())
        ends = numpy.concatenate([points, 1.1 * axis * numpy.eye(3), numpy.zeros((3, 1))], axis=1)
        right, up, _ = frame @ ends
        unit = (WIDTH - 2 * MARGIN) / float(right.max() - right.min())
        return cls(frame, float(right.min()), float(up.max()), float(up.min()), unit, top, axis)

    @property
    def height(self) -> float:
        """The height of the picture in printer's points."""
        return self.top + MARGIN + self.unit * (self.high - self.low)

    def seen(self, points: numpy.ndarray) -> numpy.ndarray:
        """Project points onto the picture, and return their positions as the columns of an array.

        The columns of ``points`` are points in space.
        """
        right, up, _ = self.frame @ points
        return numpy.array(
            [MARGIN + self.unit * (right - self.left), self.top + self.unit * (self.high - up)]
        )


def draw(figure: Motion, source: Source) -> Drawn:
    """Return the picture of a figure.

    Raises :class:`codegen.errors.SceneError` if the figure does not have exactly one run, or if a coordinate
    of a bar or of the traced point is not finite.
    """
    if len(figure.runs) != 1:
        raise SceneError(
            f"the figure of a moving body has {len(figure.runs)} runs",
            where=source.problem.name,
            expected="a figure with one run",
        )
    (run,) = figure.runs
    places = [*(place for bar in figure.bars.values() for place in bar), figure.trace]
    path = source.path(run)
    rows = source.values(run, [x for place in places for x in place])
    if not numpy.isfinite(rows).all():
        raise SceneError(
            "a coordinate of a bar or of the traced point is not finite",
            where=source.problem.name,
            expected="finite coordinates",
        )
    points = rows.reshape(len(places), 3, -1)
    frame = projection(*figure.direction)
    fixed = numpy.array([*figure.fixed.values(), (0.0, 0.0, 0.0)]).T
    top = MARGIN + LINE * (len(figure.bars) + 1 + len(figure.fixed))
    sheet = _Sheet.of(frame, numpy.concatenate([*points, fixed], axis=1), top)
    ends = [sheet.seen(p) for p in points[:-1]]
    bars = list(zip(ends[::2], ends[1::2], strict=True))
    name = re.sub(r"\W+", "-", f"{source.problem.name} {figure.name}")
    shown = [int(k) for k in numpy.linspace(0, len(path.times) - 1, figure.stills + 1)]
    trail = sheet.seen(points[-1])
    parts = [
        *_axes(sheet),
        *_fixed(figure, sheet),
        f'<path d="{_curve(trail)}" style="fill:none;stroke:var(--muted);stroke-width:0.7"/>',
        *_stills(bars, shown[1:]),
        *_times(trail, path.times, shown),
        *_moving(name, bars),
        *_legend(figure, path.times, shown),
    ]
    style = _keyframes(name, figure.seconds, bars)
    last = {label: points[2 * k + 1][:, -1].tolist() for k, label in enumerate(figure.bars)}
    note = failures(figure.runs, [path.failure])
    words = f"{figure.title}, {source.problem.title}"
    about = f"{run.name}: t from {path.times[0]:g} to {path.times[-1]:g}."
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {sheet.height:g}" class="{name}"'
    head += f' tabindex="0" role="img" aria-labelledby="{name}-title {name}-desc">'
    head += f'<title id="{name}-title">{escape(words)}</title><desc id="{name}-desc">{escape(about)}</desc>'
    return Drawn(Markup(f"{head}{style}{''.join(parts)}</svg>"), note, last)


def _number(x: float) -> str:
    return f"{x:.2f}".rstrip("0").rstrip(".")


def _curve(points: numpy.ndarray) -> str:
    """Return SVG path data for the polygonal line whose corners are the columns of ``points``."""
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points.T)


def _text(x: float, y: float, words: str, colour: str = "var(--muted)") -> str:
    style = f"font:8.5px var(--sans);fill:{colour}"
    return f'<text x="{_number(x)}" y="{_number(y)}" style="{style}">{escape(words)}</text>'


def _axes(sheet: _Sheet) -> Iterator[str]:
    """Yield SVG elements for the coordinate axes: a line from the origin and a name for each axis."""
    for k, name in enumerate("xyz"):
        ends = sheet.seen(sheet.axis * numpy.outer(numpy.eye(3)[k], (0.0, 1.0, 1.09)))
        yield f'<path d="{_curve(ends[:, :2])}" style="fill:none;stroke:var(--rule);stroke-width:0.8"/>'
        yield _text(ends[0, 2] - 2, ends[1, 2] + 3, name)


def _fixed(figure: Motion, sheet: _Sheet) -> Iterator[str]:
    """Yield a small square, as an SVG element, for each fixed point of the figure."""
    for point in figure.fixed.values():
        x, y = sheet.seen(numpy.array([point]).T)[:, 0]
        yield f'<path d="M{_number(x - 4)} {_number(y - 4)}h8v8h-8Z" style="fill:var(--ink)"/>'


def _line(bar: tuple[numpy.ndarray, numpy.ndarray], k: int) -> str:
    return _curve(numpy.array([bar[0][:, k], bar[1][:, k]]).T)


def _stroke(number: int, width: float) -> str:
    dash = ("", ";stroke-dasharray:5 2", ";stroke-dasharray:1.5 2")[number % 3]
    return f"fill:none;stroke:var(--series-{number % COLOURS + 1});stroke-width:{width:g}{dash}"


def _stills(bars: Sequence[tuple[numpy.ndarray, numpy.ndarray]], times: Sequence[int]) -> Iterator[str]:
    for k in times:
        for number, bar in enumerate(bars):
            yield f'<path d="{_line(bar, k)}" style="{_stroke(number, 1.4)};opacity:{FAINT}"/>'


def _times(trail: numpy.ndarray, times: numpy.ndarray, shown: Sequence[int]) -> Iterator[str]:
    """Yield SVG elements for numbered dots on the path of a point, one for each time index in ``shown``."""
    for number, k in enumerate(shown):
        x, y = trail[:, k]
        yield f'<circle cx="{_number(x)}" cy="{_number(y)}" r="2" style="fill:var(--ink)">'
        yield f"<title>t = {times[k]:.4g}</title></circle>"
        yield _text(x + 4, y - 4, str(number), "var(--ink)")


def _lengths(bar: tuple[numpy.ndarray, numpy.ndarray]) -> numpy.ndarray:
    """Return the length of a projected bar at each time."""
    lengths: numpy.ndarray = numpy.hypot(*(bar[1] - bar[0]))
    return lengths


def _transform(bar: tuple[numpy.ndarray, numpy.ndarray], k: int, turn: float, unit: str = "") -> str:
    """Return the SVG transform for the picture of a bar at the time with index ``k``.

    The transform is applied to a horizontal line. This line begins at the origin and is as long as the
    longest projection of the bar. ``turn`` is the angle of the projected bar in degrees. If ``unit`` is
    ``px``, the result is a CSS transform.
    """
    (x, y), lengths = bar[0][:, k], _lengths(bar)
    comma = f"{_number(x)}{unit},{_number(y)}{unit}"
    scale = f"scale({lengths[k] / lengths.max():.4f},1)"
    return f"translate({comma}) rotate({_number(turn)}{'deg' if unit else ''}) {scale}"


def _turns(bar: tuple[numpy.ndarray, numpy.ndarray]) -> numpy.ndarray:
    """Return the angle of a projected bar at each time, in degrees, without jumps of 360 degrees."""
    difference = bar[1] - bar[0]
    turns: numpy.ndarray = numpy.degrees(numpy.unwrap(numpy.arctan2(difference[1], difference[0])))
    return turns


def _moving(name: str, bars: Sequence[tuple[numpy.ndarray, numpy.ndarray]]) -> Iterator[str]:
    """Yield an SVG element for each bar at the initial time. The CSS class of bar k is ``name``-k."""
    for number, bar in enumerate(bars):
        at = _transform(bar, 0, _turns(bar)[0])
        yield f'<path class="{name}-{number}" d="M0 0H{_number(_lengths(bar).max())}" transform="{at}"'
        yield f' style="{_stroke(number, 3.2)}"/>'


def _keyframes(name: str, seconds: float, bars: Sequence[tuple[numpy.ndarray, numpy.ndarray]]) -> str:
    rules = []
    for number, bar in enumerate(bars):
        turns = _turns(bar)
        count = len(turns)
        chosen = [int(k) for k in numpy.linspace(0, count - 1, min(count, FRAMES))]
        frames = "".join(
            f"{_number(100.0 * k / max(count - 1, 1))}%{{transform:{_transform(bar, k, turns[k], 'px')}}}"
            for k in chosen
        )
        rules.append(f"@keyframes {name}-{number}{{{frames}}}")
        moves = f".{name}-{number}{{animation:{name}-{number} {seconds:g}s linear infinite}}"
        rules.append(f"@media (prefers-reduced-motion:no-preference){{{moves}}}")
    rules.append(f".{name}:hover path,.{name}:focus path{{animation-play-state:paused}}")
    return f"<style>{''.join(rules)}</style>"


def _legend(figure: Motion, times: numpy.ndarray, shown: Sequence[int]) -> Iterator[str]:
    """Yield the SVG elements of the legend above the drawing."""
    y = MARGIN / 2
    for number, label in enumerate(figure.bars):
        yield f'<path d="M8 {_number(y - 3)}H32" style="{_stroke(number, 3.2)}"/>'
        yield _text(40, y, label, "var(--ink)")
        y += LINE
    yield f'<path d="M8 {_number(y - 3)}H32" style="fill:none;stroke:var(--muted);stroke-width:0.7"/>'
    listed = ", ".join(f"{number}: t = {times[k]:.3g}" for number, k in enumerate(shown))
    yield _text(40, y, f"path; {listed}", "var(--ink)")
    for label in figure.fixed:
        y += LINE
        yield f'<path d="M16 {_number(y - 7)}h8v8h-8Z" style="fill:var(--ink)"/>'
        yield _text(40, y, label, "var(--ink)")
