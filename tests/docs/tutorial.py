# tutorial.py COMMAND FOLDER PAGE: the scene of the tutorial's blocks, one after the other, has no mistake; its wall stands until the ball
# comes, and then bricks move.
import json
import re
import subprocess
import sys

command, folder, page = sys.argv[1:]
blocks = re.findall(r"^```toml\n(.*?)^```", open(page).read(), re.S | re.M)
assert len(blocks) == 4, f"{len(blocks)} blocks"


def run(*arguments):
    return subprocess.run([command, *arguments], cwd=folder, capture_output=True, text=True)


for count in range(1, len(blocks) + 1):
    with open(folder + "/my-house.toml", "w") as file:
        file.write("\n".join(blocks[:count]))
    checked = run("check", "my-house.toml")
    assert checked.returncode == 0 and checked.stderr == "", checked.stderr
    assert "fine" in checked.stdout, checked.stdout
for seconds, least, most in (("0.4", 0, 0), ("1.2", 5, 10_000)):
    done = run("run", "my-house.toml", "--seconds", seconds, "-o", "house", "--quiet", "--no-html", "--no-glb")
    assert done.returncode == 0, done.stderr
    moved = json.load(open(folder + "/house/summary.json"))["bricks_moved_50mm"]
    assert least <= moved <= most, f"{moved} bricks moved after {seconds} s"
print("the tutorial's house stands and is hit")
