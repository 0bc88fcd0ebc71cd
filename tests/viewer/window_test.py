#!/usr/bin/env python3
"""One window, used as a person would: window_test.py BRICKFALL_VIEW FOLDER

One process for all of it, because starting costs more than the rest.
"""
import os
import re
import shutil
import struct
import subprocess
import sys
import time

sys.dont_write_bytecode = True
from drive import Viewer, check, colours, differing, main_of
from drop import drop

VIEWS = {"c": "collisions", "x": "wireframe", "F2": "colliders", "F3": "bounds", "F4": "contacts", "F5": "islands", "F6": "asleep"}
PICTURED = {"collisions", "wireframe", "colliders", "contacts"}  # the others depend on what the run has come to, or cost time


def shoot_and_step(viewer):
    start = viewer.now()
    check(not start["running"] and start["step"] == 0, f"it does not wait at the beginning: {start}")
    viewer.key("period", lambda s: s["step"] == 1, "makes one step")
    viewer.key("2", lambda s: s["tool"] == "Shoot", "takes the tool")
    viewer.mark()
    viewer.click(500, 150)
    shot = viewer.wait(lambda s: s["bodies"] == start["bodies"] + 1, "a click shoots a ball")
    check(shot["undo"] != "", "a shot can be undone")
    viewer.key("space", lambda s: s["running"], "runs")
    viewer.wait(lambda s: s["step"] > 20, "steps are made")
    viewer.key("space", lambda s: not s["running"], "pauses")
    paused = viewer.now()["step"]
    viewer.key("comma", lambda s: s["step"] == paused - 1, "goes one step back")
    viewer.key("ctrl+z", lambda s: s["bodies"] == start["bodies"], "takes the ball back")
    viewer.key("f", lambda s: s["bodies"] == start["bodies"] + 1, "shoots at the middle")
    viewer.key("space", lambda s: s["running"], "runs")
    viewer.wait(lambda s: s["step"] > 40, "steps are made")
    viewer.key("space", lambda s: not s["running"], "pauses")


def switch_views(viewer):
    viewer.key("Tab", lambda s: not s["places"], "hides the panel")
    plain = viewer.picture("plain")
    check(colours(plain) > 500, f"the picture is blank: {colours(plain)} colours")
    for key, name in VIEWS.items():
        viewer.key(key, lambda s: name in s["views"], f"view {name} on")
        if name in PICTURED:
            shown = viewer.picture(name)
            check(differing(plain, shown) > 0.001, f"view {name} shows nothing of its own")
        viewer.key(key, lambda s: name not in s["views"], f"view {name} off")
    kinds = set()
    for _ in range(4):
        before = viewer.now()["shadows"]
        viewer.key("F7", lambda s: s["why"] == "action", "shadows change")
        kinds.add(viewer.now()["shadows"])
        if viewer.now()["shadows"] == "depth" and before != "depth":
            check(differing(plain, viewer.picture("depth")) < 0.6, "the other kind of shadow shows another scene")
    check(kinds == {"none", "stencil", "depth"}, f"kinds of shadow: {kinds}")
    viewer.key("Tab", lambda s: "speed" in s["places"], "shows the panel")


def come_back(viewer):
    """A saved state wears the colours that it was saved in."""
    viewer.key("Tab", lambda s: not s["places"], "hides the panel")
    fresh = viewer.picture("fresh")
    viewer.key("ctrl+s", lambda s: s["why"].startswith("done: save"), "saves the state")
    viewer.key("ctrl+l", lambda s: s["why"] == "done: open", "loads the state")
    part = "640x260+0+60"  # below what it says about that, above what it says of the beginning
    changed = differing(fresh, viewer.picture("loaded"), part)
    check(changed < 0.002, f"a state looks otherwise when it comes back: {100 * changed:.2f} % of the pixels")
    viewer.key("Tab", lambda s: "speed" in s["places"], "shows the panel")


def click_shortly(viewer):
    """Presses far shorter than a picture takes, on a box of the panel and in a text."""
    viewer.press("Views", lambda s: "Polygons" in s["places"], "opens the tab")
    viewer.point(*viewer.middle_of("Polygons"))
    viewer.pause_pictures()
    viewer.mark()
    for milliseconds in (10, 20, 10, 20, 50, 10):
        viewer.tool("mousedown", 1, "sleep", milliseconds / 1000, "mouseup", 1, "sleep", 0.03)
    for _ in range(6):
        viewer.pause_pictures()
        seen = viewer.told(lambda s: "wireframe" in s["views"])
        if len(seen) == 7:
            break
    check(len(seen) == 7, f"of 6 short clicks {len(seen) - 1} arrived")
    viewer.press("Scenes", lambda s: "scene:wall" in s["places"], "opens the tab")


def add_up(viewer):
    """What is asked for quickly is reckoned from what was asked for, not from what is shown."""
    viewer.mark()
    viewer.tool("key", "--delay", 4, "bracketright", "bracketright", "bracketright", "space")
    viewer.wait(lambda s: s["speed"] == 8 and s["running"], "three presses make it eight times as fast")
    viewer.wait(lambda s: s["time"] > 2.1, "2 s are made")
    viewer.key("space", lambda s: not s["running"], "pauses")
    viewer.pause_pictures()
    end = viewer.now()["time"]
    viewer.mark()
    viewer.tool("key", "--delay", 4, "j", "j", "l")
    viewer.wait(lambda s: abs(s["time"] - end + 1) < 0.04, "2 s back and 1 s on make 1 s back")
    viewer.key("Home", lambda s: s["time"] == s["earliest"], "goes to the beginning")
    viewer.key("End", lambda s: abs(s["time"] - end) < 0.001, "goes to the end")
    viewer.key("backslash", lambda s: s["speed"] == 1, "speed as in life")


def point_at_ground(viewer):
    """It can neither be dragged nor removed, and says so once, without a mistake that has to be closed."""
    viewer.key("3", lambda s: s["tool"] == "Drag", "takes the tool")
    bodies = viewer.now()["bodies"]
    viewer.mark()
    for x in (520, 540, 560):
        viewer.click(x, 250)
    told = viewer.wait(lambda s: any("ground stays" in message for message in s["messages"]), "says that the ground stays")
    check(len(told["messages"]) == 1 and "Close" not in told["places"], f"messages of a drag on the ground: {told['messages']}")
    viewer.key("1", lambda s: s["tool"] == "Select", "takes the tool")
    viewer.mark()
    viewer.click(540, 250)
    chosen = viewer.wait(lambda s: s["selected"] != 0 and "Follow it" in s["places"], "a click selects the ground")
    check("Remove it" not in chosen["places"], "the ground offers to be removed")
    pressing = [re.match(r"contact (\d+): \S+, ([\d.]+) (k?N)$", place) for place in chosen["places"] if place.startswith("contact")]
    check(len(pressing) >= 3 and all(pressing), f"who presses on the ground, with numbers and forces: {list(chosen['places'])}")
    pressing.sort(key=lambda found: int(found[1]))
    check([int(found[1]) for found in pressing] == list(range(1, len(pressing) + 1)), "contacts are numbered from 1")
    forces = [float(found[2]) * (1000 if found[3] == "kN" else 1) for found in pressing]
    check(forces == sorted(forces, reverse=True), f"the strongest contact comes first: {forces}")
    viewer.key("Delete", lambda s: s["why"] == "action", "is asked to remove it")
    viewer.pause_pictures()
    check(viewer.now()["bodies"] == bodies, "the ground was removed")
    viewer.key("Escape", lambda s: s["selected"] == 0, "lets go of it")


def let_go_outside(viewer):
    """A button that goes up where no window of ours is."""
    viewer.point(600, 240)
    viewer.tool("mousedown", 3)
    viewer.pause_pictures()
    viewer.tool("mousemove", 5, 5)
    viewer.pause_pictures()
    viewer.tool("mouseup", 3)
    viewer.point(600, 240)
    for _ in range(40):
        viewer.pause_pictures()
        last = viewer.now()["camera"]
        viewer.point(500, 200)
        viewer.pause_pictures()
        if viewer.now()["camera"] == last:
            break
        viewer.point(600, 240)
    check(viewer.now()["camera"] == last, "the camera still turns with the mouse, with no button held")
    viewer.press("Views", lambda s: "Polygons" in s["places"], "the panel still hears clicks")


def open_by_name(viewer):
    """Ctrl+O: what is typed is a name from the first letter on, however quickly it comes."""
    folder = viewer.folder
    os.makedirs(os.path.join(folder, "mine"), exist_ok=True)
    with open(os.path.join(folder, "mine", "few.toml"), "w") as file:
        file.write('[[wall]]\nname = "w"\ncourses = 2\nbricks = 3\n')
    before = viewer.now()
    viewer.mark()
    viewer.tool("key", "ctrl+o", "type", "--delay", 6, "fff 42")
    typed = viewer.wait(lambda s: s["files"] and s["typed"] == "fff 42", "the list has the cursor")
    check(typed["bodies"] == before["bodies"] and typed["tool"] == before["tool"], "what was typed into the list shot or took a tool")
    viewer.tool("key", "--delay", 6, "ctrl+a", "f", "e", "w")
    chosen = viewer.wait(lambda s: s["typed"] == "few", "Ctrl+A marks what is typed, however short the press")
    check("file:mine/few.toml" in chosen["places"], f"the list shows the folder's scenes: {list(chosen['places'])}")
    viewer.key("Return", lambda s: s["scene"] == "few" and not s["files"], "opens what is marked")
    check(not viewer.now()["running"], "what is opened waits")
    viewer.key("ctrl+o", lambda s: s["files"], "shows the list again")
    viewer.wait(lambda s: any(name.startswith("file:/") and name.endswith("few.toml") for name in s["places"]), "what was opened last stands first")
    viewer.key("Escape", lambda s: not s["files"], "closes the list")


def follow_file(viewer):
    """A scene that is edited is read again; what is shown becomes a scene."""
    path, few = os.path.join(viewer.folder, "mine", "few.toml"), viewer.now()["bodies"]
    viewer.key("period", lambda s: s["step"] == 1, "makes a step")
    viewer.mark()
    with open(path, "w") as file:
        file.write('[[wall]]\nname = "w"\ncourses = 3\nbricks = 3\n')
    more = viewer.wait(lambda s: s["bodies"] > few and s["step"] == 0, "a file that changes is read again")
    viewer.key("f", lambda s: s["bodies"] == more["bodies"] + 1, "shoots")
    for _ in range(2):
        viewer.key("period", lambda s: s["why"].startswith("done: step"), "makes a step")
    viewer.mark()
    viewer.tool("key", "ctrl+e")
    viewer.wait(lambda s: any("few-1.toml" in message for message in s["messages"]), "saves the moment as a scene")
    viewer.tool("key", "ctrl+o", "type", "--delay", 6, "few-1")
    viewer.tool("key", "Return")
    saved = viewer.wait(lambda s: s["scene"] == "few-1", "opens what was saved")
    check(saved["bodies"] == more["bodies"] + 1, f"bodies of the scene that was saved: {saved['bodies']}")
    viewer.mark()
    viewer.tool("key", "ctrl+o", "type", "--delay", 6, "wall")
    viewer.wait(lambda s: s["typed"] == "wall", "asks for a shipped scene")
    viewer.tool("key", "Return")
    viewer.wait(lambda s: s["scene"] == "wall", "opens it")


def rest(viewer):
    """Nothing changes: nothing is drawn, and it costs next to nothing."""
    viewer.mark()
    viewer.wait(lambda s: s["why"] == "second" and s["resting"], "rests")
    before, cost = viewer.now()["pictures"], viewer.processor()
    viewer.mark()
    viewer.wait(lambda s: s["why"] == "second", "a second goes by")
    drawn, cost = viewer.now()["pictures"] - before, viewer.processor() - cost
    check(drawn <= 1 and cost < 0.15, f"a paused second: {drawn} pictures, {cost:.2f} s of the processor")


def use_panel(viewer):
    x, y, width, height = viewer.wait_place("speed")
    viewer.point(x + width * 0.62, y + height / 2)
    viewer.pause_pictures()
    viewer.mark()
    viewer.tool("mousedown", 1)
    viewer.pause_pictures()
    for share in (0.5, 0.35, 0.2):
        viewer.point(x + width * share, y + height / 2)
    viewer.pause_pictures()
    viewer.tool("mouseup", 1)
    viewer.wait(lambda s: s["speed"] < 0.5, "dragging the slider slows the run down")
    viewer.key("backslash", lambda s: s["speed"] == 1, "speed as in life")
    viewer.press("Views", lambda s: "Polygons" in s["places"], "opens the tab")
    viewer.press("Settings", lambda s: "group:World" in s["places"] or "group:Time" in s["places"], "opens the tab")
    viewer.press("Scenes", lambda s: "scene:wall" in s["places"], "opens the tab")


def select_and_drag(viewer):
    viewer.key("r", lambda s: s["step"] == 0 and s["why"].startswith("done"), "restarts")
    if viewer.now()["running"]:
        viewer.key("space", lambda s: not s["running"], "pauses")
    viewer.key("1", lambda s: s["tool"] == "Select", "takes the tool")
    viewer.key("Tab", lambda s: not s["places"], "hides the panel")
    viewer.mark()
    viewer.click(290, 190)
    viewer.wait(lambda s: s["selected"] != 0, "a click selects")
    bodies = viewer.now()["bodies"]
    viewer.key("3", lambda s: s["tool"] == "Drag", "takes the tool")
    viewer.key("space", lambda s: s["running"], "runs")
    viewer.mark()
    viewer.point(290, 190)
    viewer.pause_pictures()
    viewer.tool("mousedown", 1)
    viewer.wait(lambda s: s["dragging"], "the spring takes hold")
    viewer.point(360, 120)
    viewer.mark()
    viewer.tool("mouseup", 1)
    viewer.wait(lambda s: not s["dragging"], "the spring lets go")
    viewer.key("space", lambda s: not s["running"], "pauses")
    viewer.key("Delete", lambda s: s["bodies"] == bodies - 1, "removes what is selected")
    check(viewer.now()["selected"] == 0, "what is gone is not selected")
    viewer.key("ctrl+z", lambda s: s["bodies"] == bodies and s["selected"] != 0, "it comes back, and is selected")
    viewer.key("Delete", lambda s: s["bodies"] == bodies - 1, "removes it again")
    viewer.key("Tab", lambda s: "speed" in s["places"], "shows the panel")


def turn_camera(viewer):
    before = viewer.now()["camera"]
    viewer.point(600, 240)  # below what the viewer says
    viewer.mark()
    viewer.tool("mousedown", 3)
    viewer.point(540, 200)
    viewer.pause_pictures()
    viewer.tool("mouseup", 3)
    viewer.wait(lambda s: sum(abs(a - b) for a, b in zip(s["camera"], before)) > 0.05, "dragging turns the camera")
    # A key that goes up while Ctrl is down is up all the same.
    viewer.mark()
    viewer.tool("keydown", "w")
    viewer.wait(lambda s: sum(abs(a - b) for a, b in zip(s["camera"], before)) > 0.1, "a held key moves the camera")
    viewer.tool("keydown", "ctrl")
    viewer.tool("keyup", "w")
    viewer.tool("keyup", "ctrl")
    for _ in range(40):
        viewer.pause_pictures()
        last = viewer.now()["camera"]
        viewer.pause_pictures()
        if viewer.now()["camera"] == last:
            break
    check(viewer.now()["camera"] == last, "the camera stands when its key is up")


def keep_files(viewer, folder):
    take, state = os.path.join(folder, "wall.take"), os.path.join(folder, "wall.state")
    viewer.key("ctrl+r", lambda s: s["recording"] != "", "records")
    viewer.key("space", lambda s: s["running"], "runs")
    first = viewer.now()["step"]
    viewer.wait(lambda s: s["step"] > first + 10, "steps are recorded")
    viewer.key("space", lambda s: not s["running"], "pauses")
    viewer.key("ctrl+r", lambda s: s["recording"] == "", "stops recording")
    check(os.path.getsize(take) > 1000, "the take is empty")
    kept = viewer.now()
    viewer.key("ctrl+s", lambda s: s["why"].startswith("done: save"), "saves the state")
    check(os.path.getsize(state) > 1000, "the state is empty")
    viewer.key("r", lambda s: s["step"] == 0, "restarts")
    viewer.key("ctrl+l", lambda s: s["step"] == kept["step"] and s["bodies"] == kept["bodies"], "loads the state")
    viewer.key("F12", lambda s: s["why"] == "action", "saves a picture")
    stills = [name for name in os.listdir(folder) if name.startswith("wall-") and name.endswith(".png")]
    check(len(stills) == 1 and colours(os.path.join(folder, stills[0])) > 500, f"stills: {stills}")


def resize(viewer):
    viewer.mark()
    viewer.tool("windowsize", viewer.window_at(), 800, 500)
    viewer.wait(lambda s: s["size"] == [800, 500], "the window takes its new size")
    shown = viewer.picture("resized")
    size = subprocess.run(["identify", "-format", "%w %h", shown], capture_output=True, text=True, check=True).stdout
    check(size == "800 500" and colours(shown) > 500, f"the picture after resizing: {size}, {colours(shown)} colours")
    # Unmapping is what minimising does where there is no window manager.
    viewer.mark()
    viewer.tool("windowunmap", viewer.window_at())
    viewer.wait(lambda s: s["why"] == "hidden", "notices that it is hidden")
    viewer.mark()
    viewer.tool("windowmap", viewer.window_at())
    viewer.wait(lambda s: s["why"] == "shown", "notices that it is shown again")
    viewer.tool("windowfocus", "--sync", viewer.window_at())  # which a window manager would do


def be_managed(viewer):
    """Minimising and full screen are what a window manager does."""
    manager = subprocess.Popen(["openbox"], env=viewer.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        viewer.await_manager()
        viewer.mark()
        viewer.tool("windowminimize", viewer.window_at())
        viewer.wait(lambda s: s["why"] == "hidden", "notices that it is minimised")
        viewer.mark()
        viewer.tool("windowactivate", viewer.window_at())
        viewer.wait(lambda s: s["why"] == "shown", "notices that it is shown again")
        before = viewer.now()["size"]
        width, height = 2 * viewer.size[0], 2 * viewer.size[1]
        viewer.key("F11", lambda s: s["size"] == [width, height], "fills the screen")
        shown = viewer.picture("full")
        size = subprocess.run(["identify", "-format", "%w %h", shown], capture_output=True, text=True, check=True).stdout
        check(size == f"{width} {height}" and colours(shown) > 500, f"the picture that fills the screen: {size}")
        left, top, wide, high = viewer.wait_place("speed")  # here the list of files leaves it free
        viewer.key("ctrl+o", lambda s: s["files"], "shows the list of files")
        moved = differing(shown, viewer.picture("listed"), f"{wide:.0f}x{high:.0f}+{left:.0f}+{top:.0f}")
        check(moved == 0, "a slider's number moves under its knob while a text is typed elsewhere")
        viewer.key("Escape", lambda s: not s["files"], "closes the list")
        viewer.key("F11", lambda s: s["size"] == before, "is a window again")
    finally:
        manager.terminate()
        manager.wait()
    viewer.tool("windowfocus", "--sync", viewer.window_at())


def drop_files(viewer, folder):
    scene, wrong = os.path.join(folder, "dropped one.toml"), os.path.join(folder, "wrong.toml")
    with open(scene, "w") as file:
        file.write('title = "Dropped"\n[[wall]]\nname = "w"\ncourses = 2\nbricks = 3\n')
    with open(wrong, "w") as file:
        file.write("[[wall]]\ncourses = -2\n")
    viewer.mark()
    drop(viewer.display, int(viewer.window_at()), scene)
    dropped = viewer.wait(lambda s: s["scene"] == "dropped one" and s["why"].startswith("done: open"), "opens what is dropped")
    check(dropped["bodies"] < 12, f"bodies of the scene that was dropped: {dropped['bodies']}")
    viewer.mark()
    drop(viewer.display, int(viewer.window_at()), wrong)
    told = viewer.wait(lambda s: s["why"] == "refused: open", "refuses a scene with mistakes")
    check(told["scene"] == "dropped one" and told["messages"], f"the scene before stays, and a message: {told}")
    viewer.mark()
    drop(viewer.display, int(viewer.window_at()), wrong)
    told = viewer.wait(lambda s: s["why"] == "refused: open", "refuses it again")
    check(sum("wrong.toml" in message for message in told["messages"]) == 1, f"a mistake is told once: {told['messages']}")


def quit_at_once(viewer, program, folder):
    """What cannot be opened ends a run that nobody attends, by its exit code: a state that fits another scene."""
    with open(os.path.join(folder, "wall.state"), "rb") as file:
        state = bytearray(file.read())
    at = state.index(b"method") + len("method")
    state[at:at + 8] = struct.pack("<d", 1)
    total = 14695981039346656037
    for byte in state[:-8]:
        total = (total ^ byte) * 1099511628211 % 2**64
    state[-8:] = struct.pack("<Q", total)
    path, picture = os.path.join(folder, "other.state"), os.path.join(folder, "never.png")
    with open(path, "wb") as file:
        file.write(state)
    ran = subprocess.run([program, path, "--frames", "2", "--screenshot", picture], env=viewer.environment, cwd=folder,
                         capture_output=True, text=True, timeout=120)
    check(ran.returncode == 2 and "another method" in ran.stderr and ran.stderr.count("\n") == 1,
          f"a state that fits another scene: exit code {ran.returncode}: {ran.stderr!r}")
    check(not os.path.exists(picture), "a picture of nothing was saved")
    ran = subprocess.run([program, "cube", "--frames", "2", "--screenshot", picture], env=viewer.environment, cwd=folder,
                         capture_output=True, text=True, timeout=120)
    check(ran.returncode == 0 and ran.stderr == "" and colours(picture) > 300,
          f"two pictures: exit code {ran.returncode}: {ran.stderr!r}")


def quit_while_recording(viewer, folder):
    """Where the take should get its name there is a folder by then."""
    viewer.tool("windowfocus", "--sync", viewer.window_at())  # the windows that came and went had it
    viewer.key("ctrl+r", lambda s: s["recording"] != "", "records")
    os.mkdir(os.path.join(folder, "dropped one.take"))
    viewer.mark()
    viewer.tool("key", "ctrl+q")
    viewer.wait(lambda s: s["why"] == "quit", "quits", running=False)
    viewer.process.wait(timeout=60)
    said = viewer.said()
    check(viewer.process.returncode == 3 and "dropped one.take" in said and said.count("\n") == 0,
          f"a recording that cannot end: exit code {viewer.process.returncode}: {said}")


def tests(program):
    folder = sys.argv[2]
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(folder):
        path = os.path.join(folder, name)
        shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)
    viewer = Viewer(program, ["wall"], folder, environment={"XDG_STATE_HOME": os.path.join(folder, "kept")})
    try:
        for part in (come_back, shoot_and_step, switch_views, use_panel, click_shortly, add_up, select_and_drag, point_at_ground, turn_camera,
                     let_go_outside, open_by_name, follow_file, rest):
            began = time.monotonic()
            part(viewer)
            print(f"{part.__name__}: {time.monotonic() - began:.1f} s")
        keep_files(viewer, folder)
        resize(viewer)
        be_managed(viewer)
        drop_files(viewer, folder)
        quit_at_once(viewer, program, folder)
        quit_while_recording(viewer, folder)
    finally:
        viewer.end()


main_of(tests, sys.argv[1])
