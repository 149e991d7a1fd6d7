# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Messages of a film as Python's classes of Debian's ROS 1, which has readers of them that nobody here wrote: an oracle of tests alone."""

from __future__ import annotations

import numpy as np
from sensor_msgs.msg import CameraInfo, Image


def camera_info(message: dict) -> CameraInfo:
    """Matrices have large letters in ROS 1."""
    out = CameraInfo(width=message["width"], height=message["height"], distortion_model=message["distortion_model"], D=message["d"],
                     K=message["k"], R=message["r"], P=message["p"], binning_x=message["binning_x"], binning_y=message["binning_y"])
    for name, value in message["roi"].items():
        setattr(out.roi, name, value)
    return stamped(out, message)


def image(message: dict) -> Image:
    return stamped(Image(data=message["data"].tobytes(), **{name: message[name] for name in ("width", "height", "encoding", "is_bigendian",
                                                                                           "step")}), message)


def stamped(out, message: dict):
    out.header.frame_id = message["header"]["frame_id"]
    out.header.stamp.secs, out.header.stamp.nsecs = message["header"]["stamp"]["sec"], message["header"]["stamp"]["nanosec"]
    return out


def pixels(height: int, width: int, each: int) -> list[tuple[int, int]]:
    """Some of an image's pixels (row, column), the four corners among them."""
    rows, columns = (np.unique([*range(0, size, each), size - 1]) for size in (height, width))
    return [(int(row), int(column)) for row in rows for column in columns]
