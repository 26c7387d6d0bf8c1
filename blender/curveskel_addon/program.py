"""The program: its path, and one run of it beside Blender."""

import pathlib
import shutil
import subprocess
import tempfile

NOT_FOUND = ("the program curveskel is not found: install it, or give its path in "
             "Preferences > Add-ons > Curveskel")


SURFACE = "in.obj"  # the file of the selected meshes, of which the user knows nothing


class ProgramError(Exception):
    """Its words are for the user."""


def program_path(wanted):
    """The program as set by the user, else the one on the PATH."""
    found = shutil.which(wanted or "curveskel")
    if not found:
        raise ProgramError(f"{wanted}: {NOT_FOUND}" if wanted else NOT_FOUND)
    return found


def version(wanted):
    """'curveskel 0.1.0'."""
    try:
        found = subprocess.run([program_path(wanted), "--version"], capture_output=True, text=True,
                               timeout=20, stdin=subprocess.DEVNULL, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ProgramError(f"the program does not run: {error}") from error
    if found.returncode != 0 or not found.stdout.startswith("curveskel"):
        raise ProgramError(f"{program_path(wanted)} is no curveskel; give another path")
    return found.stdout.strip()


class Job:
    """A run in a folder of its own, which goes with it. Use it in a `with`."""

    def __init__(self, wanted):
        self._program = program_path(wanted)
        self._place = tempfile.TemporaryDirectory(prefix="curveskel-")
        self.folder = pathlib.Path(self._place.name)
        self._process = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def start(self, *arguments):
        try:
            with open(self.folder / "messages", "wb") as messages:
                self._process = subprocess.Popen(
                    [self._program, *map(str, arguments)], cwd=self.folder, stderr=messages,
                    stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
        except OSError as error:
            raise ProgramError(f"the program does not run: {error}") from error

    def messages(self):
        text = (self.folder / "messages").read_text(errors="replace")
        return [line for line in text.replace("\r", "\n").split("\n") if line.strip()]

    def stage(self):
        """The program's last message."""
        lines = self.messages()
        return lines[-1] if lines else "starting"

    def is_done(self):
        """Raises ProgramError, with the program's own words, where it failed."""
        code = self._process.poll()
        if code is None:
            return False
        if code != 0:
            lines = self.messages()
            said = [line for line in lines if line.startswith("curveskel: ")]
            raise ProgramError((said or lines or [f"the program ended with {code}"])[-1]
                               .removeprefix("curveskel: ").removeprefix(f"{SURFACE}: "))
        return True

    def wait(self):
        self._process.wait()
        self.is_done()

    def close(self):
        """Ends a run that still goes on; nothing is left of it."""
        if self._process is not None and self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(timeout=5)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        self._place.cleanup()
