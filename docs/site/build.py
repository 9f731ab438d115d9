#!/usr/bin/env python3
"""Builds the documentation's site, build/docs/html, offline:   build.py [--python FOLDER] [--tool PROGRAM]

Every page of the repository is laid out as it is, only its links are changed: a link to a page leads to its place on the site, and
one to another file to a page that shows the file. Then Doxygen reads include/contact, Sphinx builds with warnings as errors, and
every link of what it built is followed. FOLDER holds the built Python package; without it the functions of the pairs, which its
core describes, are left out of the reference. PROGRAM is contact-oracle; without it the tables that it prints are left out."""
import argparse
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

sys.path[:0] = [str(Path(__file__).resolve().parents[1]), str(Path(__file__).resolve().parents[2] / "engines")]
import scoreboard  # noqa: E402
from pages import ROOT, SCHEME, broken, links, name_of, pages, split  # noqa: E402

SITE = ROOT / "docs/site"
OUT = ROOT / "build/docs"
SOURCE, XML, HTML = OUT / "source", OUT / "xml", OUT / "html"
LANGUAGES = {".hpp": "cpp", ".cpp": "cpp", ".h": "c", ".c": "c", ".py": "python", ".js": "javascript", ".mjs": "javascript", ".json": "json",
             ".cff": "yaml", ".yml": "yaml", ".txt": "cmake"}
PICTURES = {".png", ".svg"}
LONGEST = 400_000  # bytes of a file that is shown
# Pages of the site alone: the page beside which each stands, its title, and the commands that print it.
TABLES = {"scoreboard-tables": ("docs/scoreboard.md", "All tables of the scoreboard", ()),
          "mutants": ("docs/bug-zoo.md", "All mutants", (("engines", "--table"),)),
          "families": ("docs/formats.md", "All families and flags", (("tables",), ("adequacy", "--table")))}


def place(page):
    """Where a page stands on the site: docs/x.md is x.md, and what the site alone has, docs/site/x.md, is x.md too."""
    return Path(re.sub("^docs/(site/)?", "", name_of(page)))


class Layout:
    """The pages as Sphinx reads them, and the files that they link to."""

    def __init__(self, tool=None):
        self.placed = {page: place(page) for page in pages() if ".github" not in page.parts}
        if len(set(self.placed.values())) != len(self.placed):
            raise SystemExit(f"two pages have one place: {sorted(map(str, self.placed.values()))}")
        self.shown = {}
        texts = {page: page.read_text(encoding="utf-8") for page in self.placed}
        if wrong := [f"{name_of(page)}: {one}" for page, text in texts.items() for one in broken(page, text)]:
            raise SystemExit("\n".join(wrong))
        for page, target in self.placed.items():
            self.write(target, self.with_links(page, texts[page], target))
        for name, (page, title, commands) in TABLES.items():
            text = "" if commands else scoreboard.tables(scoreboard.read())
            for words in commands:
                text += subprocess.run([tool, *words], text=True, capture_output=True, check=True).stdout + "\n" if tool else \
                    f"`contact-oracle {' '.join(words)}` prints this.\n\n"
            self.write(f"{name}.md", self.with_links(ROOT / page, f"# {title}\n\n{text}", Path(f"{name}.md")))
        for header in (file for file in (ROOT / "include/contact").iterdir() if file.suffix in (".h", ".hpp")):
            self.write(f"cpp/{header.name}.md", f"# `contact/{header.name}`\n\n```{{doxygenfile}} contact/{header.name}\n```\n")

    def write(self, target, text):
        (SOURCE / target).parent.mkdir(parents=True, exist_ok=True)
        (SOURCE / target).write_text(text, encoding="utf-8")

    def with_links(self, page, text, target):
        for link in reversed(links(text)):
            if SCHEME.match(link[1]):
                continue
            file, anchor = split(page, link[1])
            there = Path(os.path.relpath(self.of(file), target.parent)).as_posix() if file != page else ""
            text = text[:link.start(1)] + there + ("#" + anchor if anchor and file.suffix == ".md" else "") + text[link.end(1):]
        return text

    def of(self, file):
        """The place of whatever a page links to."""
        if file in self.placed:
            return self.placed[file]
        name = Path("files") / file.relative_to(ROOT)
        if file.suffix in PICTURES:
            (SOURCE / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, SOURCE / name)
            return name
        name = name / "index.md" if file.is_dir() else Path(f"{name}.md")
        if file not in self.shown:
            self.shown[file] = name
            self.write(name, "---\norphan: true\nnosearch: true\n---\n\n" + self.shown_file(file, name))
        return name

    def shown_file(self, file, name):
        title = f"# `{file.relative_to(ROOT)}`\n\n"
        if file.is_dir():
            entries = [entry for entry in sorted(file.iterdir()) if not entry.name.startswith((".", "__pycache__", "node_modules"))]
            return title + "".join(f"- [{entry.name}]({os.path.relpath(self.of(entry), name.parent)})\n"
                                   if entry.is_file() and entry.stat().st_size <= LONGEST else f"- {entry.name}\n" for entry in entries)
        text = file.read_text(encoding="utf-8")
        if len(text) > LONGEST:
            return f"{title}The file is too long to be shown.\n"
        return f"{title}~~~~~~{LANGUAGES.get(file.suffix, 'text')}\n{text.rstrip()}\n~~~~~~\n"


def run(*command, **environment):
    done = subprocess.run(command, cwd=SITE, env={**os.environ, **{name: str(value) for name, value in environment.items()}})
    if done.returncode:
        raise SystemExit(done.returncode)


SECTIONS = {"function": "func", "variable": "var"}


def arrange(xml):
    """A header's page has what its namespaces hold of it, once, and no macro that nothing is said of, which is the header's own affair."""
    held = {}
    # The same functions once more, for inline calls to ask: they have the names and the parameters of those that users call.
    for file in [file for file in sorted(xml.glob("namespace*.xml")) if not re.search("out__of__line|of__hit", file.name)]:
        for member in ElementTree.parse(file).iter("memberdef"):
            held.setdefault(member.find("location").get("file"), []).append(member)
    for file in xml.glob("*_8h*.xml"):
        tree = ElementTree.parse(file)
        header = tree.getroot().find("compounddef")
        structs = {one.text for one in header.findall("innerclass")}
        for parent in list(header.iter()):
            for child in list(parent):
                said = "".join(text for part in child if part.tag.endswith("description") for text in part.itertext()).strip()
                if (child.tag == "innernamespace" or child.get("kind") == "define" and child.tag == "memberdef" and not said
                        or child.get("kind") == "typedef" and child.tag == "memberdef" and child.findtext("name") in structs):
                    parent.remove(child)
        for member in held.get(header.find("location").get("file"), []):
            kind = SECTIONS.get(member.get("kind"), member.get("kind"))
            section = header.find(f"sectiondef[@kind='{kind}']")
            (ElementTree.SubElement(header, "sectiondef", kind=kind) if section is None else section).append(member)
        tree.write(file, encoding="unicode")


def bring_in(static):
    """What Debian's build of the theme lacks: its script imports another, which no page does from a file, and its style sheets
    import others by their place on a server of Debian's."""
    script, imported = static / "scripts/furo.js", 'import Gumshoe from "./gumshoe-patched.js";'
    if (text := script.read_text(encoding="utf-8")).startswith(imported):
        script.write_text((static / "scripts/gumshoe-patched.js").read_text(encoding="utf-8") + text.removeprefix(imported), encoding="utf-8")
    for sheet in [sheet for sheet in static.rglob("*.css") if sheet.is_file()]:
        text = sheet.read_text(encoding="utf-8")
        for name in re.findall(r"url\(/javascript/([^)]+)\)", text):
            (static / "javascript" / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(f"/usr/share/javascript/{name}", static / "javascript" / name)
        sheet.write_text(text.replace("url(/javascript/", f"url({os.path.relpath(static / 'javascript', sheet.parent)}/"), encoding="utf-8")


class Links(HTMLParser):
    """What a built page links to, and what a link into it may name."""

    def __init__(self, file):
        super().__init__()
        self.links, self.names = [], {""}
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value is not None:
                self.links.append(value)
            elif name == "id" or name == "name" and tag == "a":
                self.names.add(value)


def broken_links(folder):
    """Links of built pages and style sheets that lead nowhere."""
    for sheet in (sheet for sheet in folder.rglob("*.css") if sheet.is_file()):
        for link in re.findall(r"url\([\"']?([^)\"']+)", sheet.read_text(encoding="utf-8")):
            if not link.startswith("data:") and not (sheet.parent / urlsplit(link).path).is_file():
                yield f"{sheet.relative_to(folder)}: {link}: there is no such file"
    read = {file: Links(file) for file in sorted(folder.rglob("*.html"))}
    for file, page in read.items():
        for link in page.links:
            url = urlsplit(link)
            if url.scheme or url.netloc:
                continue
            target = (file.parent / unquote(url.path)).resolve() if url.path else file
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                yield f"{file.relative_to(folder)}: {link}: there is no such file"
            elif target.suffix == ".html" and url.fragment and unquote(url.fragment) not in read[target].names:
                yield f"{file.relative_to(folder)}: {link}: there is no such place on that page"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--python", metavar="FOLDER", type=Path, help="holds the built package contact_oracle")
    options.add_argument("--tool", metavar="PROGRAM", type=Path, help="contact-oracle, whose tables become pages")
    given = options.parse_args()
    built = given.python
    shutil.rmtree(OUT, ignore_errors=True)
    XML.mkdir(parents=True)
    Layout(given.tool and given.tool.resolve())
    version = re.search(r"project\(contact-oracle VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    run("doxygen", "Doxyfile", CONTACT_HEADERS=ROOT / "include", CONTACT_DOXYGEN_XML=XML)
    arrange(XML)
    run("sphinx-build", "-q", "-W", "--keep-going", "-E", "-b", "html", "-c", SITE, "-d", OUT / "doctrees", SOURCE, HTML,
        CONTACT_VERSION=version, CONTACT_DOXYGEN_XML=XML, CONTACT_PYTHON_SOURCE=ROOT / "python",
        **({"CONTACT_PYTHON": built.resolve()} if built else {}))
    bring_in(HTML / "_static")
    if wrong := list(broken_links(HTML)):
        raise SystemExit("\n".join(wrong))
    print(f"{HTML}/index.html: {len(list(HTML.rglob('*.html')))} pages, every link leads somewhere")


if __name__ == "__main__":
    main()
