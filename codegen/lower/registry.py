"""The registry of lowerings. A lowering turns the methods of one family into programs."""

from __future__ import annotations

from codegen.errors import MethodError
from codegen.lower.base import Lowering
from codegen.scene.problem import Problem
from orderconds import families
from orderconds.families import Family

_registered: dict[str, Lowering] = {}


def _built_in() -> tuple[type[Lowering], ...]:
    """Return the lowerings of this package, in the order in which commands list them."""
    # Imports at the top of this file would be circular.
    from codegen.lower.ambient import Ambient
    from codegen.lower.cayley import CayleyLowering
    from codegen.lower.cf import CommutatorFreeLowering
    from codegen.lower.cf_magnus import CommutatorFreeMagnusLowering
    from codegen.lower.cg import CrouchGrossman
    from codegen.lower.composition import CompositionLowering
    from codegen.lower.discrete_gradient import DiscreteGradient
    from codegen.lower.fer import FerLowering
    from codegen.lower.magnus import MagnusLowering
    from codegen.lower.prk import PartitionedLowering
    from codegen.lower.rk import RungeKuttaLowering
    from codegen.lower.rkmk import MuntheKaas
    from codegen.lower.slgi import SymplecticIntegrator
    from codegen.lower.splitting import SplittingLowering
    from codegen.lower.taylor import Taylor
    from codegen.lower.vcf import VariationalCommutatorFree
    from codegen.lower.vcg import VariationalCrouchGrossman
    from codegen.lower.vrkmk import VariationalMuntheKaas
    from codegen.lower.vrkmk_pade import VariationalMuntheKaasPade

    # The compiler chooses the first family among families of equal order and equal preference.
    return (
        RungeKuttaLowering,
        MuntheKaas,
        CrouchGrossman,
        CommutatorFreeLowering,
        VariationalCrouchGrossman,
        VariationalMuntheKaas,
        VariationalCommutatorFree,
        VariationalMuntheKaasPade,
        SymplecticIntegrator,
        DiscreteGradient,
        SplittingLowering,
        CompositionLowering,
        Ambient,
        Taylor,
        MagnusLowering,
        CommutatorFreeMagnusLowering,
        FerLowering,
        CayleyLowering,
        PartitionedLowering,
    )


def register(lowering: type[Lowering], family: type[Family] | None = None) -> type[Lowering]:
    """Register the class ``lowering`` for its family, and return this class.

    If ``family`` is given, :func:`orderconds.families.register` registers ``family``, too.

    :class:`codegen.errors.MethodError` is raised for a class without :attr:`Lowering.family`. The error is
    also raised if another class is registered for the family.
    """
    if not lowering.family:
        raise MethodError(
            f'the class {lowering.__name__} does not set the attribute "family"',
            expected='family = "NAME" in the class',
        )
    # Each family has one lowering class. Another class must not replace the registered class silently.
    known = _lowerings().get(lowering.family)
    # A second call with the same class is harmless, so only another class is an error.
    if known is not None and type(known) is not lowering:
        raise MethodError(
            f"another class is registered for the family {lowering.family}",
            where=lowering.__name__,
            expected="the name of a family that has no registered class",
        )
    if family is not None:
        families.register(family)
    # Objects of a lowering class have no data, so one object for each family is sufficient.
    _registered[lowering.family] = lowering()
    return lowering


def unregister(family: str) -> None:
    """Remove the lowering that :func:`register` added for a family.

    MethodError is raised for a built-in family.
    """
    # Built-in families cannot be removed, because the tableaux of the library refer to them.
    if any(lowering.family == family for lowering in _built_in()):
        raise MethodError(
            f"the built-in family {family} cannot be removed",
            expected="a family that was added by register()",
        )
    _registered.pop(family, None)


def names() -> tuple[str, ...]:
    """Return the names of all families that have a lowering, the built-in families first.

    >>> names()[:4]
    ('rk', 'rkmk', 'cg', 'cf')
    """
    # A dictionary keeps the order of insertion. The built-in families are inserted first.
    return tuple(_lowerings())


def lowering(family: str) -> Lowering:
    """Return the lowering of a family.

    :class:`codegen.errors.MethodError` is raised for a family without lowering.

    >>> lowering("vcg").hamiltonian
    True
    """
    known = _lowerings().get(family)
    if known is None:
        raise MethodError(
            f"the compiler does not support the family {family}", expected=f"one of {', '.join(names())}"
        )
    return known


def families_for(scene: Problem) -> tuple[str, ...]:
    """Return the names of the families that accept a scene.

    The names are sorted by decreasing :attr:`Lowering.preference`.
    """
    able = [own for own in _lowerings().values() if own.objection(scene) is None]
    # The sort is stable: families with equal preference keep the order of registration.
    return tuple(own.family for own in sorted(able, key=lambda own: -own.preference))


def _lowerings() -> dict[str, Lowering]:
    """Return the lowerings of all families, with the names of the families as keys."""
    if not _registered:
        _registered.update((lowering.family, lowering()) for lowering in _built_in())
    return _registered
