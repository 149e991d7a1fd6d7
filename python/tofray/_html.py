# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What a notebook shows of a frame beside its picture."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._frame import Frame


def frame_html(frame: Frame) -> str:
    """What the frame is, its raw frames in a table, and its arrays."""
    raw = frame.raw
    rows = ""
    if "modulation_frequency_hz" in raw:
        for k in range(len(raw.modulation_frequency_hz)):
            lit = bool(raw.lit[k]) if "lit" in raw else True
            rows += (f"<tr><td>{k}</td><td>{raw.modulation_frequency_hz[k] / 1e6:g} MHz</td>"
                     f"<td>{raw.reference_phase_rad[k] / 3.141592653589793 * 180:.1f}°</td>"
                     f"<td>{raw.integration_time_s[k] * 1e6:g} µs</td><td>{'' if lit else 'unlit'}</td></tr>")
    arrays = "".join(f"<li><code>{part}</code>: {html.escape(', '.join(getattr(frame, part).names) or 'none')}</li>"
                     for part in ("raw", "depth", "truth"))
    return (f"<p><b>tofray frame {frame.index}</b> {html.escape(frame._caption())}</p>"
            f"<table><tr><th>raw frame</th><th>modulation frequency</th><th>reference phase</th>"
            f"<th>integration time</th><th></th></tr>{rows}</table>"
            f"<ul>{arrays}</ul>")
