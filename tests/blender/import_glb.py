# blender --background --factory-startup --python-exit-code 3 --python import_glb.py -- FOLDER
# Imports FOLDER/wall.glb and compares what Blender shows at some frames with FOLDER/poses.json, which was written from the
# take itself: every body there under its name, at its place, turned as it should be.
import json
import sys

import numpy

numpy.bool = bool  # Debian's Blender 3.4 and numpy 1.24 disagree about this name

import bpy
from mathutils import Quaternion

folder = sys.argv[sys.argv.index("--") + 1]
with open(folder + "/poses.json") as file:
    expected = json.load(file)

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = expected["framesPerSecond"]
bpy.ops.import_scene.gltf(filepath=folder + "/wall.glb")

meshes = [o for o in bpy.data.objects if o.type == "MESH"]
cameras = [o for o in bpy.data.objects if o.type == "CAMERA"]
assert len(meshes) == len(expected["bodies"]), f"{len(meshes)} meshes, expected {len(expected['bodies'])}"
assert len(cameras) == expected["cameras"], f"{len(cameras)} cameras, expected {expected['cameras']}"
brick_meshes = {o.data.name for o in meshes if o.name.startswith("brick ")}
assert 1 <= len(brick_meshes) <= 8, f"bricks use {len(brick_meshes)} meshes, expected one for each tone"

worst_place = worst_angle = 0.0
compared = 0
for sample in expected["samples"]:
    scene.frame_set(sample["frame"])
    for name, place, turn in zip(expected["bodies"], sample["positions"], sample["rotations"]):
        body = bpy.data.objects[name]
        x, y, z = place
        found = body.matrix_world.translation
        # glTF has Y up, Blender Z: (x, y, z) there is (x, -z, y) here.
        place_off = max(abs(found.x - x), abs(found.y + z), abs(found.z - y))
        want = Quaternion((turn[3], turn[0], -turn[2], turn[1]))
        have = body.matrix_world.to_quaternion()
        # Twice the distance of the quaternions: for small angles more exact in floats than an arc cosine.
        angle_off = 2 * min((have - want).magnitude, (have + want).magnitude)
        assert place_off < 5e-4, f"{name} frame {sample['frame']}: {place_off} m off"
        assert angle_off < 3e-3, f"{name} frame {sample['frame']}: {angle_off} rad off"
        worst_place, worst_angle = max(worst_place, place_off), max(worst_angle, angle_off)
        compared += 1
assert compared == len(expected["samples"]) * len(expected["bodies"]) and compared > 300
print(f"{len(meshes)} bodies, {compared} poses compared: at most {worst_place * 1000:.3f} mm and {worst_angle:.5f} rad off")
