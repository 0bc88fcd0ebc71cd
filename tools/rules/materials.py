"""Kinds of stuff stand in one table for window, page and film; their names stand in an enum of C++ and a type of TypeScript besides.
All three must be the same, in the same order."""
import re

from rules.source import errors, read

TABLE, KINDS, PAGE = "apps/appearance/kinds.inc", "apps/appearance/look.h", "apps/web/src/materials.ts"


def quoted(text):
    return re.findall(r"""["']([^"']+)["']""", text)


def part(name, pattern):
    match = re.search(pattern, read(name), re.S)
    if not match:
        errors.append(f"{name}: no kinds of stuff found to compare with those of the other programs")
    return match.group(1) if match else ""


def check(names):
    if not {TABLE, KINDS, PAGE} <= names:
        return
    rows = re.findall(r"^KIND\((\w+),", read(TABLE), re.M)
    found = {KINDS: re.findall(r"\w+", part(KINDS, r"enum class Kind\b[^{]*\{([^}]*)\}")), PAGE: quoted(part(PAGE, r"type Kind = ([^;]*);"))}
    for name, kinds in found.items():
        if kinds != rows:
            errors.append(f"{name}: kinds {kinds}, expected {rows} as in {TABLE}")
