#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""ros1_cloud_test.py TOFRAY: what depth_image_proc of Debian's ROS 1 makes of a film's depth images: clouds.

Its nodelet, a master and this test talk over loopback, in a network of their own where that is allowed. Debian has the nodelet's library without
the file that names it (that comes with 140 packages): a folder of the test has it. Waits for what is to come, up to a minute."""

from __future__ import annotations

import os
import pathlib
import queue
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import dds_test

NODELET, LIBRARY = "/usr/lib/nodelet/nodelet", next(iter(sorted(pathlib.Path("/usr/lib").glob("*/libdepth_image_proc.so.0d"))), None)
try:
    import cv2
    import numpy as np
    import rospy
    from sensor_msgs.msg import CameraInfo, Image, PointCloud2
    if LIBRARY is None or not os.path.exists(NODELET) or not os.path.exists("/usr/bin/rosmaster"):
        raise ImportError("there is no nodelet or no rosmaster")
except ImportError as error:
    print(f"SKIPPED: {error} (Debian: libdepth-image-proc0d libnodeletlib-tools python3-rosmaster python3-rospy python3-opencv)")
    sys.exit(77)

import messages_test
import ros1

PACKAGE = """<package format="2"><name>depth_image_proc</name><version>1.17.0</version><description>as it is installed</description>
<maintainer email="nobody@localhost">nobody</maintainer><license>BSD</license>
<depend>nodelet</depend><export><nodelet plugin="${prefix}/nodelets.xml"/></export></package>"""
NODELETS = """<library path="lib/libdepth_image_proc"><class name="depth_image_proc/point_cloud_xyz" type="depth_image_proc::PointCloudXyzNodelet"
base_class_type="nodelet::Nodelet"><description>z to points</description></class></library>"""
LENS = "{k1: -0.25, k2: 0.08, p1: 0.002, p2: -0.001, k3: 0}"
POST = """camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}
objects:
  - rectangle: {name: card, center: [0.03, 0.02, 0.6], size: [0.2, 0.15], reflectivity: 0.8}
  - plane: {name: wall, point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.8}
"""


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def is_listening(port: int) -> bool:
    with socket.socket() as one:
        return one.connect_ex(("127.0.0.1", port)) == 0


class Clouds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "depth_image_proc/lib").mkdir(parents=True)
        (cls.folder / "depth_image_proc/package.xml").write_text(PACKAGE)
        (cls.folder / "depth_image_proc/nodelets.xml").write_text(NODELETS)
        (cls.folder / "depth_image_proc/lib/libdepth_image_proc.so").symlink_to(LIBRARY)
        port = free_port()
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", ROS_PACKAGE_PATH=f"{cls.folder}:/usr/share",
                          ROS_HOME=str(cls.folder), ROS_LOG_DIR=str(cls.folder), CMAKE_PREFIX_PATH=str(cls.folder / "depth_image_proc"))
        cls.start("/usr/bin/rosmaster", "--core", "-p", port)
        end = time.monotonic() + dds_test.PATIENCE_S
        while not is_listening(port):
            assert time.monotonic() < end, "the master did not begin"
            time.sleep(0.05)
        cls.start(NODELET, "standalone", "depth_image_proc/point_cloud_xyz", "image_rect:=/image", "camera_info:=/camera_info", "points:=/points")
        rospy.init_node("tofray_test", disable_signals=True)
        cls.addClassCleanup(rospy.signal_shutdown, "the end")
        cls.clouds: queue.Queue = queue.Queue()
        rospy.Subscriber("/points", PointCloud2, cls.clouds.put)
        cls.image, cls.info = (rospy.Publisher(f"/{name}", kind, queue_size=5) for name, kind in (("image", Image), ("camera_info", CameraInfo)))

    @classmethod
    def start(cls, *words: object) -> None:
        log = (cls.folder / "log.txt").open("a")
        running = subprocess.Popen(list(map(str, words)), stdout=log, stderr=subprocess.STDOUT)
        cls.addClassCleanup(log.close)
        cls.addClassCleanup(running.wait)
        cls.addClassCleanup(running.kill)

    def cloud_of(self, image: dict, info: dict) -> np.ndarray:
        """x, y, z of each pixel. Sent again until the answer to it is here: who subscribes late hears nothing of before."""
        image_1, info_1, end = ros1.image(image), ros1.camera_info(info), time.monotonic() + dds_test.PATIENCE_S
        while time.monotonic() < end:
            self.image.publish(image_1), self.info.publish(info_1)
            try:
                cloud = self.clouds.get(timeout=0.2)
            except queue.Empty:
                continue
            if cloud.header.frame_id == image_1.header.frame_id:
                data = np.frombuffer(cloud.data, np.float32).reshape(cloud.height, cloud.width, cloud.point_step // 4)
                return data[..., [field.offset // 4 for field in cloud.fields[:3]]]
        raise AssertionError("no cloud came: " + (self.folder / "log.txt").read_text()[-500:])

    def run_of(self, lens: str, *words: object) -> messages_test.Run:
        """Each with another name, which is that of its frame."""
        scene = self.folder / "post.yaml"
        scene.write_text(POST)
        return messages_test.Run("--noise", "off", "--set", f"camera.lens.distortion={lens}", "--camera-name", self.id().split(".")[-1], *words,
                                 scene=str(scene), frames=1)

    def topic(self, run: messages_test.Run, name: str) -> dict:
        return run.value(f"/{self.id().split('.')[-1]}/{name}")

    def test_a_pinholes_cloud_is_tofrays_own(self):
        run = self.run_of("{k1: 0}")
        points = run.frames[0]["points_m"]
        cloud = self.cloud_of(self.topic(run, "depth_image"), self.topic(run, "camera_info"))
        seen = np.isfinite(points[..., 2])
        self.assertGreater(seen.mean(), 0.5)
        self.assertTrue(np.array_equal(np.isfinite(cloud).all(-1), seen), "NaN stay NaN")
        self.assertLess(np.abs(cloud - points)[seen].max(), 1e-5)

    def test_millimetres_are_read_as_such(self):
        run = self.run_of("{k1: 0}", "--depth-encoding", "16UC1")
        z = run.frames[0]["z_m"]
        cloud = self.cloud_of(self.topic(run, "depth_image"), self.topic(run, "camera_info"))
        seen = np.isfinite(z)
        self.assertTrue(np.array_equal(np.isfinite(cloud[..., 2]), seen), "0 is nothing")
        self.assertLess(np.abs(cloud[..., 2] - z)[seen].max(), 0.501e-3)

    def test_rectified_depth_has_nothing_between_near_and_far(self):
        run = self.run_of(LENS, "--topics", "depth,rectified")
        info = self.topic(run, "rectified/camera_info")
        cloud = self.cloud_of(self.topic(run, "rectified/image_rect"), info)
        z = cloud[..., 2][np.isfinite(cloud[..., 2])]
        self.assertGreater(z.size, 10000)
        self.assertLess(np.minimum(np.abs(z - 0.6), np.abs(z - 1)).max(), 1e-3)
        card = cloud[np.abs(cloud[..., 2] - 0.6) < 0.01]
        for axis, (low, high) in enumerate(((-0.07, 0.13), (-0.055, 0.095))):   # straight edges, to a pixel of 0.6 m/212
            self.assertLess(abs(card[:, axis].min() - low), 0.004)
            self.assertLess(abs(card[:, axis].max() - high), 0.004)
        # What others do to depth: between two pixels.
        raw = self.topic(run, "camera_info")
        k, p = np.reshape(raw["k"], (3, 3)), np.reshape(info["k"], (3, 3))
        maps = cv2.initUndistortRectifyMap(k, np.array(raw["d"]), None, p, (info["width"], info["height"]), cv2.CV_32FC1)
        linear = cv2.remap(run.frames[0]["z_m"], *maps, cv2.INTER_LINEAR)
        linear = linear[np.isfinite(linear)]
        self.assertGreater((np.minimum(np.abs(linear - 0.6), np.abs(linear - 1)) > 0.01).sum(), 100)


if __name__ == "__main__":
    dds_test.own_network()
    messages_test.TOFRAY = sys.argv.pop(1)
    unittest.main(verbosity=1, warnings="ignore")   # rospy has its own
