#!/usr/bin/env python3
"""A public header as Doxygen wants it: `// ...` above a thing documents it, `// ...` behind a thing does so too, with the lines
that go on below. Headings (`// --- ...`) and `#` lines stay as they are. Nothing but comment marks changes, so lines keep numbers."""
import re
import sys


def escaped(text):
    return re.sub(r"([\\@<>&#%])", r"\\\1", text)


def split(line):
    """Code and comment of a line; a `//` in a string is no comment."""
    in_string = False
    for i, c in enumerate(line):
        if c == '"' and line[i - 1:i] != "\\":
            in_string = not in_string
        if not in_string and line.startswith("//", i):
            return line[:i], line[i + 2:]
    return line, None


def main():
    behind = None  # column of a comment behind code that may go on
    head = True    # the comment that opens the file is about the file
    for line in open(sys.argv[1], encoding="utf-8").read().split("\n"):
        code, comment = split(line)
        if comment is None:
            behind, head = None, False
            print(line)
            continue
        if head is True:
            print("/// \\file")
            head = None
        text = escaped(comment)
        if code.strip():
            behind = len(code)
            print(f"{code}///<{text}")
        elif behind is not None and abs(len(code) - behind) <= 1:
            print(f"{code}///<{text}")
        elif comment.startswith(" ---"):
            behind = None
            print(line)
        else:
            behind = None
            print(f"{code}///{text}")


main()
