"""The package as somebody gets it: python3 package_test.py PACKAGE TOOL [pytest arguments].

A wheel of it goes into a fresh virtual environment that sees the system's packages, and its tests run there in an empty
folder. Exit 77 where something that they need is not here."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
NEEDED = ("hypothesis", "numpy", "pip", "pytest", "venv", "wheel")


def main(package, tool, *arguments):
    missing = [name for name in NEEDED if subprocess.run([sys.executable, "-c", f"import {name}"], capture_output=True).returncode != 0]
    if missing:
        print(f"skipped: {sys.executable} has no {', '.join(missing)}; ./run python installs them")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        wheel = subprocess.run([sys.executable, HERE / "make_wheel.py", package, tool, folder], check=True, capture_output=True, text=True).stdout.strip()
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", folder / "venv"], check=True)
        python = folder / "venv" / "bin" / "python3"
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", wheel], check=True)
        (folder / "empty").mkdir()
        print(f"{Path(wheel).name}: {Path(wheel).stat().st_size / 1e6:.1f} MB", flush=True)
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        return subprocess.run([python, "-m", "pytest", "-q", "-p", "no:cacheprovider", HERE / "tests", *arguments], cwd=folder / "empty",
                              env={**environment, "CONTACT_ORACLE_TOOL": str(Path(tool).resolve())}).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
