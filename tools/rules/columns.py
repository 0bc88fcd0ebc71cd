"""No line of the solver and the world is longer than .clang-format allows: it leaves long comments as they are.

Where a folder is not in ENFORCED yet, its long lines are counted in a warning; `tools/check --columns` lists them.
"""
from rules.source import errors, read, warnings

MOST = 120
FOLDERS = ("src/solver/", "src/world/")
ENFORCED = FOLDERS


def long_lines(sources):
    for name in sources:
        if name.startswith(FOLDERS) and name.endswith((".h", ".cpp")):
            for number, line in enumerate(read(name).split("\n"), 1):
                if len(line) > MOST:
                    yield name, number, len(line)


def check(sources):
    counted = {}
    for name, number, length in long_lines(sources):
        if name.startswith(ENFORCED):
            errors.append(f"{name}:{number}: {length} columns, at most {MOST}")
        else:
            folder = next(f for f in FOLDERS if name.startswith(f))
            counted[folder] = counted.get(folder, 0) + 1
    for folder, count in counted.items():
        warnings.append(f"{folder}: {count} lines of more than {MOST} columns (tools/check --columns lists them)")
