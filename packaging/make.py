#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Debian packages, a wheel and a tarball of what `./dev package` has built with TOFRAY_PACKAGES=ON. make.py --help

All three are of the same compiled files. The wheel and the tarball carry the libraries that these need; the code for GPUs, where it was
built, is a package, a wheel and a tarball of its own. The same compiled files give the same bytes: all times are SOURCE_DATE_EPOCH,
or that of the last commit.
"""

from __future__ import annotations

import argparse
import gzip
import io
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import tarfile
import tempfile

from carry import carry, oldest_glibc, packages_of, run

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python/backend"))
import tofray_backend as backend  # noqa: E402

VERSION = backend._version()
MACHINE = platform.machine()
Files = dict[str, tuple[bytes, int]]

CARRIED = """Libraries (and a font) that go along with tofray, each a file of a package of {distribution}, but for its name and the place where it looks for others.
Their copyright and licences lie beside this file, by the packages' names; their sources are the distribution's, by name and version:

"""


def read(folder: pathlib.Path) -> Files:
    """All files below `folder` by their paths there. (A link is the file that it leads to: wheels know none.)"""
    return {str(path.relative_to(folder)): (path.read_bytes(), 0o755 if os.access(path, os.X_OK) else 0o644)
            for path in sorted(folder.rglob("*")) if path.is_file()}


def distribution() -> str:
    found = [line.split("=")[1].strip('"') for line in open("/etc/os-release", encoding="utf-8") if line.startswith("PRETTY_NAME=")]
    return found[0].strip('"\n') if found else "this system"


def write_licences(folder: pathlib.Path, foreign: list[pathlib.Path]) -> None:
    """What the carried libraries are and whose, and what is compiled in."""
    packages = packages_of(foreign)
    lines = [f"{name:28} source {source}\n" for name, source in packages.items()]
    (folder / "README").write_text(CARRIED.format(distribution=distribution()) + "".join(lines), encoding="utf-8")
    for name in packages:
        shutil.copyfile(f"/usr/share/doc/{name}/copyright", folder / name)


class Maker:
    def __init__(self, build: pathlib.Path, out: pathlib.Path, work: pathlib.Path):
        self.build, self.out, self.work = build, out, work
        self.has_cuda = "\ncode for NVIDIA GPUs" in (build / "choices.txt").read_text(encoding="utf-8")
        self.time = int(os.environ.get("SOURCE_DATE_EPOCH") or run("git", "-C", ROOT, "log", "-1", "--format=%ct"))

    def lay_out(self, lib: str, python: str, zsh: str) -> None:
        """Where things go when they are installed. Nothing is compiled for that."""
        run("cmake", "-S", ROOT, "-B", self.build, f"-DCMAKE_INSTALL_LIBDIR={lib}", f"-DTOFRAY_PYTHON_DIR={python}", f"-DTOFRAY_ZSH_DIR={zsh}")

    def debs(self) -> None:
        """By Debian's layout."""
        self.lay_out("lib/" + run("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip(), "lib/python3/dist-packages", "zsh/vendor-completions")
        environment = {**os.environ, "SOURCE_DATE_EPOCH": str(self.time)}
        said = subprocess.run(["cpack", "-B", str(self.work / "deb")], cwd=self.build, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if said.returncode != 0:
            raise SystemExit(f"cpack failed:\n{said.stdout}")
        for package in sorted((self.work / "deb").glob("*.deb")):
            shutil.copy(package, self.out)

    def install(self, component: str) -> pathlib.Path:
        """A component in a prefix of its own."""
        prefix = self.work / component
        run("cmake", "--install", self.build, "--strip", "--component", component, "--prefix", prefix)
        return prefix

    def install_all(self) -> None:
        """By the layout of a prefix of one's own: bin, lib, share."""
        self.lay_out("lib", "python", "zsh/site-functions")
        self.prefix = self.install("tofray")
        self.python = self.install("python")
        if self.has_cuda:
            self.cuda = self.install("cuda")

    def libraries(self, folder: pathlib.Path) -> list[pathlib.Path]:
        return [path for path in sorted(folder.glob("libtofray*.so*")) if not path.is_symlink()]

    def tar(self, name: str, folder: pathlib.Path, top: str) -> None:
        """The same files give the same bytes: sorted, of one time and of nobody."""
        def plain(entry: tarfile.TarInfo) -> tarfile.TarInfo:
            entry.uid = entry.gid = 0
            entry.uname = entry.gname = "root"
            entry.mtime = self.time
            entry.mode = 0o755 if entry.isdir() or entry.mode & 0o100 else 0o644
            return entry

        content = io.BytesIO()
        with tarfile.open(fileobj=content, mode="w", format=tarfile.GNU_FORMAT) as archive:
            for path in [folder, *sorted(folder.rglob("*"))]:
                archive.add(path, pathlib.Path(top) / path.relative_to(folder), recursive=False, filter=plain)
        (self.out / name).write_bytes(gzip.compress(content.getvalue(), 9, mtime=self.time))

    def tarball(self) -> None:
        top = f"tofray-{VERSION}-linux-{MACHINE}"
        folder = self.work / "tarball"
        shutil.copytree(self.prefix, folder, symlinks=True)
        lib = folder / "lib"
        foreign = carry([folder / "bin/tofray", *self.libraries(lib)], lib / "tofray", lib)
        licences = folder / "share/doc/tofray/carried"
        licences.mkdir(parents=True)
        write_licences(licences, foreign)
        self.tar(f"{top}.tar.gz", folder, top)
        if self.has_cuda:
            self.tar(f"tofray-cuda-{VERSION}-linux-{MACHINE}.tar.gz", self.cuda, top)

    def wheel(self) -> None:
        folder = self.work / "wheel"
        package = folder / "tofray"
        shutil.copytree(self.python / "python/tofray", package)
        (package / "bin").mkdir()
        shutil.copy(self.prefix / "bin/tofray", package / "bin/tofray")
        foreign = carry([*package.glob("_native*.so"), package / "bin/tofray"], folder / "tofray.libs", self.prefix / "lib", rename_own=True)
        licences = folder / f"tofray-{VERSION}.dist-info/licenses"
        (licences / "carried").mkdir(parents=True)
        write_licences(licences / "carried", foreign)
        shutil.copytree(self.prefix / "share/doc/tofray/compiled-in", licences / "compiled-in")
        shutil.copy(ROOT / "LICENSE", licences)
        tag = self.platform([path for path in folder.rglob("*") if ".so" in path.name or path == package / "bin/tofray"])
        python = backend._tag().rsplit("-", 1)[0]
        metadata = backend._metadata() + f'Provides-Extra: cuda\nRequires-Dist: tofray-cuda (=={VERSION}) ; extra == "cuda"\n'
        backend._write(str(self.out), read(folder), tag=f"{python}-{tag}", metadata=metadata)
        if self.has_cuda:
            self.cuda_wheel()

    @staticmethod
    def platform(files: list[pathlib.Path]) -> str:
        return f"manylinux_2_{oldest_glibc(files)}_{MACHINE}"

    def cuda_wheel(self) -> None:
        library = self.cuda / "lib/libtofray_cuda.so"
        files = {"tofray_cuda/__init__.py": (b'"""Code for NVIDIA GPUs, which tofray finds by itself."""\n', 0o644),
                 "tofray_cuda/libtofray_cuda.so": (library.read_bytes(), 0o755),
                 f"tofray_cuda-{VERSION}.dist-info/licenses/copyright": ((ROOT / "packaging/copyright").read_bytes(), 0o644),
                 f"tofray_cuda-{VERSION}.dist-info/licenses/LICENSE": ((ROOT / "LICENSE").read_bytes(), 0o644)}
        metadata = (f"Metadata-Version: 2.1\nName: tofray-cuda\nVersion: {VERSION}\nSummary: Code for NVIDIA GPUs, for tofray\n"
                    f"License: Apache-2.0\nRequires-Dist: tofray (=={VERSION})\n")
        backend._write(str(self.out), files, name="tofray_cuda", tag=f"py3-none-{self.platform([library])}", metadata=metadata)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="where it was built")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="where the packages go; what is there of earlier ones is removed")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for old in [*options.out.glob("*tofray*.deb"), *options.out.glob("tofray*.whl"), *options.out.glob("tofray*.tar.gz")]:
        old.unlink()
    with tempfile.TemporaryDirectory() as work:
        maker = Maker(options.build.resolve(), options.out.resolve(), pathlib.Path(work))
        maker.debs()
        maker.install_all()
        maker.tarball()
        maker.wheel()
    for file in sorted(options.out.iterdir()):
        print(f"{file.stat().st_size / 1e6:6.1f} MB  {file}")


if __name__ == "__main__":
    main()
