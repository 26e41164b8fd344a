"""Describes Python as a target language of the compiler."""

from __future__ import annotations

from codegen.printers.target import Target

TARGET = Target(
    name="python",
    title="Python",
    about="a Python module; it needs NumPy only for single precision or semilinear equations",
    printer="codegen.printers.python.module:print_module",
    loader="codegen.loader:load_interpreted",
    suffix=".py",
    most_steps=10240,
    spectral_loader="codegen.loader:load_interpreted_spectral",
    observer="codegen.printers.python.solutions:solutions",
)
