"""How long pages and sentences may be, and whether what pages name is there.

LIMITS: pages that have grown beyond use once, with the words that they may have in all (as `wc -w` counts, tables included) and in a
sentence (code and tables excepted). Every link to a heading must meet one, as GitHub names it, in each page of the project; every page of
docs/ that any file names must be there, and some way by links must lead to it from docs/README.md; every shipped scene must be in the table of docs/scene-file.md.
"""
import os
import re

from rules.source import ROOT, errors, line_of, read

LIMITS = {"docs/step.md": (7000, 40)}
# Pages that users read by ear: no long sentences, as many words as they need.
LIMITS.update({f"docs/{page}.md": (10**6, 36) for page in (
    "README tutorial animators game-programmers teachers engineers faq scene-file command-line outputs summary series export render "
    "viewer").split()})
LIMITS["README.md"] = (10**6, 36)
LIMITS["CHANGELOG.md"] = (10**6, 40)


def paragraphs(text):
    """(line, text) of each paragraph and item of a list, without code, tables and headings."""
    fenced, start, parts = False, 0, []
    for number, line in enumerate(text.split("\n") + [""], 1):
        item = re.match(r" {0,3}(?:[-*]|\d+\.) ", line)
        ends = not line.strip() or line.startswith(("|", "#", "<!--", "```")) or fenced
        if (ends or item) and parts:
            yield start, " ".join(parts)
            parts = []
        if line.startswith("```"):
            fenced = not fenced
        elif not ends and (parts or item or not line.startswith("    ")):  # else code
            if not parts:
                start = number
            parts.append(line.strip())


def sentences(paragraph):
    plain = re.sub(r"`[^`]*`", "Code", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", paragraph))
    return re.split(r"(?<=[.!?])[)*\"]*\s+(?=[\"(*\[]*[A-Z0-9])|(?<=[.!?][)*])\s+", plain)


def check_length(name, text, words, most):
    found = len(text.split())
    if found >= words:
        errors.append(f"{name}: {found} words, expected less than {words}: what only some readers need wants a page of its own")
    for line, paragraph in paragraphs(text):
        for sentence in sentences(paragraph):
            count = len(re.findall(r"\S*\w\S*", sentence))
            if count > most:
                errors.append(f"{name}:{line}: a sentence of {count} words, at most {most}: {' '.join(sentence.split()[:6])} ...")


def headings(text):
    """The names by which GitHub links to the headings of a page."""
    names = set()
    for title in re.findall(r"^#{1,6} (.*)$", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title.strip()).lower()
        name = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        at, again = name, 0
        while at in names:
            again += 1
            at = f"{name}-{again}"
        names.add(at)
    return names


def check_anchors(name, text, known):
    for target, anchor in re.findall(r"\]\(([^)\s#]*)#([^)\s]*)\)", re.sub(r"```.*?```", "", text, flags=re.S)):
        page = os.path.normpath(os.path.join(os.path.dirname(name), target)) if target else name
        if "://" in target or not page.endswith(".md") or not os.path.isfile(os.path.join(ROOT, page)):
            continue
        if page not in known:
            known[page] = headings(read(page))
        if anchor not in known[page]:
            errors.append(f"{name}: link to #{anchor}, which no heading of {page} is")


def check_named(name, text):
    for match in re.finditer(r"(?<![\w./-])docs/[\w/-]+\.md\b", text):
        if not os.path.isfile(os.path.join(ROOT, match.group(0))):
            errors.append(f"{name}:{line_of(text, match.start())}: names {match.group(0)}, which is not there")


def check_scenes(names):
    page = read("docs/scene-file.md") or ""
    for name in names:
        folder, file = os.path.split(name)
        if folder == "scenes" and file.endswith(".toml") and f"`{file[:-5]}`" not in page:
            errors.append(f"docs/scene-file.md: the shipped scene {file[:-5]} is not in its table")


def check_reached(names):
    """Pages of docs/ to which no way by links leads from its index."""
    reached, waiting = {"docs/README.md"}, ["docs/README.md"]
    while waiting:
        page = waiting.pop()
        for target in re.findall(r"\]\(([^)\s#]+)", read(page) or ""):
            found = os.path.normpath(os.path.join(os.path.dirname(page), target))
            if found.endswith(".md") and found not in reached and os.path.isfile(os.path.join(ROOT, found)):
                reached.add(found)
                waiting.append(found)
    for name in names:
        if name.startswith("docs/") and name.endswith(".md") and name not in reached:
            errors.append(f"{name}: no link leads here from docs/README.md")


def check(names):
    check_scenes(names)
    check_reached(names)
    known = {}
    for name in names:
        text = read(name)
        if text is None:
            continue
        check_named(name, text)
        if name.endswith(".md"):
            check_anchors(name, text, known)
        if name in LIMITS:
            check_length(name, text, *LIMITS[name])
