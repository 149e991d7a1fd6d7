#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""dds_test.py TOFRAY [--fast READER] [--node NODE SCRIPT]: what `tofray stream` sends, as others' DDS sees it: eProsima's Fast DDS and npm's
@foxglove/ros2, against what `tofray render --emit mcap` writes of the same frames.

In a network of its own (a namespace with nothing but loopback) where that is allowed, else on this machine's loopback. Waits for what is to
come, up to a minute, never for a time."""

from __future__ import annotations

import argparse
import collections
import hashlib
import json
import os
import pathlib
import queue
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

try:
    import mcap
except ImportError:
    print("SKIPPED: there is no numpy (Debian: python3-numpy)")
    sys.exit(77)

DOMAIN = "83"
PATIENCE_S = 60
SMALL = ["--set", "camera.readout.binning=4", "--seed", "5"]  # 56 x 43 pixels of a pico flexx: messages of one datagram and of several
GOLDEN = {  # as ROS 2's own packages have them (Iron to Jazzy, `ros2 topic info -v`)
    "sensor_msgs::msg::dds_::Image_": "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47",
    "sensor_msgs::msg::dds_::CameraInfo_": "b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275",
    "sensor_msgs::msg::dds_::PointCloud2_": "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
    "tf2_msgs::msg::dds_::TFMessage_": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    "rosgraph_msgs::msg::dds_::Clock_": "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
    "diagnostic_msgs::msg::dds_::DiagnosticArray_": "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
    "std_msgs::msg::dds_::String_": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
}


def own_network() -> None:
    """Begins again in a namespace where loopback is all there is, and is up."""
    flags = {"TOFRAY_OWN_NETWORK": "1"}
    if "TOFRAY_OWN_NETWORK" not in os.environ:
        for words in (["unshare", "-n"], ["unshare", "-rn"]):
            if shutil.which("unshare") and shutil.which("ip") and subprocess.run([*words, "true"], capture_output=True).returncode == 0:
                os.execvpe("unshare", [*words, sys.executable, *sys.argv], {**os.environ, **flags})
        return
    for words in ("link set lo up", "link set lo multicast on", "route add 224.0.0.0/4 dev lo"):
        subprocess.run(["ip", *words.split()], check=True)


class Program:
    """A program whose lines are read as they come."""

    def __init__(self, words: list[str], **more):
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)
        self.lines: list[str] = []
        self.errors: list[str] = []
        self._new: queue.Queue[str | None] = queue.Queue()
        self._threads = [threading.Thread(target=self._read, daemon=True), threading.Thread(target=self._read_errors, daemon=True)]
        for one in self._threads:
            one.start()

    def _read(self) -> None:
        for line in self.process.stdout:
            self._new.put(line.rstrip("\n"))
        self._new.put(None)

    def _read_errors(self) -> None:
        self.errors.extend(self.process.stderr)

    def until(self, enough, patience_s: float = PATIENCE_S) -> "Program":
        """Reads until enough(lines). The last line of a program that ends is None."""
        end = time.monotonic() + patience_s
        while not enough(self.lines):
            try:
                line = self._new.get(timeout=max(0.0, end - time.monotonic()))
            except queue.Empty:
                raise AssertionError(f"{self.process.args} did not say enough: {self.lines[-3:]} {''.join(self.errors)[-500:]}") from None
            if line is None:
                assert enough(self.lines), f"{self.process.args} ended: {self.lines[-3:]} {''.join(self.errors)[-500:]}"
                break
            self.lines.append(line)
        return self

    def end(self) -> int:
        try:
            self.process.stdin.close()
            code = self.process.wait(PATIENCE_S)
        finally:
            self.process.kill()
        for one in self._threads:
            one.join()
        while (line := self._new.get()) is not None:
            self.lines.append(line)
        self.process.stdout.close(), self.process.stderr.close()
        return code


class Subscriber(Program):
    def messages(self) -> dict[str, list[str]]:
        """Hashes by ROS's topic, in the order in which they came, each once: @foxglove/rtps takes for new what it asked for again. No two
        messages of a topic are equal, for they have their stamps."""
        out = collections.defaultdict(list)
        for line in dict.fromkeys(self.lines):
            if line.startswith("message "):
                _, topic, _, digest = line.split()
                out[topic.removeprefix("rt")].append(digest)
        return out

    def writers(self) -> dict[str, list[str]]:
        """What is known of each of ROS's topics: type, user data, qualities."""
        return {line.split()[1]: line.split()[2:] for line in self.lines if line.startswith("writer rt/")}

    def has(self, count: int, topic: str) -> "Subscriber":
        return self.until(lambda _: len(self.messages()[topic]) >= count)


def ready(lines: list[str]) -> bool:
    return "ready" in lines


def dds_type(ros: str) -> str:
    package, _, name = ros.split("/")
    return f"{package}::msg::dds_::{name}_"


class Tools:
    tofray = ""
    fast: str | None = None
    node: list[str] | None = None


def fast(topics: dict[str, str], qos: str = "lasting") -> Subscriber:
    words = [f"rt{topic}={dds_type(kind)}" for topic, kind in topics.items()]
    return Subscriber([Tools.fast, DOMAIN, qos, *words]).until(ready)


def node(topics: dict[str, str]) -> Subscriber:
    return Subscriber([*Tools.node, DOMAIN, *(f"{topic}={kind}" for topic, kind in topics.items())]).until(ready)


def stream(*words: object, env: dict | None = None) -> Program:
    return Program([Tools.tofray, "stream", *map(str, words), "--to", "dds", "--domain", DOMAIN], env=env)


def padded_hash(data: bytes) -> str:
    return hashlib.sha256(data + bytes(-len(data) % 4)).hexdigest()


def rendered(scene: str, frames: int, *words: object) -> tuple[dict[str, str], dict[str, list[str]]]:
    """Topics with their types, and hashes of the messages that render writes of the same frames."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([Tools.tofray, "render", scene, "-o", folder, "--frames", str(frames), "--emit", "mcap",
                               "--mcap-compression", "none", *map(str, words)],
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        name, = pathlib.Path(folder).glob("*.mcap")
        file = mcap.Mcap(name)
    hashes = collections.defaultdict(list)
    for message in file.messages:
        hashes[message.topic].append(padded_hash(message.data))
    return file.topics(), hashes


class Case(unittest.TestCase):
    def setUp(self):
        if Tools.fast is None and Tools.node is None:
            self.skipTest("there is no other DDS here")

    def readers(self, topics: dict[str, str]) -> list[Subscriber]:
        out = [one(topics) for one, there in ((fast, Tools.fast), (node, Tools.node)) if there]
        for one in out:
            self.addCleanup(one.process.kill)
        return out

    def finished(self, program: Program, code: int = 0, patience_s: float = PATIENCE_S) -> dict:
        program.until(lambda lines: bool(lines) and lines[-1] == "}", patience_s)
        self.assertEqual(program.end(), code, "".join(program.errors))
        return json.loads("\n".join(program.lines))


    def saw_all(self, one: Subscriber, told: dict, expected: dict[str, list[str]]) -> None:
        """Every message that was sent, and nothing but what render writes, of each topic in its order. On a machine that is busy with other
        things frames are dropped: those that were sent are there, on each topic as many."""
        one.until(lambda lines: len(lines) >= told["messages"] <= sum(map(len, one.messages().values())))   # counted when enough may be there
        self.assertEqual(one.end(), 0)
        seen = one.messages()
        self.assertEqual(sum(map(len, seen.values())), told["messages"])
        for camera in told["cameras"]:
            for topic in expected:
                if topic.startswith(f"/{camera['name']}/"):
                    self.assertEqual(len(seen[topic]), camera["sent"], topic)
        for topic, hashes in seen.items():
            self.assertLessEqual(set(hashes), set(expected[topic]), topic)
            places = [expected[topic].index(digest) for digest in hashes]
            if one.process.args[0] == Tools.fast and len(told["cameras"]) == 1:
                self.assertEqual(places, sorted(places), topic)


class Bytes(Case):
    def test_every_reader_sees_every_byte_of_every_frame(self):
        words = ["--driver", "pico_flexx", "--topics", "depth,amplitude,noise,points,raw,clock", *SMALL]
        topics, expected = rendered("flying-ball", 20, "--fps", 5, *words)
        readers = self.readers(topics)
        told = self.finished(stream("flying-ball", *words, "--rate", 5, "--frames", 20, "--history", 1000, "--wait-readers",
                                    len(readers) * len(topics), "--json", "--quiet"))
        camera = told["cameras"][0]
        self.assertEqual(camera["sent"] + camera["dropped"], 20)
        self.assertGreater(camera["sent"], 1)
        self.assertEqual((told["not_sent"], told["delivered"]), (0, True))
        self.assertEqual(told["readers"], len(readers) * len(topics))
        self.assertEqual(told["topics"], topics)
        for one in readers:
            self.saw_all(one, told, expected)

    def test_a_camera_that_is_moved_from_outside_sends_the_film_of_its_poses(self):
        poses = "".join(f"{0.07 * i:.2f} {0.02 * i:.3f} {0.01 * (i % 3):.2f} {-0.03 * i:.2f} 0 {0.01 * i:.3f} 0 {(1 - (0.01 * i) ** 2) ** 0.5:.12f}\n" for i in range(16))
        words = ["--topics", "depth,points,clock", *SMALL]
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "poses.txt").write_text(poses)
            (pathlib.Path(folder) / "moved.yaml").write_text(
                "camera: {profile: pico-flexx, keyframes: {file: poses.txt}}\nobjects:\n  - plane: {point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.5}\n"
                "  - sphere: {center: [0.1, 0, 1.2], radius: 20 cm, reflectivity: 0.8}\n")
            scene = str(pathlib.Path(folder) / "moved.yaml")
            topics, expected = rendered(scene, 6, "--fps", 5, *words)
            readers = self.readers(topics)
            running = stream(scene, *words, "--rate", 5, "--history", 1000, "--wait-readers", len(readers) * len(topics), "--pose-from", "-", "--json",
                             "--quiet")
            for line in poses.splitlines(True):
                running.process.stdin.write(line), running.process.stdin.flush()
            running.process.stdin.close()
            told = self.finished(running)
        self.assertEqual((told["cameras"][0]["sent"], told["cameras"][0]["dropped"], told["poses_end_s"]), (6, 0, 1.05))
        for one in readers:
            self.saw_all(one, told, expected)

    @unittest.skipUnless(os.environ.get("TOFRAY_LONG"), "a minute of a pico flexx: with TOFRAY_LONG (.ci/long)")
    def test_a_minute_of_a_camera_arrives_whole(self):
        words = ["--driver", "pico_flexx", "--set", "camera.mode=MODE_5_45FPS_500", "--topics", "depth,points,clock", "--seed", "5"]
        topics, expected = rendered("room", 300, "--fps", 45, *words)
        for first in range(300, 2700, 300):   # 0.9 MB a frame
            for topic, hashes in rendered("room", 300, "--fps", 45, "--first-frame", first, *words)[1].items():
                expected[topic].extend(hashes)
        readers = self.readers(topics)
        running = stream("room", *words, "--rate", 45, "--duration", "60s", "--history", 400, "--wait-readers", len(readers) * len(topics), "--json", "--quiet")
        told = self.finished(running, patience_s=600)
        camera = told["cameras"][0]
        print(f"\n{camera}, {told['messages']} messages")
        self.assertEqual(camera["sent"] + camera["dropped"], 2700)
        self.assertGreater(camera["sent"], 100)
        for one in readers:
            if one.process.args[0] == Tools.fast:
                self.saw_all(one, told, expected)
                continue
            # npm's subscribes with a depth of 1, and may lose what comes too fast for it: what it has is right, and no more is known.
            self.assertEqual(one.end(), 0)
            seen = one.messages()
            print(f"{sum(map(len, seen.values()))} messages by npm's reader")
            self.assertGreater(len(seen["/clock"]), 100)
            for topic, hashes in seen.items():
                self.assertLessEqual(set(hashes), set(expected[topic]), topic)

    def test_types_and_their_hashes_are_those_of_ros(self):
        topics, _ = rendered("room", 1, *SMALL, "--topics", "depth,points,raw,clock")
        readers = self.readers({"/camera/points": "sensor_msgs/msg/PointCloud2"})
        running = stream("room", *SMALL, "--topics", "depth,points,raw,clock", "--rate", 2)
        self.addCleanup(running.process.kill)
        for one in readers:
            one.until(lambda _: len(one.writers()) >= len(topics))
            seen = one.writers()
            self.assertEqual({name: told[0] for name, told in seen.items()}, {f"rt{name}": dds_type(kind) for name, kind in topics.items()})
            for name, told in seen.items():
                self.assertEqual(told[1], f"typehash=RIHS01_{GOLDEN[told[0]]};", name)
                self.assertIn(told[2:], ([], ["reliable", "transient_local"]), name)
        running.process.send_signal(signal.SIGINT)
        self.assertEqual(running.end(), 0)
        for one in readers:
            one.end()
            if Tools.node and one.process.args[0] == Tools.node[0]:
                names = {tuple(line.split()[1:]) for line in one.lines if line.startswith("topic ")}
                self.assertEqual(names, set(topics.items()))

    def test_who_comes_later_gets_the_last_frame(self):
        topic = "/camera/points"
        _, expected = rendered("flying-ball", 1, "--fps", 0.01, *SMALL)
        running = stream("flying-ball", *SMALL, "--rate", 0.01)  # the second frame comes in 100 s
        self.addCleanup(running.process.kill)
        for _ in range(2):
            for one in self.readers({topic: "sensor_msgs/msg/PointCloud2"}):
                one.has(1, topic)
                one.end()
                self.assertEqual(one.messages()[topic], expected[topic])
        running.process.send_signal(signal.SIGINT)
        self.assertEqual(running.end(), 0)  # and does not wait for the second frame

    def test_two_cameras_of_one_scene(self):
        left, right = "camera.pose.position=[-5cm,0,0]", "camera.pose.position=[5cm,0,0]"
        topics: dict[str, str] = {}
        expected: dict[str, list[str]] = {}
        for name, where in (("left", left), ("right", right)):
            of_one, hashes = rendered("room", 4, *SMALL, "--fps", 2, "--camera-name", name, "--set", where, "--topics", "depth,points,clock")
            topics.update(of_one)
            for topic, all_of_it in hashes.items():
                expected.setdefault(topic, []).extend(all_of_it)
        self.assertIn("/right/points", topics)
        readers = self.readers(topics)
        told = self.finished(stream("room", *SMALL, "--rate", 2, "--frames", 4, "--history", 100, "--topics", "depth,points,clock",
                                    "--add-camera", f"left:{left}", "--add-camera", f"right:{right}", "--wait-readers",
                                    len(readers) * len(topics), "--json"))
        self.assertEqual([one["name"] for one in told["cameras"]], ["left", "right"])
        for one in readers:
            self.saw_all(one, told, expected)
            self.assertEqual(len(one.messages()["/clock"]), told["cameras"][0]["sent"])  # one camera tells the time

    def test_sensor_quality_is_best_effort(self):
        if Tools.fast is None:
            self.skipTest("there is no Fast DDS here")
        topic = "/camera/depth_image"
        lasting, sensor = (fast({topic: "sensor_msgs/msg/Image", "/tf": "tf2_msgs/msg/TFMessage"}, qos) for qos in ("lasting", "sensor"))
        running = stream("room", *SMALL, "--rate", 5, "--qos", "sensor")
        for one in (lasting, sensor, running):
            self.addCleanup(one.process.kill)
        sensor.has(3, topic).has(3, "/tf")
        lasting.has(3, "/tf")
        self.assertEqual(sensor.writers()["rt" + topic][2:], ["best_effort", "volatile"])
        self.assertEqual(sensor.writers()["rt/tf"][2:], ["reliable", "transient_local"])
        running.process.send_signal(signal.SIGTERM)
        self.assertEqual(running.end(), 0)
        lasting.end(), sensor.end()
        self.assertEqual(lasting.messages()[topic], [])  # asks for more than is offered


class Command(unittest.TestCase):
    """What needs no reader."""

    def refused(self, *words: object, code: int = 2, env: dict | None = None) -> str:
        done = subprocess.run([Tools.tofray, "stream", *map(str, words)], capture_output=True, text=True, timeout=PATIENCE_S,
                              env={**os.environ, **(env or {})})
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_without_the_library_it_says_what_to_install(self):
        with tempfile.TemporaryDirectory() as folder:
            alone = shutil.copy(Tools.tofray, folder)
            done = subprocess.run([alone, "stream", "room", "--to", "dds"], capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 5)
            self.assertIn("tofray-dds", done.stderr)
            self.assertIn("cyclonedds-dev", done.stderr)
            (pathlib.Path(folder) / "libtofray_dds.so").write_bytes(b"no library")
            done = subprocess.run([alone, "stream", "room", "--to", "dds"], capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 5)
            self.assertIn("libtofray_dds.so cannot be loaded", done.stderr)

    def test_wrong_words_are_refused(self):
        self.assertIn("0 to 232", self.refused("room", "--domain", 233))
        self.assertIn("ROS_DOMAIN_ID", self.refused("room", env={"ROS_DOMAIN_ID": "seven"}))
        self.assertIn("--interface", self.refused("room", "--interface", "<lo>"))
        self.assertIn("one of them", self.refused("room", "--frames", 2, "--duration", "1s"))
        self.assertIn("NAME:KEY=VALUE", self.refused("room", "--add-camera", "left:pose"))
        self.assertIn("several cameras", self.refused("room", "--driver", "k4a", "--add-camera", "a", "--add-camera", "b"))
        self.assertIn("--pose-from and several cameras together", self.refused("room", "--pose-from", "-", "--add-camera", "a", "--add-camera", "b"))
        self.assertIn("--pose-from and --latency together", self.refused("room", "--pose-from", "-", "--latency", "1ms"))
        self.assertIn("/nowhere/poses: error: cannot read it", self.refused("room", "--pose-from", "/nowhere/poses", "-q", code=3))

    def test_an_interface_that_is_not_there_is_an_error_of_one_sentence(self):
        text = self.refused("room", "--interface", "nowhere7", code=5)
        self.assertIn("nowhere7", text)
        self.assertTrue(text.startswith("error: DDS cannot"), text)

    def test_no_packet_leaves_loopback(self):
        if "TOFRAY_OWN_NETWORK" not in os.environ:
            self.skipTest("no network of its own: no unshare, no ip (Debian: iproute2), or not allowed")
        for words in ("link add other type veth peer name far", "addr add 10.83.0.1/24 dev other", "link set other up multicast on",
                      "link set far up"):
            if subprocess.run(["ip", *words.split()], capture_output=True).returncode != 0:
                self.skipTest("no second interface can be made here")
        self.addCleanup(subprocess.run, ["ip", "link", "del", "other"], capture_output=True)
        quiet = pathlib.Path("/proc/sys/net/ipv6/conf/other/disable_ipv6")
        if quiet.exists():  # which would look for neighbours
            quiet.write_text("1")

        def sent() -> int:
            lines = pathlib.Path("/proc/net/dev").read_text().split("\n")
            return next(int(line.split(":")[1].split()[9]) for line in lines if line.strip().startswith("other:"))

        before = sent()
        subprocess.run([Tools.tofray, "stream", "room", *SMALL, "--frames", "2", "--rate", "5", "-q"], check=True, timeout=PATIENCE_S)
        self.assertEqual(sent(), before)
        subprocess.run([Tools.tofray, "stream", "room", *SMALL, "--frames", "2", "--rate", "5", "-q", "--interface", "other"], check=True,
                       timeout=PATIENCE_S)
        self.assertGreater(sent(), before)  # packets would have been seen

    def test_what_it_says_of_itself(self):
        done = subprocess.run([Tools.tofray, "stream", "room", *SMALL, "--rate", "5", "--duration", "600ms", "--json", "--domain", DOMAIN],
                              capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual(told["cameras"][0]["sent"] + told["cameras"][0]["dropped"], 3)
        self.assertEqual((told["interface"], told["domain"], told["interrupted"]), ("lo", int(DOMAIN), False))
        self.assertIn("on this machine alone", done.stderr)
        self.assertNotIn("/camera/raw/p0", told["topics"])
        self.assertEqual(told["topics"]["/clock"], "rosgraph_msgs/msg/Clock")

    def test_a_bounded_stream_that_is_interrupted_says_so(self):
        running = stream("room", *SMALL, "--rate", 0.01, "--frames", 2, "--json")
        self.addCleanup(running.process.kill)
        end = time.monotonic() + PATIENCE_S
        while not any("topics:" in line for line in running.errors) and time.monotonic() < end:
            time.sleep(0.05)
        running.process.send_signal(signal.SIGINT)
        self.assertEqual(running.end(), 130, "".join(running.errors))
        self.assertTrue(json.loads("\n".join(running.lines))["interrupted"])


if __name__ == "__main__":
    own_network()
    parser = argparse.ArgumentParser()
    parser.add_argument("tofray")
    parser.add_argument("--fast")
    parser.add_argument("--node", nargs=2)
    parser.add_argument("rest", nargs="*")
    known, rest = parser.parse_known_args()
    Tools.tofray, Tools.fast, Tools.node = known.tofray, known.fast, known.node
    os.environ.pop("ROS_DOMAIN_ID", None)
    os.environ.pop("CYCLONEDDS_URI", None)
    unittest.main(argv=[sys.argv[0], *rest, *known.rest], verbosity=2)
