"""Which word of a material's name means which kind of stuff stands twice: for viewer and renderer in C++, for the replay page in
TypeScript. Kinds, words and their order (the first that fits counts) must be the same, or one wall looks different in each."""
import re

from rules.source import errors, read

CPP, KINDS, PAGE = "apps/appearance/look.cpp", "apps/appearance/look.h", "apps/web/src/materials.ts"


def quoted(text):
    return re.findall(r"""["']([^"']+)["']""", text)


def part(name, pattern):
    match = re.search(pattern, read(name), re.S)
    if not match:
        errors.append(f"{name}: no kinds of stuff found to compare with those of the other programs")
    return match.group(1) if match else ""


def check(names):
    if not {CPP, KINDS, PAGE} <= names:
        return
    kinds = re.findall(r"\w+", part(KINDS, r"enum class Kind\b[^{]*\{([^}]*)\}"))
    page_kinds = quoted(part(PAGE, r"type Kind = ([^;]*);"))
    if kinds != page_kinds:
        errors.append(f"{PAGE}: kinds {page_kinds}, expected {kinds} as in {KINDS}")
    rows = [(kind, quoted(words)) for kind, words in
            re.findall(r"\{Kind::(\w+), \{([^}]*)\}\}", part(CPP, r"\bkWords\[\] = \{(.*?)\n\};"))]
    page_rows = [(kind, quoted(words)) for kind, words in
                 re.findall(r"\['(\w+)', \[([^\]]*)\]\]", part(PAGE, r"\bkWords: [^=]*= \[(.*?)\n\];"))]
    for row, page_row in zip(rows, page_rows):
        if row != page_row:
            errors.append(f"{PAGE}: words {page_row}, expected {row} as in {CPP}")
    if len(rows) != len(page_rows) or len(rows) + 1 != len(kinds):  # all but "plain" have words
        errors.append(f"{PAGE}: {len(page_rows)} rows of words, expected {len(rows)} as in {CPP}, for {len(kinds)} kinds")
