"""Measurements of emitted integrators.

A reference solution is computed without group exponentials and without the code of a method. Each
:class:`Measurement` produces one section of the report of the command ``orderconds report``.
"""

from codegen.lab.measurement import Measurement, Section
from codegen.lab.registry import listing, register

__all__ = ["Measurement", "Section", "listing", "register"]
