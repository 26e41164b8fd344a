"""The lab measures emitted integrators, against reference solutions that use no Lie group.

A :class:`Measurement` is one section of the report. :func:`register` adds one, and :func:`listing` lists
them.
"""

from codegen.lab.measurement import Measurement, Section
from codegen.lab.registry import listing, register

__all__ = ["Measurement", "Section", "listing", "register"]
