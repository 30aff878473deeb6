"""The command: files in and out, summary, pictures, refusals."""

import subprocess
import sys

import numpy as np
import pytest
from shapes import ROOT, circle, cloud, hill, wavy

from footpoint.cli import COLUMNS, load_shape, main, save_shape


def test_files(tmp_path, capsys):
    points = cloud(50)
    np.save(tmp_path / "p.npy", points)
    np.savetxt(tmp_path / "p.csv", np.column_stack([np.arange(50), points]), delimiter=",", header="id,x,y,z", comments="", fmt="%.17g")
    for shape in (wavy(), circle()):
        save_shape(tmp_path / "s.npz", shape)
        assert main(["closest", str(tmp_path / "s.npz"), str(tmp_path / "p.csv"), "-o", str(tmp_path / "f.csv")]) == 0
        assert "proven" in capsys.readouterr().err
        assert main(["closest", str(tmp_path / "s.npz"), str(tmp_path / "p.npy"), "-o", str(tmp_path / "f.npy"), "-q"]) == 0
        feet = np.load(tmp_path / "f.npy")
        table = np.genfromtxt(tmp_path / "f.csv", delimiter=",", names=True)
        assert list(table.dtype.names) == COLUMNS
        expected = shape.closest(points)
        assert np.array_equal(table["u"], expected.u) and feet.tobytes() == expected.tobytes()


def test_invert_and_text_form(tmp_path, capsys):
    case = ROOT / "tests" / "data" / "syn_s_torus"
    assert main(["invert", str(case / "geometry.txt"), str(case / "queries.csv"), "-o", str(tmp_path / "f.csv")]) == 0
    assert "not_on_shape" in capsys.readouterr().err and load_shape(case / "geometry.txt").is_closed == (True, True)
    (tmp_path / "c.json").write_text('{"degree": 1, "knots": [0, 0, 1, 1], "poles": [[0, 0, 0], [1, 0, 0]]}')
    (tmp_path / "p.csv").write_text("0.25,0,0\n0.5,1,0\n")
    assert main(["invert", str(tmp_path / "c.json"), str(tmp_path / "p.csv")]) == 0
    rows = capsys.readouterr().out.split()
    assert rows[0] == ",".join(COLUMNS) and float(rows[1].split(",")[0]) == pytest.approx(0.25) and len(rows) == 3


def test_plot(tmp_path):
    pytest.importorskip("matplotlib")
    np.save(tmp_path / "p.npy", cloud(100, size=30))
    for number, shape in enumerate((hill(), circle())):
        save_shape(tmp_path / "s.npz", shape)
        out = tmp_path / f"{number}.png"
        assert main(["plot", str(tmp_path / "s.npz"), str(tmp_path / "p.npy"), "-o", str(out)]) == 0
        assert out.read_bytes()[:4] == b"\x89PNG" and out.stat().st_size > 20_000


def test_refusals(tmp_path, capsys):
    (tmp_path / "bad.csv").write_text("x,y,z\n1,2\n")
    (tmp_path / "bad.txt").write_text("circle 1")
    save_shape(tmp_path / "s.npz", hill())
    for arguments in (["closest", str(tmp_path / "none.npz"), "x.csv"], ["closest", str(tmp_path / "s.npz"), str(tmp_path / "bad.csv")],
                      ["closest", str(tmp_path / "bad.txt"), "x.csv"], ["closest", str(tmp_path / "s.npz"), "x.csv", "--threads", "-1"]):
        assert main(arguments) == 2
        told = capsys.readouterr().err
        assert told.startswith("footpoint: ") and told.count("\n") == 1


def test_as_a_program():
    done = subprocess.run([sys.executable, "-m", "footpoint.cli", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("footpoint 0.")
