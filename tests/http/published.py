# SPDX-License-Identifier: GPL-3.0-or-later
"""api/publish.py, for the tests of what it makes."""
import sys

from conftest import ROOT

sys.path.insert(0, str(ROOT / "api"))
from publish import publish  # noqa: E402, F401
