# SPDX-License-Identifier: GPL-3.0-or-later
"""VALIDATION.md is what the program says of itself: written anew, it is the same file."""
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/http"))
from conftest import Strumd  # noqa: E402


def without_margins(text):
    """The last column, how much of its tolerance a family uses, is rounding: it may differ between processors."""
    return re.sub(r"^(\|(?:[^|\n]*\|){5})[^|\n]*\|$", r"\1", text, flags=re.M)


def test_validation_md_is_up_to_date():
    daemon = Strumd(program=os.environ.get("STRUMD", str(ROOT / "build/src/strumd")))
    try:
        done = subprocess.run([ROOT / "tests/cases/report", daemon.url], capture_output=True, text=True, timeout=300)
    finally:
        daemon.process.terminate()
        daemon.process.wait()
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr
    kept = (ROOT / "VALIDATION.md").read_text(encoding="utf-8")
    assert without_margins(kept) == without_margins(done.stdout), "write it anew: tests/cases/report URL > VALIDATION.md"
    assert "| gale/table B-3 | gale | 50 | 50 | 600 |" in without_margins(kept)
