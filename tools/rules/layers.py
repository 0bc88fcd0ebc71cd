"""Which module may include what: the USES lines of CMake say it, and nothing else does.

Checked: every include line of src/ names a module that its own module uses; no module names one that it does not need or
that comes later in src/CMakeLists.txt (so there are no circles, and siblings never include each other); the engine knows
nothing above it; programs (apps/) include public headers and their own only; the table in docs/architecture.md is made from the same lines.
"""
import re

from rules.source import errors, made_block, read

# Public headers that the engine must not know.
ABOVE_ENGINE = {"brickfall/" + name for name in ("machines.h", "masonry.h", "mesh_file.h", "report.h", "scene.h", "scenery.h", "take.h",
                                                "take_recorder.h", "whole_file.h", "output.h", "export.h")}


class Module:
    def __init__(self, path, words):
        self.path, self.name = path, words[0]
        parts = {"": [], "SOURCES": [], "USES": [], "LINK": []}
        part = ""
        for word in words[1:]:
            if word in parts:
                part = word
            else:
                parts[part].append(word)
        self.engine = "ENGINE" in parts[""]
        self.uses = parts["USES"]


def modules_of(names, folder):
    """Of `brickfall_module(NAME [ENGINE] SOURCES ... USES ...)` in each folder/*/CMakeLists.txt, in the order of building."""
    found = {}
    for path in names:
        if re.fullmatch(folder + r"/\w+/CMakeLists\.txt", path):
            text = re.sub(r"#[^\n]*", "", read(path))
            for call in re.findall(r"brickfall_module\((.*?)\)", text, re.S):
                module = Module(path, call.split())
                found[module.name] = module
    top = re.sub(r"#[^\n]*", "", read(folder + "/CMakeLists.txt"))
    lists = re.findall(r"\bset\(\w+ ([^)]*)\)|\bMODULES ([a-z_\s]+)", top)
    order = {word: at for at, word in enumerate(" ".join(a + b for a, b in lists).split())}
    return dict(sorted(found.items(), key=lambda item: order.get(item[0], len(order))))


def includes(text):
    for number, line in enumerate(text.split("\n"), 1):
        match = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
        if match:
            yield number, match.group(1)


def reached(name, modules, seen):
    """Modules that this file needs on its include path: those of its headers and of their headers in turn."""
    if name in seen:
        return
    seen.add(name)
    try:
        text = read(name)
    except OSError:
        return
    for _, header in includes(text):
        if "/" in header and header.split("/")[0] in modules:
            reached("src/" + header, modules, seen)


def check_uses(modules, sources):
    order = list(modules)
    for module in modules.values():
        seen = set()
        for name in sources:
            if name.startswith(f"src/{module.name}/"):
                reached(name, modules, seen)
        needed = {name.split("/")[1] for name in seen} - {module.name}
        for used in module.uses:
            if used not in modules:
                errors.append(f"{module.path}: {module.name} uses {used}, which is no module")
            elif order.index(used) >= order.index(module.name):
                errors.append(f"{module.path}: {module.name} uses {used}, which src/CMakeLists.txt builds later")
            elif module.engine and not modules[used].engine:
                errors.append(f"{module.path}: {module.name} is of the engine and must not use {used}")
            elif used not in needed:
                errors.append(f"{module.path}: {module.name} uses {used} and includes nothing of it, directly or by a header")


def check_includes(modules, sources):
    for name in sources:
        if not name.startswith("src/"):
            continue
        module = modules.get(name.split("/")[1])
        if module is None:
            errors.append(f"{name}: no CMakeLists.txt makes a module of src/{name.split('/')[1]}")
            continue
        allowed = set(module.uses) | {module.name}
        for number, header in includes(read(name)):
            folder = header.split("/")[0] if "/" in header else module.name
            if folder == "brickfall":
                if module.engine and header in ABOVE_ENGINE:
                    errors.append(f"{name}:{number}: the engine must not include {header}")
            elif folder in modules and folder not in allowed:
                errors.append(f"{name}:{number}: {module.name} must not include {header}: its USES line names "
                              f"{' '.join(module.uses) or 'nothing'}")


def check_apps(names, sources, modules):
    """Programs use the public API only."""
    apps = modules_of(names, "apps")
    for app in apps.values():
        if set(app.uses) - set(apps):
            errors.append(f"{app.path}: {app.name} uses {' '.join(app.uses)}: a program uses the public API only")
    for name in sources:
        if not name.startswith("apps/"):
            continue
        for number, header in includes(read(name)):
            if "/" in header and header.split("/")[0] in modules:
                errors.append(f"{name}:{number}: a program must not include {header}: it uses the public API only")


def table(modules):
    rows = {}
    for module in modules.values():  # one row for neighbours that use the same
        rows.setdefault((module.engine, tuple(module.uses)), []).append(f"`{module.name}`")
    yield "| module | may include (besides the public API) |"
    yield "|---|---|"
    for (_, uses), names in rows.items():
        yield f"| {', '.join(names)} | {', '.join(uses) or 'nothing'} |"


def engine_modules(names):
    return {module.name for module in modules_of(names, "src").values() if module.engine}


def check(names, sources, fix):
    modules = modules_of(names, "src")
    check_uses(modules, sources)
    check_includes(modules, sources)
    check_apps(names, sources, modules)
    made_block("docs/architecture.md", "the USES lines of src/*/CMakeLists.txt", list(table(modules)), fix)
