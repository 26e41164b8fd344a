"""A pytest plugin for tableau files: ``pytest --orderconds tableaux/`` tests the orders that each file
claims.

The flags ``--orderconds-require-claims``, ``--orderconds-complete``, ``--orderconds-certified``,
``--orderconds-execute`` and ``--orderconds-tolerance`` correspond to options of ``orderconds check``. The
flag ``--orderconds-tolerance`` alone does not activate the plugin. Each of the other four flags activates the
plugin.

Files without a tableau are skipped. If a tableau does not claim an order, its test is skipped. With
``--orderconds-require-claims``, the test of a tableau without a claimed order fails.

A Python file is executed only with ``--orderconds-execute``.
"""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import pytest

FLAGS = {
    "--orderconds": "collect tableau files (TOML, JSON, CSV, NPZ, Python, LaTeX, C) and check their claims",
    "--orderconds-require-claims": "like --orderconds; a tableau that claims no order fails",
    "--orderconds-complete": "like --orderconds; a test fails unless the file claims an order in every "
    "family to which the method belongs. A family whose order always follows from the order in another "
    "family needs no claim.",
    "--orderconds-certified": "like --orderconds; a test fails if a claimed order is not proved",
    "--orderconds-execute": "like --orderconds; also execute each Python file and read its arrays",
}

SKIPPED = pytest.StashKey[dict[str, str]]()
"""A map from the name of each skipped file to the reason why the file is skipped."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the flags of the plugin to the command line of pytest."""
    group = parser.getgroup("orderconds", "order conditions of tableaux")
    for flag, text in FLAGS.items():
        group.addoption(flag, action="store_true", help=text)
    group.addoption(
        "--orderconds-tolerance",
        type=float,
        metavar="UNITS",
        help="a coefficient that is a binary float x has the uncertainty UNITS * 2^-53 * max(1, |x|); "
        "default: 8",
    )


def _is_on(config: pytest.Config) -> bool:
    return any(config.getoption(flag) for flag in FLAGS)


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Return a collector for a tableau file. Return None for every other file."""
    if not _is_on(parent.config):
        return None
    from orderconds.exchange.folder import SUFFIXES, reason_to_skip

    config = parent.config
    if (
        file_path.suffix not in SUFFIXES
        or _is_test_module(file_path, config)
        or not _asked(file_path, config)
    ):
        return None
    strict = bool(config.getoption("--orderconds-require-claims"))
    reason = reason_to_skip(file_path, strict=strict)
    if reason and not (parent.session.isinitpath(file_path) and file_path.suffix != ".py"):
        config.stash.setdefault(SKIPPED, {})[str(file_path)] = reason
        return None
    return TableauFile.from_parent(parent, path=file_path)


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makemodule(module_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Prevent pytest from importing a Python file that contains a tableau."""
    if not _is_on(parent.config) or _is_test_module(module_path, parent.config):
        return None
    from orderconds.exchange.folder import reason_to_skip

    strict = bool(parent.config.getoption("--orderconds-require-claims"))
    return (
        None if reason_to_skip(module_path, strict=strict) else NoTests.from_parent(parent, path=module_path)
    )


def _asked(path: Path, config: pytest.Config) -> bool:
    """Return True if the command line of pytest names this file or a folder that contains the file."""
    places = (config.invocation_params.dir / argument.partition("::")[0] for argument in config.args)
    return any(path.is_relative_to(place) or path.is_relative_to(place.resolve()) for place in places)


def _is_test_module(path: Path, config: pytest.Config) -> bool:
    """Return True if the file is a test module according to the setting ``python_files`` of pytest."""
    return path.suffix == ".py" and any(fnmatch(path.name, x) for x in config.getini("python_files"))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Print the name of each skipped file and the reason."""
    for path, reason in config.stash.get(SKIPPED, {}).items():
        terminalreporter.write_line(f"orderconds: skipped {path}: {reason}")


class NoTests(pytest.File):
    """A Python file that contains a tableau. Pytest does not import the file and collects no tests
    from the file."""

    def collect(self) -> Iterable[pytest.Item]:
        """Return no tests. This collector replaces the collector of pytest, which would import the file.
        :class:`TableauFile` contains the test of the tableau."""
        return ()


class TableauFile(pytest.File):
    """A file with one tableau."""

    def collect(self) -> Iterable[pytest.Item]:
        """Yield a single test of all claims of the file."""
        yield TableauItem.from_parent(self, name="claims")


class TableauItem(pytest.Item):
    """A test of all claims of one tableau file."""

    def runtest(self) -> None:
        """Check the file. If a claim fails, raise :class:`ClaimFails` with the text that ``orderconds check``
        prints."""
        from orderconds.checking import check, read

        require, complete, certified, execute = (
            bool(self.config.getoption(flag)) for flag in list(FLAGS)[1:]
        )
        report = check(
            read(self.path, execute=execute),
            complete=complete,
            certified=certified,
            tolerance=self.config.getoption("--orderconds-tolerance"),
        )
        if report.verdict == "unclaimed" and not require:
            pytest.skip(report.conclusion)
        if report.verdict != "holds":
            raise ClaimFails(report.summary())

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return the text of a failure. For a false claim or an invalid file, the text has no traceback."""
        from orderconds.errors import InputError

        if isinstance(excinfo.value, ClaimFails | InputError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Return three values for the report of pytest: the path of the file, the line number (None), and
        the title of the test."""
        return self.path, None, f"orderconds: {self.path.name}"


class ClaimFails(AssertionError):
    """This error is raised if a claim is false, if a claim cannot be decided, or if a required claim is
    missing."""
