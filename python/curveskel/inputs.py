"""Surfaces as callers give them, and progress and limits as they want them."""

import contextlib
import math
import operator
import os
import re
import time
import warnings

import numpy

from . import _core
from .errors import SolverError, UsageError


MOST_THREADS = _core.most_threads


class _Listener:
    """What the core tells of its work, and asks whether its time is over."""

    def __init__(self, tell, limit):
        self.tell = tell or (lambda stage, fraction: None)
        self._limit = limit
        self._end = time.monotonic() + limit if limit else math.inf

    def look(self):
        if time.monotonic() >= self._end:
            raise SolverError(f"the time limit of {self._limit:g} s was reached; allow more, or "
                              "decimate the surface first")


@contextlib.contextmanager
def listening(progress, time_limit=0):
    """The listener for the core, or None if nothing is to be told or asked.

    progress: a callable (stage, fraction); True moves a tqdm bar, if there is tqdm; None.
    time_limit: seconds from now; 0 = none. Raises UsageError for another value.
    """
    try:
        seconds = float(time_limit)
    except (TypeError, ValueError):
        seconds = math.nan
    if not 0 <= seconds <= 1e9:
        raise UsageError(f"time_limit: needs seconds, 0 (none) to 1e9, not {time_limit!r}")
    if progress and progress is not True and not callable(progress):
        raise UsageError(f"progress: needs a callable, True or None, not {progress!r}")
    if progress is not True:
        yield _Listener(progress, seconds) if progress or seconds else None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield _Listener(None, seconds) if seconds else None
        return
    with tqdm(total=1.0, bar_format="{desc}: {percentage:3.0f}% {bar} {elapsed}") as bar:

        def show(stage, fraction):
            bar.set_description_str(stage)
            bar.n = fraction
            bar.refresh()

        yield _Listener(show, seconds)


def index(value, name, least, most):
    """A whole number in its range; raises UsageError for anything else."""
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is None or not least <= number <= most:
        raise UsageError(f"{name}: needs a whole number, {least} to {most}, not {value!r}")
    return number


def path_of(path, name):
    """A path as text, as the core takes it; raises UsageError for what is none."""
    try:
        text = os.fsdecode(path)
    except TypeError as error:
        raise UsageError(f"{name}: needs a path, not {type(path).__name__}") from error
    if "\0" in text:
        raise UsageError(f"{name}: needs a path, which has no NUL in it, not {text!r}")
    return text


def warn_of(findings, stacklevel):
    """Warns of what the program warns of, options named as Python has them."""
    for finding in findings:
        finding = re.sub(r"--([a-z-]+)", lambda name: name[1].replace("-", "_"), finding)
        warnings.warn(finding, UserWarning, stacklevel=stacklevel + 1)


def _corners_of(faces):
    """Corners one face after the other, and where each face begins: an array, or a list of faces."""
    try:
        faces = numpy.asarray(faces)
    except ValueError:
        faces = list(faces)  # of several sizes
    if isinstance(faces, list) or faces.dtype == object:
        faces = [numpy.asarray(face) for face in faces]
        sizes = numpy.array([len(face) for face in faces], dtype=numpy.int64)
        corners = numpy.concatenate(faces) if faces else numpy.empty(0, dtype=numpy.int64)
    elif faces.ndim == 2:
        sizes = numpy.full(len(faces), faces.shape[1], dtype=numpy.int64)
        corners = faces.reshape(-1)
    else:
        raise UsageError(f"faces: needs shape (n, k), one row a face, not {faces.shape}")
    if corners.ndim != 1 or not (numpy.issubdtype(corners.dtype, numpy.integer) or not sizes.size):
        raise UsageError(f"faces: needs integers, the vertices of each face, not {corners.dtype}")
    if (sizes < 3).any():
        face = int(numpy.argmax(sizes < 3))
        raise UsageError(f"faces: needs three corners or more in each, not {sizes[face]} as in "
                         f"face {face}")
    return corners.astype(numpy.int64), numpy.concatenate(([0], numpy.cumsum(sizes)))


def soup_of(mesh, listener, as_bound=False):
    """A path, a pair (vertices, faces), or an object that has both, as the core takes it."""
    if isinstance(mesh, (str, os.PathLike)):
        return _core.read_surface(path_of(mesh, "mesh"), as_bound, listener)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        mesh = (mesh.vertices, mesh.faces)
    try:
        vertices, faces = mesh
    except (TypeError, ValueError) as error:
        raise UsageError("mesh: needs a path, a pair (vertices, faces), or an object with "
                         f"vertices and faces, not {type(mesh).__name__}") from error
    try:
        vertices = numpy.ascontiguousarray(vertices, dtype=numpy.float64)
    except (TypeError, ValueError) as error:
        raise UsageError(f"vertices: needs numbers of shape (n, 3): {error}") from error
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise UsageError(f"vertices: needs shape (n, 3), not {vertices.shape}")
    try:
        corners, offsets = _corners_of(faces)
    except (TypeError, ValueError) as error:
        if isinstance(error, UsageError):
            raise
        raise UsageError("faces: needs an array of shape (n, k) or a list of faces, each the "
                         f"numbers of its vertices: {error}") from error
    return _core.soup_of_arrays(vertices, corners, offsets)
