# snippets.py COMPILER INCLUDE FOLDER PAGE...: every ```cpp block of the pages compiles, each as a function of its own.
import re
import subprocess
import sys

compiler, include, folder, *pages = sys.argv[1:]
source = """#include <cstdio>
#include <memory_resource>
#include <string>
#include <unordered_map>
#include <vector>
#include "brickfall/brickfall.h"
"""
count = 0
for page in pages:
    text = open(page).read()
    for match in re.finditer(r"^```cpp\n(.*?)^```", text, re.S | re.M):
        line = text[:match.start()].count("\n") + 2
        body = re.sub(r"^#include.*$|^using namespace brickfall;$", "", match.group(1), flags=re.M)
        # A page's own world stands for the one that its snippets are given.
        own = "World world" in body
        parameters = "double dt" if own else "[[maybe_unused]] World& world, [[maybe_unused]] const double dt"
        source += f"namespace snippet{count} {{\nusing namespace brickfall;\nvoid shown({parameters}) {{\n"
        source += f'#line {line} "{page}"\n{body}\n}}\n}}\n'
        count += 1
assert count > 15, f"{count} snippets found"
path = folder + "/snippets.cpp"
with open(path, "w") as file:
    file.write(source)
command = [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Werror", "-Wno-unused-variable",
           "-Wno-unused-but-set-variable", "-I", include, path]
sys.exit(subprocess.run(command).returncode)
