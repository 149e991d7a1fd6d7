#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""messages_test.py TOFRAY: MCAP files of `tofray render`, read by tests/ros/mcap.py, against frame.npz."""

from __future__ import annotations

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("SKIPPED: there is no numpy (Debian: python3-numpy)")
    sys.exit(77)

import mcap

TOFRAY = ""
SMALL = ["--set", "camera.readout.binning=4"]  # 56 x 43 pixels of a pico flexx
MOVED = ["--set", "camera.pose={position: [1 m, -2 m, 3 m], look_at: [2 m, -2 m, 3 m]}"]  # looks along the world's x, 2 m up


def tofray(*words: object) -> subprocess.CompletedProcess:
    return subprocess.run([TOFRAY, *map(str, words)], capture_output=True, text=True)


class Run:
    """Frames as npz and as MCAP."""

    def __init__(self, *words: object, scene: str = "room", frames: int = 2):
        with tempfile.TemporaryDirectory() as folder:
            done = tofray("render", scene, "-o", folder, "--frames", frames, "--emit", "npz,mcap", "--mcap-compression", "none", *words)
            assert done.returncode == 0, done.stderr
            self.file = mcap.Mcap(pathlib.Path(folder) / "run.mcap")
            self.frames = []
            for i in range(frames):
                with np.load(f"{folder}/frame_{i:04}.npz") as arrays:
                    self.frames.append(dict(arrays))

    def value(self, topic: str, i: int = 0) -> dict:
        return self.file.on(topic)[i].value


def same_bits(a: np.ndarray, b: np.ndarray) -> bool:
    return a.shape == b.shape and a.dtype == b.dtype and a.tobytes() == b.tobytes()


def undistorted(rays: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    x, y = rays[..., 0].astype(float), rays[..., 1].astype(float)
    return x, y, x * x + y * y


def plumb_bob(d, rays):
    k1, k2, p1, p2, k3 = d
    x, y, r2 = undistorted(rays)
    g = 1 + k1 * r2 + k2 * r2**2 + k3 * r2**3
    return x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * g + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y


def rational_polynomial(d, rays):
    k1, k2, p1, p2, k3, k4, k5, k6 = d
    x, y, r2 = undistorted(rays)
    g = (1 + k1 * r2 + k2 * r2**2 + k3 * r2**3) / (1 + k4 * r2 + k5 * r2**2 + k6 * r2**3)
    return x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * g + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y


def equidistant(d, rays):
    x, y, r2 = undistorted(rays)
    r = np.sqrt(r2)
    theta = np.arctan(r)
    g = theta * (1 + d[0] * theta**2 + d[1] * theta**4 + d[2] * theta**6 + d[3] * theta**8) / np.where(r > 0, r, 1)
    return x * g, y * g


MODELS = {"plumb_bob": plumb_bob, "rational_polynomial": rational_polynomial, "equidistant": equidistant}


def projected(info: dict, rays: np.ndarray) -> np.ndarray:
    """Pixel coordinates of rays x/z, y/z, as ROS's documentation of CameraInfo has them."""
    xd, yd = MODELS[info["distortion_model"]](info["d"], rays)
    k = info["k"]
    return np.stack([k[0] * xd + k[2], k[4] * yd + k[5]], -1)


def rotation(q: dict) -> np.ndarray:
    x, y, z, w = q["x"], q["y"], q["z"], q["w"]
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Plain(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = Run(*SMALL, "--topics", "depth,amplitude,noise,confidence,points,raw,rectified,truth,clock", frames=6)

    def test_images_have_the_bits_of_frame_npz(self):
        for i, frame in enumerate(self.run_.frames):
            for topic, array, encoding in (("depth_image", "z_m", "32FC1"), ("noise_image", "noise_m", "32FC1"),
                                           ("confidence_image", "confidence", "mono8"), ("gt/z", "gt_z_m", "32FC1"),
                                           ("gt/object_id", "gt_object_id", "32SC1")):
                message = self.run_.value(f"/camera/{topic}", i)
                self.assertEqual(message["encoding"], encoding)
                self.assertEqual(message["is_bigendian"], 0)
                self.assertTrue(same_bits(mcap.image(message), frame[array]), (topic, i))
            for k, raw in enumerate(frame["raw"]):
                message = self.run_.value(f"/camera/raw/p{k}", i)
                self.assertEqual(message["encoding"], "mono16")
                self.assertTrue(same_bits(mcap.image(message), raw), (k, i))

    def test_the_step_is_that_of_a_row_in_bytes(self):
        self.assertEqual(self.run_.value("/camera/depth_image")["step"], 4 * 56)
        self.assertEqual(self.run_.value("/camera/confidence_image")["step"], 56)

    def test_invalid_depth_is_nan(self):
        z = mcap.image(self.run_.value("/camera/depth_image"))
        self.assertGreater(np.isnan(z).sum(), 0)
        self.assertFalse((z == 0).any())

    def test_the_cloud_is_organized_and_has_the_bits_of_the_arrays(self):
        for i, frame in enumerate(self.run_.frames):
            message = self.run_.value("/camera/points", i)
            fields = mcap.cloud(message)
            self.assertEqual((message["height"], message["width"]), (43, 56))
            for c, name in enumerate("xyz"):
                self.assertTrue(same_bits(fields[name], np.ascontiguousarray(frame["points_m"][:, :, c])))
            for name, array in (("intensity", "amplitude_e"), ("noise", "noise_m"), ("flags", "flags"), ("confidence", "confidence")):
                self.assertTrue(same_bits(fields[name], frame[array]), name)
            self.assertIs(message["is_dense"], False)

    def test_amplitude_is_counted_in_the_step_that_the_file_states(self):
        step = float(self.run_.file.metadata["tofray"]["amplitude_step_e"])
        for i, frame in enumerate(self.run_.frames):
            expected = np.clip(np.floor(np.nan_to_num(frame["amplitude_e"].astype(float)) / step + 0.5), 0, 65535).astype(np.uint16)
            self.assertTrue(same_bits(mcap.image(self.run_.value("/camera/amplitude_image", i)), expected))
            self.assertGreater(expected.max(), 100)

    def test_all_of_a_frame_is_stamped_with_the_middle_of_its_exposures(self):
        for i, frame in enumerate(self.run_.frames):
            start, end = frame["start_time_s"][0], frame["start_time_s"][-1] + frame["integration_time_s"][-1]
            middle = round(1e9 * (start + end) / 2)
            for topic, kind in self.run_.file.topics().items():
                if kind in ("sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/PointCloud2"):
                    self.assertLessEqual(abs(mcap.stamp_ns(self.run_.value(topic, i)["header"]) - middle), 1, topic)
            transform, = self.run_.value("/tf", i)["transforms"]
            self.assertLessEqual(abs(mcap.stamp_ns(transform["header"]) - middle), 1)

    def test_messages_are_logged_when_the_frame_could_have_been_sent(self):
        readout_s = json.loads(str(self.run_.frames[0]["meta"]))["camera"]["readout_time_s"]
        for i, frame in enumerate(self.run_.frames):
            sent = 1e9 * (frame["start_time_s"][-1] + frame["integration_time_s"][-1] + readout_s)
            message = self.run_.file.on("/camera/depth_image")[i]
            self.assertLessEqual(abs(message.log - sent), 1)
            self.assertEqual(message.publish, message.log)
            clock = self.run_.value("/clock", i)["clock"]
            self.assertEqual(clock["sec"] * 10**9 + clock["nanosec"], message.log)

    def test_times_never_go_back_and_sequences_count(self):
        logs = [one.log for one in self.run_.file.messages]
        self.assertEqual(logs, sorted(logs))
        for topic in self.run_.file.topics():
            self.assertEqual([one.sequence for one in self.run_.file.on(topic)], list(range(len(self.run_.file.on(topic)))))

    def test_diagnostics_come_each_second_with_shares_that_are_counted(self):
        frames = [json.loads(str(frame["meta"]))["frame"] for frame in self.run_.frames]
        told = [dict((one["key"], one["value"]) for one in message.value["status"][0]["values"]) for message in
                self.run_.file.on("/diagnostics")]
        self.assertEqual([int(one["frame"]) for one in told], [i for i in frames if i % 5 == 0])  # 5 frames a second
        flags = self.run_.frames[0]["flags"]
        invalid = 1 | 2 | 4 | 8 | 16
        self.assertEqual(told[0]["valid_share"], f"{np.mean((flags & invalid) == 0):.4f}")
        self.assertEqual(told[0]["low_signal_share"], f"{np.mean((flags & 2) != 0):.4f}")

    def test_raw_meta_says_when_and_how(self):
        frame = self.run_.frames[3]
        meta = json.loads(self.run_.value("/camera/raw/meta", 3)["data"])
        self.assertEqual(meta["frame"], 3)
        self.assertEqual(meta["topics"], [f"/camera/raw/p{k}" for k in range(9)])
        for name in ("modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "start_time_s", "lit"):
            self.assertEqual(meta[name], frame[name].tolist(), name)

    def test_the_camera_and_the_scene_are_attached_and_make_the_same_film(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, body in self.run_.file.attachments.items():
                (pathlib.Path(folder) / name).write_bytes(body)
            self.assertEqual(set(self.run_.file.attachments), {"camera.yaml", "scene.yaml", "manifest.json"})
            self.assertEqual(tofray("check", f"{folder}/camera.yaml").returncode, 0)
            self.assertEqual(tofray("check", f"{folder}/scene.yaml").returncode, 0)
            done = tofray("render", "--from", f"{folder}/manifest.json", "-o", f"{folder}/again")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((pathlib.Path(folder) / "again/run.mcap").read_bytes(), self.run_.file.bytes)

    def test_rectified_pixels_are_those_of_the_nearest_pixel(self):
        info = self.run_.value("/camera/rectified/camera_info")
        self.assertEqual(info["d"], [0] * 5)
        raw_info = self.run_.value("/camera/camera_info")
        v, u = np.mgrid[0:43, 0:56]
        rays = np.stack([(u - info["k"][2]) / info["k"][0], (v - info["k"][5]) / info["k"][4]], -1)
        at = np.floor(projected(raw_info, rays) + 0.5).astype(int)
        inside = (at[..., 0] >= 0) & (at[..., 0] < 56) & (at[..., 1] >= 0) & (at[..., 1] < 43)
        z = self.run_.frames[0]["z_m"]
        expected = np.where(inside, z[np.clip(at[..., 1], 0, 42), np.clip(at[..., 0], 0, 55)], np.float32(np.nan))
        got = mcap.image(self.run_.value("/camera/rectified/image_rect"))
        self.assertTrue(np.array_equal(got, expected, equal_nan=True))
        self.assertFalse(np.array_equal(got, z, equal_nan=True))


class Geometry(unittest.TestCase):
    """CameraInfo by the formulas of ROS, in numpy: each pixel's ray comes back to its pixel."""

    def check(self, run: Run, model: str):
        frame, info = run.frames[0], run.value("/camera/camera_info")
        self.assertEqual(info["distortion_model"], model)
        self.assertTrue(any(info["d"]))
        valid = np.isfinite(frame["z_m"])
        self.assertGreater(valid.sum(), 0.9 * valid.size)
        rays = frame["points_m"].astype(float)[..., :2] / frame["points_m"].astype(float)[..., 2:]
        v, u = np.mgrid[0:valid.shape[0], 0:valid.shape[1]]
        off = np.abs(projected(info, rays) - np.stack([u, v], -1))[valid]
        self.assertLess(off.max(), 0.01)
        k = info["k"]
        self.assertEqual(info["p"], [k[0], 0, k[2], 0, 0, k[4], k[5], 0, 0, 0, 1, 0])
        self.assertEqual(info["r"], [1, 0, 0, 0, 1, 0, 0, 0, 1])
        self.assertEqual((info["binning_x"], info["binning_y"], set(info["roi"].values())), (0, 0, {0}))
        self.assertEqual((info["height"], info["width"]), valid.shape)

    LENS = "{k1: -0.31, k2: 0.12, p1: 0.004, p2: -0.003, k3: -0.02"

    def test_plumb_bob(self):
        self.check(Run("--noise", "off", "--set", f"camera.lens.distortion={self.LENS}}}", scene="card"), "plumb_bob")

    def test_plumb_bob_of_a_region_and_binned(self):
        self.check(Run("--noise", "off", "--set", f"camera.lens.distortion={self.LENS}}}", "--set",
                       "camera.readout={binning: 2, region: {left: 20, top: 10, width: 160, height: 120}}", scene="card"), "plumb_bob")

    def test_rational_polynomial(self):
        self.check(Run("--noise", "off", "--set", f"camera.lens.distortion={self.LENS}, k4: 0.05, k5: 0.02, k6: 0.01}}", scene="card"),
                   "rational_polynomial")

    def test_equidistant(self):
        self.check(Run("--noise", "off", "--set", "camera.lens.distortion={model: fisheye, k1: -0.02, k2: 0.01, k3: -0.004, k4: 0.001}",
                       scene="card"), "equidistant")

    def test_the_link_looks_along_x_and_the_optical_frame_along_z(self):
        run = Run(*SMALL, *MOVED)
        (pose,), (mount,) = run.value("/tf")["transforms"], run.value("/tf_static")["transforms"]
        self.assertEqual([pose["header"]["frame_id"], pose["child_frame_id"]], ["map", "camera_link"])
        self.assertEqual([mount["header"]["frame_id"], mount["child_frame_id"]], ["camera_link", "camera_optical_frame"])
        self.assertEqual(run.value("/camera/points")["header"]["frame_id"], "camera_optical_frame")
        link, optical = rotation(pose["transform"]["rotation"]), rotation(mount["transform"]["rotation"])
        np.testing.assert_allclose(optical, [[0, 0, 1], [-1, 0, 0], [0, -1, 0]], atol=1e-12)
        # World: x right, y down, z forward; map: x forward, y left, z up.
        np.testing.assert_allclose([pose["transform"]["translation"][c] for c in "xyz"], [3, -1, 2], atol=1e-12)
        np.testing.assert_allclose(link @ [1, 0, 0], [0, -1, 0], atol=1e-12)  # along the world's x: the map's right
        np.testing.assert_allclose(link @ [0, 0, 1], [0, 0, 1], atol=1e-12)   # upright

    def test_points_on_the_map_are_where_the_scene_has_them(self):
        run = Run(*SMALL, *MOVED, "--topics", "depth,points", scene="room")
        frame, message = run.frames[0], run.value("/camera/points")
        fields = mcap.cloud(message)
        points = np.stack([fields[c] for c in "xyz"], -1).reshape(-1, 3).astype(float)
        valid = np.isfinite(points[:, 2])
        self.assertGreater(valid.sum(), 100)
        (pose,), (mount,) = run.value("/tf")["transforms"], run.value("/tf_static")["transforms"]
        at = lambda t: np.array([t["translation"][c] for c in "xyz"])
        on_map = (rotation(pose["transform"]["rotation"]) @ rotation(mount["transform"]["rotation"]) @ points.T).T + at(pose["transform"])
        world = (frame["camera_pose"][:3, :3] @ points.T).T + frame["camera_pose"][:3, 3]
        expected = np.stack([world[:, 2], -world[:, 0], -world[:, 1]], -1)
        np.testing.assert_allclose(on_map[valid], expected[valid], atol=1e-9)


class Options(unittest.TestCase):
    def test_millimetres_are_rounded_and_0_is_invalid(self):
        run = Run(*SMALL, "--depth-encoding", "16UC1")
        z = run.frames[0]["z_m"].astype(float)
        expected = np.where(np.isfinite(z), np.floor(1000 * np.nan_to_num(z) + 0.5), 0).astype(np.uint16)
        message = run.value("/camera/depth_image")
        self.assertEqual((message["encoding"], message["step"]), ("16UC1", 112))
        self.assertTrue(same_bits(mcap.image(message), expected))
        self.assertGreater((expected == 0).sum(), 0)

    def test_stamps_may_be_those_of_the_start_or_the_end(self):
        start, end = Run(*SMALL, "--stamp", "start"), Run(*SMALL, "--stamp", "end", "--epoch", "1.7e9")
        frame = start.frames[1]
        self.assertLessEqual(abs(mcap.stamp_ns(start.value("/camera/points", 1)["header"]) - 1e9 * frame["start_time_s"][0]), 1)
        last = frame["start_time_s"][-1] + frame["integration_time_s"][-1]
        self.assertLessEqual(abs(mcap.stamp_ns(end.value("/camera/points", 1)["header"]) - 10**9 * 17 * 10**8 - round(1e9 * last)), 256)

    def test_unorganized_clouds_have_the_valid_points_alone_and_are_dense(self):
        run = Run(*SMALL, "--unorganized")
        message = run.value("/camera/points")
        valid = np.isfinite(run.frames[0]["z_m"])
        self.assertEqual((message["height"], message["width"], message["is_dense"]), (1, valid.sum(), True))
        self.assertTrue(same_bits(mcap.cloud(message)["z"][0], run.frames[0]["points_m"][:, :, 2][valid]))

    def test_an_organized_cloud_without_holes_is_dense(self):
        run = Run("--noise", "off", "--set", "camera.decoding.noise_threshold=1 m", scene="card")
        self.assertTrue(np.isfinite(run.frames[0]["points_m"]).all())
        self.assertIs(run.value("/camera/points")["is_dense"], True)

    def test_a_step_that_is_asked_for_is_taken_and_clips(self):
        run = Run(*SMALL, "--amplitude-step", "0.01", "--driver", "pico_flexx")
        amplitude = run.frames[0]["amplitude_e"].astype(float)
        expected = np.clip(np.floor(amplitude / 0.01 + 0.5), 0, 65535).astype(np.uint16)
        self.assertTrue(same_bits(mcap.image(run.value("/pico_flexx/image_mono16")), expected))
        self.assertTrue(same_bits(mcap.image(run.value("/pico_flexx/image_mono8")), (expected >> 8).astype(np.uint8)))
        self.assertEqual(expected.max(), 65535)

    def test_topics_that_are_not_asked_for_are_not_there(self):
        run = Run(*SMALL, "--topics", "points", "--camera-name", "left")
        self.assertEqual(set(run.file.topics()), {"/left/points", "/left/camera_info", "/tf", "/tf_static", "/diagnostics"})

    def test_what_cannot_be_is_refused_with_the_way_out(self):
        for words, expected in ((("--driver", "kinect"), "plain, pmd, pico_flexx, ifm, k4a or realsense"),
                                (("--topics", "dept"), 'did you mean "depth"'), (("--camera-name", "2nd"), "letters, digits and _"),
                                (("--stamp", "now"), "start, middle or end"), (("--epoch", "-1"), "0 to 2e9")):
            with tempfile.TemporaryDirectory() as folder:
                done = tofray("render", "card", "-o", f"{folder}/out", "--emit", "mcap", *words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(expected, done.stderr)
        done = tofray("render", "card", "--driver", "pmd", "--emit", "npz")
        self.assertEqual((done.returncode, "expected mcap in --emit" in done.stderr), (2, True))


class Drivers(unittest.TestCase):
    def topics(self, *words: object) -> tuple[Run, dict[str, str]]:
        run = Run(*SMALL, *words)
        short = {"sensor_msgs/msg/Image": "image", "sensor_msgs/msg/CameraInfo": "info", "sensor_msgs/msg/PointCloud2": "points"}
        return run, {topic: short[kind] for topic, kind in run.file.topics().items() if kind in short and "/raw/" not in topic}

    def test_pmd(self):
        run, topics = self.topics("--driver", "pmd")
        at = "/pmd_royale_ros_camera_node/"
        self.assertEqual(topics, {at + "depth_image_0": "image", at + "gray_image_0": "image", at + "camera_info": "info",
                                  at + "point_cloud_0": "points"})
        message = run.value(at + "point_cloud_0")
        self.assertEqual((message["height"], message["width"]), (43, 56))  # the driver's own are swapped
        fields = mcap.cloud(message)
        self.assertEqual(list(fields), ["x", "y", "z", "conf"])
        np.testing.assert_allclose(fields["conf"], run.frames[0]["confidence"] / np.float32(255), atol=1e-7)
        self.assertEqual(run.value(at + "gray_image_0")["encoding"], "mono8")
        self.assertEqual(message["header"]["frame_id"], "pmd_royale_ros_camera_node_optical_frame")

    def test_pico_flexx(self):
        run, topics = self.topics("--driver", "pico_flexx")
        self.assertEqual(topics, {"/pico_flexx/" + name: kind for name, kind in {
            "image_depth": "image", "image_mono16": "image", "image_mono8": "image", "image_noise": "image", "camera_info": "info",
            "points": "points"}.items()})
        fields = mcap.cloud(run.value("/pico_flexx/points"))
        self.assertEqual(list(fields), ["x", "y", "z", "noise", "intensity", "gray"])
        self.assertTrue(same_bits(fields["intensity"], mcap.image(run.value("/pico_flexx/image_mono16"))))

    def test_ifm_has_the_range_along_the_ray(self):
        run, topics = self.topics("--driver", "ifm")
        self.assertEqual(topics, {"/ifm3d/camera/" + name: kind for name, kind in {
            "distance": "image", "distance_noise": "image", "amplitude": "image", "confidence": "image", "camera_info": "info",
            "cloud": "points"}.items()})
        self.assertTrue(same_bits(mcap.image(run.value("/ifm3d/camera/distance")), run.frames[0]["range_m"]))
        self.assertEqual([one["child_frame_id"] for one in run.value("/tf_static")["transforms"]],
                         ["camera_mounting_link", "camera_optical_link"])

    def test_k4a(self):
        run, topics = self.topics("--driver", "k4a")
        self.assertEqual(topics, {"/depth/image_raw": "image", "/depth/camera_info": "info", "/ir/image_raw": "image",
                                  "/ir/camera_info": "info", "/points2": "points"})
        info = run.value("/depth/camera_info")
        self.assertEqual((info["distortion_model"], len(info["d"])), ("rational_polynomial", 8))
        self.assertEqual(run.value("/depth/image_raw")["encoding"], "16UC1")
        self.assertEqual(info["header"]["frame_id"], "depth_camera_link")

    def test_realsense_is_rectified(self):
        run, topics = self.topics("--driver", "realsense", "--topics", "depth,amplitude,points,rectified")
        self.assertEqual(topics, {"/camera/camera/" + name: kind for name, kind in {
            "depth/image_rect_raw": "image", "depth/camera_info": "info", "infra1/image_rect_raw": "image", "infra1/camera_info": "info",
            "depth/color/points": "points", "rectified/image_rect": "image", "rectified/camera_info": "info"}.items()})
        self.assertEqual(run.value("/camera/camera/depth/camera_info")["d"], [0] * 5)
        depth = run.value("/camera/camera/depth/image_rect_raw")
        self.assertEqual(depth["encoding"], "16UC1")
        self.assertTrue(same_bits(mcap.image(depth), mcap.image(run.value("/camera/camera/rectified/image_rect"))))


class File(unittest.TestCase):
    def test_a_second_run_has_the_same_bytes_packed_or_not(self):
        with tempfile.TemporaryDirectory() as folder:
            for packing in ("none", "zstd"):
                sums = []
                for name, threads in (("a", 1), ("b", 2)):
                    done = tofray("render", "flying-ball", "--frames", 20, "--emit", "mcap", "-o", f"{folder}/{packing}{name}", "--threads",
                                  threads, "--mcap-compression", packing, *SMALL)
                    if packing == "zstd" and "without libzstd" in done.stderr:
                        self.skipTest("this build has no libzstd")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    listed, = [one for one in json.loads(pathlib.Path(f"{folder}/{packing}{name}/manifest.json").read_text())["files"]]
                    sums.append(listed["sha256"])
                self.assertEqual(sums[0], sums[1])

    def test_a_part_of_a_run_has_a_name_of_its_own_and_the_messages_of_the_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            common = ("--emit", "mcap", "--mcap-compression", "none", *SMALL)
            whole = Run(*SMALL, frames=4)
            done = tofray("render", "room", "--first-frame", 2, "--frames", 2, "-o", folder, *common)
            self.assertEqual(done.returncode, 0, done.stderr)
            part = mcap.Mcap(pathlib.Path(folder) / "run_0002.mcap")
            for topic in whole.file.topics():
                if topic != "/tf_static" and topic != "/diagnostics":
                    self.assertEqual([one.data for one in part.on(topic)], [one.data for one in whole.file.on(topic)][2:], topic)

    def test_schemas_and_channels_come_before_all_chunks_and_attachments_survive_a_cut(self):
        run = Run(*SMALL)
        self.assertLess(max(run.file.order.index(0x03), run.file.order.index(0x04), run.file.order.index(0x09)), run.file.order.index(0x06))
        self.assertEqual((run.file.profile, run.file.library.split()[0]), ("ros2", "tofray"))


if __name__ == "__main__":
    TOFRAY = sys.argv.pop(1)
    unittest.main(verbosity=1)
