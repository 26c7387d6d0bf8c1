"""Surfaces of files, and those that fairing and contraction move."""

import numpy

from . import _core
from .inputs import listening, path_of, soup_of


def faces_of(polygons):
    """An array (f, k), or a list of arrays where the numbers of corners differ."""
    corners, offsets = polygons
    sizes = numpy.diff(offsets)
    if len(sizes) and (sizes == sizes[0]).all():
        return corners.reshape(-1, sizes[0])
    return numpy.split(corners, offsets[1:-1])


def read_surface(path, *, as_bound=False, progress=None):
    """The surface in a file, as it is there: what `extract` and the others read of a path.

    path: OBJ, OFF, PLY, STL, OM, glTF, GLB, VRM, VTP, VTK, 3MF, COLLADA or FBX, with `.gz` or not.
    as_bound: of skinned meshes the places in which they were bound, not those in which they rest.
    progress: as of `extract`.

    Returns the vertices (v, 3), in the order of the file, and faces: an array (f, k), or a list of
    arrays where their numbers of corners differ. Nothing is repaired. Raises InputError.
    """
    with listening(progress) as listener:
        soup = _core.read_surface(path_of(path, "path"), as_bound, listener)
    return soup.positions, faces_of(soup.polygons)


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
    options: the program's, with _ for -: components, flow, iterations, least_handle, least_sheet,
        merge_overlapping, min_size, solver, wrap, wrap_gap.

    Returns the vertices (v, 3), in the order given, triangles (f, 3), and a dict of lists with an
    entry for each iteration of each component: component, iteration, area_ratio and volume_ratio
    (over those at the start), residual, vertices left; pandas.DataFrame takes it. Raises
    UsageError, InputError, DeviceError or SolverError.
    """
    with listening(progress, time_limit) as listener:
        return _core.contract(soup_of(mesh, listener), dict(options, threads=threads), listener)
