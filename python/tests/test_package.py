"""The package itself: signatures, stubs, documentation and examples."""
import ast
import doctest
import importlib
import importlib.util
import inspect
import json
import os
import pathlib
import re
import runpy
import shutil
import subprocess
import sys

import numpy as np
import pytest

import contact_oracle
import every_example
from contact_oracle.pairs import PAIRS

PACKAGE = pathlib.Path(contact_oracle.__file__).parent
ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "python" / "examples"
MODULES = ["answering", "arrays", "asked", "by_command", "contacts", "datasets", "engines", "errors", "exact_answers", "gradients", "judging", "laws", "pairs", "questions", "serving",
           "shapes", "shown", "strategies", "suites"]


@pytest.mark.parametrize("pair", PAIRS)
def test_functions_have_signatures_and_documentation(pair):
    function = getattr(contact_oracle, pair)
    signature = inspect.signature(function)
    names = [field.argument for field in PAIRS[pair].fields]
    assert list(signature.parameters) == [*names, "alarm", "contact", "points"]
    assert signature.parameters["alarm"].kind is inspect.Parameter.KEYWORD_ONLY and signature.parameters["alarm"].default == 0
    for word in (*names, "Units", "Domain", "Scalar", "Decision", "Error", "Degenerate", "Source"):
        assert word in function.__doc__
    assert function.__name__ == pair and function.__module__ == "contact_oracle"


def test_the_stub_says_what_the_functions_are():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    stubs = {node.name: node.args for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert list(stubs) == list(PAIRS)
    for pair, arguments in stubs.items():
        parameters = inspect.signature(getattr(contact_oracle, pair)).parameters.values()
        assert [a.arg for a in arguments.args] == [p.name for p in parameters if p.kind is p.POSITIONAL_OR_KEYWORD]
        assert [a.arg for a in arguments.kwonlyargs] == [p.name for p in parameters if p.kind is p.KEYWORD_ONLY]
    imported = {alias.asname for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names if alias.asname}
    assert set(contact_oracle.__all__) == imported | set(PAIRS) | {"PAIRS"}


def test_the_stub_of_the_module_has_what_the_module_has():
    tree = ast.parse((PACKAGE / "_core.pyi").read_text())
    assert {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))} == \
        {name for name in dir(contact_oracle._core) if not name.startswith("_")}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            # pybind11 writes the signature in the first line of the documentation.
            said = getattr(contact_oracle._core, node.name).__doc__.splitlines()[0]
            assert [argument.arg for argument in node.args.args] == re.findall(r"(\w+): ", said), said


def test_all_names_are_there():
    for name in contact_oracle.__all__:
        assert hasattr(contact_oracle, name)
    assert contact_oracle.__version__ and (PACKAGE / "py.typed").exists()


@pytest.mark.parametrize("module", ["", *MODULES])
def test_what_the_documentation_shows_is_so(module):
    if module in ("laws", "strategies"):
        pytest.importorskip("hypothesis")
    found = doctest.testmod(importlib.import_module("contact_oracle" + ("." + module if module else "")), optionflags=doctest.ELLIPSIS)
    assert found.failed == 0
    assert found.attempted or module not in ("", "answering", "exact_answers", "datasets")


@pytest.mark.parametrize("name", [name for name in contact_oracle.__all__ if name != "PAIRS"])
def test_every_public_name_has_an_example(name):
    of = getattr(contact_oracle, name)
    example = doctest.DocTestParser().get_doctest(of.__doc__, {}, name, None, None)
    assert example.examples, "no example"
    if name in PAIRS:  # those of the others are found in their modules
        assert doctest.DocTestRunner().run(example).failed == 0


def shown(page):
    """The examples of a page, which share their names as one session does."""
    text = (ROOT / "docs" / page).read_text()
    return re.findall(r"<!-- python -->\n```pycon\n(.*?)```", text, re.S)


@pytest.mark.parametrize("page", ["python.md", "gradients.md"])
def test_what_the_page_shows_is_so(page):
    names = {}
    blocks = shown(page)
    assert len(blocks) >= 3
    if importlib.util.find_spec("torch") is None:
        blocks = [block for block in blocks if "torch" not in block] or pytest.skip("PyTorch is not installed")
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.IGNORE_EXCEPTION_DETAIL)
    for number, block in enumerate(blocks):
        test = parser.get_doctest(block, names, f"docs/{page} block {number}", None, None)
        runner.run(test, clear_globs=False)
        names.update(test.globs)
    assert runner.summarize().failed == 0


def test_the_page_has_every_function_with_its_arguments():
    text = (ROOT / "docs" / "python.md").read_text()
    rows = re.search(r"<!-- functions:begin -->\n[^\n]*\n[^\n]*\n(.*)\n<!-- functions:end -->", text, re.S)[1].splitlines()
    assert rows == [f"| `{pair.name}` | {', '.join(f'`{field.argument}`' for field in pair.fields)} |" for pair in PAIRS.values()]


def test_the_page_names_every_argument_law_and_strategy():
    text = (ROOT / "docs" / "python.md").read_text()
    for name in inspect.signature(contact_oracle.certify).parameters:
        assert f"`{name}`" in text, name
    pytest.importorskip("hypothesis")
    from contact_oracle import laws, strategies

    for name in [*laws.LAWS, *(function.__name__ for function in strategies.OF_SHAPE.values())]:
        assert f"`{name}`" in text, name
    from contact_oracle import pytest_plugin

    for option in pytest_plugin.HELP:
        assert f"`{option}" in text


@pytest.mark.skipif(not every_example.EVERY, reason="a seventh of the time of all tests here: ./run python and ./run campaign ask it")
def test_types_are_right(tmp_path):
    pytest.importorskip("mypy")
    # A copy: mypy does not look at what is installed, and refuses to be pointed there.
    shutil.copytree(PACKAGE, tmp_path / "contact_oracle", ignore=shutil.ignore_patterns("*.so", "bin", "__pycache__"))
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", os.devnull, "-p", "contact_oracle"],
                          capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(tmp_path)}, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_what_is_installed_is_found_by_pytest_and_hypothesis(tmp_path):
    """The entry points of pyproject.toml, as an installation writes them."""
    pytest.importorskip("hypothesis")
    tomllib = pytest.importorskip("tomllib")
    project = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text())["project"]
    assert project["version"] == contact_oracle.__version__
    information = tmp_path / "site" / "contact_oracle-0.dist-info"
    information.mkdir(parents=True)
    (information / "METADATA").write_text("Metadata-Version: 2.1\nName: contact-oracle\nVersion: 0\n")
    (information / "entry_points.txt").write_text("".join(f"[{group}]\n" + "".join(f"{name} = {value}\n" for name, value in entries.items())
                                                          for group, entries in project["entry-points"].items()))
    (tmp_path / "test_mine.py").write_text("""
import contact_oracle
import pytest
from hypothesis import given, strategies as st

@pytest.fixture(scope="session")
def contact_engine():
    return lambda questions: questions.answer()

test_contacts = contact_oracle.suite("cube_cube", "generic", "swap", count=5)

@given(st.from_type(contact_oracle.Cube))
def test_boxes_are_boxes(box):
    assert all(low <= high for low, high in zip(box.min, box.max))
""")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path / "site"), os.environ["PYTHONPATH"]])}
    done = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--contact-max-examples", "5"], cwd=tmp_path,
                          capture_output=True, text=True, env=environment)
    assert "3 passed" in done.stdout, done.stdout + done.stderr


def run_here(example, capsys):
    """An example in this process, which has its libraries already."""
    runpy.run_path(str(example), run_name="__main__")
    return capsys.readouterr().out


def test_the_first_engine_is_judged_as_the_page_shows(tmp_path, capsys):
    page, first = (ROOT / "docs" / "python.md").read_text(), EXAMPLES / "first_engine.py"
    second = tmp_path / "second_engine.py"
    second.write_text(first.read_text().replace(" < ", " <= "))
    for name, engine in (("first", first), ("second", second)):
        said = re.search(rf"<!-- {name}-engine:begin -->\n```text\n(.*?)```", page, re.S)[1]
        assert run_here(engine, capsys) == said


def run(example, *arguments, cwd):
    done = subprocess.run([sys.executable, str(EXAMPLES / example), *arguments], capture_output=True, text=True, cwd=cwd)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_judge_finds_the_guard_in_the_quotient(capsys):
    text = run_here(EXAMPLES / "mjx_style.py", capsys)
    assert "1e-6 added to the squared length" in text and "REFUTED: sphere_capsule 1 is not within length 1e-05" in text
    assert text.strip().splitlines()[-1].startswith("CERTIFIED within")


def test_an_engine_in_torch_is_judged(capsys):
    pytest.importorskip("torch")
    text = run_here(EXAMPLES / "torch_float32.py", capsys)
    assert "torch" in text and "(binary32)" in text


def test_the_command_comes_with_the_package(tool, tmp_path):
    def said(**environment):
        return subprocess.run([sys.executable, "-m", "contact_oracle", "--version"], capture_output=True, text=True, cwd=tmp_path, env={**os.environ, **environment})

    assert said(CONTACT_ORACLE_TOOL=tool).stdout.startswith(f"contact-oracle {contact_oracle.__version__}")
    exits = subprocess.run([sys.executable, "-m", "contact_oracle", "explain", "nowhere.jsonl"], capture_output=True, text=True, cwd=tmp_path)
    assert exits.returncode == 2 and "nowhere.jsonl" in exits.stderr


@pytest.mark.parametrize("pair, family", [("sphere_obb", "generic"), ("capsule_plane", "touching"), ("hull_hull", "extreme_scale"), ("cast_cube", "extreme_scale"),
                                          ("cube_cube", "extreme_scale"), ("triangle_line", "generic")])
def test_a_case_has_a_figure(pair, family, tmp_path):
    pytest.importorskip("matplotlib")
    for question in contact_oracle.generate(pair, family, 2, seed=3):
        figure = question.to_figure()
        figure.savefig(tmp_path / "case.png", dpi=20)
        axes, = figure.axes
        answer = question.answer()
        names = axes.get_legend_handles_labels()[1]
        assert names[0] == f"a: {type(question.a).__name__}" and ("normal" in names) == bool(answer.hit and PAIRS[pair].numbers != "none")
        assert axes.get_title().endswith("a miss" if not answer.hit else "a hit" if answer.value is None else repr(float(answer.value)))
        assert all(np.isfinite(limits).all() for limits in (axes.get_xlim(), axes.get_ylim(), axes.get_zlim()))


def test_a_figure_shows_a_shape_where_it_is():
    pytest.importorskip("matplotlib")
    from contact_oracle.shown import _farthest, _parts

    ways = np.array([(1.0, 0, 0), (0, 1, 0), (0, 0, -1)])
    turned = contact_oracle.Obb((1, 0, 0), (1, 1, 1, 1), (1, 2, 3))  # x becomes y, y becomes z, z becomes x
    capsule = contact_oracle.Capsule((0, 0, 0), (0, 0, 4), 1)
    assert np.einsum("ij,ij->i", ways, _farthest(_parts(turned), ways)).tolist() == [4, 1, 2]
    assert np.einsum("ij,ij->i", ways, _farthest(_parts(capsule), ways)).tolist() == [1, 1, 1]
    ray = contact_oracle.Ray((1, 0, 0), (0, 2, 0), 3)
    assert _farthest(_parts(ray), ways)[1].tolist() == [1, 6, 0]


def test_a_report_has_a_figure_of_its_errors():
    pytest.importorskip("matplotlib")

    def off(questions):
        answer = questions.answer()
        return {"hit": answer.hit, "value": answer.value * np.resize([1, 1.5, np.inf], len(questions)), "normal": answer.normal}

    report = contact_oracle.certify(off, "sphere_sphere", "generic", seed=1)
    axes, = report.to_figure().axes
    assert report.data["total"]["fields"]["value"]["not_finite"] > 9
    bars = {bar.get_label(): sum(rectangle.get_height() for rectangle in bar) for bar in axes.containers}
    assert bars == {name: field["judged"] for name, field in report.data["total"]["fields"].items() if name in bars} and set(bars) >= {"value", "normal"}


def test_notebooks_show_what_terminals_show():
    questions = contact_oracle.generate("hull_hull", "generic", 12, seed=1)
    assert "<th>vertices1</th>" in questions._repr_html_() and "and 2 more" in questions._repr_html_()
    assert "HIT" in contact_oracle.Question("sphere_sphere", contact_oracle.Sphere((0, 0, 0), 1), contact_oracle.Sphere((0, 0, 0), 1))._repr_html_()
    outside = contact_oracle.Question("sphere_sphere", contact_oracle.Sphere((0, 0, 0), -1), contact_oracle.Sphere((0, 0, 0), 1))
    assert "must not be negative" in outside._repr_html_()
    assert "&lt;" in contact_oracle.shown.text("a < b")


def test_a_notebook_is_made_and_its_cells_work(tmp_path):
    pytest.importorskip("matplotlib")
    run("notebook.py", "made.ipynb", cwd=tmp_path)
    made = json.loads((tmp_path / "made.ipynb").read_text())
    assert made["nbformat"] == 4 and sum(cell["cell_type"] == "code" for cell in made["cells"]) >= 5
    if (tmp_path / "made.svg").exists():
        assert (tmp_path / "made.svg").read_text().count("<use ") > 500  # a hit each
