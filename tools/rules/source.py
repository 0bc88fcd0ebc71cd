"""What every rule needs: the files of the project, their text with comments blanked, and where findings go."""
import os
import re
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

errors, warnings = [], []


def tracked():
    listing = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True)
    if listing.returncode == 0:
        names = listing.stdout.decode().split("\0")
    else:  # an unpacked archive
        names = []
        for folder, folders, files in os.walk(ROOT):
            folders[:] = [f for f in folders if not f.startswith(("build", ".git")) and f not in ("node_modules", "out")]
            names += [os.path.relpath(os.path.join(folder, f), ROOT) for f in files]
    return [n for n in names if n and os.path.isfile(os.path.join(ROOT, n))]


def read(name):
    with open(os.path.join(ROOT, name), "rb") as file:
        data = file.read()
    return None if b"\0" in data else data.decode("utf-8", "replace")


def write(name, text):
    with open(os.path.join(ROOT, name), "w", encoding="utf-8") as file:
        file.write(text)


def code_only(text):
    """The text with comments and the insides of literals blanked; lines stay where they are."""
    def blank(match):
        found = match.group(0)
        if found[0] in "\"'":
            return found[0] + found[-1] if "\n" not in found else "\n" * found.count("\n")
        return "\n" * found.count("\n")
    pattern = r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, blank, text, flags=re.S)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def find(pattern, text, name, message, into=errors):
    for match in re.finditer(pattern, text):
        into.append(f"{name}:{line_of(text, match.start())}: {message}: {match.group(0).strip()}")


def made_block(document, source, lines, fix):
    """The part of a document that is made from code, between `<!-- made from SOURCE -->` and `<!-- end -->`."""
    text = read(document)
    begin, end = f"<!-- made from {source} -->\n", "<!-- end -->"
    start = text.find(begin)
    stop = text.find(end, start)
    if start < 0 or stop < 0:
        errors.append(f"{document}: no block '{begin.strip()}' ... '{end}'")
        return
    made = "".join(line + "\n" for line in lines)
    start += len(begin)
    if text[start:stop] == made:
        return
    if fix:
        write(document, text[:start] + made + text[stop:])
        print(f"tools/check: wrote the block made from {source} in {document}")
    else:
        errors.append(f"{document}: the block made from {source} is not what it is made from: tools/check --fix writes it")
