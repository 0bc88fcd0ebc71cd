"""look_test.py COMMAND RENDER VIEW CHROMIUM PICTURE_SCRIPT WEB_FOLDER OUT_FOLDER: window, page and film draw the same moment of a
take from the same camera, and regions of the pictures have the same mean colour: sky, ground, shadow, the lit and the shaded side of
a wall, a brick that was burnt dark. Skipped where a tool is missing.
"""
import json
import math
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

SIZE = (480, 270)
CAMERA, TARGET, FIELD_OF_VIEW = (1.5, 0.9, 2.0), (0.35, 0.3, 0.0), 50.0  # sees a lit side, and a shaded end
MOST = {"sky": 4, "ground": 12, "shadow": 12, "lit side": 14, "shaded side": 12, "dark brick": 10}  # of 255, between any two


def run(*words, **more):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(str(w) for w in words)}: {done.returncode}\n{done.stdout[-600:]}\n{done.stderr[-1200:]}")


def minus(a, b): return [x - y for x, y in zip(a, b)]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def unit(a): return [x / math.sqrt(dot(a, a)) for x in a]


def pixel_of(point):
    forward = unit(minus(TARGET, CAMERA))
    right = unit(cross(forward, [0, 1, 0]))
    up, away = cross(right, forward), minus(point, CAMERA)
    scale = SIZE[1] / 2 / math.tan(math.radians(FIELD_OF_VIEW / 2)) / dot(away, forward)
    return SIZE[0] / 2 + dot(away, right) * scale, SIZE[1] / 2 - dot(away, up) * scale


def chance(number, salt):
    """Of apps/appearance/noise.h: by it bricks differ."""
    h = (number * 374761393 + salt * 668265263) & 0xffffffff
    h = (h ^ h >> 13) * 1274126177 & 0xffffffff
    return (h ^ h >> 16) / 2 ** 32


class Picture:
    def __init__(self, path):
        done = subprocess.run(["convert", path, "-depth", "8", "rgb:-"], capture_output=True, check=True)
        self.bytes = done.stdout
        if len(self.bytes) != 3 * SIZE[0] * SIZE[1]:
            raise SystemExit(f"{path}: {len(self.bytes)} bytes, expected {SIZE[0]}x{SIZE[1]} pixels")

    def mean(self, pixels):
        return [sum(self.bytes[3 * (y * SIZE[0] + x) + k] for x, y in pixels) / len(pixels) for k in range(3)]


def around(points, reach=1):
    """The pixels of little squares about points of the scene."""
    out = set()
    for at in map(pixel_of, points):
        x, y = int(at[0]), int(at[1])
        out |= {(x + i, y + j) for i in range(-reach, reach + 1) for j in range(-reach, reach + 1)}
    inside = sorted(p for p in out if 0 <= p[0] < SIZE[0] and 0 <= p[1] < SIZE[1])
    if len(inside) < 6:
        raise SystemExit(f"the camera does not see {points}")
    return inside


def spread(low, high, steps):
    """Points of a box, evenly: as many as `steps` each way."""
    def along(k, n, i): return low[k] + (high[k] - low[k]) * ((i + 0.5) / n)
    return [(along(0, steps[0], i), along(1, steps[1], j), along(2, steps[2], k))
            for i in range(steps[0]) for j in range(steps[1]) for k in range(steps[2])]


def regions_of(wall):
    bricks = [(k, body, pose) for k, (body, pose) in enumerate(wall) if body["role"] == "brick"]
    top = max(pose[1] for _, _, pose in bricks) + 0.0325
    end = max(pose[0] for _, _, pose in bricks) + 0.05  # of a half bat
    front = max(pose[2] for _, _, pose in bricks) + 0.05125
    dark = [pose for k, _, pose in bricks if chance(k, 4) < 0.11 and -0.3 < pose[0] < 0.9]
    if not dark:
        raise SystemExit("no dark brick is seen")
    return {
        "sky": [(x, y) for x in range(10, 100, 6) for y in range(8, 24, 4)],
        "ground": around(spread((-0.2, 0, 0.5), (0.6, 0, 0.7), (12, 1, 6)), 2),
        "shadow": around(spread((end, 0, -0.5), (end + 0.05, 0, -0.4), (3, 1, 4))),
        "lit side": around(spread((-0.6, 0.05, front), (end - 0.1, top - 0.05, front), (24, 12, 1))),
        "shaded side": around(spread((end, 0.1, -0.02), (end, top - 0.05, 0.03), (1, 10, 3)), 0),
        "dark brick": around([(p[0] + dx, p[1], front) for p in dark for dx in (-0.07, -0.03, 0.03, 0.07)]),
    }


def draw(tools, out):
    command, render, view, chromium, script, web = tools
    place = json.dumps(list(CAMERA)), json.dumps(list(TARGET))
    run(command, "run", "wall", "--seconds", "0.05", "--quiet", "-o", out, "--set", f"camera[0].position={place[0]}", "--set", f"camera[0].target={place[1]}",
        "--set", f"camera[0].field_of_view_degrees={FIELD_OF_VIEW}")
    take = os.path.join(out, "wall.take")
    files = {kind: os.path.join(out, f"{kind}.png") for kind in ("film", "window", "page")}
    size = f"{SIZE[0]}x{SIZE[1]}"

    def film(): run(render, take, "--frame", "0", "--size", size, "--samples", "4", "--threads", "1", "--quiet", "-o", files["film"])

    def window():
        run("xvfb-run", "-a", "-s", "-screen 0 640x480x24", view, take, "--paused", "--frames", "2", "--no-panel", "--size", size, "--screenshot", files["window"])

    def page():
        run("node", script, os.path.join(out, "replay.html"), files["page"], "frame=0", "view=1", f"size={size}", f"web={web}", env=dict(os.environ, CHROMIUM=chromium))

    with ThreadPoolExecutor(2) as pool:
        for done in [pool.submit(one) for one in (page, window, film)]:
            done.result()
    run(command, "export", take, "--to", "json", "-o", out)
    with open(os.path.join(out, "wall.json")) as file:
        return files, json.load(file)


def main(arguments):
    *tools, out = arguments
    missing = [tool for tool in ("xvfb-run", "convert", "node", tools[3]) if not shutil.which(tool)]
    if missing:
        print("skipped, not found: " + ", ".join(missing))
        return 77
    os.makedirs(out, exist_ok=True)
    files, take = draw(tools, out)
    poses = take["frames"][0]["poses"]
    wall = [(body, pose[1:4]) for body, pose in zip(take["bodies"], poses)]
    pictures = {kind: Picture(path) for kind, path in files.items()}
    faults, means = [], {}
    for name, pixels in regions_of(wall).items():
        means[name] = {kind: picture.mean(pixels) for kind, picture in pictures.items()}
        worst = max(abs(a[k] - b[k]) for a in means[name].values() for b in means[name].values() for k in range(3))
        print(f"{name}: " + "; ".join(f"{kind} " + ",".join(f"{v:.0f}" for v in mean) for kind, mean in means[name].items()) + f"; differ by {worst:.0f}")
        if worst > MOST[name]:
            faults.append(f"{name}: differs by {worst:.0f}, at most {MOST[name]}")
    for kind in pictures:
        # Each of them by itself: sun and shade, dark and usual bricks are told apart.
        for dark, light, share in (("shadow", "ground", 0.8), ("shaded side", "lit side", 0.85), ("dark brick", "lit side", 0.9)):
            if not sum(means[dark][kind]) < share * sum(means[light][kind]):
                faults.append(f"{kind}: {dark} is not darker than {light}")
    print("\n".join(faults) or "one look")
    return 1 if faults else 0


sys.exit(main(sys.argv[1:]))
