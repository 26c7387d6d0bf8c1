"""The program: its path, and one run of it beside Blender."""

import pathlib
import re
import shutil
import subprocess
import tempfile

NOT_FOUND = ("the program curveskel is not found: install it, or give its path in "
             "Preferences > Add-ons > Curveskel")


SURFACE = "in.obj"  # the file of the selected meshes, of which the user knows nothing
JOINTS = "joints.json"  # of the selected armature's bones, likewise
SETTINGS = {"--plan": "Plan", "--names": "Names", "--up": "Up", "--front": "Front",
            "--follow": "Followers", "--softness": "Softness", "--detail": "Detail"}
REMEDIES = {  # of the program's user, and of Blender's
    "needed are joints in its coordinates (glTF has y up, Blender z: export both the same way)":
        "move or turn the armature into the meshes",
    "export both in one unit": "scale the armature so",
    "; correct the curve there (`view`), or extract it anew": "", "Blender: ": ""}
OPTION = re.compile(r"--[a-z][a-z-]*")


def without_options(text):
    """The text but for advice that names an option for which the add-on has no setting."""
    def is_here(words):
        return all(name in SETTINGS for name in OPTION.findall(words))
    parts = [", or ".join(filter(is_here, part.split(", or "))) for part in text.split("; ")]
    return "; ".join(filter(None, parts))


def in_blender(text):
    """The program's words for somebody who sees neither its options nor its files."""
    for name in (SURFACE, JOINTS):
        text = text.removeprefix(f"{name}: ")
    for words, here in REMEDIES.items():
        text = text.replace(words, here)
    text = re.sub(r" \(([^()]*)\)", lambda found: f" ({without_options(found[1])})", text)
    text = without_options(text.replace(" ()", ""))
    return OPTION.sub(lambda name: SETTINGS[name[0]], text)


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
        """The program's last message of where it is."""
        lines = [line for line in self.messages() if not line.startswith("curveskel: ")]
        return lines[-1] if lines else "starting"

    def is_done(self):
        """Raises ProgramError, with the program's own words, where it failed."""
        code = self._process.poll()
        if code is None:
            return False
        if code != 0:
            lines = self.messages()
            said = [line for line in lines if line.startswith("curveskel: ")]
            last = (said or lines or [f"the program ended with {code}"])[-1]
            raise ProgramError(in_blender(last.removeprefix("curveskel: ")))
        return True

    def warnings(self):
        start = "curveskel: warning: "
        return [in_blender(line.removeprefix(start)) for line in self.messages()
                if line.startswith(start)]

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
