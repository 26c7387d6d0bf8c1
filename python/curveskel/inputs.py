"""Surfaces as callers give them, and progress as they want it."""

import contextlib
import os

import numpy

from . import _core
from .errors import UsageError


@contextlib.contextmanager
def shown(wanted):
    """The callback for the core: that given, one that moves a tqdm bar (True), or None."""
    if wanted is not True:
        yield wanted or None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(total=1.0, bar_format="{desc}: {percentage:3.0f}% {bar} {elapsed}") as bar:

        def show(stage, fraction):
            bar.set_description_str(stage)
            bar.n = fraction
            bar.refresh()

        yield show


def soup_of(mesh, progress, as_bound=False):
    """A path, a pair (vertices, faces), or an object that has both, as the core takes it."""
    if isinstance(mesh, (str, os.PathLike)):
        return _core.read_surface(os.fspath(mesh), as_bound, progress)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        mesh = (mesh.vertices, mesh.faces)
    try:
        vertices, faces = mesh
        vertices = numpy.ascontiguousarray(vertices, dtype=numpy.float64)
        faces = numpy.asarray(faces)
    except (TypeError, ValueError) as error:
        raise UsageError("mesh: needs a path, a pair (vertices, faces), or an object with "
                         f"vertices and faces, not {type(mesh).__name__}") from error
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise UsageError(f"vertices: needs shape (n, 3), not {vertices.shape}")
    if not numpy.issubdtype(faces.dtype, numpy.integer):
        raise UsageError(f"faces: needs integers, not {faces.dtype}")
    return _core.soup_of_arrays(vertices, numpy.ascontiguousarray(faces, dtype=numpy.int64))
