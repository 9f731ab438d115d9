"""Makes a notebook that goes from one question to a plot of an engine's error against the size of its numbers.

    python3 notebook.py error_by_scale.ipynb

It needs matplotlib. The notebook is run where Jupyter is installed. Elsewhere its cells run here, one after the other, so that they are known to work.
"""
import json
import shutil
import subprocess
import sys

CELLS = [
    ("markdown", "# From a question to an error\n\nTwo spheres that touch, and the right answer: each number is the exact real, rounded once."),
    ("code", """import contact_oracle

contact_oracle.sphere_sphere((0, 0, 0), 1.5, (1, 2, 2), 1.5, contact=0.25)"""),
    ("markdown", "The exact numbers behind it. The margin is 0: the spheres touch exactly."),
    ("code", """answer = contact_oracle.exact("sphere_sphere", (0, 0, 0), 1.5, (1, 2, 2), 1.5, contact=0.25)
print("D =", answer.distance2, " reach =", answer.reach, " margin =", answer.margin())
print(contact_oracle.explain(answer.question))"""),
    ("markdown", "An engine: any function of arrays. This one computes in single precision and answers in double."),
    ("code", """import numpy as np

def single_precision(questions):
    center1, radius1, center2, radius2 = (np.asarray(questions[name], np.float32) for name in ("center1", "radius1", "center2", "radius2"))
    delta = center2 - center1
    distance = np.sqrt((delta * delta).sum(axis=1))
    reach = radius1 + radius2
    return {"hit": distance <= reach + questions.alarm, "value": distance.astype(float) - reach - questions.contact}"""),
    ("markdown", "How far off is its value, by the size of the numbers? Ordinary questions, each in a unit of its own from a micrometre to a megametre."),
    ("code", """generic = contact_oracle.generate("sphere_sphere", "generic", 2000, seed=1)
unit = 10.0 ** np.random.default_rng(1).uniform(-6, 6, len(generic))
scaled = {name: generic[name] * (unit if generic[name].ndim == 1 else unit[:, np.newaxis]) for name in generic.keys()}
questions = contact_oracle.Questions("sphere_sphere", scaled)
right = questions.answer()
claimed = single_precision(questions)
both = right.hit & claimed["hit"]
size = np.abs(questions.center1).max(axis=1)[both]
error = np.abs(claimed["value"] - right.value)[both]
print(f"{both.sum()} hits, the largest error is {error.max():.3g}")"""),
    ("code", """import matplotlib.pyplot as plt

figure, axes = plt.subplots()
axes.set(xscale="log", yscale="log", xlabel="largest coordinate", ylabel="error of the value")
points = axes.scatter(size, error, s=4)"""),
    ("markdown", "The judge says the same in a verdict, and from which tolerance on the engine would pass."),
    ("code", """report = contact_oracle.certify(single_precision, "sphere_sphere", "generic", seed=1)
print(report.verdict)
print(report.fitness["everyday"]["needs"])"""),
]


def notebook():
    cells = []
    for number, (kind, text) in enumerate(CELLS):
        cell = {"id": f"cell-{number}", "cell_type": kind, "metadata": {}, "source": text.splitlines(keepends=True)}
        cells.append(cell | {"execution_count": None, "outputs": []} if kind == "code" else cell)
    python = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}, "language_info": {"name": "python"}}
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": python, "cells": cells}


def run_here():
    """The cells in one namespace, as the notebook's kernel runs them."""
    names = {}
    for number, (kind, text) in enumerate(CELLS):
        if kind == "code":
            exec(compile(text, f"cell {number}", "exec"), names)
    return names


if __name__ == "__main__":
    path = sys.argv[1] if len(sys.argv) > 1 else "error_by_scale.ipynb"
    with open(path, "w", encoding="utf-8") as file:
        json.dump(notebook(), file, indent=1)
    if shutil.which("jupyter-nbconvert"):
        subprocess.run(["jupyter-nbconvert", "--to", "notebook", "--execute", "--inplace", path], check=True)
        print(f"{path}: made, and run by Jupyter")
    else:
        plot = path.rsplit(".", 1)[0] + ".svg"
        run_here()["figure"].savefig(plot)
        print(f"{path}: made; its cells ran here, for there is no Jupyter; the plot is {plot}")
