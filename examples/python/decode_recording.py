# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Decoding recorded raw data: arrays of numpy's, however they were recorded, become a depth frame."""

from __future__ import annotations

import sys

import numpy as np

import tofray


def decode(file: str, camera: tofray.Camera) -> tofray.Depth:
    """A recording as numpy keeps it: codes [phase, height, width], and what is known of each raw frame."""
    with np.load(file) as recording:
        raw = tofray.Raw(raw=np.ascontiguousarray(recording["raw"], dtype=np.uint16),
                         modulation_frequency_hz=recording["modulation_frequency_hz"].astype(np.float64),
                         reference_phase_rad=recording["reference_phase_rad"].astype(np.float64),
                         integration_time_s=recording["integration_time_s"].astype(np.float64),
                         lit=recording["lit"].astype(np.uint8))
    return tofray.process(raw, camera)


def main() -> None:
    camera = tofray.load_camera("pico-flexx", "MODE_9_5FPS_2000")
    if len(sys.argv) > 1:
        file = sys.argv[1]
    else:  # no camera at hand: a simulated recording, with all that a recorder would not know left out
        file = "recording.npz"
        taken = tofray.Simulator(tofray.load_scene("demo"), camera).frame(0).raw
        np.savez(file, raw=taken.raw, modulation_frequency_hz=taken.modulation_frequency_hz, reference_phase_rad=taken.reference_phase_rad,
                 integration_time_s=taken.integration_time_s, lit=taken.lit)
    depth = decode(file, camera)
    valid = (depth.flags & tofray.flags["invalid"]) == 0
    print(f"{valid.mean():.0%} of the pixels are valid, from {np.nanmin(depth.z_m):.2f} to {np.nanmax(depth.z_m):.2f} m")


if __name__ == "__main__":
    main()
