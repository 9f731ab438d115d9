"""A wheel of the package as it was built here: python3 make_wheel.py PACKAGE TOOL FOLDER prints its path.

PACKAGE is the folder with the module and the Python files, TOOL the program contact-oracle, which asks laws. What the
wheel says of itself stands in pyproject.toml; scikit-build-core, which that file names for the world outside, is not
needed here. The module links to this system's libraries, so the wheel is for systems like this one."""
import email.message
import sys
import sysconfig
import tomllib
from pathlib import Path

from wheel.wheelfile import WheelFile

HERE = Path(__file__).resolve().parent


def metadata(project):
    """What a wheel says of itself (the core metadata of packages, 2.1)."""
    message = email.message.Message()
    message["Metadata-Version"] = "2.1"
    message["Name"] = project["name"]
    message["Version"] = project["version"]
    message["Summary"] = project["description"]
    message["Requires-Python"] = project["requires-python"]
    for one in project.get("classifiers", []):
        message["Classifier"] = one
    for one in project.get("dependencies", []):
        message["Requires-Dist"] = one
    for extra, needs in project.get("optional-dependencies", {}).items():
        message["Provides-Extra"] = extra
        for one in needs:
            message["Requires-Dist"] = f'{one}; extra == "{extra}"'
    return message.as_string()


def main(package, tool, folder):
    project = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
    name = project["name"].replace("-", "_")
    abi = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    path = Path(folder) / f"{name}-{project['version']}-{abi}-{abi}-{platform}.whl"
    info = f"{name}-{project['version']}.dist-info"
    entry_points = "".join(f"[{group}]\n" + "".join(f"{key} = {value}\n" for key, value in points.items()) + "\n"
                           for group, points in project.get("entry-points", {}).items())
    with WheelFile(path, "w") as wheel:
        for file in sorted(Path(package).rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                wheel.write(str(file.resolve()), str(Path("contact_oracle") / file.relative_to(package)))
        wheel.write(str(Path(tool).resolve()), "contact_oracle/bin/contact-oracle")
        wheel.writestr(f"{info}/METADATA", metadata(project))
        wheel.writestr(f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: contact-oracle\nRoot-Is-Purelib: false\nTag: {abi}-{abi}-{platform}\n")
        if entry_points:
            wheel.writestr(f"{info}/entry_points.txt", entry_points)
    print(path)


if __name__ == "__main__":
    main(*sys.argv[1:])
