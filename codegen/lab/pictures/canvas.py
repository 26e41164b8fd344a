"""The canvas of a picture. A canvas has one or several panels with curves."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias, TypedDict

import numpy
from markupsafe import Markup

from codegen.lab.page.axes import SIZE, appearance, legend, new_figure
from codegen.lab.page.series_style import Style, Styles, method_name
from codegen.lab.page.svg import INK, Text, svg_element
from codegen.scene.figure import Figure, Run
from codegen.scene.problem import Problem

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawn

WIDE = 7.4
"""The width in inches of a picture that fills the width of a page."""

DOT = 1.1
"""The diameter of a dot in printer's points (units of 1/72 inch)."""

MARKS = 8
"""The largest number of markers on a curve."""

REFERENCE = "reference"
"""The label of the curve of a reference run."""


class Looks(TypedDict, total=False):
    """Keyword arguments of Matplotlib's ``plot`` for a line."""

    color: str
    marker: str
    markerfacecolor: str
    linestyle: str | tuple[float, tuple[float, ...]]
    linewidth: float
    alpha: float
    zorder: float


Points: TypeAlias = "tuple[Sequence[float] | numpy.ndarray, Sequence[float] | numpy.ndarray]"
"""The points of a curve as a pair: the x coordinates of all points, and the y coordinates of all points."""


@dataclass
class Canvas:
    """A picture to which curves are added.

    Curves with equal labels form a series. The legend has one entry for each series.

    - ``drawing``: the figure of Matplotlib.
    - ``panels``: the Matplotlib axes of the panels.
    - ``names``: the labels of the series.
    - ``texts``: maps the index of a series in ``names`` to the texts of its markers.
    - ``titled``: the labels that the legend omits, because they are titles of panels.
    """

    drawing: Drawn
    panels: tuple[Axes, ...]
    names: list[str] = field(default_factory=list)
    texts: dict[int, list[str]] = field(default_factory=dict)
    titled: set[str] = field(default_factory=set)

    @classmethod
    def of(
        cls,
        count: int = 1,
        columns: int = 2,
        height: float = SIZE[1],
        *,
        width: float = 0.0,
        space: bool = False,
    ) -> Canvas:
        """Return a canvas with ``count`` panels.

        A row contains at most ``columns`` panels. Exception: if ``count`` is 3 and ``columns`` is 2, all
        three panels are in one row. ``height`` (of a panel) and ``width`` (of the picture) are in inches. If
        ``width`` is 0, the number of columns determines the width. If ``space`` is True, the panels have
        three axes.
        """
        columns = min(3 if count == 3 and columns > 1 else columns, count)
        rows = -(-count // columns)
        size = (width or (SIZE[0] if columns == 1 else WIDE), height * rows)
        drawing, panels = new_figure(rows, columns, size, "3d" if space else None)
        for unused in panels[count:]:
            unused.set_axis_off()
        return cls(drawing, panels[:count])

    def line(
        self,
        axes: Axes,
        points: Points,
        label: str,
        style: Style,
        marks: Sequence[int] = (),
        texts: Sequence[str] = (),
        looks: Looks | None = None,
    ) -> None:
        """Draw a curve as a line.

        ``marks`` contains the indices of the points with markers, and ``texts`` contains one text for each
        marker. The arguments in ``looks`` override ``style``.
        """
        number = self.number(label)
        listed = "_" if label in self.titled else label
        settings: Looks = {**appearance(style), **(looks or {})}
        x, y = points
        (line,) = axes.plot(x, y, label=listed, markevery=list(marks), **settings)
        line.set_gid(f"series:{number}")
        self.texts[number] += texts

    def dots(self, axes: Axes, points: Points, label: str, style: Style, alpha: float = 1.0) -> None:
        """Draw the points of a curve as dots.

        Each dot is a line of length zero with round ends, because Matplotlib's markers need more SVG code.
        """
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        number, looks = self.number(label), appearance(style)
        x, y = (numpy.asarray(row) for row in points)
        shown = numpy.isfinite(x) & numpy.isfinite(y)
        corners = numpy.repeat(numpy.array([x[shown], y[shown]]).T, 2, axis=0)
        path = Path(corners, [Path.MOVETO, Path.LINETO] * int(shown.sum()))
        path.should_simplify = False  # Simplification of the path would remove dots.
        patch = PathPatch(path, fill=False, edgecolor=looks["color"], linewidth=DOT, alpha=alpha)
        patch.set(gid=f"series:{number}", capstyle="round")
        axes.add_patch(patch)
        if label not in self.titled:
            axes.plot([], [], label=label, linestyle="", marker="o", markersize=3, color=looks["color"])

    def title(self, axes: Axes, label: str) -> None:
        """Write the label of a series above a panel, as a title. The legend omits this label."""
        axes.set_title(label, fontsize=9, color=INK)
        self.titled.add(label)

    def number(self, label: str) -> int:
        """Return the number (0, 1, 2, ...) of the series with the label ``label``.

        A new label gets the next number.
        """
        if label not in self.names:
            self.names.append(label)
            self.texts[len(self.names) - 1] = []
        return self.names.index(label)

    def finish(self, figure: Figure, scene: Problem, description: str) -> Markup:
        """Add the legend, and return the picture as an SVG element.

        ``description`` is a text for a reader who cannot see the picture.
        """
        name = f"{scene.name} {figure.name}"
        numbers = {name: k for k, name in enumerate(self.names)}
        if any(name not in self.titled for name in self.names):
            legend(self.drawing, self.panels, numbers)
        svg = svg_element(self.drawing, Text(name, f"{figure.title}, {scene.title}", description, self.texts))
        return Markup(_rounded(str(svg)))


def styles(figure: Figure) -> dict[str, Style]:
    """Return a dictionary that maps the name of each run of a figure to the style of the run."""
    runs = figure.runs
    chosen = Styles([run.method for run in runs])
    if len({run.method for run in runs}) == len(runs):
        return {run.name: chosen.of(run.method) for run in runs}
    chosen = Styles([method_name(run.name) for run in runs])
    return {run.name: chosen.of(run.name) for run in runs}


REFERENCE_LOOKS: Looks = {"color": INK, "linewidth": 0.9, "linestyle": "-", "marker": "", "zorder": 3}
REFERENCE_STYLE = Style("var(--ink)", "")


def marks(count: int, shift: float = 0.0, most: int = MARKS) -> list[int]:
    """Choose at most ``most`` of ``count`` points and return the indices of the chosen points.

    If ``count`` is greater than ``most``, one point is chosen from each of ``most`` groups of about equal
    size. ``shift`` (at least 0 and less than 1) is the relative position of the chosen point in its group.

    >>> marks(9, 0.5, 3), marks(2)
    ([1, 4, 7], [0, 1])
    """
    if count <= most:
        return list(range(count))
    return [int((k + shift) * count / most) for k in range(most)]


def failures(runs: Sequence[Run], reasons: Sequence[str]) -> str:
    """Return a text with one sentence for each run that did not reach its end time.

    ``reasons`` contains the reason for each run, or '' if the run reached its end time.
    """
    return " ".join(
        f"{run.name} ends early: {reason}." for run, reason in zip(runs, reasons, strict=True) if reason
    )


def _rounded(svg: str) -> str:
    """Return the SVG element with the coordinates of paths rounded to two decimals."""

    def shorter(match: re.Match[str]) -> str:
        path = re.sub(r"-?\d+\.\d+", lambda x: f"{float(x[0]):.2f}".rstrip("0").rstrip("."), match[1])
        path = re.sub(r"\s*\n\s*", "", path).strip()
        return f'd="{path}"'

    return re.sub(r'\bd="([^"]*)"', shorter, svg)
