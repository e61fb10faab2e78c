# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as they are typed on the page: src/dashboard/values.js."""
import json
import pathlib
import subprocess

import pytest

VALUES = pathlib.Path(__file__).resolve().parents[2] / "src/dashboard/values.js"
TYPED = [("3 MN", "N", 3e6), ("3000kN", "N", 3e6), ("99,5", "m", 99.5), ("99.5", "m", 99.5), ("110 ft", "m", 33.528), ("0,125", "m", 0.125),
         ("1,000", "m", "1,000"), ("1,000,000", "m", "1,000,000"), ("1.000,5", "m", "1.000,5"), ("3e6", "N", 3e6), ("+3e6", "N", 3e6),
         ("2 kN/m", "N/m", 2000), ("1 lb/ft", "kg/m", 1.48816394356955), ("3 MN", "m", "3 MN"), ("5 furlongs", "m", "5 furlongs"),
         ("2 Hz", "rad/s", 12.5663706143592), ("9,8 m/s^2", "m/s^2", 9.8), ("3 MN", None, "3 MN"), ("R", "N", "R"), ("", "N", None)]


@pytest.fixture(scope="module")
def read():
    script = (f"import {{ readQuantity }} from {json.dumps(VALUES.as_uri())};"
              f"console.log(JSON.stringify({json.dumps(TYPED)}.map(([text, unit]) => readQuantity(text, unit ?? undefined) ?? null)));")
    done = subprocess.run(["node", "--input-type=module", "-e", script], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@pytest.mark.parametrize("place", range(len(TYPED)), ids=[f"{text} in {unit}" for text, unit, _ in TYPED])
def test_what_is_typed(read, place):
    assert read[place] == TYPED[place][2]
