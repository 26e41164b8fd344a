"""Measurements of emitted integrators.

Errors are measured against reference solutions. A reference solution is computed without group exponentials
and without the code of a method.

The command ``orderconds report`` writes a report. Each :class:`Measurement` produces one section of the
report. :func:`register` adds a measurement to the list, and :func:`listing` returns the names and
descriptions of all measurements.
"""

from codegen.lab.measurement import Measurement, Section
from codegen.lab.registry import listing, register

__all__ = ["Measurement", "Section", "listing", "register"]
