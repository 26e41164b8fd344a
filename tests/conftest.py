"""The option that rewrites golden files, how examples are drawn, and when garbage is collected."""

from __future__ import annotations

import gc

import pytest
from hypothesis import settings

# The result depends on the code only: there are no deadlines, and every run tests the same examples.
settings.register_profile("orderconds", deadline=None, derandomize=True)
settings.load_profile("orderconds")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--update", action="store_true", help="rewrite the golden files")


# The collected tests and the imported modules are almost a million objects. They live until the end of the
# run. The garbage collector would visit them again and again. This takes a tenth of the time of all tests.
gc.disable()


def pytest_collection_finish() -> None:
    """Exempt all objects that exist before the first test from garbage collection."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(2_000_000, 20, 20)
    gc.enable()
