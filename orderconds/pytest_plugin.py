"""A pytest plugin for tableau files: ``pytest --orderconds tableaux/`` makes each file a test of its claims.

Without a flag the plugin does nothing. ``--orderconds-complete`` requires a claim for every family that a
tableau can claim. ``--orderconds-certified`` requires a proof of every order. ``orderconds check`` has the
same two flags. A tableau that claims nothing is skipped, with a reason. Files ``*.toml`` without the keys of
a tableau (``pyproject.toml``) are skipped, unless the command line names the file itself.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

FLAGS = ("--orderconds", "--orderconds-complete", "--orderconds-certified")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the flags."""
    group = parser.getgroup("orderconds", "order conditions of tableaux")
    group.addoption(
        "--orderconds", action="store_true", help="collect *.toml files as tableaux and check their claims"
    )
    group.addoption(
        "--orderconds-complete",
        action="store_true",
        help="like --orderconds, and require a claim for every family that a tableau can claim",
    )
    group.addoption(
        "--orderconds-certified",
        action="store_true",
        help="like --orderconds, and require a proof of every order",
    )


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect a tableau file if the flag is given."""
    if file_path.suffix != ".toml" or not any(map(parent.config.getoption, FLAGS)):
        return None
    from orderconds.tableau.file import meant_as_tableau

    if not (parent.session.isinitpath(file_path) or meant_as_tableau(file_path)):
        return None
    return TableauFile.from_parent(parent, path=file_path)


class TableauFile(pytest.File):
    """A file with one tableau."""

    def collect(self) -> Iterable[pytest.Item]:
        """Yield the one test of the file."""
        yield TableauItem.from_parent(self, name="claims")


class TableauItem(pytest.Item):
    """All claims of one tableau file."""

    def runtest(self) -> None:
        """Check the file; raise :class:`ClaimFails` with the text that ``orderconds check`` prints."""
        from orderconds.checking import check

        complete, certified = (bool(self.config.getoption(flag)) for flag in FLAGS[1:])
        report = check(self.path, complete=complete, certified=certified)
        if report.verdict != "holds":
            raise ClaimFails(report.summary())
        if all(family.claimed is None for family in report.orders) and not complete:
            orders = ", ".join(f"{family.family} {family.order}" for family in report.orders)
            pytest.skip(f"the file claims no order; computed orders: {orders}")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return the verdict. If the file cannot be read, return the message, without a traceback."""
        from orderconds.errors import InputError

        if isinstance(excinfo.value, ClaimFails | InputError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Name the file."""
        return self.path, None, f"orderconds: {self.path.name}"


class ClaimFails(AssertionError):
    """A claim of the file does not hold, or cannot be decided."""
