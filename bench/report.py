"""Writes what ./run bench measured to docs/performance.md, between its markers, to bench/measured.md and to docs/performance.svg.

usage: report.py MEASURED.json      what Google Benchmark wrote, with repetitions: all of it, or what --benchmark_filter='obb_|hull_' leaves, whose
                                    rows are then written alone
"""
import json
import math
import pathlib
import re
import sys

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
PLACES = ("L2", "L3", "memory")
# The rows of the tables: name in the benchmark, and whether it is ours, plain, or a peer.
SUBJECTS = {
    "plain double": "plain", "plain double, vectors": "plain", "ours, scalar": "ours", "ours, batch": "ours",
    "FCL": "peer", "Bullet, algorithm": "peer", "Bullet, contactPairTest": "peer", "ODE": "peer",
    "libccd, MPR": "peer", "libccd, GJK": "peer", "CGAL Epick": "peer", "CGAL Epeck": "peer", "GMP rationals": "peer",
}
FAMILIES = ("generic", "near_touching", "touching", "far_from_origin", "extreme_scale", "coincident")
# Bytes that a pair's question and answer take; half of the pairs are hits, of a sphere and a box two in five, of capsules nearly half.
BYTES = {"test": 65, "compute": 145, "hits": 64 + 85 / 2, "cubes": 97, "sphere_cube_test": 81, "sphere_cube_compute": 161,
         "sphere_cube_hits": 80 + 85 * 5 / 12, "sphere_capsule_test": 89, "sphere_capsule_compute": 169,
         "sphere_capsule_hits": 88 + 85 * 0.48, "capsules_test": 113, "capsules_compute": 193, "capsules_hits": 112 + 85 * 0.46}
OPERATIONS = {"test": "decide", "compute": "contacts", "hits": "hits alone", "cubes": "boxes",
              "sphere_cube_test": "sphere and box: decide", "sphere_cube_compute": "contacts of these",
              "sphere_cube_hits": "their hits alone", "sphere_capsule_test": "sphere and capsule: decide",
              "sphere_capsule_compute": "sphere and capsule: contacts", "sphere_capsule_hits": "sphere and capsule: hits alone",
              "capsules_test": "capsules: decide", "capsules_compute": "capsules: contacts",
              "capsules_hits": "capsules: hits alone"}
SETS = {"AVX3": "AVX-512", "AVX2": "AVX2", "SSE4": "SSE4", "NEON": "NEON"}


class Measured:
    def __init__(self, path):
        document = json.loads(pathlib.Path(path).read_text())
        self.context = document["context"]
        self.entries = {}
        for entry in document["benchmarks"]:
            if entry.get("error_occurred"):
                sys.exit(f"{entry['name']}: {entry['error_message']}")
            # The median of the repetitions, or the only one.
            if entry.get("aggregate_name") == "median" or entry["repetitions"] == 1:
                self.entries[entry["run_name"]] = entry

    def ns(self, name):
        """Nanoseconds a pair, or None where nothing was measured."""
        entry = self.entries.get(name)
        return entry and 1e9 * entry["time/pair"]

    def ratio(self, name, to):
        a, b = self.ns(name), self.ns(to)
        return a and b and a / b


def number(x, digits=3):
    """Three significant digits without an exponent; a dash for what was not measured."""
    if x is None:
        return "–"
    text = f"{x:.{digits}g}"
    return f"{float(text):.0f}" if "e" in text or x >= 100 else f"{x:.{max(0, digits - len(str(int(x))))}f}"


def table(head, rows):
    lines = [head, ["---"] + ["--:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def wrong(m, subject):
    """Of the committed questions: asked, wrong decisions by family, fields claimed, fields wrong."""
    entries = [m.entries.get(f"Wrong/{subject}/{family}/iterations:1/repeats:1") for family in FAMILIES]
    if None in entries:
        return None
    return {"asked": int(sum(e["asked"] for e in entries)), "decisions": [int(e["wrong decisions"]) for e in entries],
            "fields": int(sum(e["fields"] for e in entries)), "bad": int(sum(e["wrong fields"] for e in entries))}


def peers_table(m):
    rows = []
    for subject in SUBJECTS:
        ns = {op: {place: m.ns(f"Peer/{subject}/{op}/{place}") for place in PLACES} for op in ("test", "compute")}
        found = wrong(m, subject)
        faster = [m.ratio(f"Peer/{subject}/compute/{place}", f"Peer/ours, batch/compute/{place}") for place in PLACES]
        cells = [number(ns["test"]["L2"]), *(number(ns["compute"][place]) for place in PLACES),
                 *(number(x) for x in faster)]
        if found:
            cells += [f"{sum(found['decisions'])} of {found['asked']}",
                      f"{found['bad']} of {found['fields']}" if found["fields"] else "–"]
        else:
            cells += ["as plain double"] * 2
        name = f"**{subject}**" if SUBJECTS[subject] == "ours" else subject
        rows.append([name, *cells])
    head = ["", "decide, L2", "contact, L2", "L3", "memory", "to ours, batch: L2", "L3", "memory", "wrong decisions",
            "wrong numbers"]
    return table(head, rows)


def boxes_table(m):
    rows = []
    for subject in SUBJECTS:
        name = f"Peer/{subject}/boxes/"
        if m.ns(name + "L2"):
            rows.append([subject, *(number(m.ns(name + place)) for place in PLACES),
                         *(number(m.ratio(name + place, f"Peer/ours, batch/boxes/{place}")) for place in PLACES)])
    return table(["", "L2", "L3", "memory", "to ours, batch: L2", "L3", "memory"], rows)


def sphere_cube_table(m):
    rows = []
    for subject in SUBJECTS:
        test, compute = (f"Peer/{subject}/sphere_cube_{op}/" for op in ("test", "compute"))
        if not m.ns(test + "L2"):
            continue
        plain = "plain double, vectors" if subject in ("plain double, vectors", "ours, batch") else "plain double"
        rows.append([subject, number(m.ns(test + "L2")), *(number(m.ns(compute + place)) for place in PLACES),
                     *(number(m.ratio(compute + place, f"Peer/{to}/sphere_cube_compute/{place}"))
                       for to in (plain, "ours, batch") for place in ("L2", "memory"))])
    return table(["", "decide, L2", "contact, L2", "L3", "memory", "contact to plain double: L2", "memory", "to ours, batch: L2",
                  "memory"], rows)


PAIRS = {"sphere_sphere": "", "sphere_cube": "sphere_cube_", **{pair: pair + "_" for pair in (
    "sphere_capsule", "capsule_capsule", "sphere_triangle", "ray_sphere", "sphere_plane", "capsule_plane", "ray_triangle", "triangle_line")}}
# Of any two convex shapes; plain double has no row of these.
SPECIAL = ("generic", "deep", "near_touching", "touching", "parallel", "flat", "nested", "ties")
CONVEXES = ("obb_obb", "hull_hull", "sphere_hull", "capsule_hull", "hull_plane")



def pairs_table(m):
    rows = []
    for pair, prefix in PAIRS.items():
        cells = []
        for op in ("test", "compute"):
            times = {s: m.ns(f"Peer/{s}/{prefix}{op}/L2") for s in SUBJECTS}
            plain, ours = times["plain double"], times["ours, scalar"]
            peers = [(ns, s) for s, ns in times.items() if ns and SUBJECTS[s] == "peer"]
            cells += [f"{number(plain)} → {number(ours)}", number(ours / plain)]
            cells.append("–" if not peers else f"{number(min(peers)[0] / ours)} ({min(peers)[1]})")
        rows.append([f"`{pair}`", *cells])
    head = ["one pair after the other, L2", "decide: plain → ours, ns", "ratio", "fastest peer to ours", "contact: plain → ours, ns",
            "ratio", "fastest peer to ours"]
    return table(head, rows)


def many_table(m):
    rows = []
    for pair, prefix in PAIRS.items():
        cells = []
        for op in ("test", "compute"):
            plain, ours, one = (m.ns(f"Peer/{s}/{prefix}{op}/L2") for s in ("plain double, vectors", "ours, batch", "ours, scalar"))
            cells += [f"{number(plain)} → {number(ours)}", number(ours / plain), number(one / ours)]
        rows.append([f"`{pair}`", *cells])
    return table(["many pairs at once, L2", "decide: plain → ours, ns", "ratio", "one pair to this", "contact: plain → ours, ns",
                  "ratio", "one pair to this"], rows)


def scenes_table(m):
    scenes = list(dict.fromkeys(name.split("/")[2] for name in m.entries if name.startswith("Scene/")))
    subjects = [s for s in SUBJECTS if any(m.ns(f"Scene/{s}/{scene}/L2") for scene in scenes)]
    rows = [[scene, *(number(m.ns(f"Scene/{s}/{scene}/L2")) for s in subjects)] for scene in scenes]
    return table(["contact, ns", *subjects], rows)


def convexes_table(m):
    peers = [s for s in SUBJECTS if SUBJECTS[s] == "peer" and any(m.ns(f"Peer/{s}/{pair}_test/L2") for pair in CONVEXES)]
    rows = []
    for pair in CONVEXES:
        for op, what in (("test", "decide"), ("compute", "contact")):
            ours = f"Peer/ours, scalar/{pair}_{op}/L2"
            rows.append([f"`{pair}`, {what}", number(m.ns(ours)), *(number(m.ratio(f"Peer/{s}/{pair}_{op}/L2", ours)) for s in peers)])
    return table(["one pair after the other, L2", "ours, ns", *(f"{s} to ours" for s in peers)], rows)


def special_table(m):
    rows = [[family.replace("_", " "), *(number(m.ns(f"Special/{pair}/{family}/{op}/L2")) for pair in ("obb_obb", "hull_hull") for op in ("test", "compute"))]
            for family in SPECIAL]
    return table(["ours, ns", "`obb_obb`, decide", "contact", "`hull_hull`, decide", "contact"], rows)


def wrong_table(m):
    rows = []
    for subject in SUBJECTS:
        found = wrong(m, subject)
        if found:
            rows.append([subject, *(count or "." for count in found["decisions"])])
    return table(["", *(family.replace("_", " ") for family in FAMILIES)], rows)


def batch_table(m):
    rows = []
    for op, what in OPERATIONS.items():
        for key, label in SETS.items():
            ours, plain = f"Batch/{op}/ours/{key}/", f"Batch/{op}/plain/{key}/"
            if not m.ns(ours + "L2"):
                continue
            streaming = m.ns(ours + "memory")
            rows.append([f"{what}, {label}",
                         *(f"{number(m.ns(plain + place))} → {number(m.ns(ours + place))}" for place in PLACES),
                         *(number(m.ratio(ours + place, plain + place)) for place in PLACES),
                         number(BYTES[op] / streaming),
                         f"{100 * m.ratio(f'Limit/{op}/memory', ours + 'memory'):.0f} %"])
    head = ["", "plain → ours, ns: L2", "L3", "memory", "ratio L2", "L3", "memory", "GB/s from memory",
            "of the bandwidth"]
    return table(head, rows)


def families_table(m):
    rows = []
    generic = "Family/compute/generic"
    for name, entry in sorted(m.entries.items(), key=lambda item: item[1].get("time/pair", 0)):
        if name.startswith("Family/compute/"):
            share = 100 * entry["exact"]
            rows.append([name.rsplit("/", 1)[1].replace("_", " "), f"{100 * entry['hits']:.0f} %", number(m.ns(name)),
                         number(m.ratio(name, generic)), f"{share:.2g} %" if share else "none"])
    return table(["", "hits", "ns", "to generic", "left to the scalar function"], rows)


MODELS = ("ours", "ours, all threads", "FCL", "FCL, again", "Bullet", "Bullet, again")


def models_entry(m, subject, scene, n):
    """A row of bench/models.cpp; its name ends with how it was measured."""
    name = f"Models/{subject}/{scene}/{n}/"
    return next((entry for key, entry in m.entries.items() if key.startswith(name)), None)


def models_table(m):
    rows = []
    for scene in ("uniform", "clustered", "one huge"):
        for n in (10000, 100000):
            entries = [models_entry(m, subject, scene, n) for subject in MODELS]
            times = [entry and 1e9 * entry["time/element"] for entry in entries]
            found = [f"{entry['contacts']:.0f}" if entry else "–" for entry in (entries[0], entries[3], entries[5])]
            rows.append([f"{scene}, {n}", *found, *(number(t) for t in times),
                         *(number(t and times[0] and t / times[0]) for t in times[2:])])
    head = ["scene, spheres", "contacts: ours", "FCL", "Bullet", *(f"ns an element: {MODELS[0]}", *MODELS[1:]),
            "to ours: FCL", *MODELS[3:]]
    return table(head, rows)


# With the contacts kept, and with them handed over as they come.
DETECTED = ("detect_between_two_models", "detect_streamed_between_two_models")


def detect_entry(m, name, n):
    return next(e for key, e in m.entries.items() if re.match(rf"{name}/{n}(/|$)", key))


def start(m):
    return next(e for key, e in m.entries.items() if key.startswith("Startup/explain/"))


def detect_table(m):
    rows = []
    for n in (1000, 10000, 100000, 1000000):
        cells = []
        for name in DETECTED:
            seconds = detect_entry(m, name, n)["time/element"]
            cells += [1e9 * seconds, seconds / detect_entry(m, name, 1000)["time/element"]]
        rows.append([n, *(number(cell) for cell in cells)])
    return table(["elements of each model", "`detect`, ns an element", "to 1000", "`detect_streamed`, ns an element", "to 1000"], rows)


def cpu():
    info = pathlib.Path("/proc/cpuinfo")
    found = info.exists() and re.search(r"^model name\s*:\s*(.+)$", info.read_text(), re.M)
    return found[1] if found else "an unknown processor"


def machine(m):
    caches = {c["level"]: c["size"] for c in m.context["caches"] if c["type"] in ("Data", "Unified")}
    sizes = ", ".join(f"L{level} {size // 2**10} KiB" if size < 2**20 else f"L{level} {size // 2**20} MiB"
                      for level, size in sorted(caches.items())) or "caches that it does not tell"
    sets = [label for key, label in SETS.items() if m.ns(f"Batch/test/ours/{key}/L2")]
    return (f"Measured on: {cpu()}, {m.context['num_cpus']} processors, {sizes}, {sets[0]}; "
            f"compiled by {m.context['compiler']}, the `bench` preset.\n"
            f"Load average at the beginning: {m.context['load_avg'][0]:.1f}. Other programs do not count in processor "
            "time. They affect times by the wall clock, caches and memory.")


def rate(m, name):
    """Questions a second of processor time, or None. A benchmark whose name ends so counts by the wall clock."""
    entry = m.entries.get(name)
    by_wall = name.endswith("/real_time")
    return entry and entry["items_per_second"] * (entry["real_time"] / entry["cpu_time"] if by_wall else 1)


def speed_table(m):
    """What this project wants of its speed, and what it has."""
    best = next(key for key in SETS if m.ns(f"Batch/test/ours/{key}/L2"))
    rows = []

    def thousands(what, name, goal):
        found = rate(m, name)
        rows.append([what, "–" if found is None else f"{round(found, -3):,.0f}", goal])

    def ratios(what, pairs, goal):
        found = [number(m.ratio(a, b)) for a, b in pairs]
        if set(found) != {"–"}:
            rows.append([what, ", ".join(found), goal])

    in_places = lambda op, key: [(f"Batch/{op}/ours/{key}/{p}", f"Batch/{op}/plain/{key}/{p}") for p in PLACES]
    thousands("`certify` from JSON lines, questions a second of processor time", "certified_from/json_lines/1/process_time/real_time", "1,000,000")
    thousands("`certify` from HDF5", "certified_from/columns/1/process_time/real_time", "3,000,000")
    thousands("oracle in memory, generic", "judged_in_stages/generic", "5,000,000")
    thousands("oracle in memory, touching", "judged_in_stages/touching", "1,000,000")
    thousands("`certify --generate 150000`, all families and pairs",
              "certified_as_generated_of_all/iterations:1/repeats:1/process_time", "150,000")
    for key, goal in (("AVX3", "1.2, 1.0, 1.0"), ("AVX2", "2.0, 1.3, 1.1"), ("SSE4", "4 in L2")):
        ratios(f"contacts in vectors to plain double with the same, {SETS[key]}: L2, L3, memory", in_places("compute", key), goal)
    ratios("decisions in vectors to plain double, AVX2: L2", in_places("test", "AVX2")[:1], "1.2")
    one = lambda op: (f"Peer/ours, scalar/{op}/L2", f"Peer/plain double/{op}/L2")
    ratios("one pair to plain double, L2: decision, boxes, contact", [one("test"), one("boxes"), one("compute")], "2, 1.5, 3")
    peers = [s for s in SUBJECTS if SUBJECTS[s] == "peer" and m.ns(f"Peer/{s}/compute/L2")]
    fastest = min(peers, key=lambda s: m.ns(f"Peer/{s}/compute/L2"))
    ratios(f"contact to the fastest peer's ({fastest}), L2: batch, one pair",
           [(f"Peer/ours, {way}/compute/L2", f"Peer/{fastest}/compute/L2") for way in ("batch", "scalar")], "0.2, 0.6")
    ratios(f"batch, {SETS[best]}: nearly coincident, extreme scale to generic",
           [(f"Family/compute/{family}", "Family/compute/generic") for family in ("near_coincident", "extreme_scale")], "3, 20")
    grown = [detect_entry(m, name, 1000000)["time/element"] / detect_entry(m, name, 1000)["time/element"] for name in DETECTED]
    rows.append(["`detect`: time an element, of 1e6 to 1e3 elements: all contacts kept, streamed", ", ".join(map(number, grown)), "1.5"])
    two = [m.entries[f"Threads/compute/real_time/threads:{n}"] for n in (1, 2)]
    rows.append(["contacts in L2, two threads to one, by the wall clock", number(two[1]["items_per_second"] / two[0]["items_per_second"]), "1.9"])
    rows.append(["`explain`, one question, from the shell and back, ms by the wall clock", number(1e3 * start(m)["wall"]), "15"])
    return table(["", "measured", "goal"], rows)


def facts(m):
    one, two = (m.entries[f"Threads/compute/real_time/threads:{n}"] for n in (1, 2))
    triad = 24 / m.ns("Limit/triad/memory")
    moved = BYTES["compute"] / m.ns("Limit/compute/memory")
    return table(["", ""], [
        ["STREAM triad from memory, one thread, 24 bytes per number", f"{number(triad)} GB/s"],
        ["moving the bytes of contacts without computing anything, 145 bytes per pair", f"{number(moved)} GB/s"],
        ["contacts in L2, speed of two threads relative to one, by processor time",
         f"{number(2 * one['cpu_time'] / two['cpu_time'])} ×"],
        ["the same by the wall clock", f"{number(two['items_per_second'] / one['items_per_second'])} ×"],
        ["`contact-oracle explain` with one question, started from a shell: processor time",
         f"{number(start(m)['real_time'])} ms"],
        ["the same by the wall clock", f"{number(1e3 * start(m)['wall'])} ms"],
    ])


def summary(m):
    peers = [s for s in SUBJECTS if SUBJECTS[s] == "peer" and m.ns(f"Peer/{s}/compute/L2")]
    said = []
    for place, where in (("L2", "in the second level cache"), ("memory", "from memory")):
        for ours in ("ours, batch", "ours, scalar"):
            name = f"Peer/{ours}/compute/{place}"
            ratios = ((m.ratio(f"Peer/{s}/compute/{place}", name), s) for s in peers)
            best = min((ratio, s) for ratio, s in ratios if ratio)
            said.append(f"| {ours}, {where} | {number(best[0])} × ({best[1]}) |")
    return "\n".join(["| contacts with | time of the fastest peer, relative to this |", "|---|---|", *said])


COLOURS = {"ours": "#1f6fb2", "plain": "#8a8f98", "peer": "#d98b3a"}
PALE = {"ours": "#a9cbe8", "plain": "#d3d6da", "peer": "#f2d3b0"}


def plot(m):
    """Contacts by subject on a logarithmic axis, in L2 and from memory; and ours to plain with the same vectors."""
    left, top, width, row = 190, 70, 560, 34
    low, high = 1, 10000
    subjects = sorted((s for s in SUBJECTS if m.ns(f"Peer/{s}/compute/L2")), key=lambda s: m.ns(f"Peer/{s}/compute/L2"))
    at = lambda ns: left + width * math.log10(ns / low) / math.log10(high / low)
    out, labels = [], []  # labels lie on top
    text = lambda x, y, what, extra="": labels.append(f'<text x="{x:.1f}" y="{y:.1f}" {extra}>{what}</text>')
    line = lambda x1, y1, x2, y2, extra: out.append(
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" {extra}/>')
    bar = lambda x, y, w, h, colour: out.append(
        f'<rect x="{x:.1f}" y="{y:.1f}" width="{w:.1f}" height="{h:.1f}" fill="{colour}"/>')

    text(left, 28, "A contact of two spheres, nanoseconds a pair", 'class="title"')
    text(left, 48, "dark: data in L2; pale: from memory; one thread", 'class="note"')
    bottom = top + row * len(subjects)
    for decade in (1, 10, 100, 1000, 10000):
        line(at(decade), top - 6, at(decade), bottom, 'stroke="#e3e5e8"')
        text(at(decade), bottom + 16, decade, 'text-anchor="middle" class="note"')
    for i, subject in enumerate(subjects):
        y, kind = top + row * i, SUBJECTS[subject]
        text(left - 8, y + 18, subject, 'text-anchor="end"' + (' font-weight="bold"' if kind == "ours" else ""))
        for ns, colour, dy in ((m.ns(f"Peer/{subject}/compute/L2"), COLOURS[kind], 2),
                               (m.ns(f"Peer/{subject}/compute/memory"), PALE[kind], 15)):
            if ns:
                bar(left, y + dy, at(ns) - left, 12, colour)
                text(at(ns) + 4, y + dy + 10, number(ns), 'class="note"')
    limit = m.ns("Limit/compute/memory")
    line(at(limit), top - 6, at(limit), bottom, 'stroke="#b3261e" stroke-dasharray="4 3"')
    text(at(limit) + 5, bottom - 6, f"memory bandwidth: the bytes of a pair take {number(limit)} ns",
         'fill="#b3261e" class="note"')

    best = next(key for key in SETS if m.ns(f"Batch/test/ours/{key}/L2"))
    top2 = bottom + 96
    most = 1.25 * max(m.ratio(f"Batch/{op}/ours/{best}/{p}", f"Batch/{op}/plain/{best}/{p}")
                      for op in OPERATIONS for p in PLACES)
    to = lambda ratio: left + width * ratio / most
    text(left, top2 - 42, f"Batch: time to plain double with the same vectors ({SETS[best]})", 'class="title"')
    text(left, top2 - 22, "from top to bottom: L2, L3, memory", 'class="note"')
    bottom2 = top2 + 50 * len(OPERATIONS)
    line(to(1), top2 - 6, to(1), bottom2, 'stroke="#8a8f98" stroke-dasharray="4 3"')
    text(to(1), bottom2 + 14, "1 = plain double", 'text-anchor="middle" class="note"')
    for i, (op, what) in enumerate(OPERATIONS.items()):
        y = top2 + 50 * i
        text(left - 8, y + 25, what, 'text-anchor="end"')
        for k, (place, colour) in enumerate(zip(PLACES, ("#1f6fb2", "#5f9bcd", "#a9cbe8"))):
            ratio = m.ratio(f"Batch/{op}/ours/{best}/{place}", f"Batch/{op}/plain/{best}/{place}")
            bar(left, y + 2 + 14 * k, to(ratio) - left, 12, colour)
            text(to(ratio) + 4, y + 12 + 14 * k, f"{ratio:.2f}", 'class="note"')
    style = "text{font:13px sans-serif}.title{font-size:16px;font-weight:bold}"
    style += ".note{font-size:11px;paint-order:stroke;stroke:#fff;stroke-width:3px}"
    size = f'viewBox="0 0 800 {bottom2 + 30}" width="800" fill="#202124"'
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" {size}>', f"<style>{style}</style>",
                      '<rect width="100%" height="100%" fill="#fff"/>', *out, *labels, "</svg>", ""])


def write(page, name, block):
    """Puts what was measured between the page's markers of that name."""
    begin, end = f"<!-- {name}:begin -->", f"<!-- {name}:end -->"
    head, rest = page.read_text().split(begin)
    page.write_text(head + begin + "\n" + block + "\n" + end + rest.split(end)[1])


def main():
    m = Measured(sys.argv[1])
    page = DOCS / "performance.md"
    if m.ns("Peer/ours, scalar/hull_hull_compute/L2"):
        write(page, "convexes", f"Measured on {cpu()}, load average at the beginning {m.context['load_avg'][0]:.1f}.\n\n{convexes_table(m)}\n\n"
              f"Shapes in special positions, by family:\n\n{special_table(m)}")
    if not m.ns("Peer/ours, batch/compute/L2"):
        print(f"wrote the rows of rotated boxes and hulls to {page}: the rest was not measured")
        return
    block = "\n\n".join([
        machine(m), "![Contacts by subject, and batch to plain double](performance.svg)",
        "### At a glance", "Each figure beside what this project aims for; ratios are times, so less is faster.", speed_table(m),
        summary(m), "### Spheres, beside the peers",
        'Nanoseconds per pair; then the time of a contact as a multiple of the time of "ours, batch".', peers_table(m),
        "### Wrong decisions by family",
        f"Out of {wrong(m, 'FCL')['asked'] // len(FAMILIES)} questions in each family.", wrong_table(m),
        "### Every pair, one after the other",
        "Plain double is [the formula of the engine `plain-double`](../bench/peers/own.cpp), ours the function of one pair.", pairs_table(m),
        "### Every pair, many at once",
        "Plain double is [its formulas in the same vectors](../bench/plain_batch.cpp), ours the functions of `contact::batch`.", many_table(m),
        "### Scenes, beside the peers",
        "One pair after the other, [as scenes have them](../bench/peers/scenes.hpp): on floors, upright, along axes. About half of the pairs are hits.",
        scenes_table(m),
        "### Whole models, beside the peers",
        "Every contact of a set of spheres with itself, without an alarm distance. FCL and Bullet build their broad phase anew, as ours does each time; "
        '"again" leaves this out. Times of "ours, all threads" are by the wall clock.', models_table(m),
        "Boxes, a sphere and a box, batches by instruction set and by family, detection and limits: [measured.md](../bench/measured.md)."])
    more = "\n\n".join([
        "# Measured too", "What `./run bench` measured beside the tables of [performance.md](../docs/performance.md), which says what is compared, on the same "
        "machine.",
        "### Boxes, beside the peers", boxes_table(m),
        "### A sphere and a box, beside the peers",
        'Nanoseconds per pair; then the time of a contact as a multiple of plain double (of "plain double, vectors" for the '
        "subjects with vectors) and of ours.", sphere_cube_table(m),
        "### Batch, beside plain double with the same vectors", batch_table(m),
        "### Detection between two models, one thread", detect_table(m),
        "### Contacts by family, batch, in L2", families_table(m), "### Limits", facts(m)])
    write(page, "measured", block)
    (DOCS / "performance.svg").write_text(plot(m))
    (DOCS.parent / "bench/measured.md").write_text(more + "\n")
    print(f"wrote {page} and {DOCS / 'performance.svg'}")


main()
