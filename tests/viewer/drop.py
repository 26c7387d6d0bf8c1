"""Drops files on a window as a file manager does: the source's side of XDND, version 5
(https://www.freedesktop.org/wiki/Specifications/XDND/), of which xdotool knows nothing."""

import ctypes
import pathlib

from display import ClientMessage, until

CLIENT_MESSAGE, SELECTION_NOTIFY, SELECTION_REQUEST = 33, 31, 30
VERSION = 5


class SelectionRequest(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                ("display", ctypes.c_void_p), ("owner", ctypes.c_ulong),
                ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong),
                ("target", ctypes.c_ulong), ("property", ctypes.c_ulong), ("time", ctypes.c_ulong)]


class SelectionNotify(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                ("display", ctypes.c_void_p), ("requestor", ctypes.c_ulong),
                ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong),
                ("property", ctypes.c_ulong), ("time", ctypes.c_ulong)]


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("message", ClientMessage),
                ("request", SelectionRequest), ("notify", SelectionNotify),
                ("room", ctypes.c_long * 24)]


def x11_library():
    x11 = ctypes.CDLL("libX11.so.6")
    place, number, whole = ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int
    for name, result, arguments in (
            ("XOpenDisplay", place, [ctypes.c_char_p]),
            ("XDefaultRootWindow", number, [place]),
            ("XInternAtom", number, [place, ctypes.c_char_p, whole]),
            ("XCreateSimpleWindow", number, [place, number] + 5 * [whole] + 2 * [number]),
            ("XSetSelectionOwner", whole, [place, number, number, number]),
            ("XSendEvent", whole, [place, number, whole, ctypes.c_long, place]),
            ("XPending", whole, [place]),
            ("XNextEvent", whole, [place, place]),
            ("XChangeProperty", whole, [place] + 3 * [number] + 2 * [whole]
             + [ctypes.c_char_p, whole]),
            ("XSync", whole, [place, whole]),
            ("XCloseDisplay", whole, [place])):
        function = getattr(x11, name)
        function.restype, function.argtypes = result, arguments
    return x11


class Source:
    """A window that owns what is dragged."""

    def __init__(self, display, files):
        self.x11 = x11_library()
        self.server = self.x11.XOpenDisplay(display.encode())
        root = self.x11.XDefaultRootWindow(self.server)
        self.window = self.x11.XCreateSimpleWindow(self.server, root, 0, 0, 1, 1, 0, 0, 0)
        self.list = self.atom("text/uri-list")
        self.text = "".join(pathlib.Path(file).as_uri() + "\r\n" for file in files).encode()
        self.x11.XSetSelectionOwner(self.server, self.atom("XdndSelection"), self.window, 0)

    def atom(self, name):
        return self.x11.XInternAtom(self.server, name.encode(), 0)

    def send(self, target, kind, *data):
        event = Event()
        event.message = ClientMessage(type=CLIENT_MESSAGE, window=target, kind=self.atom(kind),
                                      format=32)
        event.message.data[:] = [self.window, *data, *[0] * (4 - len(data))]
        self.x11.XSendEvent(self.server, target, 0, 0, ctypes.byref(event))
        self.x11.XSync(self.server, 0)

    def answer(self, kind):
        """The target's answer of this kind; serves its request for the list meanwhile."""
        wanted, event = self.atom(kind), Event()

        def arrived():
            while self.x11.XPending(self.server):
                self.x11.XNextEvent(self.server, ctypes.byref(event))
                if event.type == SELECTION_REQUEST:
                    self.give(event.request)
                if event.type == CLIENT_MESSAGE and event.message.kind == wanted:
                    return True
            return False

        until(arrived, kind)
        return list(event.message.data)

    def give(self, request):
        self.x11.XChangeProperty(self.server, request.requestor, request.property, request.target,
                                 8, 0, self.text, len(self.text))
        event = Event()
        event.notify = SelectionNotify(type=SELECTION_NOTIFY, requestor=request.requestor,
                                       selection=request.selection, target=request.target,
                                       property=request.property, time=request.time)
        self.x11.XSendEvent(self.server, request.requestor, 0, 0, ctypes.byref(event))
        self.x11.XSync(self.server, 0)

    def close(self):
        self.x11.XCloseDisplay(self.server)


def drop(display, window, files, at=(400, 300)):
    """Whether the window took them."""
    source = Source(display, files)
    try:
        copy = source.atom("XdndActionCopy")
        source.send(window, "XdndEnter", VERSION << 24, source.list)
        source.send(window, "XdndPosition", 0, at[0] << 16 | at[1], 0, copy)
        if not source.answer("XdndStatus")[1] & 1:
            source.send(window, "XdndLeave")
            return False
        source.send(window, "XdndDrop")
        # Bit 0, says the standard; GLFW 3.3 answers with the number of bytes.
        return bool(source.answer("XdndFinished")[1])
    finally:
        source.close()
