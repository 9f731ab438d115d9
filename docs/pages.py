"""The Markdown pages of the repository: their links, their anchors and the blocks that they show. The tests and the site read them here."""
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FENCE = re.compile(r"^( *)```.*?^\1```[^\S\n]*$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`[^`\n]*(?:\n[^`\n]+)*`")
LINK = re.compile(r"\]\(<?([^()\s>]+)>?(?: \"[^\"]*\")?\)")
SCHEME = re.compile(r"[a-z][a-z+.-]*:", re.IGNORECASE)


def pages():
    """Every page: those beside the source of a folder, and all of docs/."""
    found = {*ROOT.glob("*.md"), *ROOT.glob("*/README.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / ".github").rglob("*.md")}
    return sorted(path for path in found if path.relative_to(ROOT).parts[0] != "build")


def name_of(page):
    return page.relative_to(ROOT).as_posix()


def prose(text):
    """The text with all code blanked, each character in its place."""
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])
    return SPAN.sub(blank, FENCE.sub(blank, text))


def links(text):
    """The targets of links and pictures, each as a match whose group 1 is the target."""
    return list(LINK.finditer(prose(text)))


def slug(heading):
    """The anchor that GitHub gives a heading."""
    plain = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip())
    return re.sub(r"[^\w -]", "", plain.lower()).replace(" ", "-")


def anchors(text):
    """What a link into the page may name: its headings, and <a id="...">."""
    found = re.findall(r'<a id="([^"]+)"></a>', prose(text))
    seen = {}
    for heading in re.findall(r"^#+ (.*?)#*$", FENCE.sub("", text), re.MULTILINE):
        one = slug(heading)
        found.append(one if one not in seen else f"{one}-{seen[one]}")
        seen[one] = seen.get(one, 0) + 1
    return found


def split(page, target):
    """The file or folder that a link of a page leads to, and the anchor there."""
    path, _, anchor = target.partition("#")
    return ((page.parent / path).resolve() if path else page), anchor


def broken(page, text):
    """What is wrong with the links of a page, given as text."""
    found = []
    for link in links(text):
        target = link[1]
        if SCHEME.match(target):
            if not re.fullmatch(r"https?://[\w.-]+\.[a-z]+(?::\d+)?(?:/\S*)?|mailto:\S+@\S+", target):
                found.append(f"{target}: not an address")
            continue
        file, anchor = split(page, target)
        if not file.exists():
            found.append(f"{target}: there is no such file")
        elif not file.is_relative_to(ROOT):
            found.append(f"{target}: outside the repository")
        elif anchor and file.suffix == ".md" and anchor not in anchors(text if file == page else file.read_text(encoding="utf-8")):
            found.append(f"{target}: {name_of(file)} has no such heading")
    return found
