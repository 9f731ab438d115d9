"""The command contact-oracle, asked about an engine that lives in this process.

The command starts its engines as programs. Here the program is a few lines that carry what the host says to this process, and the answers
back.
"""
from __future__ import annotations

import contextlib
import os
import pathlib
import shlex
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping
from typing import Any

from .engines import Engine
from .errors import InputError
from .serving import Conversation

START_LIMIT = 60
# The path of a socket has at most 107 bytes, on macOS 103: a name in a temporary folder takes 19 of them.
LONGEST_FOLDER = 84

# Reads of 1 byte or more as they come: what waits to be full would wait for ever.
CARRIER = """
import os, socket, sys, threading
s = socket.socket(socket.AF_UNIX); s.connect(sys.argv[1])
def carry(read, write, end):
    while data := read(1 << 16): write(data)
    end()
threading.Thread(target=carry, args=(lambda n: os.read(0, n), s.sendall, lambda: s.shutdown(socket.SHUT_WR)), daemon=True).start()
carry(s.recv, lambda data: [sys.stdout.buffer.write(data), sys.stdout.buffer.flush()], lambda: None)
"""


def command() -> str:
    """The command's path: what CONTACT_ORACLE_TOOL says, what a wheel holds or a build has beside this package, or what is on the path.

    What came with the package comes first: it is of the same version.
    """
    here = pathlib.Path(__file__).parent
    places: list[str | os.PathLike[str] | None] = [os.environ.get("CONTACT_ORACLE_TOOL"), here / "bin" / "contact-oracle",
                                                   here.parent.parent / "contact-oracle", shutil.which("contact-oracle")]
    for place in places:
        if place is not None and os.path.isfile(place) and os.access(place, os.X_OK):
            return str(place)
    raise InputError("the command contact-oracle is not on the path, and CONTACT_ORACLE_TOOL does not name it")


@contextlib.contextmanager
def _answering(engine: Engine, hello: Mapping[str, Any], scalar: str, path: str) -> Iterator[None]:
    """Answers every program that connects to the path, each on a thread of its own."""
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(path)
        listener.listen()

        def answer(connection: socket.socket) -> None:
            with connection, contextlib.suppress(OSError):
                Conversation(engine, dict(hello), scalar).converse(connection.fileno(), connection.fileno())

        def accept() -> None:
            # Closing a listener does not wake who waits for it; a last connection does.
            while not done.is_set():
                connection, _ = listener.accept()
                threading.Thread(target=answer, args=(connection,), daemon=True).start()

        done = threading.Event()
        thread = threading.Thread(target=accept, daemon=True)
        thread.start()
        try:
            yield
        finally:
            done.set()
            with socket.socket(socket.AF_UNIX) as last:
                last.connect(path)
            thread.join()


def ask_command(verb: str, options: list[str], engine: Engine, declared: Mapping[str, Any], scalar: str) -> dict[str, Any]:
    """Runs a verb of the command on the engine: its exit status, and what it wrote as text, JSON and JUnit."""
    hello = {"op": "hello", "protocol": 1, **declared}
    place = "/tmp" if len(os.fsencode(tempfile.gettempdir())) > LONGEST_FOLDER else None
    with tempfile.TemporaryDirectory(dir=place) as folder:
        path = os.path.join(folder, "engine")
        carrier = shlex.join([sys.executable, "-S", "-c", CARRIER, path])
        with _answering(engine, hello, scalar, path):
            done = subprocess.run([command(), verb, "--engine-command", carrier, "--start-limit", str(START_LIMIT), "--jobs", "1", *options,
                                   "--json", os.path.join(folder, "json"), "--junit", os.path.join(folder, "junit")],
                                  capture_output=True, text=True)
        files = {kind: pathlib.Path(folder, kind) for kind in ("json", "junit")}
        written = {kind: file.read_text(encoding="utf-8") if file.exists() else "" for kind, file in files.items()}
    return {"exit": done.returncode, "text": done.stdout or done.stderr, **written}
