"""A display of the test's own (Xvfb) and the viewer's window on it, driven by keys and mouse."""

import ctypes
import os
import re
import shutil
import subprocess
import time

import numpy
from PIL import ImageGrab

from program import start

PATIENCE = 60  # seconds, which only a hang takes
POLL = 0.03


def until(condition, what):
    """The first value of `condition` that is true; fails where none comes."""
    end = time.monotonic() + PATIENCE
    while True:
        found = condition()
        if found:
            return found
        if time.monotonic() > end:
            raise AssertionError(f"waited {PATIENCE} s in vain: {what}")
        time.sleep(POLL)


class Display:
    """Xvfb on a free display, until `close`."""

    def __init__(self, width=1300, height=1000):
        reading, writing = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24",
             "-nolisten", "tcp", "-noreset"], pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        self.name = ":" + number

    def close(self):
        self.process.terminate()
        self.process.wait()

    def xdotool(self, *words):
        return subprocess.run(["xdotool", *map(str, words)], text=True, capture_output=True,
                              env={**os.environ, "DISPLAY": self.name}).stdout.strip()

    def screen(self):
        """height x width x RGB."""
        return numpy.asarray(ImageGrab.grab(xdisplay=self.name).convert("RGB")).astype(int)


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong),
                ("kind", ctypes.c_ulong), ("format", ctypes.c_int), ("data", ctypes.c_long * 5),
                ("room", ctypes.c_long * 24)]  # XSendEvent reads a whole XEvent


def ask_to_close(display, window):
    """What a window manager sends when its close button is pressed; xdotool cannot."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XInternAtom.restype = ctypes.c_ulong
    for function in (x11.XInternAtom, x11.XSendEvent, x11.XCloseDisplay):
        function.argtypes = None
    server = ctypes.c_void_p(x11.XOpenDisplay(display.encode()))
    atoms = [x11.XInternAtom(server, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW")]
    client_message = 33
    event = ClientMessage(type=client_message, window=window, kind=atoms[0], format=32)
    event.data[0] = atoms[1]
    x11.XSendEvent(server, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(event))
    x11.XCloseDisplay(server)


def different(first, second):
    """The share of pixels that a person would see to be different."""
    if first.shape != second.shape:
        return 1.0
    return float((numpy.abs(first - second).max(axis=2) > 24).mean())


class Window:
    """The viewer, started with these words after `view`."""

    def __init__(self, display, folder, *words, size=(1000, 700)):
        self.display = display
        self.width, self.height = size
        # So that the files of the test do not become anybody's recent files.
        environment = {**os.environ, "DISPLAY": display.name, "XDG_STATE_HOME": str(folder),
                       "LIBGL_ALWAYS_SOFTWARE": "1"}
        for name in ("WAYLAND_DISPLAY", "XDG_SESSION_TYPE"):
            environment.pop(name, None)
        self.process = start("view", *words, "--size", f"{size[0]}x{size[1]}", env=environment)
        self.id = until(self.find, "a window")
        display.xdotool("windowfocus", "--sync", self.id)

    def find(self):
        if self.process.poll() is not None:
            raise AssertionError(self.process.stderr.read().decode())
        return self.display.xdotool("search", "--onlyvisible", "--pid", self.process.pid,
                                    "--name", "curveskel")

    def close(self):
        """Whatever state it is in."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()

    def exit_code(self, seconds=PATIENCE):
        return self.process.wait(timeout=seconds)

    # All that can be seen.

    def title(self):
        if self.process.poll() is not None:
            raise AssertionError(f"ended with {self.process.returncode}: "
                                 + self.process.stderr.read().decode())
        return self.display.xdotool("getwindowname", self.id)

    def wait_for_title(self, pattern):
        return until(lambda: re.search(pattern, self.title()), f"a title with {pattern}")

    def wait_for_skeleton(self):
        self.wait_for_title(r"\(skeleton\)$")

    def whole(self):
        return self.display.screen()[:self.height, :self.width]

    def side(self):
        return int(min(290, self.width * 0.3))

    def above_status(self):
        """Without the times of pictures, which change."""
        return self.whole()[130:self.height - 26]

    def picture(self):
        """What lies between the panels, without the messages that come and go."""
        side, timeline = self.side(), int(min(130, self.height * 0.2))
        return self.whole()[:self.height - 26 - timeline, side:self.width - side][130:]

    def rest(self, see=None, seconds=0.9):
        """What is seen once nothing has changed for so long; by default longer than it takes until
        the picture of what rests is drawn anew, finer."""
        see = see or self.picture
        last = [see(), time.monotonic()]

        def unchanged():
            now = see()
            if not numpy.array_equal(now, last[0]):
                last[:] = now, time.monotonic()
            return time.monotonic() - last[1] > seconds

        until(unchanged, "a picture that rests")
        return last[0]

    def wait_for_likeness(self, wanted, most=0.002, see=None):
        see = see or self.picture
        until(lambda: different(see(), wanted) <= most, "a picture like an earlier one")

    def wait_for_change(self, before, least=0.002, see=None):
        see = see or self.picture
        until(lambda: different(see(), before) > least, "another picture")

    # All that a person does.

    def key(self, *names):
        self.display.xdotool("key", "--delay", 5, *names)

    def key_at_once(self, *names, text, then):
        """Keys, a text and keys, several in the time of a frame."""
        delay = 2  # milliseconds; GLFW drops a key that goes down twice in one
        self.display.xdotool("key", "--delay", delay, *names, "type", "--delay", delay, "--args", 1,
                             text, "key", "--delay", delay, *then)

    def type_into_dialogue(self, key, text):
        """Opens the dialogue with this key, and answers."""
        before = self.rest(self.whole)
        self.key(key)
        self.wait_for_change(before, 0.05, self.whole)
        blink = 0.3  # seconds, in which the blinking cursor rests
        self.rest(self.whole, blink)
        self.key("ctrl+a")
        self.display.xdotool("type", "--delay", 5, text)
        self.rest(self.whole, blink)
        asking = self.whole()
        self.key("Return")
        self.wait_for_change(asking, 0.05, self.whole)
        self.rest(self.whole, blink)  # until keys are for the picture again

    def changes(self, *names, least=0.002, see=None):
        """Types and waits for another picture; gives that, at rest."""
        before = self.rest(see)
        self.key(*names)
        self.wait_for_change(before, least, see)
        return self.rest(see)

    def move(self, x, y):
        self.display.xdotool("mousemove", int(x), int(y))

    def away(self):
        """To a corner of the picture where there is nothing."""
        self.move(self.side() + 3, 135)

    def click(self, x, y, shift=False):
        """On something that can be selected: waits until it is seen to be under the pointer, and
        then to be selected."""
        self.away()
        before, all_before = self.rest(), self.above_status()
        self.move(x, y)
        # The description beside the pointer may lie over a panel.
        self.wait_for_change(all_before, 0.001, self.above_status)
        words = ["click", 1]
        if shift:
            words = ["keydown", "shift", *words]
        self.display.xdotool(*words)
        self.rest()
        if shift:
            self.display.xdotool("keyup", "shift")
        self.away()
        self.wait_for_change(before, 0.0001)

    def tips(self):
        """Places in the window of the skeleton's outermost points: right, left, top, bottom."""
        self.away()
        seen = self.rest()
        red = (seen[..., 0] - seen[..., 2] > 50) & (seen[..., 0] - seen[..., 1] > 40)
        rows, columns = numpy.nonzero(red)
        assert len(rows) > 20, "no skeleton in the picture"
        found = [numpy.argmax(columns), numpy.argmin(columns), numpy.argmin(rows),
                 numpy.argmax(rows)]
        return [(int(columns[i]) + self.side(), int(rows[i]) + 130) for i in found]


def is_there():
    return all(shutil.which(name) for name in ("Xvfb", "xdotool"))
