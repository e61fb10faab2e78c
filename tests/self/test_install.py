# SPDX-License-Identifier: GPL-3.0-or-later
"""libstrum as its users get it: installed, found by pkg-config, linked by a program of their own."""
import os
import pathlib
import subprocess

import pytest

BUILD = pathlib.Path(os.environ["STRUMD"]).parents[1]
# In-plane mode 1 of rise 0, sag parameter 0.85: Taylor shooting with 220 bits (tests/cases, in-00-thesis).
FREQUENCY = 2.445024346759859
PROGRAM = """
#include <stdio.h>
#include <strum/strum.h>

int main(void)
{
    strum_catenary catenary;
    strum_modes_params params = STRUM_MODES_PARAMS_INIT;
    strum_modes *modes = NULL;
    strum_mode first;
    strum_error fault;
    if (strum_catenary_from_sag(0, 0.85, &catenary, &fault) != STRUM_OK)
        return 1;
    params.cable.chi_m = catenary.chi_m;
    params.cable.mu = catenary.mu;
    params.count = 1;
    if (strum_modes_solve(&params, NULL, &modes, &fault) != STRUM_OK || strum_modes_get(modes, 0, &first) != STRUM_OK)
        return 1;
    printf("%.17g\\n", first.frequency);
    strum_modes_free(modes);
    return 0;
}
"""


@pytest.fixture(scope="module")
def root(tmp_path_factory):
    folder = tmp_path_factory.mktemp("root")
    subprocess.run(["meson", "install", "-C", BUILD, "--no-rebuild", "--quiet", "--destdir", folder], check=True)
    return folder


def flags(root, *options):
    """What pkg-config says of the library where it lies: below `root`, not in the prefix it was built for."""
    pc, = root.rglob("strum.pc")
    prefix = next(line for line in pc.read_text().splitlines() if line.startswith("prefix="))[len("prefix="):]
    prefix = f"{root}{prefix}"
    environment = {**os.environ, "PKG_CONFIG_PATH": str(pc.parent)}
    command = ["pkg-config", f"--define-variable=prefix={prefix}", *options, "strum"]
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.split()


@pytest.mark.parametrize("compiler, suffix, linkage", [
    (["cc", "-std=gnu17", "-Wall", "-Wextra"], ".c", []),
    (["cc", "-std=gnu17"], ".c", ["--static"]),
    (["g++", "-std=c++17", "-Wall", "-Wextra"], ".cpp", []),
])
def test_a_program_of_a_user(root, tmp_path, compiler, suffix, linkage):
    source, program = tmp_path / f"user{suffix}", tmp_path / "user"
    source.write_text(PROGRAM)
    shared, = root.rglob("libstrum.so")
    if linkage:  # the archive instead of the shared library
        shared.rename(shared.with_suffix(".away"))
    try:
        subprocess.run([*compiler, "-Werror", source, "-o", program, *flags(root, "--cflags"),
                        *flags(root, "--libs", *linkage)], check=True)
    finally:
        if linkage:
            shared.with_suffix(".away").rename(shared)
    environment = {**os.environ, "LD_LIBRARY_PATH": str(shared.parent)}
    out = subprocess.run([program], env=environment, check=True, capture_output=True, text=True).stdout
    assert abs(float(out) - FREQUENCY) <= 1e-12 * FREQUENCY


def test_what_is_installed(root):
    found = {str(path.relative_to(root)) for path in root.rglob("*") if not path.is_dir()}
    names = {pathlib.Path(path).name for path in found}
    assert {"strumd", "libstrum.so", "libstrum.a", "strum.pc", "strum.h", "catenary.h", "status.h"} <= names
    headers = {path for path in found if path.endswith(".h")}
    assert all("/include/strum/" in f"/{path}" for path in headers)


def test_the_library_builds_without_the_daemon(tmp_path):
    source = pathlib.Path(__file__).parents[2]
    subprocess.run(["meson", "setup", tmp_path, source, "-Ddaemon=false", "-Dtests=false", "-Dwerror=true",
                    "-Doptimization=0"], check=True, capture_output=True)
    subprocess.run(["ninja", "-C", tmp_path], check=True, capture_output=True)
    assert list(tmp_path.rglob("libstrum.so")) and not list(tmp_path.rglob("strumd"))
