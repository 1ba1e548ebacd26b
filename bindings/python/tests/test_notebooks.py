"""The notebooks run, and their pictures are drawn. With GONIO_PICTURES=FOLDER these are kept there, to be looked at."""

import os
import re
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.md"))


def cells(notebook):
    return re.findall(r"^```\{code-cell\}.*?\n(.*?)^```$", notebook.read_text(encoding="utf-8"), re.S | re.M)


def test_there_are_some():
    assert len(NOTEBOOKS) >= 8


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(notebook):
    pytest.importorskip("xarray")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    found = cells(notebook)
    assert len(found) >= 2
    names = {"__name__": "notebook"}
    with matplotlib.rc_context(fname=FOLDER / "matplotlibrc"):
        for number, cell in enumerate(found):
            exec(compile(cell, f"{notebook.name}, cell {number + 1}", "exec"), names)
        figures = [plt.figure(number) for number in plt.get_fignums()]
        for number, figure in enumerate(figures):
            figure.canvas.draw()
            if kept := os.environ.get("GONIO_PICTURES"):
                Path(kept).mkdir(parents=True, exist_ok=True)
                figure.savefig(Path(kept) / f"{notebook.stem}_{number + 1}.png")
    plt.close("all")
    assert figures
