"""A header as Doxygen reads it. A comment of C before a declaration, or behind one, is about it. In a comment of /// a line "Domain    finite" begins a paragraph of that name, and lines that are
indented are shown as they are. Its first line, a comment of //, describes the file.   doc_blocks.py FILE"""
import re
import sys
from pathlib import Path

KEYED = re.compile(r"([A-Z][a-z]+) {2,}(\S.*)|(Environment|Degenerate) (\S.*)")


def block(lines):
    """The lines of one comment, without their ///."""
    shown, keyed = False, False
    for line in lines:
        key = KEYED.fullmatch(line)
        verbatim = not keyed and not key and line.startswith("  ")
        if verbatim != shown:
            yield "@verbatim" if verbatim else "@endverbatim"
            shown = verbatim
        if key:
            keyed = True
            yield f"@par {key[1] or key[3]}"
            yield (key[2] or key[4]).replace("#", "\\#")
        else:
            yield line if verbatim else line.strip().replace("#", "\\#")
    if shown:
        yield "@endverbatim"


def c_comments(text):
    """The comments of a header in C, as Doxygen takes them; the first is about the file."""
    text = re.sub(r"^( *)/\*(?= )", r"\1/**", text, flags=re.MULTILINE).replace("/**", "/** @file\n  ", 1)
    return re.sub(r"(?<=[;,])( +)/\*(?= )", r"\1/**<", text)


def filtered(text):
    """The whole header."""
    text = re.sub(r"\A//(.*\n)((?://.*\n)*)", lambda head: f"/// @file\n///{head[1]}" + head[2].replace("//", "///"), text)
    comment, indent = [], ""
    for line in [*text.splitlines(), ""]:
        found = re.fullmatch(r"(\s*)/// ?(.*)", line)
        if found:
            indent = found[1]
            comment.append(found[2])
            continue
        yield from (f"{indent}/// {one}" for one in block(comment))
        comment = []
        yield line


if __name__ == "__main__":
    header = Path(sys.argv[1]).read_text(encoding="utf-8")
    print(c_comments(header) if sys.argv[1].endswith(".h") else "\n".join(filtered(header)))
