#!/usr/bin/env python3
"""Mistakes at the command line, for which no display is needed: arguments_test.py BRICKFALL_VIEW FOLDER

Each gives one line that names what was found and what was expected, and the exit code of docs/command-line.md.
"""
import os
import subprocess
import sys

program, folder = sys.argv[1], sys.argv[2]
os.makedirs(folder, exist_ok=True)
without_display = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}

CASES = [
    (["--size", "12x34"], 2, ["--size", "12x34", "1280x720"]),
    (["--size", "1280"], 2, ["--size", "1280", "WIDTHxHEIGHT"]),
    (["--shadows", "stencill"], 2, ["--shadows", "stencill", "did you mean", "stencil"]),
    (["--frames", "0"], 2, ["--frames", "'0'"]),
    (["--frames", "-1"], 2, ["--frames"]),
    (["--time", "nan"], 2, ["--time", "nan"]),
    (["--samples", "3"], 2, ["--samples", "3", "0, 2, 4 or 8"]),
    (["--set", "speed"], 2, ["--set", "speed", "KEY=VALUE"]),
    (["--set", "speed=fast"], 2, ["speed"]),
    (["--no-such-flag"], 2, ["--no-such-flag"]),
    (["wal"], 2, ["wal", "did you mean", "wall"]),
    ([""], 2, ["scene"]),
    (["--size", ""], 2, ["--size", "WIDTHxHEIGHT"]),
    (["--shadows", ""], 2, ["--shadows", "stencil"]),
    (["--frames", ""], 2, ["--frames"]),
    (["--time", ""], 2, ["--time"]),
    (["--samples", ""], 2, ["--samples"]),
    (["--set", ""], 2, ["--set", "KEY=VALUE"]),
    (["--screenshot", ""], 2, ["--screenshot", "file"]),
    (["wall", "--log", folder + "/no/such/folder/log"], 3, ["--log", "cannot be written"]),
    (["wall", "--status", folder + "/no/such/folder/status"], 3, ["--status", "cannot be written"]),
    (["wall"], 5, ["no display", "DISPLAY is not set"]),
    (["wall", "--frames", "1"], 5, ["no display"]),
]

problems = []
for arguments, code, words in CASES:
    ran = subprocess.run([program, *arguments], cwd=folder, env=without_display, capture_output=True, text=True, timeout=120)
    said = ran.stderr.strip()
    if ran.returncode != code:
        problems.append(f"{arguments}: exit code {ran.returncode}, expected {code}: {said}")
    if not said or (said.count("\n") > 0 and "error: " not in said):  # mistakes of a scene are a line each
        problems.append(f"{arguments}: expected one line, found: {said!r}")
    problems += [f"{arguments}: '{word}' is not in: {said}" for word in words if word not in said]

unreachable = dict(without_display, DISPLAY=":9999")
ran = subprocess.run([program, "wall"], env=unreachable, capture_output=True, text=True, timeout=120)
if ran.returncode != 5 or ":9999" not in ran.stderr or ran.stderr.strip().count("\n") > 0:
    problems.append(f"a display that does not answer: exit code {ran.returncode}: {ran.stderr!r}")
taught = subprocess.run([program, "--help"], env=without_display, capture_output=True, text=True, timeout=120)
if taught.returncode != 0 or "Examples:" not in taught.stdout or "--shadows" not in taught.stdout:
    problems.append(f"--help: exit code {taught.returncode}: {taught.stdout[:400]!r}")

if problems:
    sys.exit("\n".join(problems))
print("ok")
