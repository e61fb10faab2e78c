# SPDX-License-Identifier: GPL-3.0-or-later
"""The house keeps its storeys: what a file uses lies below it, and no circle of files exists.

A room is a source file together with its header. Arrows between rooms are read twice: from the includes, and, where
a build is at hand (STRUMD names its program), from the symbols of its objects, since a call can also reach a function
that some third header declares.
"""
import collections
import json
import os
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Folder of src -> the folders that its files may use, beside their own. Folders below one named are meant too.
BELOW = {
    "core/numerics": [],
    "core/suspended": ["core/numerics"],
    "core/inclined": ["core/numerics", "core/suspended"],
    "core/taut": ["core/numerics"],
    "core/cable": ["core/numerics"],
    "core/absorber": ["core/numerics", "core/taut"],
    "core/identify": ["core/numerics", "core/taut"],
    "json": [],
    "schema": ["json"],
    "endpoints": ["schema", "json"],
    "validation": ["endpoints", "schema", "json"],
    "cache": ["endpoints", "schema", "json"],
    "http/transport": ["http/service", "cache", "endpoints", "schema", "json"],
    "http/service": ["cache", "endpoints", "schema", "json"],
    "http/api": ["http/transport", "http/service", "cache", "validation", "endpoints", "schema", "json"],
}
# They put the others together.
ABOVE_ALL = {"main", "blas_memory"}
# Circles that are true: nested objects are read by groups of fields, which are read as objects.
RECURSIONS = [{"schema/groups", "schema/read"}]


def sources():
    return sorted(path for kind in ("*.c", "*.h") for path in (ROOT / "src").rglob(kind))


def name_of(path):
    return str(path.relative_to(ROOT / "src").with_suffix(""))


def folder_of(name):
    fitting = [folder for folder in BELOW if name.startswith(folder + "/")]
    return max(fitting, key=len, default=None)


def arrows_of_includes():
    arrows = collections.defaultdict(set)
    for path in sources():
        for included in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.M):
            if (ROOT / "src" / included).exists():
                arrows[name_of(path)].add(included.rsplit(".", 1)[0])
    return arrows


def arrows_of_symbols(build):
    """Who defines and who uses a name, by the objects of a build; several programs may define a `main`."""
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    defined, used = {}, collections.defaultdict(set)
    for command in commands:
        source, item = (build / command["file"]).resolve(), build / command["output"]
        if ROOT / "src" not in source.parents or not item.exists():
            continue
        room = name_of(source)
        for line in subprocess.run(["nm", item], capture_output=True, text=True, check=True).stdout.splitlines():
            kind, symbol = line.split()[-2:]
            public = symbol.startswith("strum_") and not room.startswith("core/")  # the library is below all
            if kind == "U":
                used[room].update([] if public else [symbol])
            elif kind.isupper():
                defined[symbol] = room
    assert defined, "the build has no objects of src"
    return {room: {defined[symbol] for symbol in symbols if symbol in defined} for room, symbols in used.items()}


def faults(arrows):
    """Arrows that run upward or sideways, as sentences."""
    found = []
    for room, targets in sorted(arrows.items()):
        home = folder_of(room)
        for target in sorted(targets):
            there = folder_of(target)
            if home and there and there != home and there not in BELOW[home]:
                found.append(f"{room} uses {target}: {home} may not use {there}")
            if home and not there:
                found.append(f"{room} uses {target}, which stands above all folders")
    return found


def circles(arrows):
    """Strongly connected components of more than one room (Tarjan)."""
    index, low, stack, found = {}, {}, [], []

    def visit(room):
        index[room] = low[room] = len(index)
        stack.append(room)
        for target in sorted(arrows.get(room, ())):
            if target not in index:
                visit(target)
                low[room] = min(low[room], low[target])
            elif target in stack:
                low[room] = min(low[room], index[target])
        if low[room] == index[room]:
            circle = set()
            while room not in circle:
                circle.add(stack.pop())
            if len(circle) > 1 and circle not in RECURSIONS:
                found.append(sorted(circle))

    for room in sorted(arrows):
        if room not in index:
            visit(room)
    return found


def build_folder():
    program = os.environ.get("STRUMD")
    folder = pathlib.Path(program).resolve().parents[1] if program else ROOT / "build"
    return folder if (folder / "compile_commands.json").exists() else None


def test_every_folder_is_on_a_storey():
    homeless = {name_of(path) for path in sources() if not folder_of(name_of(path))}
    assert homeless <= ABOVE_ALL, f"no storey: {sorted(homeless - ABOVE_ALL)}"


def test_includes_run_downward():
    assert faults(arrows_of_includes()) == []


def test_includes_make_no_circle():
    assert circles(arrows_of_includes()) == []


def test_endpoints_use_the_public_library_only():
    """Above the core everybody is a stranger to it: its private headers serve itself alone."""
    for path in sources():
        if not name_of(path).startswith("core/"):
            assert not re.search(r'^#include "core/', path.read_text(encoding="utf-8"), re.M), path


def test_calls_run_downward_and_make_no_circle():
    build = build_folder()
    if build is None:
        pytest.skip("no build at hand: STRUMD names none")
    arrows = arrows_of_symbols(build)
    assert faults(arrows) == []
    assert circles(arrows) == []


def test_the_test_sees_circles_and_upward_arrows():
    assert circles({"json/read": {"json/write"}, "json/write": {"json/strbuf"}, "json/strbuf": {"json/read"}})
    assert not circles({"json/read": {"json/write"}, "json/write": {"json/strbuf"}})
    assert faults({"core/suspended/modes": {"core/taut/chain"}})
    assert faults({"json/read": {"schema/read"}})
    assert not faults({"schema/read": {"json/read"}})
