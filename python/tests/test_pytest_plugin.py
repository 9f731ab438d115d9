"""The plugin, by the file that a user writes."""
import json
import pathlib

import pytest

import contact_oracle
import contact_oracle.laws

TESTS = pathlib.Path(__file__).parent

FILE = """
import sys; sys.path.insert(0, {tests!r})
import contact_oracle, pytest
import engines

@pytest.fixture(scope="session")
def contact_engine():
    return engines.{engine}

test_contacts = contact_oracle.suite({arguments})
"""


def runner(pytester, plugin, run_pytest):
    def run(engine, arguments, *options, more=""):
        pytester.makepyfile(FILE.format(tests=str(TESTS), engine=engine, arguments=arguments) + more)
        return run_pytest(*plugin, "-ra", "-p", "no:cacheprovider", "--strict-markers", *options)

    return run


@pytest.fixture
def run(pytester, plugin):
    return runner(pytester, plugin, pytester.runpytest_subprocess)


@pytest.fixture
def run_here(pytester, plugin):
    """In this process, where few questions are asked: to read NumPy, Hypothesis and the package anew would take longer than the rest."""
    return runner(pytester, plugin, pytester.runpytest_inprocess)


def test_a_right_engine_passes(run):
    result = run("right", '"sphere_sphere", count=10', "-v", "--contact-seed", "3", "--contact-max-examples", "20")
    result.stdout.fnmatch_lines(["contact_oracle: --contact-seed=3", "*::test_contacts[[]golden-sphere_sphere-touching] PASSED*",
                                 "*::test_contacts[[]law-swap] PASSED*"])
    outcomes = result.parseoutcomes()
    laws = len(contact_oracle.laws.laws_about(("sphere_sphere",)))
    families = sum(not family["outside_domain"] for family in contact_oracle.families("sphere_sphere"))
    assert sum(outcomes.values()) == laws + families and not outcomes.get("failed") and result.ret == 0, outcomes


def test_a_wrong_engine_fails_with_a_question_expected_and_got(run):
    result = run("strict_spheres", '"sphere_sphere", ["touching"], "decision"', "--contact-seed", "3")
    result.assert_outcomes(failed=2)
    text = result.stdout.str()
    for part in ("REFUTED", "  question  {", "  expected  {", "  got       {", "question 1  {", "again with --contact-seed 3"):
        assert part in text, text
    line = next(line for line in text.splitlines() if "  question  {" in line).split("question  ")[1]
    assert "sphere_sphere" in contact_oracle.explain(line)
    assert result.ret == 1


def test_golden_files_take_the_place_of_generated_cases(run_here, golden):
    result = run_here("right", '["sphere_sphere", "cube_cube"], laws=False', "-v", f"--contact-golden={golden}")
    result.stdout.fnmatch_lines(["*[[]golden-sphere_sphere-hardest] PASSED*"])
    result.stdout.fnmatch_lines(["*[[]golden-cube_cube-generic-binary32] PASSED*"])
    assert result.ret == 0


@pytest.mark.parametrize("arguments, options, message", [
    ('"sphere_sphere"', ["--contact-golden={golden}/cube_cube"], "no golden cases of sphere_sphere in binary64"),
    ('"sphere_sphere"', ["--contact-golden=nowhere"], "datasets: is not there, got nowhere"),
    ('"sphere_sphere", laws="gravity"', [], "no law 'gravity'"), ('"sphere_sphere", "cheese"', [], "families: is a family of none of the pairs"),
])
def test_what_cannot_be_asked_is_named_before_any_test(run_here, golden, arguments, options, message):
    result = run_here("right", arguments, *(option.format(golden=golden) for option in options))
    assert result.ret == 2
    result.stdout.fnmatch_lines([f"*{message}*"])


def test_known_failures_are_listed_in_files(run, pytester):
    (pytester.path / "xfails.txt").write_text("# known\ngolden-sphere_sphere-touching  # strict\ngolden-sphere_sphere-generic\n")
    (pytester.path / "skips.txt").write_text("law-decision\n")
    result = run("strict_spheres", '"sphere_sphere", ["touching", "generic"], ["decision", "repeatable"]', "--contact-xfails-file=xfails.txt",
                 "--contact-skips-file=skips.txt", "--contact-seed", "1")
    result.assert_outcomes(xfailed=1, xpassed=1, skipped=1, passed=1)
    result.stdout.fnmatch_lines(["*xfails.txt:2*"])
    assert result.ret == 0
    assert run("right", '"sphere_sphere"', "--contact-xfails-file=nowhere.txt").ret == 4
    (pytester.path / "latin.txt").write_bytes(b"# caf\xe9\n")
    assert run("right", '"sphere_sphere"', "--contact-xfails-file=latin.txt").ret == 4


def test_how_many_questions_a_law_is_asked_is_a_number_from_1(run_here):
    for number in ("0", "-3", "many"):
        assert run_here("right", '"sphere_sphere", (), "swap"', f"--contact-max-examples={number}").ret == 4


def test_markers_choose(run):
    result = run("right", '"cube_cube", count=5', "-m", "contact_law", "--contact-max-examples", "5", "-q")
    outcomes = result.parseoutcomes()
    assert outcomes["deselected"] == sum(not family["outside_domain"] for family in contact_oracle.families("cube_cube"))


def test_fixtures_say_what_answers_mean(run_here):
    more = """
@pytest.fixture(scope="session")
def contact_conventions():
    return {"normal": "second-to-first"}

@pytest.fixture(scope="session")
def contact_tolerance():
    return {"length": 1e-9, "relative": 1e-9, "angle": 1e-9}
"""
    run_here("reversed_normal", '"sphere_sphere", "generic", "bounds"', more=more).assert_outcomes(passed=1, skipped=1)
    run_here("reversed_normal", '"sphere_sphere", "generic", "bounds"').assert_outcomes(failed=2)


TOLERANCE = """
@pytest.fixture(scope="session")
def contact_tolerance():
    return {"length": 1e-9, "relative": 1e-12, "angle": 1e-6}
"""


def test_laws_forgive_what_the_tolerance_forgives_in_golden_cases(run):
    arguments = '"sphere_sphere", ["generic", "touching"], ["decision", "alarm_growth", "bounds"], count=20'
    options = ("--contact-seed", "3", "--contact-max-examples", "30")
    run("strict_spheres", arguments, *options, more=TOLERANCE).assert_outcomes(passed=5)
    run("strict_spheres", arguments, *options).stdout.fnmatch_lines(["FAILED *law-decision*"])


@pytest.mark.parametrize("engine, laws", [("reversed_normal", ["bounds"]), ("twice_the_tolerance_off", ["bounds"]), ("forgets_a_radius", ["decision"])])
def test_what_a_tolerance_does_not_forgive_fails_and_is_shown_once(run, engine, laws):
    result = run(engine, f'"sphere_sphere", "generic", {laws!r}, count=20', "--contact-seed", "3", "--contact-max-examples", "50", more=TOLERANCE)
    result.stdout.fnmatch_lines([f"FAILED *law-{laws[0]}*"])
    text = result.stdout.str()
    assert "During handling of the above exception" not in text and "direct cause" not in text, text
    assert text.split("short test summary")[0].count(f"{laws[0]}: ") == 1, text


def test_an_engine_that_raises_shows_its_own_trace(run_here):
    result = run_here("raises", '"sphere_sphere", "generic", "swap"')
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["*KeyError: 'no such shape'*"])


def test_without_an_engine_the_message_says_what_to_do(pytester, plugin):
    pytester.makepyfile("import contact_oracle\ntest_contacts = contact_oracle.suite('cube_cube', 'generic', False)")
    result = pytester.runpytest_inprocess(*plugin, "-p", "no:cacheprovider")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*define a fixture contact_engine*"])


def test_without_hypothesis_the_laws_are_a_test_that_is_skipped(run):
    result = run("right", '"cube_cube", "generic", count=5', "-p", "no:hypothesispytest", more="\nsys.modules['hypothesis'] = None\n")
    result.assert_outcomes(passed=1, skipped=1)
    result.stdout.fnmatch_lines(["*the laws need Hypothesis*"])


def test_other_tests_are_left_alone(pytester, plugin):
    pytester.makepyfile("def test_nothing(): pass")
    result = pytester.runpytest_inprocess(*plugin, "-p", "no:cacheprovider")
    result.assert_outcomes(passed=1)
    result.stdout.no_fnmatch_line("*contact*seed*")


def test_the_seed_is_drawn_and_said(run):
    result = run("right", '"cube_cube", "generic", "swap", count=5', "--contact-max-examples", "5")
    result.stdout.fnmatch_lines(["contact_oracle: --contact-seed=*"])
    result.assert_outcomes(passed=2)
