"""A header as Doxygen reads it. In a comment, of /// or of C before what it is about, a line "Domain    finite" begins a paragraph of that
name, and lines that are indented are shown as they are. The first comment describes the file.   doc_blocks.py FILE"""
import re
import sys
from pathlib import Path

KEYED = re.compile(r"([A-Z][a-z]+) {2,}(\S.*)|(Environment|Degenerate) (\S.*)")


def block(lines):
    """A comment of these lines."""
    shown, keyed = False, False
    yield "/**"
    for line in lines:
        key = KEYED.fullmatch(line)
        verbatim = not keyed and not key and line.startswith("  ")
        if verbatim != shown:
            yield "@verbatim" if verbatim else "@endverbatim"
            shown = verbatim
        if key:
            keyed = True
            yield f"@par {key[1] or key[3]}"
        yield line if verbatim else (key[2] or key[4] if key else line.strip()).replace("#", "\\#")
    if shown:
        yield "@endverbatim"
    yield "*/"


def filtered(text):
    """The header, all of whose comments are blocks or stand behind what they are about."""
    c_comment = re.compile(r"^( *)/\*(?= )((?:(?!\*/).)*)\*/$", re.MULTILINE | re.DOTALL)
    text = c_comment.sub(lambda found: "".join(f"{found[1]}/// {line}\n" for line in re.split(rf"\n {{,{len(found[1]) + 3}}}", found[2].strip()))[:-1], text)
    text = re.sub(r"(?<=[;,])( +)/\*(?= )", r"\1/**<", text)
    text = re.sub(r"\A///?(.*\n)((?:///?.*\n)*)", lambda head: f"/// @file\n///{head[1]}" + re.sub("^///?", "///", head[2], flags=re.MULTILINE), text)
    text = text.replace("::inline CONTACT_ABI", "")  # which version it is, a reader does not write
    comment = []
    for line in [*text.splitlines(), ""]:
        if found := re.fullmatch(r" */// ?(.*)", line):
            comment.append(found[1])
            continue
        if comment:
            yield from block(comment)
        comment = []
        yield line


if __name__ == "__main__":
    print("\n".join(filtered(Path(sys.argv[1]).read_text(encoding="utf-8"))))
