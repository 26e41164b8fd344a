"""The type of functions that display the progress of long measurements."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Progress: TypeAlias = Callable[[str], object]
"""A function that displays one line of text about the progress, for example the name of the next measurement.

Pass :class:`str` to display nothing: ``str(text)`` only returns the text.
"""
