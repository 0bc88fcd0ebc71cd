"""A kind of tie is named by its own folder alone: a second kind is then added beside the first, not in all that walk them.

Checked for each kind that Rows lists (src/solver/rows.h, `auto kinds()`): its member (`rows.contacts`) and its types are
named in its folder of src/solver/ only. The folder is that of the header which defines the member's type.
"""
import re

from rules.source import code_only, errors, find, read

LIST = "src/solver/rows.h"


def kinds_of(names):
    """Of each kind: its member in Rows, its folder, the types that the headers of its rows define."""
    text = code_only(read(LIST))
    for member in re.search(r"auto kinds\(\) \{ return std::tie\(([^)]*)\)", text).group(1).split(","):
        member = member.strip()
        row_type = re.search(r"(\w+) " + member + r";", text).group(1)
        header = next((name for name in names if name.startswith("src/solver/") and name.endswith("/rows.h")
                       and re.search(rf"\bstruct {row_type}\b[^;]*\{{", read(name))), None)
        if header is None:
            errors.append(f"{LIST}: {row_type} is in no rows.h of a folder of src/solver")
            continue
        defined = re.findall(r"^struct (?:alignas\(\d+\) )?(\w+)(?: : [\w, ]+)? \{", code_only(read(header)), re.M)
        yield member, header[:-len("rows.h")], sorted(defined)


def check(names):
    if LIST not in names:
        return
    for member, folder, types in kinds_of(names):
        for name in names:
            if not re.fullmatch(r"(src|apps)/.*\.(h|cpp)", name) or name.startswith(folder) or name == LIST:
                continue
            text = code_only(read(name))
            find(rf"\brows_?\.{member}\b", text, name, f"rows.{member} is read and written in {folder} only: ask all rows (contact/rows.h)")
            for word in types:
                find(rf"\b{word}\b", text, name, f"{word} is known in {folder} only")
