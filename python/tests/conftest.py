"""What the tests share: pytest runs pytest here, without the plugin's entry point where the package is not installed."""
import importlib.metadata
import os
import pathlib
import signal

import pytest

pytest_plugins = ["pytester"]

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A shell that runs this in its background ignores it, and so would every process that is started here.
signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_configure(config):
    # Processes that tests start find the package where this one does.
    import contact_oracle

    folder = str(pathlib.Path(contact_oracle.__file__).parent.parent)
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [folder, os.environ.get("PYTHONPATH")]))


@pytest.fixture
def plugin():
    """Arguments that load the plugin."""
    installed = any(entry.value == "contact_oracle.pytest_plugin" for entry in importlib.metadata.entry_points(group="pytest11"))
    return [] if installed else ["-p", "contact_oracle.pytest_plugin"]


@pytest.fixture
def golden():
    return ROOT / "golden"


@pytest.fixture
def tool():
    """The command, where the environment names it."""
    path = os.environ.get("CONTACT_ORACLE_TOOL")
    if not path:
        pytest.skip("CONTACT_ORACLE_TOOL names no contact-oracle")
    return path
