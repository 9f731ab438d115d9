#!/usr/bin/env python3
"""What is in our packages, as SPDX 2.3:   sbom.py BUILD -o FILE [--packages FOLDER]

BUILD is a finished build by Ninja on Debian or Ubuntu. What went into a program is read off the build itself: the headers that the compiler
opened for each of its objects, the static libraries that the linker could take from, the shared libraries that it asks the loader for, and the
scripts in its HTML page. Their versions and source packages are dpkg's, their licences those of packaging/copyright and of LINKED. A part without a licence there, or a
header of CGAL that is under the GPL, is an error: exit status 1. --packages names the folder of the finished .deb files, whose digests join."""
import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# Our packages, and the targets that are in each. The library is in one more, which has the version of its interface in its name.
PACKAGES = {"contact-oracle": "contact-oracle", "contact-oracle-mpi": "contact-oracle-mpi", "python3-contact-oracle": "contact_python",
            "libcontact-oracle-dev": (LIBRARY := "contact_shared")}
# What packaging/copyright does not speak of, because its headers only declare what is in a shared library, or are the compiler's own: licences by
# Debian's source package.
LINKED = {"gmp": "LGPL-3.0-or-later OR GPL-2.0-or-later", "mpfr4": "LGPL-3.0-or-later", "mpfi": "LGPL-2.1-or-later",
          "libdeflate": "MIT", "libzip": "BSD-3-Clause", "libaec": "BSD-2-Clause", "libuv1": "MIT", "openssl": "Apache-2.0", "zlib": "Zlib", "openmpi": "BSD-3-Clause",
          "glibc": "LGPL-2.1-or-later", "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1", "linux": "GPL-2.0-only WITH Linux-syscall-note",
          "llvm-toolchain-14": "Apache-2.0 WITH LLVM-exception", "python3.11": "PSF-2.0"}


class Refused(Exception):
    """What is packaged is not what packaging/copyright says."""


def said(*words, cwd=None):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, cwd=cwd).stdout


def licences(text):
    """SPDX's names of the licences in a debian/copyright, by source package; ours under ''."""
    found = {}
    for paragraph in re.split(r"\n\s*\n", text):
        fields = dict(re.findall(r"(?m)^([\w-]+): *(.*)$", paragraph))
        if "Files" in fields:
            found[fields.get("Source-Package", "")] = fields["SPDX"]
    return found


def owners(paths):
    """The Debian package of each file, {path: package}."""
    # What is in /usr/lib may be known as /lib, and the other way round.
    asked = {other: path for path in paths for other in (path, path.removeprefix("/usr") if path.startswith("/usr/lib") else "/usr" + path)}
    done = subprocess.run(["dpkg-query", "-S", *asked], capture_output=True, text=True)
    found = {}
    for line in done.stdout.splitlines():
        package, _, path = line.partition(": ")
        if path in asked and "diversion by" not in line:
            found[asked[path]] = package.split(",")[0]
    lost = sorted(set(paths) - set(found))
    if lost:
        raise Refused(f"of no Debian package: {', '.join(lost)}")
    return found


def versions(packages):
    """{package: (source package, its version, own version)}."""
    lines = said("dpkg-query", "-W", "-f", "${Package}:${Architecture}\t${source:Package}\t${source:Version}\t${Version}\n", *packages).splitlines()
    known = {}
    for line in lines:
        package, *rest = line.split("\t")
        known[package] = known[package.split(":")[0]] = tuple(rest)
    return {package: known[package] for package in packages}


class Build:
    """A build, as Ninja knows it."""

    def __init__(self, folder):
        self.folder = folder
        self.cache = dict(re.findall(r"(?m)^(CONTACT_\w+_JS):\w+=(.+)$", (folder / "CMakeCache.txt").read_text()))

    def inputs(self, target):
        return said("ninja", "-t", "inputs", target, cwd=self.folder).splitlines()

    def has(self, target):
        return subprocess.run(["ninja", "-t", "query", target], cwd=self.folder, capture_output=True).returncode == 0

    def headers(self, objects):
        """What the compiler read for these objects, outside the build and the source."""
        found = set()
        for line in said("ninja", "-t", "deps", *objects, cwd=self.folder).splitlines():
            path = os.path.normpath(line.strip()) if line.startswith("    ") else ""
            if path.startswith("/usr/"):
                found.add(path)
        return found

    def program(self, target):
        """The program, module or shared library that a target is."""
        stands_for = said("ninja", "-t", "query", target, cwd=self.folder).split("outputs:")[0].split()[1:]  # a name that CMake gives to a file
        for path in (target, *stands_for):
            if (path == target or re.search(r"\.so(\.|$)", path)) and (self.folder / path).is_file():
                return self.folder / path
        raise Refused(f"{self.folder}: {target} is not built")

    def parts(self, target):
        """What is in a target: {path: how}."""
        inputs = self.inputs(target)
        program = self.program(target)
        found = dict.fromkeys(self.headers([one for one in inputs if one.endswith(".o")]), "header")
        if not found:
            raise Refused(f"{self.folder}: {target} is not built")
        # Some of glibc's are empty.
        found |= {one: "static" for one in inputs if one.startswith("/usr/") and one.endswith(".a") and said("ar", "t", one)}
        if any(one.endswith("/page.cpp.o") for one in inputs):
            found |= {path: "inlined" for path in self.cache.values() if not path.endswith("NOTFOUND")}
        needed = set(re.findall(r"NEEDED +(\S+)", said("objdump", "-p", program)))
        return found | {os.path.realpath(path): "shared" for name, path in re.findall(r"(\S+) => (\S+)", said("ldd", program)) if name in needed}


def components(parts, known):
    """{source package: (version, hows, binary packages)} of the parts of a target; Refused where a licence is missing or is not what is said."""
    owner = owners(parts)
    about = versions(set(owner.values()))
    found = {}
    for path, how in sorted(parts.items()):
        source, version, _ = about[owner[path]]
        if how == "header" and source in LINKED:
            continue
        if source not in known and source not in LINKED:
            raise Refused(f"{path}: packaging/copyright says nothing of the source package {source}")
        if source == "cgal" and how == "header":
            said_licence = re.search(r"SPDX-License-Identifier: *(.*)", Path(path).read_text(errors="replace"))
            if not said_licence or not re.match(r"(LGPL|BSL)-", said_licence[1]):
                raise Refused(f"{path}: is under {said_licence[1].strip() if said_licence else 'no licence that it names'}, and would be part of a program")
        _, hows, packages = found.setdefault(source, (version, set(), set()))
        hows.add(how)
        packages.add(owner[path].split(":")[0])
    return found


HOW = {"header": ("STATIC_LINK", "compiled from its headers"), "static": ("STATIC_LINK", "its static library"),
       "inlined": ("CONTAINS", "copied into the HTML reports"), "shared": ("DYNAMIC_LINK", "its shared library")}


def named(name):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)


def document(ours, version, commit, created, known, files):
    """The SPDX document: ours is {package: components}, files {package: (file name, SHA-256)}."""
    packages, relationships, sources = [], [], {}
    licence = (LINKED | known).get
    for package, parts in ours.items():
        one = {"SPDXID": named(package), "name": package, "versionInfo": version, "supplier": "Organization: contact-oracle maintainers",
               "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": "NOASSERTION", "licenseDeclared": known[""],
               "copyrightText": "2026 The contact-oracle authors", "sourceInfo": f"built from commit {commit}"}
        if package in files:
            name, digest = files[package]
            one |= {"packageFileName": name, "checksums": [{"algorithm": "SHA256", "checksumValue": digest}]}
        packages.append(one)
        relationships.append({"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": named(package)})
        one["licenseConcluded"] = " AND ".join(sorted({known[""], *(licence(source) for source, (_, hows, _) in parts.items() if hows - {"shared"})}))
        for source, (its_version, hows, binaries) in sorted(parts.items()):
            sources.setdefault(source, (its_version, set()))[1].update(binaries)
            for how in sorted(hows):
                kind, comment = HOW[how]
                relationships.append({"spdxElementId": named(package), "relationshipType": kind, "relatedSpdxElement": named("Debian-" + source),
                                      "comment": comment})
    for source, (its_version, binaries) in sorted(sources.items()):
        packages.append({"SPDXID": named("Debian-" + source), "name": source, "versionInfo": its_version, "supplier": "Organization: Debian",
                         "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": licence(source), "licenseDeclared": licence(source),
                         "copyrightText": "NOASSERTION", "comment": "Debian packages: " + ", ".join(sorted(binaries)),
                         "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                                           "referenceLocator": f"pkg:deb/debian/{source}@{its_version.replace('+', '%2B')}?arch=source"}]})
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"contact-oracle-{version}",
            "documentNamespace": f"https://contact-oracle.example/spdx/contact-oracle-{version}-{commit}",
            "creationInfo": {"created": created, "creators": ["Tool: contact-oracle-packaging/sbom.py", "Organization: contact-oracle maintainers"]},
            "packages": packages, "relationships": relationships}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("-o", dest="out", type=Path, required=True)
    arguments.add_argument("--packages", type=Path)
    options = arguments.parse_args()
    if not (options.build / "build.ninja").is_file():
        arguments.error(f"{options.build}: no build by Ninja")
    known = licences((ROOT / "packaging/copyright").read_text(encoding="utf-8"))
    build = Build(options.build.resolve())
    files = {}
    for deb in sorted(options.packages.glob("*.deb")) if options.packages else []:
        files[said("dpkg-deb", "-f", deb, "Package").strip()] = (deb.name, hashlib.sha256(deb.read_bytes()).hexdigest())
    try:
        ours = {package: components(build.parts(target), known) for package, target in PACKAGES.items() if build.has(target)}
        if build.has(LIBRARY):
            soname = re.search(r"SONAME +\S+\.so\.(\S+)", said("objdump", "-p", build.program(LIBRARY)))
            ours[f"libcontact-oracle{soname[1]}"] = ours["libcontact-oracle-dev"]
        if set(files) - set(ours):
            raise Refused(f"{options.packages}: nothing is known of {', '.join(sorted(set(files) - set(ours)))}")
    except Refused as refused:
        print(f"sbom: {refused}", file=sys.stderr)
        return 1
    if files:
        ours = {package: parts for package, parts in ours.items() if package in files}
    version = re.search(r"project\(contact-oracle VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
    git = subprocess.run(["git", "log", "-1", "--format=%H %ct"], cwd=ROOT, capture_output=True, text=True).stdout if (ROOT / ".git").exists() else ""
    # The archive of a release has no history: its file says of which commit it is. A copy of the files says nothing.
    archived = re.fullmatch(r"[0-9a-f]{40}", (ROOT / "cmake/commit.txt").read_text().strip())
    commit, time = git.split() or (archived[0] if archived else "unknown", (ROOT / "CHANGELOG.md").stat().st_mtime)
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH") or time)
    created = datetime.fromtimestamp(seconds, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    text = json.dumps(document(ours, version, commit, created, known, files), indent=1) + "\n"
    with tempfile.NamedTemporaryFile("w", dir=options.out.resolve().parent, delete=False) as unfinished:
        unfinished.write(text)
    os.replace(unfinished.name, options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
