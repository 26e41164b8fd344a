"""The compiler's commands as pyproject.toml registers them, as for the commands' own tests."""

from tests.codegen.commands.conftest import registered

__all__ = ["registered"]
