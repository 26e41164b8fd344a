"""The type of a progress display: a function that is called with a message for the user."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Progress: TypeAlias = Callable[[str], object]
"""A function that is called with one line of text, the name of the next measurement.

Pass :class:`str` to display nothing.
"""
