"""The option that rewrites golden files, and how examples are drawn."""

from __future__ import annotations

import pytest
from hypothesis import settings

# A run tells of the code, not of the machine's load or of luck: no deadlines, the same examples every time.
settings.register_profile("orderconds", deadline=None, derandomize=True)
settings.load_profile("orderconds")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--update", action="store_true", help="rewrite the golden files")
