#!/usr/bin/env python3
"""Every shipped scene in a window: it opens, runs, is shot at and seen: scenes_test.py BRICKFALL_VIEW FOLDER SCENES

Its pictures stay in FOLDER for whoever wants to look. Takes minutes, and is run by the target viewer_scenes.
"""
import os
import sys

sys.dont_write_bytecode = True
from drive import Viewer, check, colours, differing, main_of


def visit(program, scene, folder):
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(folder):
        os.remove(os.path.join(folder, name))
    viewer = Viewer(program, [scene, "--paused", "--no-panel"], folder)
    try:
        start = viewer.now()
        check(start["scene"] == scene, f"opened {start['scene']}")
        first = viewer.picture("start")
        check(colours(first) > 300, f"the picture is blank: {colours(first)} colours")
        viewer.key("f", lambda s: s["bodies"] == start["bodies"] + 1, "shoots")
        viewer.key("space", lambda s: s["running"], "runs")
        viewer.wait(lambda s: s["step"] > 30, "steps are made")
        viewer.key("space", lambda s: not s["running"], "pauses")
        check(differing(first, viewer.picture("later")) > 1e-4, "nothing is seen to move")
        viewer.mark()
        viewer.tool("key", "ctrl+q")
        viewer.wait(lambda s: s["why"] == "quit", "quits", running=False)
        viewer.process.wait(timeout=120)
        check(viewer.process.returncode == 0 and viewer.said() == "", f"exit code {viewer.process.returncode}: {viewer.said()}")
    finally:
        viewer.end()


def tests(program):
    scenes = sorted(name[:-5] for name in os.listdir(sys.argv[3]) if name.endswith(".toml"))
    check(len(scenes) > 10, f"scenes: {scenes}")
    for scene in scenes:
        visit(program, scene, os.path.join(sys.argv[2], scene))
        print("fine:", scene, flush=True)


main_of(tests, sys.argv[1], skipped=0)
