"""Measurements of emitted integrators.

Errors are measured against reference solutions, which are computed without Lie groups.

A :class:`Measurement` is one section of the report that the command ``report`` writes. :func:`register` adds
a measurement, and :func:`listing` returns all measurements.
"""

from codegen.lab.measurement import Measurement, Section
from codegen.lab.registry import listing, register

__all__ = ["Measurement", "Section", "listing", "register"]
