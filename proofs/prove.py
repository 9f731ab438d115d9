#!/usr/bin/env python3
"""Checks the proofs behind every constant that accepts a fast answer.   python3 proofs/prove.py [--coq]

Without an option: the numbers of bounds.json into the scripts, Gappa on each, the links between them, and the headers that
carry the proved bounds into C++. With --coq every Gappa proof is checked by Coq with each rewriting hint made a lemma, and
so are the lemmas of coq/. README.md says how to read a script.

--write       writes the headers and the table of README.md
--table       prints the list of constants
--only NAME   that script alone, and no link
"""

import argparse
import concurrent.futures
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
# Numbers are rounded up to a whole number of 2^-20 of their unit: scripts, links and headers have the same dyadic number.
RESOLUTION = 2**20
UNITS = {"": Fraction(1), "u": Fraction(1, 2**53), "u^2": Fraction(1, 2**106), "u^3": Fraction(1, 2**159)}
# ctest's word for a test that could not run.
SKIPPED = 77
# Near touching the scripts scale D' into [1, 2). Its exponent k is between -900 and 1020, and 2^-1074 the least number:
# whole numbers of 2^-174 and, at the other end, of 2^-2094. Both are checked.
NARROW = "float<53, -174, ne>"
WIDE = (NARROW, "float<53, -2094, ne>")


class ProofError(Exception):
    """Something that is not proved, in words."""


def number(text):
    """'34.5 u^2', '2^-950' or '3 * 2^-140' exactly, but rounded up to a whole number of 2^-20 of the unit."""
    if " + " in text:
        return sum(map(number, text.split(" + ")))
    power = re.fullmatch(r"(?:([0-9.]+) \* )?2\^(-?\d+)", text)
    if power:
        factor, unit = Fraction(power[1] or 1), Fraction(2) ** int(power[2])
    else:
        digits, _, unit = text.partition(" ")
        factor, unit = Fraction(digits), UNITS[unit]
    return Fraction(math.ceil(factor * RESOLUTION), RESOLUTION) * unit


def dyadic(x):
    """x as Gappa writes it: a whole number times a power of two."""
    exponent = -(x.denominator.bit_length() - 1)
    return f"{x.numerator}b{exponent}" if exponent else str(x.numerator)


def hexadecimal(x):
    """x as a C++ literal; it must be a double."""
    value = float(x)
    if Fraction(value) != x:
        raise ProofError(f"{x} is not a double")
    mantissa, exponent = value.hex().split("p")
    mantissa = re.sub(r"\.?0+$", "", mantissa)
    return f"{mantissa}p{int(exponent)}"


def camel(name):
    return "k" + "".join(part.capitalize() for part in name.split("_"))


CPP_NAMES = {"kUnit": "0x1p-53", "kUnitSquared": "0x1p-106", "kU2": "0x1p-106", "two_to(kHalf)": "0x1p21",
             "two_to(-kHalf)": "0x1p-21"}


def cpp_constant(file, name):
    """What a header says: a sum of products of numbers and of the names of powers of u."""
    found = re.findall(rf"constexpr double {name} = ([^;]*);", (ROOT / file).read_text())
    if len(found) != 1:
        raise ProofError(f"{file} has {len(found)} definitions of {name}")
    total = Fraction(0)
    for term in found[0].split(" + "):
        product = Fraction(1)
        for factor in term.split(" * "):
            product *= Fraction(float.fromhex(CPP_NAMES.get(factor, factor)) if not factor.isdigit() else int(factor))
        total += product
    return total


class Table:
    """bounds.json: the one list of numbers."""

    def __init__(self, folder):
        data = json.loads((folder / "bounds.json").read_text())
        self.bounds = {bound["name"]: bound for bound in data["bounds"]}
        if len(self.bounds) != len(data["bounds"]):
            raise ProofError("bounds.json: a name stands twice")
        self.values = {name: number(bound["value"]) for name, bound in self.bounds.items()}
        self.links = data["links"]
        self.constants = data["constants"]

    def evaluate(self, expression):
        """A sum of products of names and numbers, exactly."""
        total = Fraction(0)
        for term in expression.split(" + "):
            product = Fraction(1)
            for factor in term.split(" * "):
                product *= self.values[factor] if factor in self.values else number(factor)
            total += product
        return total

    def rows(self):
        """Each constant of C++, with its value and what is proved to suffice, in its own unit."""
        for side in self.constants:
            for row in side["rows"]:
                factor = math.prod(map(number, row["times"].split(" * "))) if "times" in row else 1
                yield row, cpp_constant(row["in"], row["constant"]), self.values[row["needs"]] / factor

    def check_constants(self):
        for row, value, needed in self.rows():
            if value < needed:
                raise ProofError(f"{row['in']}: {row['constant']} is {shown(value)}, "
                                 f"and {row['needs']} needs {shown(needed)}")

    def check_links(self):
        for link in self.links:
            small, large = link["holds"].split(" <= ")
            if self.evaluate(small) > self.evaluate(large):
                raise ProofError(f"link fails: {link['holds']} ({link['why']})")


class Script:
    """One Gappa script, its hypotheses and its conclusions by name."""

    def __init__(self, path):
        self.name = path.stem
        self.text = path.read_text()
        code = re.sub(r"#.*", "", self.text)
        goal = re.search(r"\{(.*?)\}", code, re.DOTALL)
        if not goal or goal[1].count("->") != 1:
            raise ProofError(f"{path.name}: one goal with one arrow is wanted")
        before, after = goal[1].split("->")
        # A conclusion is |..| <= @name@; any other name is used, but where the table says that this script proves it.
        bounded = re.sub(r"<=\s*@\w+@", "", after)
        self.used = re.findall(r"@(\w+)@", code[: goal.start()] + before + bounded + code[goal.end() :])
        self.grids = re.findall(r"@FIX\(\w+,\s*(-\d+)\)", after)
        self.concluded = re.findall(r"@(\w+)@", after)
        self.assumed = [re.sub(r"\s", "", part) for part in before.split("/\\")]
        self.hints = code[goal.end() :].count("->")

    def variants(self):
        """The least exponents to check it for: both ends of the range where the script stands for many."""
        return WIDE if NARROW in self.text else ("",)

    def filled(self, table, least=""):
        def value(match):
            if match[1] not in table.values:
                raise ProofError(f"{self.name}.g: bounds.json has no {match[1]}")
            return dyadic(table.values[match[1]])

        return re.sub(r"@(\w+)@", value, self.text.replace(NARROW, least or NARROW))


def check_order(scripts, table, lemmas):
    """Every hypothesis is given or the conclusion of exactly what the table names, and nothing rests on itself."""
    uses = {}
    for name, bound in table.bounds.items():
        source = bound.get("proved_by")
        if source is None:
            if "given" not in bound:
                raise ProofError(f"bounds.json: {name} is neither given nor proved")
            continue
        if source.endswith(".g"):
            script = scripts.get(source[:-2])
            if script is None or name not in script.concluded:
                raise ProofError(f"link fails: {source} does not conclude {name}")
            uses[name] = {used for used in script.used if table.bounds.get(used, {}).get("proved_by") != source}
        else:
            file, _, lemma = source.partition(":")
            fraction = Fraction(bound["value"])
            if f"{fraction.numerator} / {fraction.denominator}" not in lemmas.get(file, {}).get(lemma, ""):
                raise ProofError(f"link fails: coq/{file} has no lemma {lemma} about {bound['value']}")
    for text in [*(script.text for script in scripts.values()), json.dumps([*table.bounds.values(), *table.links])]:
        for file, lemma in re.findall(r"coq/(\w+\.v)(?:, (\w+))?", text):
            if file not in lemmas or lemma and lemma not in lemmas[file]:
                raise ProofError(f"coq/{file} has no lemma {lemma}")
    grids = {grid for script in scripts.values() for grid in script.grids}
    for script in scripts.values():
        for part in script.assumed:
            grid = re.fullmatch(r"@FIX\(\w+,(-\d+)\)", part)
            if grid and grid[1] in grids:
                continue
            found = re.search(r"@(\w+)@", part)
            if not found or grid:
                raise ProofError(f"{script.name}.g: the hypothesis {part} has a number of its own")
            symbols = table.bounds.get(found[1], {}).get("bounds")
            subject = re.fullmatch(r"\|?(.*?)\|?(?:<=@\w+@|in\[.*,@\w+@\])", part)
            if symbols and not (subject and {subject[1], subject[1].rstrip("0123456789")} & set(symbols)):
                raise ProofError(f"link fails: {script.name}.g takes {found[1]} for a bound of {part}; "
                                 f"it is one of {symbols}")
    done, path = set(), []

    def visit(name):
        if name in done:
            return
        if name in path:
            raise ProofError("link fails: a circle " + " <- ".join(path[path.index(name) :] + [name]))
        path.append(name)
        for other in sorted(uses.get(name, ())):
            visit(other)
        path.pop()
        done.add(name)

    for name in table.bounds:
        visit(name)


def run(command, folder, limit):
    try:
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired as late:
        raise ProofError(f"{command[-1]}: not done after {limit} s") from late



def without_warnings(result):
    """Gappa warns of hints that it cannot prove itself; with --coq they are proved. A goal stands on its own."""
    return "\n".join(line for line in result.stderr.splitlines() if not line.startswith("Warning"))


def gappa(script, table, folder):
    for variant, least in enumerate(script.variants()):
        file = folder / f"{script.name}{variant or ''}.g"
        file.write_text(script.filled(table, least))
        result = run(["gappa", "-Eprecision=128", file.name], folder, 120)
        if result.returncode != 0:
            raise ProofError(f"{script.name}.g is not proved:\n{without_warnings(result)}")


# A hint comes out of Gappa as an unproved hypothesis and a lemma that applies it.
HINT = re.compile(r"Hypothesis (a\d+) : (.*?)\.\nLemma (b\d+) : (.*?)\.\n.*?Qed\.\n", re.DOTALL)
DISCHARGE = "Ltac hint := intros; unfold Float1; field; repeat split; assumption || lra.\n"


def coq(script, table, folder):
    for variant, least in enumerate(script.variants()):
        name = f"{script.name}{variant or ''}"
        (folder / f"{name}.g").write_text(script.filled(table, least))
        result = run(["gappa", "-Eprecision=128", "-Bcoq", f"{name}.g"], folder, 120)
        if result.returncode != 0:
            raise ProofError(f"{script.name}.g is not proved:\n{without_warnings(result)}")
        text, replaced = HINT.subn(lambda found: f"Lemma {found[3]} : {found[4]}.\nProof. hint. Qed.\n", result.stdout)
        # Reals and Lra come first: names of Reals would hide Gappa's.
        text = "Require Import Reals Lra.\n" + text.replace("Section Generated", DISCHARGE + "Section Generated", 1)
        if re.search(r"\b(Hypothesis|Axiom|Admitted|admit)\b", text):
            raise ProofError(f"{script.name}.g: a hypothesis is left in its Coq proof")
        (folder / f"{name}.v").write_text(text)
        result = run(["coqc", "-q", f"{name}.v"], folder, 600)
        if result.returncode != 0:
            raise ProofError(f"{script.name}.g: Coq refuses the proof ({replaced} hints)\n{result.stderr[-2000:]}")


def lemma_files(paths, folder):
    """The files of lemmas, each after those that it requires."""
    texts = {path.stem: path.read_text() for path in paths}
    done = set()

    def compile_after_its_own(name):
        if name in done:
            return
        done.add(name)
        for line in re.findall(r"^Require Import (.*)\.$", texts[name], re.MULTILINE):
            for other in line.split():
                compile_after_its_own(other)
        if re.search(r"\b(Hypothesis|Variable|Axiom|Admitted|admit|Conjecture|Parameter)\b", texts[name]):
            raise ProofError(f"coq/{name}.v: something in it is not proved")
        (folder / f"{name}.v").write_text(texts[name])
        result = run(["coqc", "-q", f"{name}.v"], folder, 600)
        if result.returncode != 0:
            raise ProofError(f"coq/{name}.v: Coq refuses it\n{result.stderr[-2000:]}")

    for name in texts:
        compile_after_its_own(name)


def header(table, side):
    lines = [
        f"// The proved bounds of {side['what']}, from proofs/bounds.json: written by proofs/prove.py --write.",
        "#pragma once",
        "",
        f"namespace {side['namespace']} {{",
        "",
    ]
    definitions = [f"inline constexpr double {camel(name)} = {hexadecimal(table.values[name])};" for name in side["bounds"]]
    width = max(map(len, definitions))
    for name, definition in zip(side["bounds"], definitions):
        lines.append(f"{definition:{width}}  // {table.bounds[name]['value']}")
    return "\n".join([*lines, "", f"}}  // namespace {side['namespace']}", ""])


def check_headers(table, write):
    for side in table.constants:
        path = ROOT / side["header"]
        text = header(table, side)
        if write:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            raise ProofError(f"{side['header']} is not what bounds.json says: prove.py --write")


def constants_table(table):
    lines = ["| constant | of | its value | proved to suffice | share | bound, proof |", "|---|---|---|---|---|---|"]
    for row, value, needed in table.rows():
        proof = table.bounds[row["needs"]].get("proved_by", "given")
        cells = [f"`{row['constant']}`", Path(row["in"]).name, shown(value), shown(needed),
                 f"{float(needed / value) * 100:.0f} %", f"`{row['needs']}`, {proof}"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def check_page(table, scripts, write):
    """The table of README.md is the list's, and it says of every script what rests on it."""
    path = HERE / "README.md"
    text = path.read_text()
    begin, end = "<!-- constants:begin -->\n", "\n<!-- constants:end -->"
    unnamed = [name for name in scripts if f"`{name}`" not in text]
    if unnamed:
        raise ProofError(f"proofs/README.md does not say what rests on {', '.join(unnamed)}")
    before, _, rest = text.partition(begin)
    _, _, after = rest.partition(end.strip())
    wanted = before + begin + constants_table(table) + end + after
    if write:
        path.write_text(wanted)
    elif text != wanted:
        raise ProofError("proofs/README.md has another table of constants than bounds.json: prove.py --write")


def shown(x):
    for unit in ("u", "u^2", ""):
        scaled = float(x / UNITS[unit])
        if unit and 0.001 <= scaled < 10000:
            return f"{scaled:.6g} {unit}"
    if 1 < x < 1 + Fraction(1, 2**40):
        return f"1 + {shown(x - 1)}"
    power = math.log2(x.numerator) - math.log2(x.denominator)
    return f"2^{power:.2f}".removesuffix(".00")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coq", action="store_true")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--only")
    parser.add_argument("--folder", type=Path, default=HERE, help="another folder with bounds.json, scripts/ and coq/")
    options = parser.parse_args(arguments)
    needed = ["gappa", "coqc"] if options.coq else ["gappa"]
    for program in needed:
        if shutil.which(program) is None:
            print(f"{program} is not installed: nothing was checked", file=sys.stderr)
            return SKIPPED
    try:
        table = Table(options.folder)
        if options.table:
            print(constants_table(table))
            return 0
        scripts = {path.stem: Script(path) for path in sorted((options.folder / "scripts").glob("*.g"))}
        files = sorted((options.folder / "coq").glob("*.v"))
        statement = re.compile(r"^(?:Lemma|Theorem) (\w+)(.*?)^Proof", re.MULTILINE | re.DOTALL)
        lemmas = {path.name: dict(statement.findall(path.read_text())) for path in files}
        if options.only:
            if options.only not in scripts:
                raise ProofError(f"no script is named {options.only}")
            scripts = {options.only: scripts[options.only]}
            files = []
        else:
            check_order(scripts, table, lemmas)
            table.check_links()
            table.check_constants()
            check_headers(table, options.write)
            check_page(table, scripts, options.write)
        with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            folder = Path(name)
            check = coq if options.coq else gappa
            waiting = [pool.submit(check, script, table, folder) for script in scripts.values()]
            if options.coq and files:
                waiting.append(pool.submit(lemma_files, files, folder))
            failures = [str(error) for error in (future.exception() for future in waiting) if error]
        if failures:
            raise ProofError("\n".join(failures))
        hints = sum(script.hints for script in scripts.values())
        print(f"{len(scripts)} scripts with {hints} hints" +
              (f", {sum(map(len, lemmas.values()))} Coq lemmas" if options.coq else "") + ": proved")
        return 0
    except ProofError as error:
        print(f"not proved: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
