# snippets.py COMPILER INCLUDE FOLDER PAGE...: every ```cpp block of the pages compiles, each as a function of its own. Each section of
# the first page has one, and a picture.
import os
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
guide = open(pages[0]).read()
for section in re.split(r"^## ", guide, flags=re.M)[1:-1]:
    title = section.split("\n")[0]
    assert "```cpp" in section, f"{pages[0]}: no snippet under {title}"
    pictures = re.findall(r"^!\[.+\]\((.+)\)$", section, re.M)
    assert pictures, f"{pages[0]}: no picture under {title}"
    for picture in pictures:
        assert os.path.exists(os.path.join(os.path.dirname(pages[0]), picture)), f"{pages[0]}: {picture} is not there"
assert count > 15, f"{count} snippets found"
path = folder + "/snippets.cpp"
with open(path, "w") as file:
    file.write(source)
program = os.path.join(os.path.dirname(pages[0]), "images/api/pictures.cpp")  # what makes pictures for it
command = [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Werror", "-Wno-unused-variable",
           "-Wno-unused-but-set-variable", "-I", include, path, program]
sys.exit(subprocess.run(command).returncode)
