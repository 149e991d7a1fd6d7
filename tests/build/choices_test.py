# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Which code a build has: for the processor, and for GPUs where there is one or where somebody asks. CMake is run; nothing is compiled."""

import argparse
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

arguments = argparse.ArgumentParser()
arguments.add_argument("--source", type=pathlib.Path, required=True)
arguments.add_argument("--compiler", required=True)
options, rest = arguments.parse_known_args()

NVCC = """#!/bin/sh
case $1 in
  --version) echo "Cuda compilation tools, release 13.0, V13.0.88" ;;
  --list-gpu-arch) printf 'compute_75\\ncompute_80\\ncompute_86\\ncompute_90\\ncompute_100\\ncompute_120\\n' ;;
  *) exit 1 ;;
esac
"""


class Choices(unittest.TestCase):
    """Each test is a build folder of its own, on a machine that has what the test puts on the path."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.programs = self.folder / "toolkit/bin"
        self.programs.mkdir(parents=True)
        (self.folder / "toolkit/lib64").mkdir()
        (self.folder / "toolkit/lib64/libcudart_static.a").touch()
        self.program("nvidia-smi", "#!/bin/sh\nexit 9\n")   # no driver, whatever this machine has

    def program(self, name, text):
        (self.programs / name).write_text(text)
        (self.programs / name).chmod(0o755)

    def nvcc(self):
        self.program("nvcc", NVCC)

    def gpus(self, *capabilities):
        self.program("nvidia-smi", "#!/bin/sh\n" + "".join(f"echo {one}\n" for one in capabilities))

    def configure(self, *words, **environment):
        """The lines of choices.txt: processors, GPUs."""
        tools = {f"TOFRAY_{name.upper().replace('-', '_')}": self.programs / name for name in ("nvcc", "nvidia-smi")}
        given = [f"-D{option}={path}" for option, path in tools.items() if path.exists()]
        clean = {name: value for name, value in os.environ.items() if name not in ("CUDAARCHS", "TOFRAY_CUDA", "CUDA_HOME", "CUDA_PATH")}
        path = ":".join(part for part in clean["PATH"].split(":") if not (pathlib.Path(part) / "nvcc").exists())
        done = subprocess.run(
            ["cmake", "-S", options.source, "-B", self.folder / "build", f"-DCMAKE_CXX_COMPILER={options.compiler}", "-DTOFRAY_TESTS=OFF",
             "-DTOFRAY_PYTHON=OFF", "-DCMAKE_BUILD_TYPE=Release", *given, *words],
            env={**clean, "PATH": path, **environment}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "build/choices.txt").read_text().splitlines()

    def capabilities(self, line):
        """Of `code for NVIDIA GPUs of compute capability 75, 90 (…)`; none where there is no such code."""
        found = re.match(r"code for NVIDIA GPUs of compute capability ([0-9, virtual-]+) \(", line)
        return found[1].split(", ") if found else []

    def test_nvcc_alone_is_no_reason_to_compile_for_gpus(self):
        self.nvcc()
        line = self.configure()[1]
        self.assertEqual(self.capabilities(line), [])
        self.assertIn("none is here; TOFRAY_CUDA=ON makes it", line)

    def test_a_gpu_gets_code_for_its_own_generation(self):
        self.nvcc(), self.gpus("8.6", "12.0", "8.6")
        self.assertEqual(self.capabilities(self.configure()[1]), ["86", "120"])

    def test_a_gpu_beside_an_old_nvcc_is_told(self):
        self.program("nvcc", NVCC.replace("13.0", "11.8")), self.gpus("9.0")
        self.assertRegex(self.configure()[1], r"no code for NVIDIA GPUs \(.*/nvcc is version 11.8; 12.1 or newer is needed\)")

    def test_who_asks_without_a_gpu_gets_the_first_of_each_generation(self):
        self.nvcc()
        self.assertEqual(self.capabilities(self.configure("-DTOFRAY_CUDA=ON")[1]), ["75", "80", "90", "100", "120"])

    def test_cudaarchs_asks(self):
        self.nvcc()
        self.assertEqual(self.capabilities(self.configure(CUDAARCHS="80;120-virtual")[1]), ["80", "120-virtual"])

    def test_off_is_off_where_a_gpu_is(self):
        self.nvcc(), self.gpus("9.0")
        self.assertEqual(self.configure("-DTOFRAY_CUDA=OFF")[1], "no code for NVIDIA GPUs (TOFRAY_CUDA=OFF)")

    def test_native_is_plain_code_and_one_set_and_all_is_more(self):
        native = re.match(r"code for ([a-z0-9_, ]+) \(what this processor runs", self.configure("-DTOFRAY_KERNELS=native")[0])
        self.assertIsNotNone(native)
        names = native[1].split(", ")
        self.assertEqual(names[0], "scalar")
        self.assertLessEqual(len(names), 2)
        every = self.configure("-DTOFRAY_KERNELS=all")[0].removeprefix("code for ").split(", ")
        self.assertTrue(set(names) < set(every), every)


if __name__ == "__main__":
    unittest.main(argv=["choices", *rest])
