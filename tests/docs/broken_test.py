#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A document with one broken word in it is refused at its line, and the same document without it is not."""

import pathlib
import sys

import exceptions
from run_document import Document, arguments
from workplace import Workplace

GOOD = """# A page
`--noise off` leaves `noise_m`; `rotation: {axis: [0, 1, 0], angle: 30 deg}`; `level: 5 %`; `power_model: paper_literal`.

```yaml
# ball.yaml: a ball
camera: {profile: pico-flexx}
objects:
  - sphere: {center: [0, 0, 1], radius: 25 cm, reflectivity: 0.5}
```

<!-- test: into ball.yaml -->
```yaml
  - sphere: {center: [0, 0, 2], radius: 25 cm, reflectivity: 0.5}
```

```sh
tofray render ball.yaml -o out --set camera.lens.f_number=1.2
```

`tofray inspect out/frame.npz`, and then:

<!-- test: prints 1.75 m -->
```python
import numpy as np
print(f"{np.nanmin(np.load('out/frame.npz')['gt_range_m']):.2f} m")
```

```text
anything
```
"""

# C++ is built at the end, so its faults are the first line's.
PROGRAM = """`find_package(tofray)`
```cpp
auto scene = tofray::load_scene("scenes/room.yaml");
```
"""

# A word, what stands in its place, and the line at which that has to be noticed.
BROKEN = [
    ("--noise off", "--nois off", 2),
    ("`noise_m`", "`noice_m`", 2),
    ("angle: 30", "angel: 30", 2),
    ("level: 5 %", "level: 5 m", 2),
    ("paper_literal", "paper_litteral", 2),
    ("# ball.yaml: a ball\n", "# a ball\n", 4),
    ("into ball.yaml", "onto ball.yaml", 11),
    ("[0, 0, 2]", "[0, 0, 3]", 23),  # gt_range_m is 2.75 then
    ("prints 1.75 m", "prints 1.85 m", 23),
    ("prints 1.75 m", "print 1.75 m", 22),
    ("radius: 25 cm, reflectivity: 0.5}\n```\n\n```sh", "raduis: 25 cm, reflectivity: 0.5}\n```\n\n```sh", 16),
    ("f_number", "f_numbre", 16),
    ("tofray inspect out", "tofray inspct out", 20),
    ("gt_range_m", "gt_rang_m", 23),
    ("```text", "```", 28),
    ("```text", "```rust", 28),
    ("```text", "<!-- test: by try_packages.sh nothing -->\n```text", 29),
]
BROKEN_PROGRAM = [("find_package(tofray)", "find_package(tofrai)", 1), ("load_scene", "load_scenes", 1)]


def lines_of_faults(text, first):
    with Workplace(first.source, first.build, first.compiler, first.path / "home/.local") as place:
        page = place.path / "page.md"
        page.write_text(text)
        return [line for line, _ in Document(page, place).faults()]


def faults_of(first):
    faults = []
    for good, changes in ((GOOD, BROKEN), (PROGRAM, BROKEN_PROGRAM)):
        if lines := lines_of_faults(good, first):
            faults.append(f"the good page has faults in lines {lines}")
        for word, broken, line in changes:
            assert word in good, word
            lines = lines_of_faults(good.replace(word, broken, 1), first)
            if line not in lines:
                faults.append(f"{broken!r} in place of {word!r}: faults in lines {lines}, expected one in line {line}")
    return faults


def idle_exceptions(source):
    """Exceptions that no document needs any more."""
    text = "".join(path.read_text(encoding="utf-8") for path in [*source.glob("*.md"), *source.glob("docs/*.md"), *source.glob("docs/how-to/*.md")])
    return [f"no document says {one!r}: not an exception" for one in [*exceptions.REPLACED, *exceptions.UNKNOWN_NAMES] if one not in text]


def main():
    options = arguments(__doc__).parse_args()
    with Workplace(pathlib.Path(options.source).resolve(), pathlib.Path(options.build).resolve(), options.compiler) as first:
        faults = faults_of(first) + idle_exceptions(first.source)
    print("\n".join(faults) or "every broken word was noticed")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
