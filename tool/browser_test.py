#!/usr/bin/env python3
"""The HTML report in a real browser: python3 tool/browser_test.py PATH_TO_TOOL [--pictures FOLDER | unittest arguments].

Needs Chromium; without it the exit status is 77, which ctest calls skipped. --pictures takes pictures of reports instead."""
import base64
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from published import published

TOOL = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else sys.exit(__doc__)
ROOT = Path(__file__).resolve().parent.parent
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
PHONE, DESKTOP = (390, 844), (1280, 900)


class Browser:
    """Headless Chromium, spoken to through its DevTools protocol on two pipes: JSON, a zero byte behind each message."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        theirs_in, self.out = os.pipe()
        self.back, theirs_out = os.pipe()

        def pipes():  # the browser reads from 3 and writes to 4
            copies = os.dup(theirs_in), os.dup(theirs_out)
            os.dup2(copies[0], 3)
            os.dup2(copies[1], 4)

        self.process = subprocess.Popen(
            [CHROMIUM, "--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--no-first-run", "--disable-dev-shm-usage",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars", "--disable-background-networking",
             f"--user-data-dir={self.folder.name}", "about:blank"],
            close_fds=False, preexec_fn=pipes, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(theirs_in)
        os.close(theirs_out)
        self.count, self.rest, self.events, self.session = 0, b"", [], None
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.out)
        os.close(self.back)
        self.folder.cleanup()

    def message(self):
        while b"\0" not in self.rest:
            more = os.read(self.back, 1 << 20)
            if not more:
                raise RuntimeError("the browser is gone")
            self.rest += more
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **params):
        self.count += 1
        session = {"sessionId": self.session} if self.session else {}
        os.write(self.out, json.dumps({"id": self.count, "method": method, "params": params, **session}).encode() + b"\0")
        while (message := self.message()).get("id") != self.count:
            self.events.append(message)
        if "error" in message:
            raise RuntimeError(f"{method}: {message['error']}")
        return message["result"]

    def run(self, script):
        """What a script gives, awaited."""
        done = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in done:
            raise RuntimeError(f"{script}: {done['exceptionDetails']}")
        return done["result"].get("value")

    def wait(self, script, seconds=120):
        deadline = time.monotonic() + seconds
        while not (value := self.run(script)):
            if time.monotonic() > deadline:
                raise TimeoutError(script)
            time.sleep(0.1)
        return value

    def open(self, path, size=DESKTOP, scheme="light"):
        self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.events.clear()
        self.call("Page.navigate", url=Path(path).as_uri())
        self.wait(f"location.href === {json.dumps(Path(path).as_uri())} && document.readyState === 'complete'")

    def complaints(self):
        """What went to the console as an error, and what was fetched other than the page itself."""
        self.run("new Promise((done) => requestAnimationFrame(() => setTimeout(done, 50)))")
        said = []
        for event in self.events:
            params = event.get("params", {})
            method = event.get("method")
            if method == "Runtime.exceptionThrown" or (method == "Runtime.consoleAPICalled" and params["type"] == "error") or \
                    (method == "Log.entryAdded" and params["entry"]["level"] == "error"):
                said.append(params)
            if method == "Network.requestWillBeSent" and params.get("type") != "Document":
                said.append(params["request"]["url"][:200])
        return said

    def draw(self, case=0):
        """Scrolls a worst case into view and waits for its picture."""
        self.run(f"document.querySelectorAll('article')[{case}].scrollIntoView()")
        self.wait(f"document.querySelectorAll('article')[{case}].querySelector('figure').dataset.drawn")

    def pixels(self, case=0):
        """The picture of a worst case: how many pixels are drawn, of how many colours, and their digest."""
        return self.run("""(async () => {
            const canvas = document.querySelectorAll('article')[%d].querySelector('canvas');
            const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
            const colours = new Set();
            let drawn = 0;
            for (let i = 0; i < data.length; i += 4)
                if (data[i + 3] > 0) { ++drawn; colours.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]); }
            let hash = 0;
            for (const byte of data) hash = (hash * 31 + byte) | 0;
            return {share: drawn * 4 / data.length, colours: colours.size, hash};
        })()""" % case)

    def key(self, key):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, text=key if len(key) == 1 and kind == "keyDown" else "")

    def drag(self, x, y, dx, dy):
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, button="left", buttons=1, clickCount=1)
        for step in range(1, 5):
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + dx * step / 4, y=y + dy * step / 4, button="left", buttons=1)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=x + dx, y=y + dy, button="left", buttons=0, clickCount=1)

    def picture(self, path, clip=None):
        shot = self.call("Page.captureScreenshot", **({"clip": {**clip, "scale": 1}, "captureBeyondViewport": True} if clip else {}))
        Path(path).write_bytes(base64.b64decode(shot["data"]))


def page_of(folder, *args):
    """The page of a run."""
    page = Path(folder) / "report.html"
    done = subprocess.run([TOOL, *published(["certify", *args, "--report", page])], cwd=ROOT, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stderr)
    return page


def certify(folder, *args):
    """The page and the JSON report of one engine's run."""
    report = Path(folder) / "report.json"
    return page_of(folder, *args, "--json", report), json.loads(report.read_text())


GOLDEN = ROOT / "golden"
# Every kind of failure: missed and false hits, NaN, numbers that are off; boxes too.
WRONG = (*(GOLDEN / "sphere_sphere" / f"{family}.jsonl" for family in ("coincident", "touching", "containment")), GOLDEN / "cube_cube")


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.browser = Browser()
        # Pages name the reports by their paths: here one without a place to break it, wider than a phone.
        cls.reports = Path(cls.folder.name) / ("W" * 60)
        cls.reports.mkdir()
        for name, args in (("wrong", (*WRONG, "--engine", "plain-double")), ("right", (*WRONG, "--engine", "production")),
                           ("ugly", (GOLDEN / "sphere_sphere" / "extreme_scale.jsonl", "--engine", "plain-double"))):
            folder = cls.reports / name
            folder.mkdir()
            setattr(cls, name, certify(folder, *args))
        cls.history = cls.reports / "history.html"
        reports = [cls.reports / name / "report.json" for name in ("wrong", "ugly", "right")]
        subprocess.run([TOOL, "compare", *reports, "--report", cls.history], check=True, capture_output=True)
        cls.browser.open(cls.wrong[0])
        if cls.browser.run("typeof d3") == "undefined":
            cls.tearDownClass()
            raise unittest.SkipTest("built without D3 and three.js")

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def test_nothing_goes_wrong_and_nothing_is_fetched(self):
        for (page, report), scheme, size in ((self.wrong, "light", DESKTOP), (self.wrong, "dark", PHONE), (self.right, "light", PHONE)):
            with self.subTest(page=page, scheme=scheme, size=size):
                self.browser.open(page, size, scheme)
                for case in range(0 if report["certified"] else len(report["worst"])):
                    self.browser.draw(case)
                self.assertEqual(self.browser.complaints(), [])

    def test_the_verdict_stands_first(self):
        for page, report in (self.wrong, self.right):
            self.browser.open(page)
            text = self.browser.run("document.querySelector('section').innerText")
            self.assertIn("✓ certified" if report["certified"] else "✕ refuted", text.splitlines()[0])
            self.assertIn(report["verdict"], text)
            top = self.browser.run("document.querySelector('.verdict').getBoundingClientRect().bottom")
            self.assertLess(top, 300)

    def test_the_numbers_of_the_worst_cases_are_those_of_the_judge(self):
        page, report = self.wrong
        self.browser.open(page)
        shown = self.browser.run("""[...document.querySelectorAll('article')].map((article) => ({
            what: article.querySelector('h4').innerText, line: article.querySelector('code').innerText,
            rows: Object.fromEntries([...article.querySelectorAll('.numbers tbody tr')].map((row) =>
                [row.cells[0].innerText, [row.cells[1], row.cells[2]].map((cell) => cell.innerText.split('\\n'))]))}))""")
        self.assertEqual(len(shown), len(report["worst"]))
        text = lambda x: x if isinstance(x, str) else json.dumps(x)
        fields = 0
        for article, worst in zip(shown, report["worst"]):
            self.assertEqual(article["what"], worst["what"])
            question = json.loads(article["line"].split("'")[1])
            self.assertEqual(question, worst["query"])
            # What the page calls right is what explain says of the line to copy.
            told = json.loads(subprocess.run([TOOL, "explain", "--json"], input=json.dumps(question), capture_output=True,
                                             text=True).stdout)["expect"]
            for side, answer in enumerate((worst["right"], worst["claimed"])):
                self.assertEqual(article["rows"]["overlap"][side], ["hit" if answer["overlap"] else "miss"])
                for field, value in (answer.get("contact") or {}).items():
                    here = article["rows"][field][side]
                    if side == 0:
                        self.assertEqual(value, told[field])
                    self.assertEqual([float(x) for x in here if x != "NaN"],
                                     [float(x) for x in (value if isinstance(value, list) else [value]) if x != "NaN"])
                    fields += 1
        self.assertGreater(fields, 8)

    def test_the_two_shapes_are_drawn_and_turn_with_mouse_and_keys(self):
        page, report = self.wrong
        for scheme in ("light", "dark"):
            self.browser.open(page, scheme=scheme)
            for case in range(len(report["worst"])):
                with self.subTest(case=report["worst"][case]["what"], scheme=scheme):
                    self.browser.draw(case)
                    drawn = self.browser.pixels(case)
                    self.assertGreater(drawn["share"], 0.02)
                    self.assertGreater(drawn["colours"], 20)
        self.browser.draw(0)
        self.browser.run("document.querySelector('canvas').focus()")
        self.browser.key("0")
        first = self.browser.pixels(0)["hash"]
        self.browser.key("ArrowLeft")
        turned = self.browser.pixels(0)["hash"]
        self.assertNotEqual(turned, first)
        self.browser.key("+")
        self.assertNotEqual(self.browser.pixels(0)["hash"], turned)
        self.browser.key("0")
        self.assertEqual(self.browser.pixels(0)["hash"], first)
        x, y = self.browser.run("(({x, y, width, height}) => [x + width / 2, y + height / 2])(document.querySelector('canvas').getBoundingClientRect())")
        self.browser.drag(x, y, 60, 20)
        self.assertNotEqual(self.browser.pixels(0)["hash"], first)

    def test_hulls_and_rotated_boxes_are_drawn_with_all_that_they_have(self):
        cube = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        turned = {"center": [3, 0, 0], "orientation": [0, 0, 1, 1], "extents": [2, 1, 1]}
        shown = {}
        for name, vertices, radius in (
                ("corners", cube, 0), ("round", cube, 0.5), ("inner and repeated", [*cube, [0, 0, 0], *cube], 0), ("flat", cube[:4], 0),
                ("line", [cube[0], cube[7], [0, 0, 0]], 0.25), ("point", cube[:1], 0), ("on a face", [*cube, [1, 0, 0], [1, 1, 0]], 0)):
            with self.subTest(name):
                folder = self.reports / f"hull {name}"
                folder.mkdir()
                query = {"pair": "obb_hull", "a": turned, "b": {"vertices": vertices, "radius": radius}, "alarm": 9, "contact": 0}
                subprocess.run([TOOL, "annotate", "-", "-o", folder / "q.jsonl"], input=json.dumps(query), text=True, check=True, capture_output=True)
                header = {"format": "contact-oracle/results", "version": 1, "engine": {"name": "none", "version": "1"}, "scalar": "binary64",
                          "pairs": ["obb_hull"]}
                case = json.loads((folder / "q.jsonl").read_text().splitlines()[1])
                wrong = {"overlap": True, "contact": {**{key: case["expect"][key] for key in ("normal", "point1", "point2")}, "value": 7}}
                (folder / "answers.jsonl").write_text("".join(json.dumps(one) + "\n" for one in (header, {"id": case["id"], **wrong})))
                page, _ = certify(folder, folder / "q.jsonl", "--results", folder / "answers.jsonl")
                self.browser.open(page)
                self.browser.draw()
                shown[name] = self.browser.pixels()
                self.assertGreater(shown[name]["colours"], 20)
                self.assertEqual(self.browser.complaints(), [])
        # Points inside or twice change nothing that is seen but the dots where they are; what has more of an outside covers more.
        self.assertGreater(shown["round"]["share"], shown["corners"]["share"])
        self.assertAlmostEqual(shown["inner and repeated"]["share"], shown["corners"]["share"], delta=0.002)
        self.assertAlmostEqual(shown["on a face"]["share"], shown["corners"]["share"], delta=0.002)
        for name in ("flat", "line", "point"):
            self.assertLess(shown[name]["share"], shown["corners"]["share"], name)

    def test_the_charts_count_what_the_report_counts(self):
        for page, report in (self.wrong, self.ugly):
            self.browser.open(page)
            self.counted(report)
        # Of these points some have a component that is no number beside others that are far off.
        self.assertGreater(self.ugly[1]["total"]["fields"]["point1"]["not_finite"], 0)

    def counted(self, report):
        titles = "[...document.querySelectorAll('.chart g > title')].map((title) => title.textContent)"
        choose = "(() => { const s = document.querySelector('select'); s.value = %d; s.dispatchEvent(new Event('change')); })()"
        for i, counts in enumerate((report["total"], *report["families"])):
            self.browser.run(choose % i)
            said = self.browser.run(titles)
            here = [title for title in said if "decisions" in title]
            count = lambda title: [int(word) for word in title.split(": ")[1].replace(",", "").split() if word.isdigit()]
            self.assertEqual([sum(x) for x in zip(*map(count, here))] or [0, 0],
                             [sum(m[2] for m in counts["margins"]), sum(m[3] for m in counts["margins"])])
            off = sum(int(title.split()[0]) for title in said if " off by " in title)
            self.assertEqual(off, sum(n for field in counts["fields"].values() for _, n in field["errors"]))
            fields = counts["fields"].values()
            drawn_at_all = any(field["errors"] or field["not_finite"] for field in fields)
            for key in ("correctly_rounded", "not_finite"):
                drawn = [int(title.split()[0]) for title in said if re.fullmatch(rf"-?[0-9]+ {key.replace('_', ' ')}", title)]
                self.assertEqual(drawn, [field[key] for field in fields] if drawn_at_all else [], key)

    def test_every_word_can_be_read_in_light_and_dark(self):
        backgrounds = set()
        for page, scheme in ((page, scheme) for page in (self.wrong[0], self.history) for scheme in ("light", "dark")):
            self.browser.open(page, scheme=scheme)
            contrasts = self.browser.run("""(() => {
                const rgb = (text) => text.match(/[\\d.]+/g).map(Number);
                const light = ([r, g, b]) => [r, g, b].map((c) => (c /= 255) <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
                    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
                const behind = (e) => { for (; e; e = e.parentElement) { const c = rgb(getComputedStyle(e).backgroundColor);
                    if (c.length === 3 || c[3] === 1) return c; } };
                const seen = {};
                for (const e of document.querySelectorAll('body *')) {
                    if (![...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim())) continue;
                    if (['SCRIPT', 'STYLE', 'TITLE', 'OPTION'].includes(e.nodeName.toUpperCase())) continue;
                    const style = getComputedStyle(e);
                    const [x, y] = [light(rgb(e instanceof SVGElement ? style.fill : style.color)), light(behind(e))];
                    const ratio = (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05);
                    const name = e.nodeName + '.' + (e.getAttribute('class') || '');
                    seen[name] = Math.min(seen[name] || 99, ratio);
                }
                return seen;
            })()""")
            self.assertGreater(len(contrasts), 20)
            self.assertEqual({name: ratio for name, ratio in contrasts.items() if ratio < 4.5}, {})
            backgrounds.add(self.browser.run("getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(backgrounds), 2)

    def test_the_history_draws_every_measure_of_every_report_and_nothing_goes_wrong(self):
        reports = [json.loads((self.reports / name / "report.json").read_text())["total"] for name in ("wrong", "ugly", "right")]
        for scheme, size in (("light", DESKTOP), ("dark", PHONE)):
            self.browser.open(self.history, size, scheme)
            self.assertEqual(self.browser.complaints(), [])
            drawn = self.browser.run("""[...document.querySelectorAll('#history .chart')].map((chart) => ({
                what: chart.querySelector('figcaption').textContent, numbers: chart.querySelector('details p').textContent,
                heights: [...chart.querySelectorAll('circle')].map((dot) => Number(dot.getAttribute('cy')))}))""")
            asked = sum(report["everyday"]["answers"] > 0 for report in reports)  # extreme scales are not everyday numbers
            self.assertEqual([(len(chart["heights"]), chart["what"].split(" (")[0]) for chart in drawn],
                             [(asked, "values and coordinates fit from"), (asked, "normals fit from"),
                              (asked, "decisions fit from"), (3, "numbers correctly rounded"), (3, "wrong decisions")])
            self.assertGreater(asked, 1)
            wrong = [report["missed_hits"] + report["false_hits"] for report in reports]
            self.assertEqual([int(part.split(": ")[1]) for part in drawn[4]["numbers"].split("; ")], wrong)
            # On the logarithmic scale 0 stands a power of ten below the one under the smallest number.
            self.assertEqual((wrong[2], min(wrong[:2]) > 0), (0, True))
            first, second, zero = drawn[4]["heights"]
            powers = [math.log10(count) for count in wrong[:2]]
            decade = (first - second) / (powers[1] - powers[0])
            self.assertGreater(decade, 10)
            self.assertAlmostEqual(zero - first, decade * (powers[0] - math.floor(min(powers)) + 1), delta=0.5)

    def test_no_page_is_wider_than_its_window(self):
        for page in (self.wrong[0], self.right[0], self.history):
            for size in (PHONE, DESKTOP):
                self.browser.open(page, size)
                self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), size[0])

    def test_what_is_not_colour_tells_right_from_wrong(self):
        self.browser.open(self.wrong[0])
        signs = self.browser.run("""Object.fromEntries([0, 1, 2, 3, 4].map((g) =>
            [g, [...new Set([...document.querySelectorAll(`.matrix td.g${g}`)].map((cell) => isNaN(cell.innerText) ? cell.innerText : '12'))]]))""")
        used = [sign for grade in signs.values() for sign in grade if sign != "12"]
        self.assertEqual(len(used), len(set(used)))
        self.assertEqual((signs["3"], signs["4"]), (["12"], ["12"]))

    def test_everything_is_reached_by_keyboard_and_the_line_is_copied(self):
        page, report = self.wrong
        self.browser.open(page)
        self.browser.draw(0)
        self.browser.call("Browser.grantPermissions", permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])
        self.browser.run("document.querySelector('article canvas').focus()")
        reached = []
        for _ in range(6):
            self.browser.key("Tab")
            reached.append(self.browser.run("document.activeElement.nodeName"))
        self.assertIn("BUTTON", reached)
        self.browser.run("document.querySelector('article button').click()")
        self.browser.wait("document.querySelector('article button').innerText === 'Copied'")


def pictures(folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    browser = Browser()
    for engine in ("board", "production", "plain-double", "plain-float"):
        with tempfile.TemporaryDirectory() as temporary:
            page = page_of(temporary, *(() if engine == "board" else ("golden", "--engine", engine)))
            for name, size, scheme in (("light", DESKTOP, "light"), ("dark", DESKTOP, "dark"), ("phone", PHONE, "light")):
                start = time.monotonic()
                browser.open(page, size, scheme)
                for case in range(min(2, browser.run("document.querySelectorAll('article').length"))):
                    browser.draw(case)
                browser.run("scrollTo(0, 0)")
                height = browser.run("document.documentElement.scrollHeight")
                browser.picture(folder / f"{engine}-{name}.png", {"x": 0, "y": 0, "width": size[0], "height": min(height, 5000)})
                timing = browser.run("(({domInteractive, loadEventEnd}) => [domInteractive, loadEventEnd])(performance.getEntriesByType('navigation')[0])")
                print(engine, name, f"{page.stat().st_size} bytes, {height} high, interactive and loaded after", timing, "ms;", browser.complaints())
    browser.close()


if __name__ == "__main__":
    if CHROMIUM is None:
        print("No Chromium here, so no page is opened: ./run browser installs it and runs these tests.")
        sys.exit(77)
    if sys.argv[2:3] == ["--pictures"]:
        pictures(sys.argv[3])
    else:
        unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
