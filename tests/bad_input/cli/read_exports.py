# read_exports.py STEM: do STEM.*.csv, STEM.json and STEM.npz say the same, read by readers of another make?
import ast
import csv
import json
import math
import struct
import sys
import zipfile

stem = sys.argv[1]


def table(name):
    with open(f"{stem}.{name}.csv", newline="") as file:
        return list(csv.DictReader(file))


def array(content):
    """An .npy file of version 1.0: its shape, and its items in order."""
    assert content[:8] == b"\x93NUMPY\x01\x00"
    size = struct.unpack("<H", content[8:10])[0]
    assert (10 + size) % 64 == 0
    head = ast.literal_eval(content[10:10 + size].decode("latin1"))
    assert head["fortran_order"] is False
    data, kind = content[10 + size:], head["descr"]
    count = math.prod(head["shape"])
    if kind.startswith("<U"):
        width = int(kind[2:])
        assert len(data) == 4 * width * count
        items = [data[4 * width * k:4 * width * (k + 1)].decode("utf-32-le").rstrip("\0") for k in range(count)]
    else:
        code = {"<f8": "d", "<f4": "f", "<u4": "I", "<i8": "q"}[kind]
        items = list(struct.unpack(f"<{count}{code}", data))
    return head["shape"], items


archive = zipfile.ZipFile(stem + ".npz")
assert archive.testzip() is None
arrays = {name.removesuffix(".npy"): array(archive.read(name)) for name in archive.namelist()}
with open(stem + ".json") as file:
    whole = json.load(file)
bodies, poses, events, series = table("bodies"), table("poses"), table("events"), table("series")

assert [b["name"] for b in bodies] == arrays["body_name"][1] == [b["name"] for b in whole["bodies"]]
assert [float(b["mass_kg"]) for b in bodies] == arrays["body_mass_kg"][1]
frames, count, three = arrays["position_m"][0]
assert three == 3 and frames == len(arrays["time_s"][1]) == len(whole["frames"]) and frames > 20
assert len(poses) == frames * count, "all bodies are always there in this take"
places = [float(p[key]) for p in poses for key in ("x_m", "y_m", "z_m")]
assert places == arrays["position_m"][1]
assert places == [x for frame in whole["frames"] for pose in frame["poses"] for x in pose[1:4]]
turns = arrays["rotation_xyzw"][1]
for k, pose in enumerate(poses):
    quaternion = [float(pose[key]) for key in ("qx", "qy", "qz", "qw")]
    assert abs(math.hypot(*quaternion) - 1) < 1e-4
    assert all(abs(a - b) < 1e-6 for a, b in zip(quaternion, turns[4 * k:4 * k + 4]))
assert len(events) == len(arrays["event"][1]) == sum(len(f["events"]) for f in whole["frames"])
for name in series[0]:
    column = [float(row[name]) for row in series]
    assert column == arrays["series_" + name][1] == [float(x) for x in whole["series"][name]], name
assert len(series) == frames
assert whole["summary"]["state_hash"]
try:
    import numpy
except ImportError:
    print("numpy is not there: read without it")
else:
    loaded = numpy.load(stem + ".npz")
    assert loaded["position_m"].shape == (frames, count, 3) and loaded["body_name"][0] == bodies[0]["name"]
    print("read by numpy", numpy.__version__)
