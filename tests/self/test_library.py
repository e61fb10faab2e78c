# SPDX-License-Identifier: GPL-3.0-or-later
"""libstrum as others meet it: installed, found by pkg-config, used from C and C++."""
import cmath
import json
import math
import os
import pathlib
import re
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("STRUMD", str(ROOT / "build/src/strumd"))
BUILD = pathlib.Path(PROGRAM).resolve().parents[1]
COMPILERS = [name for name in ("gcc", "clang-14", "g++", "clang++-14") if shutil.which(name)]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
HEADERS = sorted(path.name for path in (ROOT / "include/strum").glob("*.h")) + ["version.h"]


def language(compiler):
    return ["-x", "c++", "-std=c++17"] if "++" in compiler else ["-x", "c", "-std=c17"]


def run(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}"
    return done.stdout


class Installed:
    """The library that the build installs, below a folder of its own."""

    def __init__(self, folder):
        run("meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", folder)
        (pc,) = folder.rglob("strum.pc")
        self.libraries = pc.parents[1]
        self.pc, self.prefix = pc, folder / re.search(r"^prefix=/(.*)$", pc.read_text(), re.M).group(1)

    def flags(self, *wanted):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.pc.parent)}
        return run("pkg-config", f"--define-variable=prefix={self.prefix}", *wanted, "strum", env=environment).split()

    def build(self, compiler, source, *more):
        program = source.parent / f"{source.stem}-{compiler}"
        run(compiler, *language(compiler), "-O1", *WARNINGS, source, "-x", "none", *more,
            *self.flags("--cflags", "--libs"), "-lm", "-o", program)
        return program

    def answer(self, program):
        return run(program, env={"LD_LIBRARY_PATH": str(self.libraries)})


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    return Installed(tmp_path_factory.mktemp("installed"))


def declared(folder):
    """The functions that the public headers declare."""
    names = set()
    for header in (folder / "include/strum").glob("*.h"):
        text = re.sub(r"/\*.*?\*/", "", header.read_text(encoding="utf-8"), flags=re.S)
        text = re.sub(r"^#(?:.*\\\n)*.*$", "", text, flags=re.M)
        names |= set(re.findall(r"\b(strum_\w+)\s*\((?!\*)", text))
    return names


def symbols(*arguments):
    lines = run("nm", *arguments).splitlines()
    return {fields[2] for fields in map(str.split, lines) if len(fields) == 3 and fields[1] in "TDBRVWi"}


def test_the_shared_library_exports_its_headers_and_nothing_else(installed):
    names = declared(installed.prefix)
    assert len(names) > 50
    assert symbols("-D", "--defined-only", installed.libraries / "libstrum.so") == names


def test_every_header_is_installed(installed):
    assert sorted(path.name for path in (installed.prefix / "include/strum").iterdir()) == sorted(HEADERS)


@pytest.mark.parametrize("compiler", COMPILERS)
def test_every_header_compiles_alone(installed, compiler, tmp_path):
    for header in HEADERS:
        source = tmp_path / "alone.c"
        source.write_text(f"#include <strum/{header}>\n#include <strum/{header}>\nint main(void) {{ return 0; }}\n")
        run(compiler, *language(compiler), *WARNINGS, "-fsyntax-only", *installed.flags("--cflags"), source)


# What the examples at the head of the headers take for given.
GIVEN = """
#include <stdio.h>
extern strum_catenary catenary;
extern strum_cable cable;
extern strum_hanging *hanging;
extern strum_modes_params params;
extern strum_modes *modes;
extern strum_status status;
extern strum_error error;
bool user_pressed_stop(void *context);
__typeof__(*((strum_absorber_params *)0)->build) build;
"""


def example_of(header):
    """The call that the head comment shows: its indented block that ends a statement of strum's."""
    head = re.search(r"^/\*\n.*?\*/", (ROOT / "include/strum" / header).read_text(encoding="utf-8"), re.S | re.M)
    blocks = re.split(r"\n \*(?!     ).*", head[0]) if head else []
    shown = [re.sub(r"^ \*", "", block, flags=re.M) for block in blocks if "strum_" in block and ";" in block]
    return shown[0] if shown else None


EXAMPLES = {header: example_of(header) for header in HEADERS if header != "version.h"}


def test_most_headers_show_a_call():
    assert {"absorber.h", "catenary.h", "forced.h", "handbook.h", "inclined.h", "modes.h", "options.h", "series.h",
            "status.h", "taut.h"} <= {header for header, shown in EXAMPLES.items() if shown}


@pytest.mark.parametrize("header", [header for header, shown in EXAMPLES.items() if shown])
def test_the_call_at_the_head_of_a_header_compiles(installed, header, tmp_path):
    source = tmp_path / "example.c"
    includes = "".join(f"#include <strum/{name}>\n" for name in HEADERS)
    source.write_text(f"{includes}{GIVEN}void example(void)\n{{\n{EXAMPLES[header]}\n}}\n", encoding="utf-8")
    run("gcc", "-std=gnu17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *installed.flags("--cflags"), source)


def test_a_host_may_use_the_private_names(installed, tmp_path):
    """Every private name of the library is also a function of the host, which ends the program when it is called."""
    private = symbols("--defined-only", installed.libraries / "libstrum.a") - declared(installed.prefix)
    assert "arena_alloc" in private
    host = tmp_path / "host.c"
    host.write_text("#include <stdlib.h>\n" + "".join(
        f"void {name}(void);\nvoid {name}(void) {{ abort(); }}\n" for name in sorted(private)))
    # -rdynamic: the host's functions are in reach of the library.
    program = tmp_path / "frequencies.c"
    shutil.copy(ROOT / "examples/frequencies.c", program)
    run("gcc", "-c", "-fno-builtin", host, "-o", tmp_path / "host.o")
    printed = rows(installed.answer(installed.build("gcc", program, "-rdynamic", tmp_path / "host.o")))
    assert printed[0][1] == pytest.approx(1.93740173960883, rel=1e-11)  # Gale's Table B-3, exactly


def test_static_use(installed, tmp_path):
    program = tmp_path / "static"
    static = [f"{installed.libraries}/libstrum.a" if word == "-lstrum" else word
              for word in installed.flags("--static", "--cflags", "--libs")]
    run("gcc", ROOT / "examples/frequencies.c", *static, "-o", program)
    assert "libstrum" not in run("readelf", "-d", program)
    check_frequencies(rows(run(program)))


def rows(printed):
    return [[float(word) for word in line.split()] for line in printed.splitlines() if line[:1].isdigit()]


def case(file, identifier):
    cases = json.loads((ROOT / "tests/cases" / file).read_text())["cases"]
    (found,) = (entry for entry in cases if entry["id"] == identifier)
    return found["request"], {entry["pointer"]: entry.get("values", entry.get("value")) for entry in found["expect"]}


def check_frequencies(printed):
    """Gale's Table B-3; a/b of a level cable: mu/sinh mu = p, a/b = 1/(2 mu) (his equation 3.5)."""
    right = case("gale_table_B-3.json", "h/b=0.00 p=0.800")[1]["/result/in_plane/*/frequency_ratio"]
    low, high = 1e-3, 5.0
    for _ in range(200):
        mu = (low + high) / 2
        low, high = (mu, high) if mu / math.sinh(mu) > 0.8 else (low, mu)
    unit = math.sqrt(9.80665 / (100 / (2 * low))) / (2 * math.pi)
    assert len(printed) == 6
    for number, (mode, ratio, hertz) in enumerate(printed):
        assert (mode, ratio) == (number + 1, pytest.approx(right[number], rel=1e-11))
        assert hertz == pytest.approx(right[number] * unit, rel=1e-10)


def check_chain(printed):
    """README's figures solve the closed form of a string with an absorber at its middle, and are what is printed."""
    shown = re.findall(r'"frequency_Hz": ([\d.]+), "damping_ratio": ([\d.]+)', (ROOT / "README.md").read_text())
    assert len(printed) == 2 and len(shown) >= 2  # further questions follow in README.md
    for (_, hertz, ratio), readme in zip(printed, shown):
        assert (hertz, ratio) == (pytest.approx(float(readme[0]), rel=1e-10), pytest.approx(float(readme[1]), rel=1e-10))
        w = 2 * math.pi * hertz * complex(1, ratio / math.sqrt(1 - ratio * ratio))
        # 2 T k cot(k l) = m w^2 (K + i w R)/(K + i w R - m w^2), k = w sqrt(rho/T), l half the length
        k = w / math.sqrt(5000)
        mount = 68.45 + 15j * w
        left, right = 2 * 5000 * k / cmath.tan(25 * k), 5 * w * w * mount / (mount - 5 * w * w)
        assert abs(left - right) < 1e-8 * abs(left)


def check_forced(printed):
    """Gale's Table C-2."""
    request, expected = case("gale_table_C-2.json", "h/b=0.00 p=0.90")
    right = dict(zip(request["frequency_ratios"], expected["/result/curve/*/max_dynamic_tension"]))
    assert len(printed) == 13
    for frequency, tension in printed:
        assert tension == pytest.approx(right[frequency], rel=1e-9)


CHECKS = {"frequencies": check_frequencies, "chain": check_chain, "forced": check_forced}


def test_every_example_is_checked():
    assert {path.stem for path in (ROOT / "examples").glob("*.c")} == set(CHECKS)


@pytest.mark.parametrize("compiler", ["gcc", "g++"])
@pytest.mark.parametrize("name", sorted(CHECKS))
def test_an_example(installed, compiler, name, tmp_path):
    source = tmp_path / f"{name}.c"
    shutil.copy(ROOT / "examples" / source.name, source)
    CHECKS[name](rows(installed.answer(installed.build(compiler, source))))
