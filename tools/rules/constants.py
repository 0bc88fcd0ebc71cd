"""The constants of the method stand where they are used, each with what happens if it is wrong; the table in docs/constants.md is
made from them. The line above a constant says

    //! UNIT | too small: WHAT THEN | too large: WHAT THEN     a row of the table; UNIT is - where there is none
    //! UNIT | with kOTHER                                     in the row of that one
    //! not of the method: WHY                                 in no row; up to the next empty line

In the folders of the method each constant of a file must have such a line (one inside a function may); elsewhere those that have one are in the table too.
"""
import re

from rules.source import errors, line_of, made_block, read

SETTINGS = "include/brickfall/solver_settings.h"
MUST = ("src/solver/", "src/dynamics/", "src/world/", SETTINGS)
FIRST = [SETTINGS, "src/solver/step_context.h"]

CONSTANT = re.compile(r"^[ \t]*(?:inline |static )*constexpr (double|float|int|std::size_t|std::uint32_t|std::int64_t) "
                      r"(k[A-Z]\w*\s*=[^;{]*);", re.M)
FIELD = re.compile(r"^[ \t]*(double|int) (\w+\s*=[^;{]*);", re.M)
# A number as code writes it.
NUMBER = r"-?(?:\d[\d']*\.?\d*|\.\d+)(?:e-?\d+)?f?"


def number(value, unit):
    """A value as people write it: 25e-6 m is 25 um."""
    if not re.fullmatch(NUMBER, value):
        return f"`{value}`" + (f" {unit}" if unit else "")
    value = value.rstrip("f").replace("'", "")
    size = abs(float(value))
    if re.match(r"(m|m/s|rad)(?= |$)", unit) and 0 < size < (0.01 if unit.startswith("rad") else 0.1):
        return f"{float(value) * 1e6:.6g} u{unit}" if size < 1e-4 else f"{float(value) * 1e3:.6g} m{unit}"
    return value + (f" {unit}" if unit else "")


def marked(name, text):
    """(line, whether outside functions, names, values, mark) of each constant in the file, in order; mark is None where none is given."""
    pattern = FIELD if name == SETTINGS else CONSTANT
    lines = text.split("\n")
    for match in pattern.finditer(text):
        first = line_of(text, match.start())
        mark, above = None, first - 2
        comment = []
        while above >= 0 and lines[above].strip().startswith("//!"):
            comment.insert(0, lines[above].strip()[3:].strip())
            above -= 1
        if comment:
            mark = " ".join(comment)
        else:
            while above >= 0 and lines[above].strip():
                if lines[above].strip().startswith("//! not of the method"):
                    mark = lines[above].strip()[3:].strip()
                above -= 1
        parts = [part.split("=", 1) for part in re.split(r",\s+(?=\w+\s*=)", match.group(2))]
        if all(len(part) == 2 for part in parts):
            of_file = not match.group(0)[0].isspace() or name == SETTINGS
            yield first, of_file, [a.strip() for a, _ in parts], [b.strip() for _, b in parts], mark


def rows(sources):
    found, ordered = {}, []
    for name in sorted(sources, key=lambda n: (FIRST.index(n) if n in FIRST else len(FIRST), n)):
        if not name.startswith("src/") and name != SETTINGS:
            continue
        for line, of_file, names, values, mark in marked(name, read(name)):
            at = f"{name}:{line}: {', '.join(names)}"
            if mark is None:
                if of_file and name.startswith(MUST) and not re.fullmatch(r"0x[0-9a-f]+u", values[0]):
                    errors.append(f"{at}: no line `//! unit | too small: ... | too large: ...` above it (tools/rules/constants.py)")
                continue
            if re.match(r"not of the method: \S", mark):
                continue
            parts = [part.strip() for part in mark.split("|")]
            unit = "" if parts[0] == "-" else parts[0]
            shown = [number(value, unit) for value in values]
            if len(parts) == 2 and parts[1].startswith("with "):
                row = found.get(parts[1][5:])
                if row is None:
                    errors.append(f"{at}: no {parts[1][5:]} above it to stand with")
                    continue
                row["names"] += names
                row["values"] += shown
            elif len(parts) == 3 and parts[1].startswith("too small: ") and parts[2].startswith("too large: "):
                where = "" if name == SETTINGS else f"`{name[4:]}`"
                row = {"names": names, "values": shown, "small": parts[1][11:], "large": parts[2][11:], "where": where}
                ordered.append(row)
            else:
                errors.append(f"{at}: `//! {mark}` is not `//! unit | too small: ... | too large: ...`")
                continue
            for each in names:
                found[each] = row
    return ordered


def check(sources, fix):
    lines = ["| constant | value | too small | too large | in |", "|---|---|---|---|---|"]
    for row in rows(sources):
        names = ", ".join(f"`{name}`" for name in row["names"])
        lines.append(f"| {names} | {', '.join(row['values'])} | {row['small']} | {row['large']} | {row['where']} |")
    made_block("docs/constants.md", "the constants of the method", lines, fix)
