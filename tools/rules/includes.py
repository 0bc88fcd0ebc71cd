"""Each file of src/ includes what declares the types that it names, itself or by its headers.

make builds many files as one (BRICKFALL_UNITY), where a file compiles that lives by what another has included; the presets
build each alone. Checked: types that one header alone declares at the start of a line.
"""
import re

from rules.layers import includes
from rules.source import code_only, errors, line_of, read


def check(sources):
    texts = {name: read(name) for name in sources if name.startswith(("src/", "include/"))}
    code = {name: re.sub(r"#include[^\n]*", "", code_only(text)) for name, text in texts.items()}
    says = {name: set(re.findall(r"\b(?:struct|class|using|typename)(?: alignas\(\w+\))? (\w+)", text)) for name, text in code.items()}
    homes = {}
    for name in sorted(n for n in code if n.endswith(".h")):
        for word in re.findall(r"^(?:struct|class|enum class) (\w+)[^;]*?\{", code[name], re.M):
            homes.setdefault(word, []).append(name)
    home = {word: names[0] for word, names in homes.items() if len(names) == 1}
    if len(home) < 100:
        errors.append("tools/rules/includes.py: finds hardly any types")
    reached = {}

    def reach(name):
        """The file and all headers of ours that it includes, all the way down."""
        if name not in reached:
            reached[name] = found = {name}
            for _, header in includes(texts[name]):
                for path in ("src/" + header, "include/" + header, name.rsplit("/", 1)[0] + "/" + header):
                    found |= reach(path) if path in texts else set()
        return reached[name]

    for name, text in code.items():
        known = set().union(*(says[path] for path in reach(name)))
        for match in re.finditer(r"(?<![\w.>:])[A-Z]\w+", text):
            word = match.group(0)
            if word in home and word not in known:
                errors.append(f"{name}:{line_of(text, match.start())}: {word} is named, and {home[word]}, which declares it, "
                              "not included")
                known.add(word)
