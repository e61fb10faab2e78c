#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts files into the program: writes the table of src/http/api/assets.h, whose bytes the assembler takes in by .incbin,
which costs nothing at any size.

    embed.py OUTPUT.c WORK_FOLDER PATH=FILE...

PATH/=FOLDER stands for every file of the folder; its pages (.html) go without their ending.
"""
import gzip
import hashlib
import pathlib
import sys

TYPES = {
    ".html": "text/html; charset=utf-8", ".css": "text/css; charset=utf-8", ".js": "text/javascript; charset=utf-8",
    ".json": "application/json", ".svg": "image/svg+xml",
}


def expand(pairs):
    for path, name in (pair.split("=", 1) for pair in pairs):
        if path == "/" or not path.endswith("/"):
            yield path, pathlib.Path(name).resolve()
            continue
        for file in sorted(pathlib.Path(name).resolve().iterdir()):
            yield path + (file.stem if file.suffix == ".html" else file.name), file


def main():
    table, work = map(pathlib.Path, sys.argv[1:3])
    work.mkdir(parents=True, exist_ok=True)
    blobs, externs, rows = [], [], []
    for i, (path, source) in enumerate(expand(sys.argv[3:])):
        data = source.read_bytes()
        packed = work / f"{i}.gz"
        packed.write_bytes(gzip.compress(data, 9, mtime=0))  # no time in it: the same input, the same bytes
        for symbol, file in ((f"asset_{i}", source), (f"asset_{i}_gzip", packed.resolve())):
            # In C's own asm, not in a .S file: the object then keeps the compiler's marks (stack, CET).
            blobs.append(f'__asm__(".pushsection .rodata\\n.global {symbol}, {symbol}_end\\n{symbol}:\\n"\n'
                         f'        ".incbin \\"{file}\\"\\n{symbol}_end:\\n.popsection");')
            externs.append(f"extern const unsigned char {symbol}[], {symbol}_end[];")
        rows.append(f'    {{"{path}", "{TYPES[source.suffix]}", "{hashlib.sha256(data).hexdigest()}",\n'
                    f"     asset_{i}, asset_{i}_end, asset_{i}_gzip, asset_{i}_gzip_end}},")
    table.write_text('#include "http/api/assets.h"\n\n' + "\n".join(blobs + externs) +
                     "\n\nconst asset assets[] = {\n" + "\n".join(rows) + "\n    {.path = NULL}};\n")


if __name__ == "__main__":
    main()
