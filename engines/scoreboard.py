#!/usr/bin/env python3
"""Certifies every engine that is here on the committed golden files, and writes what was found to engines/scoreboard.jsonl, a line
an engine. From there come the table of docs/scoreboard.md and all tables: build/scoreboard.html, and a page of the site.

    python3 engines/scoreboard.py build/release/contact-oracle             every engine
    python3 engines/scoreboard.py build/release/contact-oracle fcl ode     these alone; their tables are printed, not written
    python3 engines/scoreboard.py build/release/contact-oracle --html      the page and the HTML from the data as they are

What stands outside of the page's markers, and engines/findings.json, are written by people."""
import json
import math
import re
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE, HTML, DATA = ROOT / "docs/scoreboard.md", ROOT / "build/scoreboard.html", ROOT / "engines/scoreboard.jsonl"
BEGIN, END = "<!-- engines:begin -->\n", "<!-- engines:end -->\n"
GRADES = ("not_finite", "beyond_bound", "bounded", "faithful", "correctly_rounded")  # the worst first
PAIRS = {"sphere_sphere": "spheres", "cube_cube": "boxes", "sphere_cube": "a sphere and a box",
         "sphere_capsule": "a sphere and a capsule", "capsule_capsule": "capsules", "sphere_triangle": "a sphere and a triangle",
         "ray_sphere": "a ray and a sphere", "sphere_plane": "a sphere and a plane", "capsule_plane": "a capsule and a plane",
         "ray_triangle": "a ray and a triangle", "triangle_line": "a triangle and a line",
         **{f"cast_{shape}": f"a ray cast at a {shape}" for shape in ("sphere", "cube", "capsule", "triangle", "plane")},
         "obb_obb": "rotated boxes", "sphere_obb": "a sphere and a rotated box", "capsule_cube": "a capsule and a box",
         "capsule_obb": "a capsule and a rotated box", "capsule_triangle": "a capsule and a triangle", "cube_obb": "a box and a rotated box",
         "cube_triangle": "a box and a triangle", "obb_triangle": "a rotated box and a triangle", "triangle_triangle": "triangles",
         "cube_plane": "a box and a plane", "obb_plane": "a rotated box and a plane", "triangle_plane": "a triangle and a plane",
         "sphere_hull": "a sphere and a hull", "capsule_hull": "a capsule and a hull", "cube_hull": "a box and a hull",
         "obb_hull": "a rotated box and a hull", "triangle_hull": "a triangle and a hull", "hull_hull": "hulls", "hull_plane": "a hull and a plane"}
FIELDS = ("normal", "point1", "point2", "point", "points", "value")
# What the others are seen beside: this project's own, and the formulas as everybody computes them.
REFERENCES = ("production", "plain-double", "plain-float")


def certified(tool, name):
    """The report of an engine, or the reason why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "report.json"
        slow = [] if name in REFERENCES else ["--start-limit", "60"]
        run = subprocess.run([tool, "certify", "golden", "--fresh", "0", "--engine", name, *slow, "--json", path],
                             cwd=ROOT, capture_output=True, text=True)
        if run.returncode not in (0, 1):
            said = (run.stderr or run.stdout).strip().splitlines()
            return said[-1] if said else f"exit status {run.returncode}"
        return json.loads(path.read_text())


def conversation(command, queries):
    """What an engine answers to queries of the protocol, one by one; it must survive them."""
    lines = ['{"op":"hello","protocol":1}']
    lines += [json.dumps({"op": "query", "seq": i + 1, **q}) for i, q in enumerate(queries)] + ['{"op":"stop"}']
    run = subprocess.run(command, input="\n".join(lines) + "\n", capture_output=True, text=True, check=True, timeout=300)
    return [json.loads(line) for line in run.stdout.splitlines()][1:]


def usual_question(pairs):
    """A question for the time that an engine takes: of spheres, boxes, or else the first pair that it serves."""
    pair = next((pair for pair in ("sphere_sphere", "cube_cube") if pair in pairs), pairs[0])
    if pair == "sphere_sphere":
        shapes = {"a": {"center": [0, 0, 0], "radius": 1.5}, "b": {"center": [1, 0.5, 1.75], "radius": 1.25}}
    elif pair == "cube_cube":
        shapes = {"a": {"min": [0, 0, 0], "max": [2, 2, 2]}, "b": {"min": [1, 1, 1], "max": [3, 4, 5]}}
    else:
        case = json.loads((ROOT / f"golden/{pair}/generic.jsonl").read_text(encoding="utf-8").splitlines()[1])
        shapes = {key: case[key] for key in ("a", "b")}
    return {"pair": pair, **shapes, "alarm": 0, "contact": 0}


def microseconds(command, query):
    """The processor's time for a question: reading and writing JSON, and the engine. The least of three. Time on the clock
    would say more of what else the machine does."""

    def seconds(count):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        conversation(command, [query] * count)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    count = 5000
    return max(0, min(seconds(count) for _ in range(3)) - min(seconds(1) for _ in range(3))) / count * 1e6


COUNTS = ("judged", "hits", "missed_hits", "false_hits", "incomplete", "not_finite", "unanswered")


def of_report(families):
    """Families of a report as one, since a binary64 engine is asked each in both scalars: COUNTS, and of each field the largest error and the
    number of each grade, the best first; no list ends in zeros."""
    def short(numbers):
        while numbers and not numbers[-1]:
            numbers.pop()
        return numbers

    counts, fields = Counter(), {}
    for f in families:
        counts.update({key: f[key] for key in COUNTS[:-1]})
        counts["unanswered"] += sum(n for how, n in f["answers"].items() if how != "answered")
        for name, field in f["fields"].items():
            if field["judged"]:
                worst, *grades = fields.get(name, [0.0] + [0] * len(GRADES))
                fields[name] = [max(worst, float(f"{float(field['worst_ulps']):.2g}")), *(n + field[grade] for n, grade in zip(grades, reversed(GRADES)))]
    return [short([counts[key] for key in COUNTS]), {name: short(field) for name, field in fields.items()}]


def added(families):
    """Families of the data as one, with names."""
    sums, fields = Counter(dict.fromkeys(COUNTS, 0)), {}
    for counts, of in families:
        sums.update(dict(zip(COUNTS, counts)))
        for name, (ulps, *grades) in of.items():
            to = fields.setdefault(name, Counter())
            worst = max(to["worst_ulps"], ulps)
            to.update({"judged": sum(grades), **dict(zip(reversed(GRADES), grades))})
            to["worst_ulps"] = worst
    return {**sums, "fields": fields}


NEEDS = ("length", "relative_length", "angle", "decision")


def fitness_of(families):
    """From which tolerance on an engine would pass questions whose numbers are everyday ones, of some families of a report."""
    fitness = [f["everyday"] for f in families]
    return {"answers": sum(f["answers"] for f in fitness), "never": sum(f["never"] for f in fitness),
            **{key: largest(f["needs"][key]["from"] for f in fitness) for key in NEEDS},
            **{f"beyond_{key}": largest(f["needs_beyond_last_bit"][key]["from"] for f in fitness) for key in NEEDS}}


def largest(numbers):
    """The largest of a report's numbers, which says "Infinity" as JSON cannot."""
    return max(numbers, key=float, default=0)


def up(x):
    """Two figures, rounded up, as the reports write them."""
    if x in (0, math.inf):
        return "." if x == 0 else "any share is too small"
    text = f"{x:.1e}"
    return text if float(text) >= x else f"{x + 10.0 ** (math.floor(math.log10(x)) - 1) / 2:.1e}"


def said(fit, key, without=""):
    """The same, but for what nobody would state: a length of some number's whole scale or more than any everyday number,
    an angle beyond a right one."""
    x, share = fit[without + key], fit[without + "relative_length"]
    if key in ("length", "relative_length") and (1 <= share < math.inf or (key == "length" and x > 1e4)):
        return "beyond"
    return "beyond" if key == "angle" and x > math.pi / 2 else up(x)


def number(n):
    return str(n) if n else "."


def ulps(x):
    return f"{x:.2g}" if x < 1e5 else f"{x:.0e}"


def level_of(field):
    """The worst grade, how many have it where it is a failure, and the largest error in ulps."""
    if field is None:
        return ""
    grade = next(g for g in GRADES if field[g])
    if grade == "not_finite":
        return f"not finite: {field[grade]}"
    if grade == "beyond_bound":
        return f"beyond: {field[grade]}, {ulps(field['worst_ulps'])}"
    return grade.replace("_", " ") + ("" if grade == "correctly_rounded" else f", {ulps(field['worst_ulps'])}")


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows]) + "\n\n"


def decisions(counts):
    """Missed and false hits of some questions, and those without an answer."""
    if not counts.get("judged"):
        return ""
    missed, false, lost = counts["missed_hits"], counts["false_hits"], counts["unanswered"]
    return (f"{missed} / {false}" if missed or false else ".") + (f", {lost} unanswered" if lost else "")


LEVELS = ("none", "conservative", "decisions", "bounded", "faithful", "correctly-rounded")  # the worst first


def of_engine(tool, listed, report):
    """What the data say of an engine that was certified."""
    families = [f for f in report["families"] if f["judged"]]
    command = listed.get("command") or [tool, "serve", "--engine", listed["name"]]
    try:
        time = f"{microseconds(command, usual_question([f['pair'] for f in families])):.1f}"
    except (subprocess.SubprocessError, OSError, ValueError):
        time = "-"
    skipped = Counter()
    for one in report["skipped"]:
        skipped[one["why"]] += one["cases"]
    pairs = {}
    for pair in dict.fromkeys(f["pair"] for f in families):
        of = [f for f in families if f["pair"] == pair]
        pairs[pair] = {"level": min((f["level"] for f in of), key=LEVELS.index), "fitness": fitness_of(of),
                       "families": {name: of_report([f for f in of if f["family"] == name]) for name in dict.fromkeys(f["family"] for f in of)}}
    return {"engine": listed["name"], "about": listed["about"], "version": report["engine"]["version"], "scalar": report["scalar"],
            "level": report["total"]["level"], **report["total"]["decided"], "microseconds": time, "claims": report["claims"],
            "conventions": report["conventions"], "pair_conventions": report.get("pair_conventions", {}), "verdict": report["verdict"],
            "diagnosis": report["diagnosis"], "not_asked": skipped, "pairs": pairs}


class Engine:
    """An engine of the data."""

    def __init__(self, line):
        self.name, self.scalar, self.conventions, self.line = line["engine"], line["scalar"], line["conventions"], line
        self.total = added([f for pair in line["pairs"].values() for f in pair["families"].values()])

    def fitness(self, *pairs):
        """That of some pairs, or of all."""
        of = [self.line["pairs"][pair]["fitness"] for pair in pairs or self.line["pairs"] if pair in self.line["pairs"]]
        return {key: sum(f[key] for f in of) if key in ("answers", "never") else max(float(f[key]) for f in of)
                for key in (of[0] if of else ())} or {"answers": 0}

    def families(self, pair):
        """The families of a pair, by name, in both scalars."""
        return {name: added([f]) for name, f in self.line["pairs"].get(pair, {"families": {}})["families"].items()}

    def reaches(self):
        """The pairs whose decisions are all right, those with numbers that are right too first."""
        of = {}
        for pair, one in self.line["pairs"].items():
            if LEVELS.index(one["level"]) >= LEVELS.index("decisions"):
                of.setdefault(one["level"], []).append(f"`{pair}`")
        if sum(map(len, of.values())) == len(self.line["pairs"]) > len(PAIRS) / 2:  # of few pairs the names say more
            return "all"
        return ", ".join(pair for pairs in of.values() for pair in pairs) or "."


def wrong_numbers(e):
    return sum(f["beyond_bound"] + f["not_finite"] for f in e.total["fields"].values())


def page_table(data):
    """The table of the page."""
    engines = [Engine(line) for line in data if "engine" in line]
    rows = [[f"`{e.name}`", e.line["version"], e.scalar.removeprefix("binary"), e.line["level"], str(len(e.line["pairs"])), e.reaches(),
             str(e.line["hits"] + e.line["misses"]), number(e.total["missed_hits"]), number(e.total["false_hits"]),
             str(sum(f["judged"] for f in e.total["fields"].values())), number(wrong_numbers(e)), number(e.total["unanswered"] + e.total["incomplete"])]
            for e in engines]
    return table(["engine", "version", "bits", "level", "pairs", "all decisions right in", "decisions", "missed hits", "false hits", "numbers",
                  "wrong numbers", "no answer"], rows)


def main_table(engines):
    rows = []
    for e in engines:
        fit = e.fitness()
        rows.append([f"`{e.name}`", e.line["version"], e.scalar, e.line["level"], str(e.line["hits"]), str(e.line["misses"]),
                     number(e.total["missed_hits"]), number(e.total["false_hits"]), number(e.total["incomplete"]),
                     str(sum(f["judged"] for f in e.total["fields"].values())), number(wrong_numbers(e)), number(e.total["not_finite"]),
                     number(e.total["unanswered"]), said(fit, "length"), said(fit, "angle"), up(fit["decision"]), e.line["microseconds"],
                     f"`./run certify golden --engine {e.name}`"])
    return table(["engine", "version", "arithmetic", "level", "hits", "misses", "missed hits", "false hits", "missing fields",
                  "numbers", "wrong numbers", "not finite", "no answer", "lengths fit from",
                  "normals fit from, radians", "decisions fit from", "µs a question", "again"], rows)


def claims_numbers(e, pair):
    return any(field in FIELDS for field in e.line["claims"]) and pair != "cube_cube"


def fitness_tables(engines):
    """A table a measure, engines by pairs: what it needs, and in brackets what it needs but for answers that are no worse
    than what the inputs' last bit does."""
    text = ""
    for title, key, measure in (("Lengths: a value or a coordinate is off by at most", "length", "numbers"),
                                ("Lengths, as a share of their scale", "relative_length", "numbers"),
                                ("Normals: off by at most so many radians", "angle", "numbers"),
                                ("Decisions: wrong no farther than so much from where the answer changes", "decision", "")):
        rows, pairs = [], [p for p in PAIRS if any(e.fitness(p)["answers"] for e in engines)]
        for e in engines:
            cells = []
            for pair in pairs:
                f = e.fitness(pair)
                if not f["answers"] or (measure and not claims_numbers(e, pair)):
                    cells.append("")
                    continue
                beyond = "" if f[key] == f[f"beyond_{key}"] else f" ({said(f, key, 'beyond_')})"
                cells.append(said(f, key) + beyond + (f", but for {f['never']}" if f["never"] else ""))
            if any(cells):
                rows.append([f"`{e.name}`", *cells])
        text += f"{title}:\n\n" + table(["engine", *(PAIRS[p] for p in pairs)], rows)
    return text


def edge_table(engines):
    rows = []
    for e in engines:
        families = e.families("sphere_sphere")
        if "touching" not in families:
            continue
        c = e.conventions
        touching = {c["touching_overlap"], c["touching_contact"]}
        says = touching.pop() if len(touching) == 1 else f"overlap {c['touching_overlap']}, contact {c['touching_contact']}"

        def cell(family):
            counts = families[family]
            return f"{decisions(counts)} of {counts['judged']}"

        fields = families["coincident"]["fields"]
        rows.append([f"`{e.name}`", says, cell("touching"), c["coincident"].replace("_", " "), cell("coincident"),
                     level_of(fields.get("normal")), level_of(fields.get("value")), c["margin"], cell("alarm_edge")])
    return table(["engine", "touching", "wrong", "coincident centres", "wrong", "normal there", "value there", "margin",
                  "wrong at it"], rows)


def family_tables(engines):
    text = ""
    for pair, title in PAIRS.items():
        for scalar in ("binary64", "binary32"):
            of = {e.name: e.families(pair) for e in engines if e.scalar == scalar}
            of = {name: families for name, families in of.items() if families}
            names = list(dict.fromkeys(family for families in of.values() for family in families))
            if not of:
                continue
            text += f"{title[0].upper() + title[1:]}, engines in {scalar}:\n\n"
            text += table(["engine", *names], [[f"`{name}`"] + [decisions(families.get(family, {})) for family in names]
                                               for name, families in of.items()])
    return text


def detail(e):
    text = f"<details markdown=\"1\">\n<summary><code>{e.name}</code>: {e.line['about']}</summary>\n\n"

    def declared(conventions):
        return ", ".join(f"{key} {json.dumps(value) if isinstance(value, (dict, bool)) else value}" for key, value in conventions)

    text += f"Declares {declared(e.conventions.items())}"
    for pair, own in e.line["pair_conventions"].items():
        text += f"; of {PAIRS[pair]} {declared((key, value) for key, value in own.items() if e.conventions.get(key) != value)}"
    text += f"; claims {', '.join(e.line['claims'])}.\n\n{e.line['verdict']}\n\n"
    text += "".join(f"Not asked, {n} questions: {why}.\n\n" for why, n in e.line["not_asked"].items())
    if e.line["diagnosis"]:
        text += "What the report says of the wrong answers:\n\n" + "".join(f"- {line}\n" for line in e.line["diagnosis"]) + "\n"
    fields = [f for f in FIELDS if f in e.total["fields"]]
    rows = []
    for pair, title in PAIRS.items():
        for name, f in e.families(pair).items():
            rows.append([("" if pair == "sphere_sphere" else f"{title}: ") + name, str(f["judged"]), str(f["hits"]),
                         number(f["missed_hits"]), number(f["false_hits"]), number(f["incomplete"]), number(f["not_finite"]),
                         number(f["unanswered"]),
                         *(level_of(f["fields"].get(field)) for field in fields)])
    text += table(["family", "judged", "hits", "missed", "false", "missing fields", "not finite", "no answer", *fields], rows)
    return text + "</details>\n\n"


def shown(answer):
    """An answer of the protocol, short."""
    for key in ("unsupported", "rejected", "error"):
        if key in answer:
            return f"no answer: {answer[key]}"
    words = []
    if "overlap" in answer:
        words.append("overlap" if answer["overlap"] else "no overlap")
    if "contact" in answer:
        contact = answer["contact"]
        numbers = [] if contact is None else [f"{key} {value if isinstance(value, str) else json.dumps(value)}"
                                              for key, value in contact.items()]
        words.append("no contact" if contact is None else "contact with " + ", ".join(numbers) if numbers else "contact")
    return "; ".join(words)


def questions():
    """Every committed question by its id: its file and itself."""
    of = {}
    for path in sorted((ROOT / "golden").glob("*_*/*.jsonl")):
        with path.open() as lines:
            header = json.loads(next(lines))
            for line in lines:
                case = json.loads(line)
                of.setdefault((case["id"], header["scalar"]), (path.relative_to(ROOT), header, case))
    return of


def asked_in(finding, committed):
    """Where a finding's question comes from, in words, and itself: one made small by hand, or a committed one."""
    if "query" in finding:
        query = {"alarm": 0, "contact": 0, **finding["query"]}
        return f"on {PAIRS[query['pair']]}", query
    path, header, case = committed[finding["id"], finding["scalar"]]
    return (f"on `{case['id']}` in [{path.relative_to('golden')}](../{path})",
            {"pair": header["pair"], **{key: case[key] for key in ("a", "b", "alarm", "contact")}})


def of_finding(tool, listed, finding, committed):
    """What the data say of a finding: the question in words, and what the engine answers."""
    where, query = asked_in(finding, committed)
    try:
        answer, = conversation(listed["command"], [query])
    except (subprocess.SubprocessError, OSError, ValueError) as problem:
        answer = {"error": str(problem)}
    made = subprocess.run([tool, "explain"], input=json.dumps({"scalar": finding["scalar"], **query}) + "\n",
                          capture_output=True, text=True, check=True)
    lines = [line.strip() for line in made.stdout.splitlines() if line.strip()]
    return {"finding": finding["engine"], "where": where, "about": finding["about"], "explained": lines[1:], "answer": shown(answer)}


def tables(data):
    """All tables of the data, as Markdown."""
    engines = [Engine(line) for line in data if "engine" in line]
    text = "## All engines\n\n" + main_table(engines)
    text += ("## What each is good for\n\nFrom which [tolerance](specification.md#tolerances) on an engine would pass, on questions whose "
             "numbers are 0 or from 1e-4 to 1e4. In brackets: from which it would, if answers are left out that are no worse than "
             "what the [inputs' last bit](specification.md#conditioning) does. `.` is any tolerance, *but for 3* three answers that "
             "none allows, *beyond* more than anybody would state, an empty cell was not asked or claims no number.\n\n") + fitness_tables(engines)
    text += ("## At the edges\n\nWhat each declares about spheres that touch, share their centre, or are as far apart as the alarm "
             "distance, and how many of the questions\nthere it decides wrongly: missed / false hits, `.` for none.\n\n") + edge_table(engines)
    text += ("## Decisions by family\n\nMissed / false hits; `.` is all right, an empty cell was not asked. A binary64 engine is asked "
             "each family in both scalars.\n\n") + family_tables(engines)
    text += ("## Each engine by family\n\nOf each field the worst grade, how many have it where it is a failure, and the largest error "
             "in ulps of the field's scale.\n\n")
    text += "".join(map(detail, engines))
    text += ("## Findings looked at by hand\n\nSome of each engine: what `./run explain` says of the question, what the engine says, and "
             "why, by its source or documentation.\n\n")
    text += "".join(f"**`{f['finding']}`** {f['where']}.\n{f['about']}\n\n```text\n" + "\n".join(f["explained"]) + f"\n{f['finding']} says: {f['answer']}\n```\n\n"
                    for f in data if "finding" in f)
    return text + "## Not measured\n\n" + "".join(f"- {line['absent']}\n" for line in data if "absent" in line)


def read():
    return [json.loads(line) for line in DATA.read_text(encoding="utf-8").splitlines()]


def write(data):
    """The page's table, and all as one self-contained HTML file."""
    page = PAGE.read_text(encoding="utf-8")
    head, rest = page.split(BEGIN)
    PAGE.write_text(head + BEGIN + page_table(data) + END + rest.split(END)[1], encoding="utf-8")
    html(head + tables(data))


def html(text):
    import markdown  # the site needs none of it
    body = markdown.markdown(text, extensions=["tables", "fenced_code", "toc", "md_in_html"])
    # Figures that are wrong stand out, and stay figures for those who do not see the colour.
    body = re.sub(r"<td>(\d+ / \d+.*?|(?:beyond|not finite): .*?)</td>", r'<td class="bad">\1</td>', body)
    body = re.sub(r"<td>(\.|correctly rounded)</td>", r'<td class="ok">\1</td>', body)
    body = re.sub(r'href="(?!https?:|#)', 'href="../docs/', body)
    body = body.replace("<table>", '<div class="wide" tabindex="0"><table>').replace("</table>", "</table></div>")
    style = """
:root{color-scheme:light dark;--ok:#0b6e4f;--bad:#b3261e;--line:#8885;--soft:#8882;--link:#0b57d0}
@media (prefers-color-scheme:dark){:root{--ok:#5fd3a6;--bad:#ff8f85;--link:#a8c7fa}}
body{font:15px/1.5 system-ui,sans-serif;max-width:80rem;margin:1.5rem auto;padding:0 1rem}
p,li{max-width:52rem;overflow-wrap:anywhere}h1{font-size:1.6rem}h2{font-size:1.25rem;margin-top:2.2rem}h3{font-size:1.05rem}
a{color:var(--link)}.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.87rem;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .6rem;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}
th,td code{white-space:nowrap}td{min-width:2.5rem}tbody tr:hover{background:var(--soft)}
@media (min-width:50rem){td:first-child,th:first-child{position:sticky;left:0;background:Canvas}}
.ok{color:var(--ok)}.bad{color:var(--bad);font-weight:600}
pre{overflow-x:auto;background:var(--soft);padding:.6rem .8rem;border-radius:.3rem;font-size:.8rem}
code{font-size:.87em}summary{cursor:pointer;margin:.4rem 0}"""
    HTML.parent.mkdir(exist_ok=True)
    HTML.write_text(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
        f"<title>contact-oracle: scoreboard</title><style>{style}</style></head>\n<body>\n{body}\n</body></html>\n")


def main(tool, *wanted):
    tool = str(Path(tool).resolve())
    if wanted == ("--html",):
        return write(read())
    listed = [json.loads(line) for line in subprocess.run([tool, "engines", "--json"], capture_output=True, text=True,
                                                          check=True).stdout.splitlines()]
    names = {e["name"] for e in listed}
    if unknown := [name for name in wanted if name not in names]:
        print(f"no engine {', '.join(unknown)}; contact-oracle engines lists them", file=sys.stderr)
        sys.exit(2)
    listed = [e for e in listed if (e["name"] in wanted if wanted else "command" in e or e["name"] in REFERENCES)]
    data, absent, asked = [], [], {}
    for engine in listed:
        name = engine["name"]
        if engine.get("command", "built in") is None:
            absent.append({"absent": f"`{name}` is not installed here; `./run engines` installs what it needs."})
            continue
        print(name, file=sys.stderr, flush=True)
        report = certified(tool, name)
        if isinstance(report, str):
            absent.append({"absent": f"`{name}` could not be certified: {report}"})
        else:
            data.append(of_engine(tool, engine, report))
            asked[name] = {**engine, "command": engine.get("command") or [tool, "serve", "--engine", name]}
    committed = questions()
    data += [of_finding(tool, asked[f["engine"]], f, committed)
             for f in json.loads((ROOT / "engines/findings.json").read_text()) if f["engine"] in asked] + absent
    if wanted:
        return print(tables(data))
    DATA.write_text("".join(json.dumps(line, ensure_ascii=False, separators=(",", ":")) + "\n" for line in data),
                    encoding="utf-8")
    write(data)


if __name__ == "__main__":
    main(*sys.argv[1:])
