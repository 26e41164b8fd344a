"""A drawn picture, with a note for its caption and with the numbers that it shows."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from markupsafe import Markup

from codegen.lab.page.axes import SIZE

POINTS = 72.0
"""Printer's points in an inch."""


@dataclass(frozen=True)
class Drawn:
    """A picture: the SVG element, a note for the caption, and the numbers that the picture shows.

    ``numbers`` contains, for example, the largest deviation or the final point of each run.
    """

    svg: Markup
    note: str = ""
    numbers: Mapping[str, object] = field(default_factory=dict)

    @property
    def wide(self) -> bool:
        """True if the picture has the width of a page."""
        size = re.search(r'viewBox="0 0 ([\d.]+) ', self.svg)
        return size is not None and float(size[1]) > POINTS * SIZE[0] + 1.0
