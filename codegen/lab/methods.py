"""Methods as the laboratory's commands are given them: a spelling, read for a scene."""

from __future__ import annotations

from codegen.lower import families_for
from codegen.method import Method, parse
from codegen.scene import Setting


def parse_for(scene: Setting, spelling: str) -> Method:
    """Return the method of that spelling among those the scene can take."""
    return parse(spelling, families_for(scene))
