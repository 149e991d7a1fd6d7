#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The files of examples/ that a script beside them writes are what it writes.

    made_files_test.py --source DIR

Pictures are compared by what is in them: how small zlib makes them differs from version to version."""
import argparse
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

PNG = b"\x89PNG\r\n\x1a\n"


def picture(data):
    """A PNG file's chunks, the compressed ones as they were before."""
    out, at, pixels = [], len(PNG), b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IDAT":
            pixels += body
        else:
            out.append((kind, body))
        at += 12 + length
    return out, zlib.decompress(pixels)


def content(data):
    """What is in a file: of a glTF file its JSON without the sizes of pictures, and each piece of its bytes."""
    if data.startswith(PNG):
        return picture(data)
    if not data.startswith(b"glTF"):
        return data
    size = struct.unpack("<I", data[12:16])[0]
    said, binary = json.loads(data[20:20 + size]), data[20 + size + 8:]
    pieces = []
    for view in said["bufferViews"]:
        start, length = view.pop("byteOffset", 0), view.pop("byteLength")
        piece = binary[start:start + length]
        pieces.append(picture(piece) if piece.startswith(PNG) else piece)
    for buffer in said["buffers"]:
        buffer.pop("byteLength")
    return said, pieces


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", type=pathlib.Path, required=True)
    examples = parser.parse_args().source.resolve() / "examples"
    faults, seen = [], 0
    for script in sorted(examples.glob("*/make_*.py")):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, script], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            made = sorted(pathlib.Path(folder).iterdir())
            if not made:
                faults.append(f"{script.name} writes nothing")
            for one in made:
                seen += 1
                kept = script.parent / one.name
                if not kept.exists():
                    faults.append(f"{script.name} writes {one.name}, which is not kept")
                elif content(one.read_bytes()) != content(kept.read_bytes()):
                    faults.append(f"{kept} is not what {script.name} writes")
    if seen < 7:
        faults.append(f"expected seven files at least, saw {seen}")
    print("\n".join(faults) or f"{seen} files are what their scripts write")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
