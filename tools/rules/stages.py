"""One list of stages: kStageNames, the table of step.cpp, a file for each, and docs/step.md with what each reads and changes."""
import re

from rules.source import errors, read


def check(names):
    if "src/world/stages.h" not in names:
        return
    listed = re.findall(r'"(\w+)"', re.search(r"kStageNames = \{(.*?)\}", read("include/brickfall/step_trace.h"), re.S).group(1))
    if re.findall(r"\{Stage::(\w+),", read("src/world/step.cpp")) != listed:
        errors.append("src/world/step.cpp: its rows are not the stages of kStageNames in their order")
    declared = [(name, arguments) for name, arguments in re.findall(r"^void (\w+)\(([^)]*)\);", read("src/world/stages.h"), re.M)
                if not name.startswith(("hash", "book"))]
    text = read("docs/step.md")
    rows = re.findall(r"^\| (\w+) \|([^|]*)\|([^|]*)\|$", text.split("## Stages")[1].split("**pairs**")[0], re.M)[1:]
    if [row[0] for row in rows] != listed or len(declared) < len(listed):
        errors.append("docs/step.md: the rows of its table are not the stages of kStageNames in their order")
        return
    types = set(re.findall(r"(?:const )?([A-Z]\w+)&", " ".join(arguments for _, arguments in declared)))
    for stage, (function, arguments), (_, reads, changes) in zip(listed, declared, rows):
        if f"src/world/stage_{stage}.cpp" not in names:
            errors.append(f"src/world/stage_{stage}.cpp is missing: each stage has a file")
        elif not re.search(rf"\bvoid {function}\(", read(f"src/world/stage_{stage}.cpp")):
            errors.append(f"src/world/stage_{stage}.cpp: {function}, the stage of stages.h, is not there")
        if f"**{stage}** (`stage_{stage}.cpp`" not in text:
            errors.append(f"docs/step.md: stage {stage} is not described with its file")
        constant = set(re.findall(r"const ([A-Z]\w+)&", arguments))
        for what, cell, wanted in (("reads", reads, constant), ("changes", changes, set(re.findall(r"([A-Z]\w+)&", arguments)) - constant)):
            named = set(re.findall(r"`(\w+)`", cell)) & types
            if named != wanted:
                errors.append(f"docs/step.md: stage {stage} {what} {', '.join(sorted(wanted))} in stages.h, {', '.join(sorted(named))} here")
