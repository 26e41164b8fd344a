"""Python as a target."""

from __future__ import annotations

from codegen.printers.target import Target

TARGET = Target(
    name="python",
    title="Python",
    about="a Python module without dependencies (in single precision: NumPy)",
    printer="codegen.printers.python.module:print_module",
    loader="codegen.loader:load_interpreted",
    suffix=".py",
    most_steps=10240,
    observer="codegen.printers.python.solutions:solutions",
)
