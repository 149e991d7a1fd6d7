# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What the test of the documents does not run word for word, each with its reason. All the rest it does."""

# What stands in a document: what runs in its place, and why.
REPLACED = {
    "git clone <this repository> tofray && cd tofray": ("true", "only the reader knows where his repository is"),
    "cmake --build --preset dev --target test_power": (
        "cmake --build --preset dev --target help | grep test_power",
        "takes minutes; that there is such a target is asked",
    ),
    "build/dev/tests/test_power": (
        "build/release/tests/test_power --gtest_list_tests",
        "was not built, see above; that of this build is asked",
    ),
    ".ci/run asan tsan": ("grep -q '^step_asan()' .ci/run && grep -q '^step_tsan()' .ci/run", "takes most of an hour"),
    "TOFRAY_EXPECT_GPU=1 build/release/tests/test_backend --gtest_filter='*Gpu*:*/gpu'": (
        "build/release/tests/test_backend --gtest_list_tests --gtest_filter='*Gpu*:*/gpu' | grep bytes_of_the_processor",
        "the machine may have no GPU; that there are such tests is asked",
    ),
    "ssh -L 7170:127.0.0.1:7170 HOST": ("true", "only the reader knows his machines"),
    "python3 -m tofray.plot power": (
        "/usr/bin/python3 -m tofray.plot power",
        "another Python may be the first on the path than the one that the module is for",
    ),
    "python3 -m tofray.plot light": ("/usr/bin/python3 -m tofray.plot light", "likewise"),
    "python3 -m tofray fit": ("/usr/bin/python3 -m tofray fit", "likewise"),
    "python3 -m tofray calibrate": ("/usr/bin/python3 -m tofray calibrate", "likewise"),
    "sudo tofray bench": ("tofray bench", "a test is never root on purpose"),
}

# Stands in for ./dev: it builds and tests what this test is a part of. The real one is asked whether it knows the word.
DEV = """#!/usr/bin/env bash
set -euo pipefail
"{source}/dev" help | grep -q "^./dev $1 " || exit 2
if [[ $1 == demo ]]; then tofray demo -o out/demo; fi
"""

# C++ of a document needs more than it says: what stands outside main, what inside it, and why it is built but not run (empty: it is run).
CPP = {
    "gpu.md": (
        "void use(std::uint64_t, const float*) {}\nvoid my_kernel(const float*) {}\n",
        'auto scene = tofray::load_scene("scene.yaml");\nauto camera = tofray::load_camera(scene);\n',
        "it needs a GPU, and a kernel of the reader's",
    ),
}

# g++ takes no CUDA: the launch of a kernel becomes a call.
CUDA_LAUNCH = (r"<<<.*?>>>", "")

# Measuring is cut short: the words are all read, fewer frames are timed.
FEW_FRAMES = "--frames 2"

# A viewer serves until somebody ends it: Ctrl-C after some seconds, which is a good end. One without its page says so (exit code 5).
# (--foreground: timeout sends one signal, and not a second one to its group.)
VIEW = "{{ timeout --foreground --preserve-status -s INT 3 {} || [[ $? == 5 ]]; }}"
VIEW_EXPORT = "{{ {} || [[ $? == 5 ]]; }}"   # ends by itself

# A stream ends in the same ways, also in a build that speaks no DDS.
STREAM = VIEW
STREAM_BOUNDED = VIEW_EXPORT

# Names in backticks that nothing in the source knows.
UNKNOWN_NAMES = {
    "raduis": "misspelled on purpose",
    "lower_snake": "how names are written",
    "UpperCamel": "how names are written",
    "cv2.undistortPoints": "OpenCV's",
    "_optical_frame": "ROS's",
    "camera_optical_frame": "ROS's",
    "base_link": "ROS's",
    "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST": "ROS's",
    "ROS_LOCALHOST_ONLY=1": "ROS's",
    "use_sim_time": "ROS's",
    "cv2.fisheye.undistortPoints": "OpenCV's",
    "compinit": "zsh's",
    "std::*_distribution": "what the source must not call",
    "~deb13": "out of a package's name",
    "cp311": "out of a package's name",
    "cp313": "out of a package's name",
    "manylinux_2_36": "out of a package's name",
    "tofray-cuda_….deb": "a package's name",
    "CMAKE_PREFIX_PATH": "CMake's",
    "explorer.exe tofray-demo": "Windows'",
    "date-released": "a key of CITATION.cff, once there is a release",
    "v0.2.0": "a tag that is to come",
}
