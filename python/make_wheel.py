"""A wheel of the package as it was built here: python3 make_wheel.py PACKAGE TOOL FOLDER prints its path.
With --info FOLDER only what a package says of itself, NAME.dist-info, for other ways to install it.

PACKAGE is the folder with the module and the Python files, TOOL the program contact-oracle, which asks laws. What the
wheel says of itself stands in pyproject.toml; scikit-build-core, which that file names for the world outside, is not
needed here. The module links to this system's libraries, so the wheel is for systems like this one."""
import email.message
import sys
import sysconfig
import tomllib
from pathlib import Path

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


def dist_info(project):
    """The name of its folder, and the files in it but those of wheels."""
    entry_points = "".join(f"[{group}]\n" + "".join(f"{key} = {value}\n" for key, value in points.items()) + "\n"
                           for group, points in project.get("entry-points", {}).items())
    return f"{project['name'].replace('-', '_')}-{project['version']}.dist-info", {"METADATA": metadata(project), "entry_points.txt": entry_points}


def write_info(project, folder):
    name, files = dist_info(project)
    (Path(folder) / name).mkdir(parents=True, exist_ok=True)
    for file, content in files.items():
        (Path(folder) / name / file).write_text(content)


def write_wheel(project, package, tool, folder):
    from wheel.wheelfile import WheelFile  # which --info does not need

    info, files = dist_info(project)
    abi = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    path = Path(folder) / f"{info.removesuffix('.dist-info')}-{abi}-{abi}-{platform}.whl"
    with WheelFile(path, "w") as wheel:
        for file in sorted(Path(package).rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                wheel.write(str(file.resolve()), str(Path("contact_oracle") / file.relative_to(package)))
        wheel.write(str(Path(tool).resolve()), "contact_oracle/bin/contact-oracle")
        wheel.writestr(f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: contact-oracle\nRoot-Is-Purelib: false\nTag: {abi}-{abi}-{platform}\n")
        for file, content in files.items():
            wheel.writestr(f"{info}/{file}", content)
    print(path)


def main(*words):
    project = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
    if words[:1] == ("--info",):
        write_info(project, *words[1:])
    else:
        write_wheel(project, *words)


if __name__ == "__main__":
    main(*sys.argv[1:])
