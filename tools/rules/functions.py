"""How long a function may be: 80 lines, or 120 where a comment beside its head says why (`// length: ...`).

Functions are found without a compiler: in text without comments, literals and directives, a brace opens a function if what
stands before it since the last statement ends in a list of arguments and what may follow one.
"""
import re

from rules.source import code_only, errors, line_of, read

USUAL, MOST = 80, 120
# Longer than that, and known: the longest function of a file -> no more lines than this.
KNOWN = {}

def without_directives(code):
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda m: "\n" * m.group(0).count("\n"), code, flags=re.M)


def opens(head):
    """What the brace behind this head opens: 'function', 'scope', or 'value' (the statement goes on behind it)."""
    head = re.sub(r"\b(?:alignas|__attribute__|decltype)\s*\((?:[^()]|\([^()]*\))*\)", "", head).strip()
    while re.search(r"\{[^{}]*\}", head):  # of members: Type() : member_{...}
        head = re.sub(r"\{[^{}]*\}", "()", head)
    flat = head
    while re.search(r"\([^()]*\)", flat):
        flat = re.sub(r"\([^()]*\)", "", flat)
    called = flat != head
    if re.match(r"(?:template\s*<.*>\s*)?(?:inline\s+)?(?:namespace|class|struct|union|enum|extern)\b", flat, re.S) and not called:
        return "scope"
    if re.search(r"(?<![=!<>])=(?!=)", flat.replace("operator=", "")):
        return "value"
    if re.search(r"(?<!:):(?!:)", flat):  # a list of members' values is done when the last one has its brackets
        return "function" if called and head.endswith(")") else "value"
    after = r"(?:\b(?:const|noexcept|override|final|mutable|requires)\b|&|->.*)"
    return "function" if called and re.search(r"\)\s*(?:" + after + r"\s*)*$", head, re.S) else "value"


def functions(text):
    """(first line, last line) of every function; those inside others belong to them."""
    code = without_directives(code_only(text))
    stack, start = [], 0  # kinds of the open braces; where the present statement began
    inside = None  # the first line of the function that the walk is in
    for match in re.finditer(r"[{};]|\b(?:public|private|protected)\s*:", code):
        at, found = match.start(), match.group(0)
        outside = inside is None and "value" not in stack
        if found == "{":
            kind = opens(code[start:at]) if outside else "inner"
            if kind == "function":
                inside = line_of(code, start + len(code[start:at]) - len(code[start:at].lstrip()))
            stack.append(kind)
        elif found == "}":
            kind = stack.pop() if stack else "scope"
            if kind == "function":
                yield inside, line_of(code, at)
                inside = None
        else:
            kind = "scope" if outside else "inner"
        if kind in ("function", "scope"):
            start = match.end()


def check(sources):
    unseen = dict(KNOWN)
    for name in sources:
        text = read(name)
        lines = text.split("\n")
        for first, last in functions(text):
            length = last - first + 1
            if length <= USUAL:
                continue
            reason = any(re.search(r"//.*\blength: \S", line) for line in lines[max(0, first - 4):first])
            most = max(MOST if reason else USUAL, KNOWN.get(name, 0))
            if length > most:
                errors.append(f"{name}:{first}: {length} lines, at most {most}: {lines[first - 1].strip()}")
            unseen.pop(name, None)
    for name in unseen:
        errors.append(f"tools/rules/functions.py: {name} has no long function any more: take it out of KNOWN")
