"""Verdicts on engines, and what becomes of engines that do not answer."""
import json
import pathlib
import subprocess
import sys
import tempfile

import engines
import numpy as np
import pytest

import contact_oracle
from contact_oracle import EngineError, InputError
from contact_oracle.serving import lines_of


def test_a_right_engine_is_certified():
    report = contact_oracle.certify(engines.right, count=5, seed=1, level="correctly-rounded")
    assert report.certified and report and report.level == "correctly-rounded" and report.failures == [] and report.seed == 1
    assert {family["pair"] for family in report.families} == set(contact_oracle.PAIRS)
    assert "CERTIFIED" in str(report) and "Generated from seed 1." in str(report)


def test_a_right_engine_is_certified_in_single_precision():
    report = contact_oracle.certify(engines.right, count=3, seed=1, scalar="binary32", level="correctly-rounded")
    assert report.certified and {family["scalar"] for family in report.families} == {"binary32"}


def test_a_plain_engine_is_refuted_and_the_failures_can_be_explained(tmp_path):
    report = contact_oracle.certify(engines.plain_spheres, "sphere_sphere", "touching", seed=1)
    assert not report.certified and not report and report.level == "none" and report.failure_count == len(report.failures) > 0
    assert "REFUTED" in report.verdict and any("rounded" in line for line in report.diagnosis)
    assert "D = reach^2" in contact_oracle.explain(report.failures[0]["line"]) or "MISS" in contact_oracle.explain(report.failures[0]["line"])
    assert report.fitness["all"]["answers"] == 200 and report.worst[0]["claimed"]
    assert report.to_html(tmp_path / "report.html") == (tmp_path / "report.html").read_text()
    assert json.loads(report.to_json(tmp_path / "report.json"))["certified"] is False
    assert report.to_junit().startswith("<?xml") and "|" in report.to_markdown()
    assert report._repr_html_().startswith("<iframe srcdoc=") and "<html" not in report._repr_html_()
    pytest.importorskip("pandas")
    frame = report.to_dataframe()
    assert frame["family"].tolist() == ["touching"] and frame["missed_hits"][0] > 0


def test_an_engine_is_judged_by_what_it_declares():
    refuted = contact_oracle.certify(engines.reversed_normal, "sphere_sphere", "generic", seed=1)
    assert not refuted.certified and any("second-to-first" in line for line in refuted.diagnosis)
    assert contact_oracle.certify(engines.reversed_normal, "sphere_sphere", "generic", seed=1, conventions={"normal": "second-to-first"})
    hit_alone = lambda questions: {"hit": questions.answer().hit}
    report = contact_oracle.certify(hit_alone, "sphere_sphere", "touching", seed=1, level="decisions", claims=["overlap"])
    assert report.certified and report.level == "decisions"


def test_a_tolerance_takes_the_place_of_a_level():
    single = lambda questions: {name: array.astype(float) if array.dtype.kind == "f" else array for name, array in
                                engines.plain_spheres(questions_in_single(questions)).items()}
    asked = dict(pairs="sphere_sphere", families="generic", seed=1)
    assert not contact_oracle.certify(single, **asked)
    report = contact_oracle.certify(single, **asked, tolerance={"length": 1e-4, "angle": 1e-4})
    assert report.certified and "within length 0.0001" in report.verdict
    assert contact_oracle.certify(single, **asked, profile="game").certified
    with pytest.raises(InputError, match="tolerance: cannot stand beside a profile"):
        contact_oracle.certify(single, **asked, profile="game", tolerance={"length": 1})
    with pytest.raises(InputError):
        contact_oracle.certify(single, **asked, profile="horseshoe")


def questions_in_single(questions):
    with np.errstate(over="ignore"):
        return contact_oracle.Questions(questions.pair, {name: questions[name].astype(np.float32) for name in questions.keys()})


def test_engines_by_pair():
    report = contact_oracle.certify({"cube_cube": engines.right, "sphere_sphere": engines.right}, count=5, seed=1)
    assert {family["pair"] for family in report.families} == {"cube_cube", "sphere_sphere"}
    with pytest.raises(InputError, match="pair: must be one of"):
        contact_oracle.certify({"cube_donut": engines.right})


@pytest.mark.parametrize("answer", [None, NotImplemented])
def test_no_answer_is_unsupported(answer):
    half = lambda questions: questions.answer() if questions.pair == "cube_cube" else answer
    report = contact_oracle.certify(half, ["cube_cube", "sphere_sphere"], "generic", count=10, seed=1)
    assert not report.certified and report.data["total"]["answers"]["unsupported"] == 10
    assert contact_oracle.certify(half, ["cube_cube", "sphere_sphere"], "generic", count=10, seed=1, allow_unsupported=True, level="decisions").certified


def test_published_answers_alone_do_not_certify(golden):
    published = golden / "sphere_sphere" / "generic.jsonl"
    known = {json.loads(line)["id"] for line in published.read_text().splitlines()[1:]}

    def looks_up(questions):
        right = questions.answer()
        ids = np.isin(questions.id, list(known))
        return {"hit": right.hit & ids, "normal": right.normal, "point1": right.point1, "point2": right.point2, "value": right.value}

    assert contact_oracle.certify(looks_up, "sphere_sphere", datasets=published, fresh=0)
    report = contact_oracle.certify(looks_up, "sphere_sphere", datasets=published, seed=1)
    assert not report.certified and report.level == "none" and "is right on published questions alone" in report.verdict
    assert report.failure_count == len(report.failures) == report.data["fresh"]["total"]["hits"]


def test_who_always_says_hit_is_not_conservative():
    always = lambda questions: {"hit": np.ones(len(questions), bool)}
    asked = {"pairs": "sphere_sphere", "families": "generic", "seed": 1, "level": "conservative", "claims": ["overlap"]}
    report = contact_oracle.certify(always, **asked)
    assert not report.certified and report.data["falls_short"] == ["its overlap is hit every time"]
    assert contact_oracle.certify(always, **asked, least_judged=0)
    assert not contact_oracle.certify(always, **asked, least_judged=0, within=1e-3)
    with pytest.raises(InputError, match="within: is of the level conservative"):
        contact_oracle.certify(always, "sphere_sphere", within=1)


def test_golden_files_are_judged(golden):
    report = contact_oracle.certify(engines.right, "sphere_sphere", datasets=golden, scalar="binary64", fresh=0)
    assert report.certified and report.seed is None and report.data["total"]["cases"] > 1000
    assert report.verdict.endswith("On published questions alone: --fresh 0 left fresh ones out.")
    one = contact_oracle.certify(engines.plain_spheres, "sphere_sphere", datasets=golden / "sphere_sphere" / "generic.jsonl", seed=1)
    assert one.certified and one.data["total"]["cases"] == 210
    assert (one.seed, one.data["fresh"]["seed"], one.data["fresh"]["total"]["cases"]) == (1, 1, 100)
    with pytest.raises(InputError, match="seed: chooses fresh questions"):
        contact_oracle.certify(engines.right, datasets=golden, fresh=0, seed=1)
    with pytest.raises(InputError, match="datasets: is not there"):
        contact_oracle.certify(engines.right, datasets="nowhere")
    with pytest.raises(InputError, match="no question to judge"):
        contact_oracle.certify(engines.right, "cube_cube", datasets=golden / "sphere_sphere")


def test_what_else_stands_beside_golden_files_is_passed_over_or_named(tmp_path):
    contact_oracle.write_dataset(tmp_path / "questions.jsonl", contact_oracle.generate("sphere_sphere", "generic", 20, seed=1))
    np.savez(tmp_path / "answers.npz", header=json.dumps({"format": "contact-oracle/results", "version": 1}), hit=np.ones(20, bool))
    judged = lambda: contact_oracle.certify(engines.right, "sphere_sphere", datasets=tmp_path, fresh=0)
    assert judged().data["total"]["cases"] == 20
    (tmp_path / "bad.jsonl").write_text('{"format":"contact-oracle/dataset","version":1}\n')
    with pytest.raises(InputError, match="bad.jsonl:1: pair: missing"):
        judged()
    (tmp_path / "bad.jsonl").unlink()
    (tmp_path / "nowhere.jsonl").symlink_to(tmp_path / "gone.jsonl")
    with pytest.raises(InputError, match="nowhere.jsonl: cannot read"):
        judged()
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="empty: no dataset"):
        contact_oracle.certify(engines.right, datasets=tmp_path / "empty")


def test_without_a_question_no_case_is_judged():
    with pytest.raises(InputError, match="no case was judged; there is none$"):
        contact_oracle.certify(engines.right, "sphere_sphere", "generic", count=0)


def test_the_engine_that_raises_is_named_with_its_first_question():
    with pytest.raises(EngineError, match="sphere_sphere: the engine raised KeyError: 'no such shape'") as caught:
        contact_oracle.certify(engines.raises, "sphere_sphere", "generic", seed=1)
    assert isinstance(caught.value.__cause__, KeyError) and caught.value.pair == "sphere_sphere"
    assert "sphere_sphere" in contact_oracle.explain(caught.value.line)


@pytest.mark.parametrize("answers, message", [
    ({}, "no answer: give a dict"), (5, "no answer: give a dict or an object with some of hit.*got int"),
    ({"hits": [True]}, "an answer has no 'hits'"), ({"hit": [0.5] * 10}, "hit must be truth values"),
    ({"hit": np.ones(9, bool)}, r"hit must have the shape \(10,\), a row a question, got \(9,\)"),
    ({"hit": np.ones(10, bool), "normal": np.zeros((3, 10))}, r"normal must have the shape \(10, 3\)"),
    ({"hit": np.ones(10, bool), "value": np.zeros(10, complex)}, "value must be binary64 or binary32"),
    ({"hit": np.ones(10, bool), "value": ["a"] * 10}, "value must be"),
])
def test_what_is_no_answer_is_named(answers, message):
    with pytest.raises(EngineError, match=message):
        contact_oracle.certify(lambda questions: answers, "sphere_sphere", "generic", count=10, seed=1, claims=["overlap"])


def test_answers_in_double_are_none_of_an_engine_in_single():
    with pytest.raises(EngineError, match="value is binary64, and the engine's scalar is binary32"):
        contact_oracle.certify(lambda q: {"hit": q.answer().hit, "value": np.zeros(len(q))}, "sphere_sphere", "generic", scalar="binary32", seed=1)


def test_tensors_are_answers():
    torch = pytest.importorskip("torch")

    def engine(questions):
        right = questions.answer()
        value = torch.from_numpy(right.value).requires_grad_() * 1
        return {"hit": torch.from_numpy(right.hit), "value": value}

    assert contact_oracle.certify(engine, "sphere_sphere", "generic", seed=1, claims=["overlap", "contact", "value"]).certified


def test_an_engine_in_its_own_process():
    report = contact_oracle.certify(engines.right, "sphere_sphere", "generic", seed=1, isolated=True)
    assert report.certified
    with pytest.raises(EngineError, match="process ended, with exit status 7"):
        contact_oracle.certify(engines.dies, "sphere_sphere", "generic", seed=1, isolated=True)
    with pytest.raises(EngineError, match="KeyError"):
        contact_oracle.certify(engines.raises, "sphere_sphere", "generic", seed=1, isolated=True)
    with pytest.raises(EngineError, match="no answer within 0.5 seconds"):
        contact_oracle.certify(engines.hangs, "sphere_sphere", "generic", seed=1, isolated=True, time_limit=0.5)
    with pytest.raises(InputError, match="engine: cannot be sent to another process"):
        contact_oracle.certify(lambda questions: None, "sphere_sphere", "generic", seed=1, isolated=True)
    with pytest.raises(InputError, match="time_limit: needs isolated"):
        contact_oracle.certify(engines.right, "sphere_sphere", "generic", seed=1, time_limit=1)


@pytest.mark.parametrize("named", [dict(level="good"), dict(pairs="sphere_donut"), dict(families="cheese"), dict(scalar="half"), dict(pairs=[]),
                                   dict(conventions={"normal": "sideways"}), dict(bounds={"value": 1000}), dict(rounds=["radius"]), dict(engine=5),
                                   dict(count=float("nan")), dict(bounds={"value": float("nan")}), dict(tolerance={"length": float("inf")}),
                                   dict(level="conservative", within=-1), dict(level="conservative", within=float("nan")),
                                   *(dict(isolated=True, time_limit=seconds) for seconds in (0, -1, float("nan"), "1"))])
def test_wrong_arguments_are_refused(named):
    with pytest.raises(InputError):
        contact_oracle.certify(**{**dict(engine=engines.right, pairs="sphere_sphere", families="generic", count=3, seed=1), **named})


def test_numbers_of_numpy_are_numbers():
    report = contact_oracle.certify(engines.right, "sphere_sphere", "generic", count=np.int64(20), seed=np.uint32(3), least_judged=np.int8(5),
                                    bounds={"value": np.int32(2)}, determinism=np.bool_(True))
    assert report.certified and report.data["total"]["judged"] == 20
    assert contact_oracle.certify(engines.right, "sphere_sphere", "generic", count=20, seed=3, tolerance={"length": np.float32(0.5)})


def test_what_is_rounded_before_the_engine_sees_it_is_declared():
    report = contact_oracle.certify(engines.right, "sphere_sphere", "generic", count=20, seed=1, rounds=["orientation"])
    assert report.certified and json.loads(report.to_json())["rounds"] == ["orientation"]


def test_an_engine_that_gives_other_bits_is_not_deterministic():
    state = [0]

    def unsteady(questions):
        state[0] += 1
        right = questions.answer()
        return {"hit": right.hit, "value": np.nextafter(right.value, np.inf) if state[0] % 2 else right.value}

    asked = dict(pairs="sphere_sphere", families="generic", count=50, seed=1, claims=["overlap", "contact", "value"])
    assert contact_oracle.certify(unsteady, **asked).certified
    assert not contact_oracle.certify(unsteady, **asked, determinism=True).certified


def midpoints(questions):
    """As MuJoCo and Newton answer: one position, half way between the surfaces."""
    answers = engines.plain_spheres(questions)
    middle = answers["point1"] + (answers["point2"] - answers["point1"]) / 2
    return {"hit": answers["hit"], "normal": answers["normal"], "point": middle, "value": answers["value"]}


def test_one_point_is_the_middle():
    report = contact_oracle.certify(midpoints, "sphere_sphere", "generic", seed=1)
    assert report.certified and "point" in report.data["total"]["fields"], str(report)
    boxes_first = contact_oracle.certify({"cube_cube": engines.right, "sphere_sphere": midpoints}, families="generic", seed=1)
    assert boxes_first.certified


def corners_over_a_plane(questions, most=4):
    """The deepest corners of each box, on the box, and how deep each is below the plane. In double numbers, as anybody would."""
    length = np.sqrt((questions.normal2 * questions.normal2).sum(axis=1))
    up = questions.normal2 / length[:, np.newaxis]
    ends = np.stack((questions.min1, questions.max1), axis=1)
    places = np.stack([np.stack([ends[:, i >> axis & 1, axis] for axis in range(3)], axis=1) for i in range(8)], axis=1)
    depths = (questions.offset2 / length)[:, np.newaxis] - (places * up[:, np.newaxis]).sum(axis=2)
    deepest = np.argsort(-depths, axis=1)[:, :most]
    rows = np.arange(len(places))[:, np.newaxis]
    places, depths = places[rows, deepest], depths[rows, deepest]
    return {"hit": -depths[:, 0] <= questions.alarm, "normal": -up, "points": places, "depths": depths}


def test_several_points_are_judged_each():
    asked = dict(pairs="cube_plane", families="generic", count=60, seed=1, tolerance={"length": 1e-9, "angle": 1e-9})
    report = contact_oracle.certify(corners_over_a_plane, **asked)
    hits = report.data["total"]["fields"]["points"]
    assert report.certified and report.data["claims"] == ["overlap", "contact", "normal", "points"] and sum(hits[grade] for grade in hits if isinstance(hits[grade], int)) > 10, str(report)

    def fewer(questions):
        """Those that are above the plane are not there."""
        answers = corners_over_a_plane(questions)
        there = (answers["depths"] >= 0) | (np.arange(4) == 0)
        return answers | {"points": np.where(there[:, :, np.newaxis], answers["points"], np.nan), "depths": np.where(there, answers["depths"], np.nan)}

    assert contact_oracle.certify(fewer, **asked).certified

    assert lines_of({"hit": np.array([True, False]), "points": np.array([[[1, 2, 3], [np.nan] * 3, [4, 5, 6], [np.nan] * 3]] * 2, float),
                     "depths": np.array([[1, np.nan, 0, np.nan]] * 2)}) == \
        [{"overlap": True, "contact": {"points": [[1, 2, 3], ["NaN"] * 3, [4, 5, 6]], "depths": [1, "NaN", 0]}}, {"overlap": False, "contact": None}]

    def not_deepest(questions):
        answers = corners_over_a_plane(questions)
        return answers | {"points": answers["points"][:, 1:], "depths": answers["depths"][:, 1:]}

    def one_depth(questions):
        answers = corners_over_a_plane(questions)
        return answers | {"depths": np.repeat(answers["depths"][:, :1], 4, axis=1)}

    def moved(questions):
        answers = corners_over_a_plane(questions)
        return answers | {"points": answers["points"] + [1e-3, 0, 0]}

    def too_many(questions):
        return corners_over_a_plane(questions, 5)

    for wrong in (not_deepest, one_depth, moved):
        assert not contact_oracle.certify(wrong, **asked).certified, wrong.__name__
    assert contact_oracle.certify(too_many, **asked).certified
    assert not contact_oracle.certify(too_many, **asked, conventions={"points": "manifold", "most_points": 4}).certified
    for answer, message in (({"points": np.zeros((1, 65, 3)), "depths": np.zeros((1, 65))}, "from 1 to 64"), ({"points": np.zeros((1, 3))}, "must have the shape"),
                            ({"points": np.zeros((1, 2, 3))}, "go together"), ({"points": np.zeros((1, 2, 3)), "depths": np.zeros((1, 3))}, "go together")):
        with pytest.raises(contact_oracle.EngineError, match=message):
            contact_oracle.certify(lambda questions: {"hit": np.ones(1, bool), **answer}, **asked)


def test_a_fault_of_the_oracle_is_no_verdict(monkeypatch):
    def fault(*_):
        raise contact_oracle._core.OracleFault("two oracles differ")

    monkeypatch.setattr(contact_oracle._core, "certify", fault)
    with pytest.raises(contact_oracle.OracleDisagreement, match="two oracles differ"):
        contact_oracle.certify(engines.right, "sphere_sphere", "generic", seed=1)


def test_laws_of_the_command_hold_of_a_right_engine_and_name_a_mistake(tool):
    report = contact_oracle.properties(engines.right, "sphere_sphere", cases=30, seed=1)
    assert report.holds and report.violated == [] and report.seed == 1
    report = contact_oracle.properties(engines.reversed_normal, "sphere_sphere", "direction", cases=100, seed=1)
    assert not report.holds and [law["law"] for law in report.violated] == ["direction"]
    assert report.violated[0]["questions"][0]["query"]["pair"] == "sphere_sphere" and "direction VIOLATED" in str(report)
    with pytest.raises(InputError, match="gravity"):
        contact_oracle.properties(engines.right, laws="gravity")
    with pytest.raises(EngineError, match="KeyError"):
        contact_oracle.properties(engines.raises, "sphere_sphere", "swap", cases=10, seed=1)


def test_laws_are_asked_where_the_temporary_folder_has_a_long_name(tool, monkeypatch, tmp_path):
    # A socket's name may be no longer than 107 bytes.
    folder = tmp_path / ("long" * 30)
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    assert contact_oracle.properties(engines.right, "sphere_sphere", "swap", cases=10, seed=1).holds


def test_without_the_command_its_laws_are_not_asked(monkeypatch, tmp_path):
    monkeypatch.setattr("contact_oracle.by_command.__file__", str(tmp_path / "contact_oracle" / "by_command.py"))
    monkeypatch.delenv("CONTACT_ORACLE_TOOL", raising=False)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(InputError, match="contact-oracle is not on the path"):
        contact_oracle.properties(engines.right, "sphere_sphere", "swap")


SERVED = """
import engines, contact_oracle
print("a greeting that must not reach the host")
contact_oracle.serve({"sphere_sphere": engines.%s}, name="served", version="2"%s)
"""


def conversation(tmp_path, engine, lines, more=""):
    script = tmp_path / "adapter.py"
    script.write_text(SERVED % (engine, more))
    text = "".join(json.dumps(line) + "\n" for line in lines)
    tests = str(pathlib.Path(__file__).parent)
    import os

    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([tests, os.environ["PYTHONPATH"]])}
    done = subprocess.run([sys.executable, str(script)], input=text, capture_output=True, text=True, timeout=60, env=environment)
    assert done.returncode == 0, done.stderr
    greeting, *replies = done.stdout.splitlines()
    return [json.loads(reply) for reply in replies], done


QUERY = {"op": "query", "seq": 1, "pair": "sphere_sphere", "a": {"center": [0, 0, 0], "radius": 1.5}, "b": {"center": [1, 2, 2], "radius": 1.5},
         "alarm": 0, "contact": 0.25}


def test_a_script_serves_the_protocol(tmp_path):
    far = {**QUERY, "seq": 2, "b": {"center": [9, 0, 0], "radius": 1}}
    bad = {**QUERY, "seq": 3, "a": {"center": ["NaN", 0, 0], "radius": 1}}
    replies, _ = conversation(tmp_path, "right", [{"op": "hello", "protocol": 1}, QUERY, far, bad, {"op": "stop"}])
    hello, *answers = replies
    assert hello == {"op": "hello", "protocol": 1, "engine": {"name": "served", "version": "2"}, "scalar": "binary64", "pairs": ["sphere_sphere"]}
    by_seq = {answer["seq"]: answer for answer in answers}
    assert by_seq[1]["overlap"] is True and by_seq[1]["contact"]["value"] == -0.25 and by_seq[1]["contact"]["point1"] == [0.5, 1, 1]
    assert by_seq[2] == {"op": "answer", "seq": 2, "overlap": False, "contact": None}
    assert by_seq[3]["rejected"] == "a.center[0]"


def test_an_engine_that_raises_serves_errors(tmp_path):
    replies, _ = conversation(tmp_path, "raises", [{"op": "hello", "protocol": 1}, QUERY])
    assert replies[1]["error"] == "KeyError: 'no such shape'"


@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
def test_the_command_certifies_a_script(tmp_path, tool, golden, scalar):
    import os

    script = tmp_path / "adapter.py"
    script.write_text(SERVED.replace('print("a greeting that must not reach the host")\n', "") % ("right", f", scalar={scalar!r}"))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(pathlib.Path(__file__).parent), os.environ["PYTHONPATH"]])}
    done = subprocess.run([tool, "certify", str(golden / "sphere_sphere"), "--engine-command", f"{sys.executable} {script}", "--level", "correctly-rounded",
                           "--start-limit", "60"], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "CERTIFIED: served 2 reaches correctly-rounded" in done.stdout and f"served 2 ({scalar})" in done.stdout
