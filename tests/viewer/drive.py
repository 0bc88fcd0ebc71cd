"""Drives brickfall-view under Xvfb as a user would: keys and mouse by xdotool, pictures by ImageMagick's import. What it did is
read from the file of --status, so that tests check facts; they wait for facts, never for a time.
"""
import json
import os
import shutil
import subprocess
import sys
import time

NEEDED = {"Xvfb": "xvfb", "openbox": "openbox", "xdotool": "xdotool", "import": "imagemagick", "compare": "imagemagick", "identify": "imagemagick"}
PATIENCE = 120  # s: for a fact that must come; only a broken viewer waits so long


def missing_tools():
    return sorted({package for tool, package in NEEDED.items() if not shutil.which(tool)})


class Failed(Exception):
    pass


def check(holds, what):
    if not holds:
        raise Failed(what)


def start_display(width, height):
    """An X server with a number that it finds itself. Returns the process and DISPLAY."""
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp"],
                              pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        number = pipe.readline().strip()
    check(number.isdigit(), "Xvfb did not start")
    return server, ":" + number


class Viewer:
    def __init__(self, program, arguments, folder, size=(640, 360), environment=None):
        self.folder, self.size = folder, size
        self.server, self.display = start_display(2 * size[0], 2 * size[1])
        self.environment = dict(os.environ, DISPLAY=self.display, **(environment or {}))
        self.status_path = os.path.join(folder, "status.jsonl")
        if os.path.exists(self.status_path):
            os.remove(self.status_path)
        preload = os.environ.get("BRICKFALL_VIEWER_PRELOAD")  # for the viewer alone, not for what drives it
        if preload:
            self.environment["LD_PRELOAD"] = preload
        self.seen = 0
        self.known, self.read_to = [], 0
        self.window = None
        self.errors = open(os.path.join(folder, "stderr.txt"), "w+")
        self.process = subprocess.Popen([program, *arguments, "--status", self.status_path, "--size", f"{size[0]}x{size[1]}"],
                                        cwd=folder, env=self.environment, stdout=self.errors, stderr=self.errors)
        try:
            self.wait(lambda s: s["pictures"] > 0 and s["bodies"] > 0, "the first picture")
        except BaseException:
            self.end()
            raise

    # --- Facts
    def lines(self):
        """All so far; read on from where they ended, for there is one for each picture."""
        if os.path.exists(self.status_path):
            with open(self.status_path, "rb") as file:
                file.seek(self.read_to)
                whole = file.read().rpartition(b"\n")[0]
            self.read_to += len(whole) + 1 if whole else 0
            self.known += [json.loads(line) for line in whole.splitlines()]
        return self.known

    def wait(self, holds, what, running=True):
        """The newest line, once one that was not there before fulfils it."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            lines = self.lines()
            for line in lines[self.seen:]:
                if holds(line):
                    return lines[-1]
            if running and self.process.poll() is not None:
                raise Failed(f"{what}: the viewer ended with exit code {self.process.returncode}: {self.said()}")
            time.sleep(0.03)
        raise Failed(f"{what}: did not come; last: {self.lines()[-1:]}")

    def now(self):
        return self.lines()[-1]

    def said(self):
        self.errors.flush()
        with open(self.errors.name) as file:
            return file.read().strip()[-2000:]

    def mark(self):
        self.seen = len(self.lines())

    # --- Hands
    def tool(self, *words):
        subprocess.run(["xdotool", *[str(word) for word in words]], env=self.environment, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def key(self, name, holds, what):
        self.mark()
        self.tool("key", name)
        return self.wait(holds, f"key {name}: {what}")

    def window_at(self):
        if not self.window:
            self.window = self.find_window()
        return self.window

    def find_window(self):
        out = subprocess.run(["xdotool", "search", "--name", "Brickfall"], env=self.environment, capture_output=True, text=True)
        return out.stdout.split()[0]

    def await_manager(self):
        """Until a window manager has the window: only then it can be made the active one."""
        end = time.monotonic() + PATIENCE
        while subprocess.run(["xdotool", "windowactivate", "--sync", self.window_at()], env=self.environment,
                             stderr=subprocess.DEVNULL).returncode != 0:
            check(time.monotonic() < end, "no window manager takes the window")
            time.sleep(0.03)

    def corner(self):
        out = subprocess.run(["xdotool", "getwindowgeometry", "--shell", self.window_at()], env=self.environment,
                             capture_output=True, text=True).stdout
        values = dict(line.split("=") for line in out.split() if "=" in line)
        return int(values["X"]), int(values["Y"])

    def point(self, x, y):
        left, top = self.corner()
        self.tool("mousemove", left + round(x), top + round(y))

    def click(self, x, y):
        left, top = self.corner()
        self.tool("mousemove", left + round(x), top + round(y), "click", 1)

    def pause_pictures(self):
        """Until what was just done is shown: pictures were drawn after it, or there was nothing to draw."""
        before, seen = self.now()["pictures"], self.seen
        self.mark()
        # The first picture may have been begun before. A viewer that rests says so once a second.
        self.wait(lambda s: s["pictures"] >= before + 3 or s["why"] == "rest" or (s["why"] == "second" and s["resting"]), "pictures")
        self.seen = seen

    def middle_of(self, place):
        at = self.wait_place(place)
        return at[0] + at[2] / 2, at[1] + at[3] / 2

    def wait_place(self, place):
        self.seen = max(len(self.lines()) - 1, 0)
        return self.wait(lambda s: place in s["places"], f"'{place}' in the panel")["places"][place]

    def press(self, place, holds, what):
        x, y = self.middle_of(place)
        self.mark()
        self.click(x, y)
        return self.wait(holds, f"'{place}': {what}")

    def told(self, tell):
        """What `tell` makes of each line since the mark, equal neighbours once."""
        values = []
        for line in self.lines()[max(self.seen - 1, 0):]:
            value = tell(line)
            if not values or values[-1] != value:
                values.append(value)
        return values

    def processor(self):
        """Seconds that it has cost so far."""
        with open(f"/proc/{self.process.pid}/stat") as file:
            fields = file.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    # --- Pictures
    def picture(self, name):
        path = os.path.join(self.folder, name + ".png")
        self.pause_pictures()
        subprocess.run(["import", "-silent", "-window", self.window_at(), path], env=self.environment, check=True)
        return path

    def end(self):
        """Exit code; the display goes with it."""
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.server.terminate()
        self.server.wait()
        return self.process.returncode


def colours(path):
    return int(subprocess.run(["identify", "-format", "%k", path], capture_output=True, text=True, check=True).stdout)


def differing(a, b, part=None):
    """Share of pixels that differ by more than noise; of a part such as "640x280+0+80"."""
    cut = ["-extract", part] if part else []
    out = subprocess.run(["compare", "-metric", "AE", "-fuzz", "4%", *cut, a, b, "null:"], capture_output=True, text=True)
    size = subprocess.run(["identify", "-format", "%w %h", a], capture_output=True, text=True, check=True).stdout.split()
    return float(out.stderr.split()[0]) / (int(size[0]) * int(size[1]))


def main_of(tests, program_of, skipped=77):
    """Runs the tests; exit code `skipped` where a tool is not installed."""
    missing = missing_tools()
    if missing:
        print("skipped: no window can be driven here, install the Debian packages " + " ".join(missing))
        sys.exit(skipped)
    try:
        tests(program_of)
    except Failed as problem:
        sys.exit(f"failed: {problem}")
    print("ok")
