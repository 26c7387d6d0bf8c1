"""Errors: one class for each exit status of the program, with the program's message."""


class Error(Exception):
    """Any error of curveskel. The message says what was found, what is needed, and a remedy."""

    exit_status = 1


class UsageError(Error, ValueError):
    """An option or an argument out of its range."""

    exit_status = 2


class InputError(Error, ValueError):
    """The file, or the surface in it."""

    exit_status = 3


class DeviceError(Error):
    """The OpenCL device, its driver or a kernel."""

    exit_status = 4


class SolverError(Error):
    """A linear solver, or, where `strict` asks for it, a certificate that does not hold."""

    exit_status = 5


class OutputError(Error, OSError):
    """A file could not be written."""

    exit_status = 6


class CertificateWarning(UserWarning):
    """The skeleton's certificate does not hold: the message says in which respect."""
