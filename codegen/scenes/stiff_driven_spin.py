"""Stiff driven spin on the sphere: the equation of ``driven_spin`` with rates of 2000 and 1000.

Explicit methods must take steps of about a thousandth here; the solution itself turns with the slow field.
"""

from sympy import Rational

from codegen.scenes.driven_spin import driven_spin

scene = driven_spin("Stiff driven spin on the sphere", 2000, Rational(1, 2), 100, 5)
