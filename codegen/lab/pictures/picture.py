"""A class for drawn pictures."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from markupsafe import Markup

from codegen.lab.page.axes import SIZE

POINTS = 72.0
"""The number of printer's points in an inch (the SVG elements measure lengths in printer's points)."""


@dataclass(frozen=True)
class Drawn:
    """A drawn picture.

    - ``svg``: the SVG element.
    - ``note``: sentences for the caption.
    - ``numbers``: a dictionary of numbers that the picture shows, for example the final point of each run.
    """

    svg: Markup
    note: str = ""
    numbers: Mapping[str, object] = field(default_factory=dict)

    @property
    def wide(self) -> bool:
        """True if the picture is wider than the default. A wide picture fills the width of the page."""
        size = re.search(r'viewBox="0 0 ([\d.]+) ', self.svg)
        return size is not None and float(size[1]) > POINTS * SIZE[0] + 1.0
