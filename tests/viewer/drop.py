"""Drops a file onto a window as a file manager would: the X protocol for drag and drop (XDND 5), by libX11 itself, since xdotool
cannot. drop(DISPLAY, WINDOW, PATH) returns once the window has taken it.
"""
import ctypes
import ctypes.util
import pathlib
import select

SELECTION_REQUEST, SELECTION_NOTIFY, CLIENT_MESSAGE = 30, 31, 33
PATIENCE = 60  # s

Id = ctypes.c_ulong  # window, atom or time


class Head(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int), ("display", ctypes.c_void_p)]


class Message(ctypes.Structure):
    _fields_ = Head._fields_ + [("window", Id), ("kind", Id), ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]


class Request(ctypes.Structure):
    _fields_ = Head._fields_ + [(name, Id) for name in ("owner", "requestor", "selection", "target", "property", "time")]


class Notice(ctypes.Structure):
    _fields_ = Head._fields_ + [(name, Id) for name in ("requestor", "selection", "target", "property", "time")]


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("message", Message), ("request", Request), ("notice", Notice),
                ("room", ctypes.c_long * 24)]


def library():
    x = ctypes.CDLL(ctypes.util.find_library("X11") or "libX11.so.6")
    pointer, text, number = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int
    for name, result, arguments in (
            ("XOpenDisplay", pointer, [text]),
            ("XDefaultRootWindow", Id, [pointer]),
            ("XInternAtom", Id, [pointer, text, number]),
            ("XCreateSimpleWindow", Id, [pointer, Id] + [number] * 5 + [ctypes.c_ulong] * 2),
            ("XSetSelectionOwner", number, [pointer, Id, Id, Id]),
            ("XSendEvent", number, [pointer, Id, number, ctypes.c_long, ctypes.POINTER(Event)]),
            ("XChangeProperty", number, [pointer, Id, Id, Id, number, number, text, number]),
            ("XPending", number, [pointer]),
            ("XNextEvent", number, [pointer, ctypes.POINTER(Event)]),
            ("XConnectionNumber", number, [pointer]),
            ("XFlush", number, [pointer]),
            ("XCloseDisplay", number, [pointer])):
        function = getattr(x, name)
        function.restype, function.argtypes = result, arguments
    return x


class Source:
    def __init__(self, display, target, path):
        self.x = library()
        self.display = self.x.XOpenDisplay(display.encode())
        if not self.display:
            raise RuntimeError(f"the X server at {display} does not answer")
        self.window = self.x.XCreateSimpleWindow(self.display, self.x.XDefaultRootWindow(self.display), 0, 0, 1, 1, 0, 0, 0)
        self.target, self.uri = target, pathlib.Path(path).resolve().as_uri().encode() + b"\r\n"

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), 0)

    def tell(self, kind, *data):
        event = Event()
        event.message.type, event.message.window, event.message.format = CLIENT_MESSAGE, self.target, 32
        event.message.kind = self.atom(kind)
        event.message.data[:] = (list((self.window,) + data) + [0] * 5)[:5]
        self.x.XSendEvent(self.display, self.target, 0, 0, ctypes.byref(event))
        self.x.XFlush(self.display)

    def hand_over(self, request):
        """What was dropped, to whoever asks for the selection."""
        self.x.XChangeProperty(self.display, request.requestor, request.property, request.target, 8, 0, self.uri, len(self.uri))
        event = Event()
        event.notice.type = SELECTION_NOTIFY
        for name in ("requestor", "selection", "target", "property", "time"):
            setattr(event.notice, name, getattr(request, name))
        self.x.XSendEvent(self.display, request.requestor, 0, 0, ctypes.byref(event))
        self.x.XFlush(self.display)

    def await_message(self, kind):
        wanted, event = self.atom(kind), Event()
        while True:
            while not self.x.XPending(self.display):
                if not select.select([self.x.XConnectionNumber(self.display)], [], [], PATIENCE)[0]:
                    raise RuntimeError(f"{kind} did not come")
            self.x.XNextEvent(self.display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                self.hand_over(event.request)
            if event.type == CLIENT_MESSAGE and event.message.kind == wanted:
                return

    def drop(self, x, y):
        self.x.XSetSelectionOwner(self.display, self.atom("XdndSelection"), self.window, 0)
        self.tell("XdndEnter", 5 << 24, self.atom("text/uri-list"))
        self.tell("XdndPosition", 0, x << 16 | y, 0, self.atom("XdndActionCopy"))
        self.await_message("XdndStatus")
        self.tell("XdndDrop", 0, 0)
        self.await_message("XdndFinished")
        self.x.XCloseDisplay(self.display)


def drop(display, window, path, x=300, y=200):
    Source(display, window, path).drop(x, y)
