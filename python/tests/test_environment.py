"""The caller's floating-point environment, which changes no bit of an answer and is the engine's own: libraries that are imported set it."""
import contextlib
import ctypes
import platform
import subprocess
import sys

import every_example
import numpy as np
import pytest

import contact_oracle
from contact_oracle import _core
from contact_oracle.pairs import PAIRS

pytestmark = pytest.mark.skipif(platform.machine() != "x86_64" or platform.libc_ver()[0] != "glibc", reason="sets the register of x86-64, by glibc")

# Bits of MXCSR: where to round, and what becomes of subnormal numbers.
ROUNDING = {"to nearest": 0, "downward": 0x2000, "upward": 0x4000, "toward zero": 0x6000}
FLUSHING = 0x8040
ENVIRONMENTS = {f"{rounding}{', flushing' * bool(flushing)}": bits | flushing for flushing in (0, FLUSHING) for rounding, bits in ROUNDING.items()}


@contextlib.contextmanager
def in_environment(bits):
    libm = ctypes.CDLL("libm.so.6")
    before = ctypes.create_string_buffer(32)  # its last four bytes are MXCSR
    libm.fegetenv(before)
    register = int.from_bytes(before.raw[28:], "little") & ~(0x6000 | FLUSHING) | bits
    # That of long double has its rounding two bits lower; glibc reads numbers by it.
    control = int.from_bytes(before.raw[:2], "little") & ~0xC00 | bits >> 3 & 0xC00
    libm.fesetenv(ctypes.create_string_buffer(control.to_bytes(2, "little") + before.raw[2:28] + register.to_bytes(4, "little"), 32))
    try:
        yield
    finally:
        libm.fesetenv(before)


def arithmetic():
    """What sums and products are made of one and a hair, and of subnormal numbers."""
    hair, least = np.array([2.0**-60, -(2.0**-60)]), np.array([5e-324])
    return ((1 + hair).tobytes(), (-1 + hair).tobytes(), (least * 2.0**60).tobytes())


def test_an_environment_is_set_and_left():
    before = arithmetic()
    seen = set()
    for bits in ENVIRONMENTS.values():
        with in_environment(bits):
            seen.add(arithmetic())
        assert arithmetic() == before
    assert len(seen) == len(ENVIRONMENTS)


def everything(pair, arrays, alarm, contact, line, scalar, path):
    """Bytes alone, since to compare numbers is arithmetic too."""
    family = "extreme_scale"
    said = [array.tobytes() for array in _core.contacts(pair, arrays, alarm, contact, "nearest_surface", scalar).values()]
    said.append(_core.hits(pair, arrays, alarm, contact).tobytes())
    said.append(_core.ids(pair, arrays, alarm, contact).tobytes())
    said += _core.cases(pair, arrays, alarm, contact, scalar)
    columns, *distances = _core.generate(pair, family, 5, 3, scalar)
    said += [column.tobytes() for column in (*columns, *distances)]
    said.append(_core.explain(line))
    if PAIRS[pair].numbers == "distance":
        found = _core.gradients(pair, arrays, alarm, contact)
        said += [found[name].tobytes() for name in ("derivatives", "sides", "why")]
    _core.write_dataset(str(path), pair, scalar, "mine", arrays, alarm, contact)
    said.append(path.read_bytes())
    header, columns = _core.read_dataset(str(path))
    said += [header, *(column.tobytes() for column in columns.values() if isinstance(column, np.ndarray))]
    return said


@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
@pytest.mark.parametrize("pair", PAIRS)
def test_what_the_core_says_is_the_same_in_every_environment(pair, scalar, tmp_path):
    names = [family["name"] for family in contact_oracle.families(pair)]
    assert "extreme_scale" in names
    for family in every_example.some(name for name in names if name != "invalid"):
        asked = contact_oracle.generate(pair, family, 5, seed=1, scalar=scalar).asked()
        line = str(contact_oracle.generate(pair, family, 1, seed=2, scalar=scalar)[0])
        given = (pair, asked.columns, asked.alarm, asked.contact, line, scalar, tmp_path / "mine.jsonl")
        expected = everything(*given)
        for name, bits in every_example.some(ENVIRONMENTS.items()):
            with in_environment(bits):
                said = everything(*given)
            assert said == expected, (family, name)


def test_alarm_distances_that_are_flushed_are_told_apart():
    """Those of a block are answered together where they are one."""
    centers = np.array([[0.0, 0, 0], [0, 0, 0]])
    with in_environment(FLUSHING):
        hits = _core.contacts("sphere_sphere", [centers, np.zeros(2), np.array([[5e-324, 0, 0]] * 2), np.zeros(2)], np.array([0, 5e-324]), np.zeros(2))["hit"]
    assert hits.tolist() == [False, True]


@pytest.mark.parametrize("name, bits", ENVIRONMENTS.items())
def test_an_engine_computes_in_its_callers_environment_and_the_judge_in_its_own(name, bits):
    seen = set()

    def engine(questions):
        seen.add(arithmetic())
        return questions.answer()

    given = (engine, "sphere_sphere", ["generic", "extreme_scale"])
    tolerance = dict(count=60, seed=1, tolerance={"length": 0.1, "relative": 1e-9, "angle": 1e-3})
    expected = contact_oracle.certify(*given, **tolerance).to_json()
    seen.clear()
    with in_environment(bits):
        report = contact_oracle.certify(*given, **tolerance)
        of_the_caller = arithmetic()
    assert seen == {of_the_caller}
    assert report.to_json() == expected


@pytest.mark.parametrize("call", ["questions.answer()", "contact_oracle.hits('hull_hull', **questions)", "contact_oracle.generate('hull_hull', 'generic', 1000)",
                                  "contact_oracle.certify(lambda asked: asked.answer(), 'hull_hull', 'generic', count=50, seed=1)"])
def test_a_program_may_end_while_another_thread_asks(call):
    """Python ends such a thread in the middle of a call."""
    script = f"""
import threading, time
import contact_oracle
questions = contact_oracle.generate("hull_hull", "generic", 200, seed=1)
began = threading.Event()
def ask():
    while True:
        began.set()
        {call}
for _ in range(2):
    threading.Thread(target=ask, daemon=True).start()
began.wait()
time.sleep(0.2)
print("the end")
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=100)
    assert (done.returncode, done.stdout, done.stderr) == (0, "the end\n", "")
