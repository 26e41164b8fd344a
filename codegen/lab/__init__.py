"""Measurements of emitted integrators.

Each :class:`Measurement` produces one section of the report of the command ``orderconds report``.
"""

from codegen.lab.measurement import Measurement, Section
from codegen.lab.registry import listing, register

__all__ = ["Measurement", "Section", "listing", "register"]
