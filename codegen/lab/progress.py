"""The type of a progress display: a function that is called with a message for the user."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Progress: TypeAlias = Callable[[str], object]
"""Called with one line that says what is measured next; :class:`str` ignores it."""
