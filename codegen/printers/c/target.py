"""Describes C as a target language of the compiler."""

from __future__ import annotations

from codegen.printers.target import Target

TARGET = Target(
    name="c",
    title="C",
    about="C11 without dependencies: a header and a source file",
    printer="codegen.printers.c.module:print_module",
    loader="codegen.loader:load_compiled",
    suffix=".c",
    most_steps=163840,
    compiler="codegen.build:compile_seconds",
    stack=r"stack: +at most (\d+) bytes",
    batches=True,
    lattice_loader="codegen.loader:load_compiled_lattice",
    spectral_loader="codegen.loader:load_compiled_spectral",
)
