#!/usr/bin/env python3
"""Makes a release, and publishes nothing:   ./run release VERSION [--dry-run] [--tested REPORT..]

It stops at the first doubt: the tree, the branch, the tag, the version in every place, the date, the changelog, the tests, two builds of the packages in
two folders that must give the same bytes, the bill of materials. Then build/release-VERSION/ has the packages, the notes, SPDX and SHA256SUMS, and the
commit has a tag, signed if a key is there. What is left to a person is printed.

--dry-run tells every doubt and does nothing else. --tested takes the reports of a run of .ci/run that is finished, build/readers-tests.xml and
build/release-tests.xml, instead of running it. Exit status: 0 done, 1 a doubt, 2 bad usage."""
import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# Every place where the version stands, and how.
VERSIONS = {"CMakeLists.txt": r"(?m)^project\(contact-oracle VERSION (\S+)", "vcpkg.json": r'"version": "([^"]*)"',
            "python/pyproject.toml": r'(?m)^version = "([^"]*)"', "CITATION.cff": r"(?m)^version: (\S+)",
            "CHANGELOG.md": r"(?m)^## (\d\S*)", "packaging/debian/changelog": r"\Acontact-oracle \(([^-)]*)",
            "packaging/vcpkg/contact-oracle/vcpkg.json": r'"version": "([^"]*)"'}


class Doubt(Exception):
    """Why there is no release."""


def said(*words, cwd=ROOT, **more):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, cwd=cwd, **more).stdout.strip()


def section(changelog, heading):
    """The text under a heading of the changelog, or None."""
    found = re.search(rf"(?ms)^## {re.escape(heading)}(?: \(([^)]*)\))?\n(.*?)(?=^## |\Z)", changelog)
    return found and (found[1], found[2].strip())


def places(root):
    """The version in each place; None where there is none."""
    return {name: found[1] if (found := re.search(how, (root / name).read_text(encoding="utf-8"))) else None for name, how in VERSIONS.items()}


def check_commit(root, version):
    """The commit is what will be published: nothing beside it, on main, without a tag."""
    if said("git", "status", "--porcelain", cwd=root):
        raise Doubt("the tree has changes that are not committed, or files that git does not know")
    if (branch := said("git", "branch", "--show-current", cwd=root)) != "main":
        raise Doubt(f"the branch is {branch or 'none'}, not main")
    if said("git", "tag", "--list", f"v{version}", cwd=root):
        raise Doubt(f"there is a tag v{version}")


def check_version(root, version):
    for name, found in places(root).items():
        if found != version:
            raise Doubt(f"{name}: the version is {found}, not {version}")


def check_changelog(root, version, today):
    changelog = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    date, text = section(changelog, version) or (None, "")
    if not text:
        raise Doubt(f"CHANGELOG.md: no section {version}, or nothing in it")
    if date != today:
        raise Doubt(f"CHANGELOG.md: the section {version} has the date {date}, not {today}")
    if (section(changelog, "Unreleased") or (None, None))[1] != "":
        raise Doubt("CHANGELOG.md: no section Unreleased, or something is in it")
    if (cited := re.search(r'(?m)^date-released: "?([\d-]+)', (root / "CITATION.cff").read_text(encoding="utf-8"))) is None or cited[1] != date:
        raise Doubt(f"CITATION.cff: date-released is {cited and cited[1]}, not {date}")


def check_tests(root, reports):
    """Finished reports: of this commit, whole, without a failure, and without a skip that is not allowed."""
    committed = int(said("git", "log", "-1", "--format=%ct", cwd=root))
    for report in reports:
        if not report.is_file():
            raise Doubt(f"{report}: no such report")
        suite = ElementTree.parse(report).getroot()
        begun = datetime.fromisoformat(suite.get("timestamp")).timestamp()
        if begun < committed:
            raise Doubt(f"{report}: the tests ran before the last commit")
        # What is not "run" or "notrun" has failed; ctest's own count is compared with the list.
        cases = list(suite.iter("testcase"))
        failed = [case.get("name") for case in cases if case.get("status") == "fail" or case.find("failure") is not None]
        if failed or int(suite.get("failures")) != 0:
            raise Doubt(f"{report}: {len(failed)} tests failed: {', '.join(failed[:5])}")
        if not cases or int(suite.get("tests")) != len(cases):
            raise Doubt(f"{report}: {len(cases)} tests, of {suite.get('tests')} that it speaks of")
    done = subprocess.run([sys.executable, root / ".ci/skips.py", "--allowed", root / ".ci/allowed-skips.txt", *reports], capture_output=True, text=True)
    if done.returncode != 0:
        raise Doubt(done.stderr.strip())


def digests(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir()) if path.is_file()}


def build_twice(root, version, folder):
    """Builds the packages from two clones in different folders, and copies them to `folder` if both gave the same bytes. Returns the first clone."""
    made = []
    for name in ("first", "another-folder/second"):
        clone = folder.parent / name
        said("git", "clone", "--quiet", "--no-hardlinks", root, clone)
        # A cache of the compiler would give the second build what the first one made.
        subprocess.run([clone / "run", "packages"], check=True, cwd=clone, stdout=sys.stderr, env=os.environ | {"CCACHE_DISABLE": "1"})
        made.append((clone, digests(clone / "build/packages/out")))
    (clone, first), (_, second) = made
    if first != second:
        differ = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
        raise Doubt(f"two builds of one commit differ: {', '.join(differ)}")
    if not any(name.endswith(".deb") for name in first):
        raise Doubt("./run packages made no Debian package")
    if strangers := [name for name in first if version not in name]:
        raise Doubt(f"./run packages made what has not the version in its name: {', '.join(strangers)}")
    for name in first:
        shutil.copy2(clone / "build/packages/out" / name, folder)
    return clone


def check_sbom(path, version, folder):
    """The bill of materials speaks of this release and of each of its packages."""
    bill = json.loads(path.read_text())
    named = {one.get("packageFileName") for one in bill["packages"]}
    if lost := [deb.name for deb in folder.glob("*.deb") if deb.name not in named]:
        raise Doubt(f"{path.name} says nothing of {', '.join(lost)}")
    if bill["name"] != f"contact-oracle-{version}":
        raise Doubt(f"{path.name} is of {bill['name']}")


def signing_key(root):
    """The key that git would sign with, or None."""
    key = subprocess.run(["git", "config", "user.signingkey"], cwd=root, capture_output=True, text=True).stdout.strip()
    if key:
        return key
    found = subprocess.run(["gpg", "--list-secret-keys", "--with-colons"], capture_output=True, text=True).stdout if shutil.which("gpg") else ""
    return next((line.split(":")[4] for line in found.splitlines() if line.startswith("sec:")), None)


def release(root, version, reports):
    target = root / f"build/release-{version}"
    if target.exists():
        raise Doubt(f"{target} is there already")
    if not reports:
        subprocess.run([root / ".ci/run"], check=True, cwd=root, env=os.environ | {"CI": "1"})
        reports = [root / "build/readers-tests.xml", root / "build/release-tests.xml"]
    check_tests(root, reports)
    target.parent.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(dir=target.parent, prefix="unfinished-release-") as work:
        folder = Path(work) / "artefacts"
        folder.mkdir()
        clone = build_twice(root, version, folder)
        bill = folder / f"contact-oracle-{version}.spdx.json"
        said(sys.executable, clone / "packaging/sbom.py", clone / "build/packages", "-o", bill, "--packages", folder, cwd=clone)
        check_sbom(bill, version, folder)
        (folder / "NOTES.md").write_text(section((root / "CHANGELOG.md").read_text(encoding="utf-8"), version)[1] + "\n", encoding="utf-8")
        (folder / "SHA256SUMS").write_text("".join(f"{digest}  {name}\n" for name, digest in digests(folder).items()))
        key = signing_key(root)
        if key:
            said("gpg", "--batch", "--armor", "--local-user", key, "--detach-sign", folder / "SHA256SUMS")
        check_commit(root, version)  # once more: the builds took their time
        said("git", "tag", "--sign" if key else "--annotate", "-m", f"contact-oracle {version}", f"v{version}", cwd=root)
        os.rename(folder, target)
    print(f"{target}:")
    for name in sorted(path.name for path in target.iterdir()):
        print(f"  {name}")
    print(f"The tag v{version} and SHA256SUMS are {'signed with ' + key if key else 'NOT signed: git has no user.signingkey, and gpg no secret key'}.\n"
          "Nothing was published. Left to you:\n"
          f"  git push origin main v{version}\n"
          f"  a release v{version} on the site that hosts the repository, with NOTES.md as its text and the other files attached\n"
          "  the container: packaging/docker/Dockerfile beside the package\n"
          "  CITATION.cff: a DOI, if an archive gave one")


def main():
    arguments = argparse.ArgumentParser(prog="./run release", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("version")
    arguments.add_argument("--dry-run", action="store_true")
    arguments.add_argument("--tested", nargs="+", type=Path, default=[], metavar="REPORT")
    options = arguments.parse_args()
    if not re.fullmatch(r"\d+\.\d+\.\d+", options.version):
        arguments.error(f"a version is three numbers, got {options.version}")
    today = datetime.now(timezone.utc).strftime("%Y-%m-%d")
    checks = [lambda: check_commit(ROOT, options.version), lambda: check_version(ROOT, options.version),
              lambda: check_changelog(ROOT, options.version, today)]
    if options.tested:
        checks.append(lambda: check_tests(ROOT, options.tested))
    doubts = 0
    for check in checks:
        try:
            check()
        except Doubt as doubt:
            print(f"release: {doubt}", file=sys.stderr)
            doubts += 1
            if not options.dry_run:
                return 1
    if options.dry_run:
        print(f"{doubts or 'no'} doubt{'s' if doubts != 1 else ''}; a release would {'' if options.tested else 'run .ci/run, '}build the packages twice, "
              f"write build/release-{options.version} and set the tag v{options.version}, {'signed' if signing_key(ROOT) else 'not signed'}")
        return 1 if doubts else 0
    try:
        release(ROOT, options.version, options.tested)
    except Doubt as doubt:
        print(f"release: {doubt}", file=sys.stderr)
        return 1
    except subprocess.CalledProcessError as failed:
        print(f"release: {' '.join(map(str, failed.cmd))} ended with {failed.returncode}\n{failed.stderr or ''}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
