#!/usr/bin/env python3
"""packaging/sbom.py and packaging/copyright, on the build that is tested:   sbom_test.py BUILD"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import sbom

BUILD = Path(sys.argv.pop(1)) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
COPYRIGHT = (sbom.ROOT / "packaging/copyright").read_text(encoding="utf-8")
KNOWN = sbom.licences(COPYRIGHT)


@unittest.skipUnless(shutil.which("dpkg-query"), "no dpkg here")
class Bill(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.path = Path(folder.name) / "bill.json"
        cls.make()
        cls.bytes = cls.path.read_bytes()
        cls.bill = json.loads(cls.bytes)
        cls.packages = {one["SPDXID"]: one for one in cls.bill["packages"]}

    @classmethod
    def make(cls):
        subprocess.run([sys.executable, sbom.ROOT / "packaging/sbom.py", BUILD, "-o", cls.path], check=True)

    def parts(self, package, *kinds):
        return {self.packages[one["relatedSpdxElement"]]["name"] for one in self.bill["relationships"]
                if one["spdxElementId"] == sbom.named(package) and one["relationshipType"] in kinds}

    def test_it_has_what_spdx_2_3_requires(self):
        for field, value in (("spdxVersion", "SPDX-2.3"), ("dataLicense", "CC0-1.0"), ("SPDXID", "SPDXRef-DOCUMENT")):
            self.assertEqual(self.bill[field], value)
        self.assertRegex(self.bill["creationInfo"]["created"], r"\A\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ\Z")
        commit = r"[0-9a-f]{40}" if (sbom.ROOT / ".git").exists() else "unknown"
        self.assertRegex(self.bill["documentNamespace"], rf"\Ahttps://[^#]+-{commit}\Z")
        self.assertEqual(len(self.packages), len(self.bill["packages"]), "an identifier twice")
        for one in self.bill["packages"]:
            self.assertRegex(one["SPDXID"], r"\ASPDXRef-[A-Za-z0-9.-]+\Z")
            self.assertTrue(all(one[field] for field in ("name", "versionInfo", "downloadLocation", "licenseConcluded", "licenseDeclared", "copyrightText")), one)
        for one in self.bill["relationships"]:
            self.assertIn(one["relatedSpdxElement"], self.packages)
            self.assertIn(one["spdxElementId"], {"SPDXRef-DOCUMENT", *self.packages})
        described = {one["relatedSpdxElement"] for one in self.bill["relationships"] if one["relationshipType"] == "DESCRIBES"}
        self.assertLessEqual({sbom.named("contact-oracle"), sbom.named("libcontact-oracle-dev")}, described)
        self.assertTrue(any(re.fullmatch(r"SPDXRef-libcontact-oracle[\d.]+", one) for one in described))

    def test_the_program_has_parts_of_cgal_and_asks_for_gmp(self):
        self.assertLess({"cgal", "boost1.74", "eigen3", "rapidcheck"}, self.parts("contact-oracle", "STATIC_LINK"))
        self.assertLess({"gmp", "mpfi", "openssl", "glibc"}, self.parts("contact-oracle", "DYNAMIC_LINK"))
        self.assertIn("LGPL-3.0-or-later", self.packages[sbom.named("contact-oracle")]["licenseConcluded"])

    def test_the_library_has_nothing_but_eigen_boost_and_highway(self):
        self.assertEqual(self.parts("libcontact-oracle-dev", "STATIC_LINK", "DYNAMIC_LINK", "CONTAINS") - set(sbom.LINKED), {"eigen3", "boost1.74", "highway"})

    def test_the_page_brings_two_scripts(self):
        if "CONTACT_D3_JS:FILEPATH=CONTACT_D3_JS-NOTFOUND" in (BUILD / "CMakeCache.txt").read_text():
            self.skipTest("built without D3")
        self.assertEqual(self.parts("contact-oracle", "CONTAINS"), {"d3", "three.js"})

    def test_every_paragraph_of_the_copyright_speaks_of_something_that_is_there(self):
        there = {one["name"] for one in self.bill["packages"]}
        if sbom.named("python3-contact-oracle") not in self.packages:
            there.add("pybind11")
        self.assertEqual(set(KNOWN) - {""} - there, set())

    def test_the_same_build_gives_the_same_bytes(self):
        self.make()
        self.assertEqual(self.path.read_bytes(), self.bytes)


@unittest.skipUnless(shutil.which("dpkg-query"), "no dpkg here")
class Refusals(unittest.TestCase):
    def refused(self, pattern, path, known, how="header"):
        with self.assertRaisesRegex(sbom.Refused, pattern):
            sbom.components({path: how}, known)

    def test_a_header_of_cgal_under_the_gpl(self):
        self.refused("box_intersection_d.h: is under GPL-3.0-or-later", "/usr/include/CGAL/box_intersection_d.h", KNOWN)
        self.assertEqual(set(sbom.components({"/usr/include/CGAL/Gmpq.h": "header"}, KNOWN)), {"cgal"})

    def test_a_part_that_the_copyright_does_not_speak_of(self):
        self.refused("says nothing of the source package librandom123", "/usr/include/Random123/philox.h", {"": "MIT"})

    def test_a_file_of_no_package(self):
        self.refused("of no Debian package: /usr/local/include/strange.h", "/usr/local/include/strange.h", KNOWN)

    def test_a_folder_that_is_no_build(self):
        done = subprocess.run([sys.executable, sbom.ROOT / "packaging/sbom.py", sbom.ROOT / "docs", "-o", "x"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("docs: no build by Ninja", done.stderr)

    def test_a_target_that_is_not_built(self):
        with self.assertRaisesRegex(sbom.Refused, "contact-oracle is not built"):
            build = sbom.Build(BUILD)
            folder = tempfile.TemporaryDirectory()
            self.addCleanup(folder.cleanup)
            build.folder = Path(folder.name)
            (build.folder / "build.ninja").write_text("build contact-oracle: phony\n")
            build.parts("contact-oracle")


class Copyright(unittest.TestCase):
    def test_every_licence_that_is_named_has_its_text(self):
        paragraphs = [dict(re.findall(r"(?m)^([\w-]+): *(.*)$", text)) for text in COPYRIGHT.split("\n\n")]
        named = {one["License"] for one in paragraphs if "Files" in one}
        texts = {one["License"] for one in paragraphs if "Files" not in one and "License" in one}
        self.assertEqual(named, texts)
        self.assertGreater(len(named), 5)

    def test_licences_of_the_page_are_in_the_page(self):
        page = (sbom.ROOT / "tool/page/licences.txt").read_text(encoding="utf-8")
        for source, words in (("d3", "BSD 3-Clause License"), ("three.js", "MIT License")):
            self.assertIn(words, page)
            self.assertIn(f"Source-Package: {source}\n", COPYRIGHT)


if __name__ == "__main__":
    unittest.main()
