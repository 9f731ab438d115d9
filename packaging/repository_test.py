#!/usr/bin/env python3
"""What sites that host the repository read: forms, workflows, the action, the citation; and the version wherever it stands."""
import json
import re
import subprocess
import unittest
from pathlib import Path

import yaml

import release

ROOT = release.ROOT
COMMANDS = set(re.findall(r"(?m)^  (\w+)\)$", (ROOT / "run").read_text()))
VARIABLES = set(re.findall(r"\bCONTACT_[A-Z0-9_]+", (ROOT / "packaging/ci/certify.sh").read_text()))


def read(name):
    # YAML 1.1 reads the key "on" as true.
    found = yaml.safe_load((ROOT / name).read_text(encoding="utf-8"))
    return {"on" if key is True else key: value for key, value in found.items()}


def steps(job):
    return [step for step in job["steps"] if "run" in step]


class Workflows(unittest.TestCase):
    def test_they_call_commands_that_there_are(self):
        called = set()
        for path in sorted((ROOT / ".github/workflows").glob("*.yml")):
            for name, job in read(path.relative_to(ROOT))["jobs"].items():
                for what in job.get("strategy", {}).get("matrix", {}).get("what", []):
                    called.add(what.split()[0])
                for step in steps(job):
                    called.update(word for word in re.findall(r"\./run (\w+)", step["run"]))
                    for script in re.findall(r"(?<!\S)(\.[\w/]+)(?=\s|$)", step["run"]):
                        self.assertTrue((ROOT / script).is_file(), f"{path.name}, {name}: {script}")
        self.assertLess({"install", "packages", "fuzz", "prove", "portability", "campaign"}, called)
        self.assertEqual(called - COMMANDS, set())
        usage = subprocess.run([ROOT / "run", "help"], check=True, capture_output=True, text=True).stdout
        for command in called:
            self.assertIn(f"./run {command} ", usage)

    def test_they_may_only_read_and_end_some_time_and_put_no_expression_into_a_script(self):
        found = sorted((ROOT / ".github/workflows").glob("*.yml"))
        self.assertGreater(len(found), 1)
        for path in found:
            with self.subTest(path.name):
                workflow = read(path.relative_to(ROOT))
                self.assertEqual(workflow["permissions"], {"contents": "read"})
                for job in workflow["jobs"].values():
                    self.assertLess(0, job["timeout-minutes"])
                    for step in steps(job):
                        self.assertNotIn("${{", step["run"])

    def test_what_is_kept_up_to_date_is_there(self):
        for update in read(".github/dependabot.yml")["updates"]:
            folder = ROOT / update["directory"].lstrip("/")
            self.assertTrue({"npm": folder / "package.json", "github-actions": folder / ".github/workflows"}[update["package-ecosystem"]].exists())


class Action(unittest.TestCase):
    def setUp(self):
        self.action = read("action.yml")
        self.steps = self.action["runs"]["steps"]

    def test_every_input_reaches_the_script_by_the_environment_alone(self):
        run = steps(self.action["runs"])
        self.assertEqual([step["shell"] for step in run], ["bash"])
        self.assertNotIn("${{", run[0]["run"])
        script = re.search(r"\$GITHUB_ACTION_PATH/([\w/.-]+)", run[0]["run"])[1]
        self.assertTrue((ROOT / script).stat().st_mode & 0o111)
        self.assertEqual(run[0]["env"], {f"CONTACT_{name.upper().replace('-', '_')}": f"${{{{ inputs.{name} }}}}"
                                         for name in self.action["inputs"] if name != "artifact"})
        self.assertLessEqual(set(run[0]["env"]), VARIABLES)

    def test_nothing_speaks_of_an_input_that_there_is_not_and_outputs_are_those_of_the_script(self):
        text = (ROOT / "action.yml").read_text()
        self.assertEqual(set(re.findall(r"inputs\.([\w-]+)", text)), set(self.action["inputs"]))
        written = re.search(r"printf '(.*)' \"\$status\"", (ROOT / "packaging/ci/certify.sh").read_text())[1]
        self.assertEqual(set(self.action["outputs"]), set(re.findall(r"(\w+)=%s", written.replace("\\n", " "))))

    def test_reports_are_kept_whatever_the_verdict(self):
        self.assertIn("always()", self.steps[-1]["if"])

    def test_what_the_documentation_shows_is_so(self):
        page = (ROOT / "docs/certify-your-engine.md").read_text(encoding="utf-8")
        chapter = page.split("\n## In continuous integration\n")[1].split("\n## ")[0]
        shown = [yaml.safe_load(block) for block in re.findall(r"```yaml\n(.*?)```", chapter, re.DOTALL)]
        self.assertEqual(len(shown), 2)
        github, gitlab = shown
        used = [step for job in github["jobs"].values() for step in job["steps"] if step.get("uses", "").startswith("OWNER/")]
        self.assertEqual(len(used), 1)
        self.assertLessEqual(set(used[0]["with"]), set(self.action["inputs"]))
        template = read("packaging/ci/contact-oracle.gitlab-ci.yml")
        job = next(job for name, job in gitlab.items() if name != "include")
        self.assertIn(job["extends"], template)
        self.assertLessEqual(set(job["variables"]), VARIABLES)
        self.assertIn("packaging/ci/contact-oracle.gitlab-ci.yml", gitlab["include"][0]["remote"])

    def test_the_gitlab_template_speaks_of_variables_and_files_that_there_are(self):
        text = (ROOT / "packaging/ci/contact-oracle.gitlab-ci.yml").read_text()
        self.assertLessEqual(set(re.findall(r"CONTACT_[A-Z0-9_]+", text)), VARIABLES)
        job = read("packaging/ci/contact-oracle.gitlab-ci.yml")[".contact-oracle"]
        self.assertEqual(job["artifacts"]["when"], "always")
        self.assertTrue(all(path.startswith(job["variables"]["CONTACT_REPORTS"]) for path in [*job["artifacts"]["paths"], job["artifacts"]["reports"]["junit"]]))
        # Where the package puts the script.
        self.assertRegex((ROOT / "packaging/CMakeLists.txt").read_text(), r"PROGRAMS ci/certify\.sh DESTINATION \$\{CMAKE_INSTALL_DATADIR\}/contact-oracle/ci ")
        self.assertIn("/usr/share/contact-oracle/ci/certify.sh", job["script"][-1])


class Forms(unittest.TestCase):
    def test_each_field_has_a_name_of_its_own_and_the_questions_are_asked_for(self):
        forms = [path for path in sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml")) if path.stem != "config"]
        self.assertGreater(len(forms), 2)
        for path in forms:
            with self.subTest(path.name):
                form = read(path.relative_to(ROOT))
                self.assertLess({"name", "description", "body"}, set(form))
                asked = [field for field in form["body"] if field["type"] != "markdown"]
                self.assertEqual(len({field["id"] for field in asked}), len(asked))
                self.assertLessEqual({field["type"] for field in asked}, {"input", "textarea", "dropdown", "checkboxes"})
                self.assertTrue(all(field["attributes"]["label"] for field in asked))
                self.assertTrue(any(field.get("validations", {}).get("required") for field in asked))


class Citation(unittest.TestCase):
    def test_it_has_what_the_format_requires(self):
        citation = read("CITATION.cff")
        self.assertLess({"cff-version", "message", "title", "authors"}, set(citation))
        self.assertEqual(citation["cff-version"], "1.2.0")
        self.assertEqual(citation["license"], json.loads((ROOT / "vcpkg.json").read_text())["license"])
        self.assertRegex(citation["date-released"], r"\A\d{4}-\d\d-\d\d\Z")


class Vcpkg(unittest.TestCase):
    @staticmethod
    def included(folders, tests):
        """The ports of the Boost libraries that the sources in these folders include."""
        files = [path for folder in folders for path in (ROOT / folder).rglob("*") if path.suffix in (".cpp", ".h", ".hpp")]
        text = "".join(path.read_text(encoding="utf-8") for path in files if tests or not re.search("_tests?$", path.stem))
        return {"boost-" + library.replace("_", "-") for library in re.findall(r"#include <boost/(\w+)", text)}

    @staticmethod
    def asked(manifest):
        found = json.loads((ROOT / manifest).read_text())
        return {name for one in [found, *found.get("features", {}).values()] for name in one["dependencies"] if str(name).startswith("boost-")}

    def test_the_boost_libraries_that_are_asked_for_are_those_that_are_included(self):
        self.assertEqual(self.asked("packaging/vcpkg/contact-oracle/vcpkg.json"), self.included(["include", "src"], tests=False))
        self.assertEqual(self.asked("vcpkg.json"), self.included(["bench", "dev", "docs", "engines", "formats", "golden", "include", "oracle", "proptests",
                                                                  "python", "src", "tool"], tests=True))


class Version(unittest.TestCase):
    def test_it_is_the_same_wherever_it_stands(self):
        found = release.places(ROOT)
        self.assertGreater(len(found), 5)
        self.assertRegex(found["CMakeLists.txt"], r"\A\d+\.\d+\.\d+\Z")
        self.assertEqual(found, dict.fromkeys(found, found["CMakeLists.txt"]))

    def test_the_changelog_has_room_for_what_is_not_released_and_a_date_for_what_is(self):
        changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"(?m)^## (\S+)", changelog)[0], "Unreleased")
        date, text = release.section(changelog, release.places(ROOT)["CMakeLists.txt"])
        self.assertEqual(date, read("CITATION.cff")["date-released"])
        self.assertGreater(len(text), 100)


if __name__ == "__main__":
    unittest.main()
