# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What a notebook shows of a frame beside its picture."""

from __future__ import annotations

import base64
import html
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._frame import Frame
    from ._part import Part


def _value(raw: Part, name: str, k: int, scale: float, form: str) -> str:
    """One raw frame's number as text; empty where the frame does not have it."""
    values = raw.get(name)
    return form.format(values[k] * scale) if getattr(values, "ndim", 0) == 1 and values is not None and k < len(values) else ""


def frame_html(frame: Frame) -> str:
    """The picture, which a notebook would not show beside HTML, what the frame is, its raw frames in a table, and its arrays."""
    png = frame._repr_png_()
    picture = "" if png is None else f'<p><img alt="preview" src="data:image/png;base64,{base64.b64encode(png).decode()}"></p>'
    raw = frame.raw
    rows = ""
    phases = raw.phases if isinstance(raw.phases, int) and any(name in raw for name, (*_, shape, _, _) in raw._rows.items()
                                                               if shape == "[phase]") else 0
    for k in range(phases):
        rows += (f"<tr><td>{k}</td><td>{_value(raw, 'modulation_frequency_hz', k, 1e-6, '{:g} MHz')}</td>"
                 f"<td>{_value(raw, 'reference_phase_rad', k, 180 / 3.141592653589793, '{:.1f}°')}</td>"
                 f"<td>{_value(raw, 'integration_time_s', k, 1e6, '{:g} µs')}</td>"
                 f"<td>{'unlit' if _value(raw, 'lit', k, 1, '{:g}') == '0' else ''}</td></tr>")
    arrays = "".join(f"<li><code>{part}</code>: {html.escape(', '.join(getattr(frame, part).names) or 'none')}</li>"
                     for part in ("raw", "depth", "truth"))
    return (f"{picture}<p><b>tofray frame {frame.index}</b> {html.escape(frame._caption())}</p>"
            f"<table><tr><th>raw frame</th><th>modulation frequency</th><th>reference phase</th>"
            f"<th>integration time</th><th></th></tr>{rows}</table>"
            f"<ul>{arrays}</ul>")
