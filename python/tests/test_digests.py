"""The answers have the digests that golden/manifest.json records of every platform: docs/formats.md#digests."""
import hashlib
import json
from pathlib import Path

import every_example
import numpy as np
import pytest

from contact_oracle import _core

MANIFEST = Path(__file__).resolve().parents[2] / "golden" / "manifest.json"


def streams():
    """Every fortieth; all of them with every example. Production itself gives all digests in every run of the tests."""
    files = [file for file in json.loads(MANIFEST.read_text())["files"] if file["origin"] == "generated" and file["family"] != "invalid"]
    step = 1 if every_example.EVERY else 40
    return [pytest.param(file, id=file["path"]) for file in files[::step]]


def digest(pair, answers):
    """Of the bytes of each answer, one behind the other."""
    sha256 = hashlib.sha256()
    numbers = None
    if "value" in answers:
        numbers = np.concatenate([answers["normal"], answers["point1"], answers["point2"], answers["value"][:, None]], axis=1).astype(">f8")
        kinds = answers["degenerate"] + 2 * ~answers["unique"]
    for row, hit in enumerate(answers["hit"]):
        sha256.update(bytes([int(hit)]))
        if hit and numbers is not None:
            sha256.update(bytes([int(kinds[row])]) + numbers[row].tobytes())
    return sha256.hexdigest()


@pytest.mark.parametrize("file", streams())
def test_answers_have_the_digest_of_every_platform(file):
    count = min(map(int, file["digests"]))
    columns, alarm, contact = _core.generate(file["pair"], file["family"], count, file["seed"], file["scalar"], 0)
    columns, alarm, contact = [np.asarray(c, float) for c in columns], np.asarray(alarm, float), np.asarray(contact, float)
    answers = _core.contacts(file["pair"], columns, alarm, contact, "nearest_surface", file["scalar"])
    assert digest(file["pair"], answers) == file["digests"][str(count)]
