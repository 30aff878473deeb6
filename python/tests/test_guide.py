"""The programs of the guide for Python users, as they stand there, and the example of the package's README."""

import re
import subprocess
import sys

import pytest
from shapes import ROOT

GUIDE = (ROOT / "docs" / "guide.md").read_text(encoding="utf-8")
PROGRAMS = [text for section in ("## Python users", "## Fairing and inspection")
            for text in re.findall(r"```python\n(.*?)```", GUIDE.split(section)[1].split("\n## ")[0], re.S)]
PROGRAMS += re.findall(r"```python\n(.*?)```", (ROOT / "python" / "README.md").read_text(encoding="utf-8"), re.S)


@pytest.mark.parametrize("number", range(len(PROGRAMS)))
def test_program(number, tmp_path):
    done = subprocess.run([sys.executable, "-c", PROGRAMS[number]], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout


def test_there_are_programs():
    assert len(PROGRAMS) == 10
