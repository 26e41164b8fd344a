"""References are computed once a test process."""

from __future__ import annotations

from functools import cache

import pytest

from codegen.lab.reference import Reference, reference
from codegen.scenes import load


@cache
def of(name: str) -> Reference:
    return reference(load(name))


@pytest.fixture(scope="session")
def exact() -> object:
    """A function from a gallery scene's name to its reference."""
    return of
