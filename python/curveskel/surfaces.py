"""Surfaces that fairing and contraction move."""

from . import _core
from .inputs import listening, soup_of


def fair(mesh, *, iterations=3, threads=0, time_limit=0, progress=None, **options):
    """A noisy surface smoothed, its connectivity and volume kept, as `curveskel fair` does.

    mesh, threads, time_limit, progress: as of `extract`.
    options: the program's, with _ for -: local_solver, method, precision, rings, smoothing, volume.

    Returns the vertices (v, 3), in the order given, and triangles (f, 3). Raises UsageError,
    InputError, DeviceError or SolverError.
    """
    with listening(progress, time_limit) as listener:
        return _core.fair(soup_of(mesh, listener),
                          dict(options, iterations=iterations, threads=threads), listener)


def contract(mesh, *, threads=0, time_limit=0, progress=None, **options):
    """Where each vertex ends up when the surface collapses, as `curveskel contract` finds it.

    mesh, threads, time_limit, progress: as of `extract`.
    options: the program's, with _ for -: components, flow, iterations, least_sheet, merge_overlapping,
        min_size, solver, wrap, wrap_gap.

    Returns the vertices (v, 3), in the order given, triangles (f, 3), and a dict of lists with an
    entry for each iteration of each component: component, iteration, area_ratio and volume_ratio
    (over those at the start), residual, vertices left; pandas.DataFrame takes it. Raises
    UsageError, InputError, DeviceError or SolverError.
    """
    with listening(progress, time_limit) as listener:
        return _core.contract(soup_of(mesh, listener), dict(options, threads=threads), listener)
