# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The viewer in a browser, by the command `tofray view`: live, and as a page with frames in it."""

from __future__ import annotations

import html
import json
import os
import subprocess
import sys
import tempfile
from typing import TYPE_CHECKING, Any, Mapping, Sequence

from ._errors import BadInput, DeviceError, error_of
from ._frame import Frame
from ._run import _settings

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Literal

_KINDS = {2: "bad_input", 3: "io", 4: "limit", 5: "device"}


def _command() -> str:
    from .__main__ import command

    found = command()
    if found is None:
        raise DeviceError("error: the command tofray is neither beside this package nor on the path\n"
                          "  expected it there, or its place in the environment variable TOFRAY_COMMAND")
    return os.path.abspath(found)


def _failed(code: int, text: str) -> Exception:
    return error_of(_KINDS.get(code, "bug"), text.rstrip("\n") or f"error: tofray view ended with exit code {code}")


def _elsewhere() -> str:
    """Why a browser does not reach 127.0.0.1 of this process; empty where it does, as far as anybody can tell."""
    for name, what in (("JUPYTERHUB_SERVICE_PREFIX", "JupyterHub"), ("COLAB_RELEASE_TAG", "Colab"), ("KAGGLE_KERNEL_RUN_TYPE", "Kaggle"),
                       ("BINDER_SERVICE_HOST", "Binder"), ("CODESPACES", "Codespaces"), ("VSCODE_IPC_HOOK_CLI", "VS Code on another machine"),
                       ("SSH_CONNECTION", "ssh")):
        if os.environ.get(name):
            return what
    return "Colab" if "google.colab" in sys.modules else ""


def _words(scene: Any, set: Mapping[str, Any] | None, mode: str, root: str | os.PathLike[str], seed: int | None, noise: str | None,
           exposure_samples: int | None, subpixel: int | None, camera: str | os.PathLike[str]) -> list[str]:
    if not isinstance(scene, (str, os.PathLike)):
        raise TypeError(f"scene: got {type(scene).__name__}, expected a scene's file or name, or a file or folder of frames\n"
                        "  frames of a Scene of one's own: tofray.explore(frames)")
    out = [os.fspath(scene)]
    if out[0].startswith("-"):
        out[0] = "./" + out[0]
    for key, text in _settings(set):
        out += ["--set", f"{key}={text}"]
    for name, value in (("--mode", mode), ("--root", os.fspath(root)), ("--camera", os.fspath(camera)), ("--noise", noise)):
        if value:
            out += [name, value]
    for name, number in (("--seed", seed), ("--exposure-samples", exposure_samples), ("--subpixel", subpixel)):
        if number is not None:
            out += [name, str(int(number))]
    return out


class View:
    """A viewer that runs: ``tofray.view()`` starts it. As a context manager it ends with its block; it ends with Python, too.

    A notebook shows it in place where it was started with ``embed=True`` and the browser is on this machine; otherwise it says what to do.

    Attributes
    ----------
    url : str
        To be opened in a browser. It has a key: all who have it see and change the view.
    port : int
        Of this machine, which the viewer listens on.
    """

    def __init__(self, process: subprocess.Popen[bytes], url: str, port: int, embed: bool) -> None:
        self.url = url
        self.port = port
        self._process = process
        self._embed = embed

    @property
    def closed(self) -> bool:
        """Whether it has ended."""
        return self._process.poll() is not None

    def close(self) -> None:
        """Ends it; nothing where it has ended before."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        try:
            self._process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def wait(self) -> None:
        """Waits until it ends, or until Ctrl-C, which ends it."""
        try:
            self._process.wait()
        except KeyboardInterrupt:
            self.close()

    def __enter__(self) -> View:
        return self

    def __exit__(self, kind: type[BaseException] | None, fault: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<tofray.View {'closed' if self.closed else self.url}>"

    def _repr_html_(self) -> str:
        url = html.escape(self.url)
        link = f'<a href="{url}" target="_blank" rel="noopener">{url}</a>'
        if self.closed:
            return "<p>This viewer has ended. <code>tofray.view(…)</code> starts another one.</p>"
        place = _elsewhere()
        if place:
            return (f"<p>The viewer runs where Python does, and your browser does not reach it there ({html.escape(place)}). "
                    "<code>tofray.explore(frames)</code> shows frames here. By ssh: "
                    f"<code>ssh -L {self.port}:127.0.0.1:{self.port} HOST</code>, then {link}</p>")
        if not self._embed:
            return f"<p>The viewer: {link}. <code>tofray.view(…, embed=True)</code> shows it here.</p>"
        return f'<iframe title="tofray view" src="{url}" style="width:100%;height:720px;border:0"></iframe>'


def view(
    scene: str | os.PathLike[str] = "demo",
    *,
    set: Mapping[str, Any] | None = None,
    mode: str = "",
    root: str | os.PathLike[str] = "",
    seed: int | None = None,
    noise: Literal["off", "exact"] | None = None,
    exposure_samples: int | None = None,
    subpixel: int | None = None,
    camera: str | os.PathLike[str] = "",
    folder: str | os.PathLike[str] = "",
    port: int = 0,
    open: bool = True,
    embed: bool = False,
    block: bool = False,
) -> View:
    """Starts the viewer, ``tofray view``, which ends with this process.

    Parameters
    ----------
    scene : path or name
        A scene or a camera as of ``tofray view``; also a .npz file, or a folder of such, which it plays.
    set, mode, root, seed, noise, exposure_samples, subpixel
        As of ``render``. Not of files, but for ``set``, which changes how depth is computed of their raw frames.
    camera : path or name
        Of files with raw frames that do not say which camera made them: its profile.
    folder : path
        For what pages record and export; left empty: the working folder.
    port : int
        Of this machine; 0: any that is free.
    open : bool
        Whether it is opened in the browser, where there is one. Not where it is embedded.
    embed : bool
        Whether pages of this machine, such as a notebook's, may hold it in a frame.
    block : bool
        Whether to wait until it ends, as a script does that would end otherwise.

    Returns
    -------
    View
        With ``url`` and ``close()``.

    Raises
    ------
    Error
        As ``load_inputs``; of kind "device" where there is no command tofray, or one without its viewer.
    TypeError
        For a scene that is no file and no name.
    """
    words = [_command(), "view", *_words(scene, set, mode, root, seed, noise, exposure_samples, subpixel, camera)]
    words += ["--port", str(int(port)), "--quiet", "--end-with-input"]
    words += (["-o", os.fspath(folder)] if os.fspath(folder) else []) + (["--embed"] if embed else ["--open"] if open else [])
    with tempfile.TemporaryFile() as said:
        # Its standard input is a pipe of this process alone: however Python ends, the pipe does, and the viewer with it.
        process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=said, start_new_session=True)
        assert process.stdout is not None
        url = process.stdout.readline().decode().strip()  # all that it says there
        process.stdout.close()
        if not url.startswith("http://"):
            code = process.wait()
            if process.stdin is not None:
                process.stdin.close()
            said.seek(0)
            raise _failed(code, said.read().decode("utf-8", "replace"))
    out = View(process, url, int(url.split("/")[2].rsplit(":", 1)[1]), embed)
    if block:
        out.wait()
    return out


class Page:
    """A page with frames in it, which needs no server: ``tofray.explore()`` makes it. A notebook shows it in place.

    Attributes
    ----------
    text : str
        HTML, complete in itself.
    """

    def __init__(self, text: str, height: int) -> None:
        self.text = text
        self._height = height

    def save(self, file: str | os.PathLike[str]) -> str:
        """Writes it into a file, which browsers open by itself.

        Parameters
        ----------
        file : path
            ``"frames.html"``. A file of this name is replaced.

        Returns
        -------
        str
            The file.

        Raises
        ------
        Error
            Of kind "io" where it cannot be written.
        """
        from ._frame import _write

        try:
            return _write(os.fspath(file), self.text.encode())
        except OSError as fault:
            raise error_of("io", f"{os.fspath(file)}: error: {fault.strerror}") from fault

    def __repr__(self) -> str:
        return f"<tofray.Page of {1e-6 * len(self.text):.1f} MB: save(file), or the last line of a notebook's cell>"

    def _repr_html_(self) -> str:
        # A frame of no origin: nothing of the notebook is within its reach.
        return (f'<iframe title="tofray frames" sandbox="allow-scripts allow-downloads" style="width:100%;height:{self._height}px;border:0" '
                f'srcdoc="{html.escape(self.text)}"></iframe>')


def _npz_of(frame: Frame) -> bytes:
    """The frame as a file that the command reads."""
    if frame._scene is not None and frame._camera is not None:
        from . import _native

        if frame._request is not None:
            frame._own()
        out: bytes = _native.frame_npz(frame, frame._scene, frame._camera, frame._own_options(), False)
        return out
    import io

    import numpy as np

    arrays: dict[str, Any] = dict(frame.to_dict())
    if frame.meta:
        arrays["meta"] = np.array(json.dumps(frame.meta))
    file = io.BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


def explore(frames: Frame | Sequence[Frame], *, arrays: Sequence[str] = (), height: int = 720) -> Page:
    """Frames as a page with panes, read-out, points in space and a time line, which needs no server and no network.

    It is that of ``tofray view --export``, about 2 MB for each frame of 224 x 172 pixels, and good for notebooks on other machines, for
    papers and for reports of faults. For more frames, or to change anything: ``view``.

    Parameters
    ----------
    frames : Frame or sequence of Frame
        Of one camera, in the order of the time line.
    arrays : sequence of str
        Which are in the page, by name: ``["z_m", "flags"]``. Left empty: those of all panes, and raw.
    height : int
        Of the page in a notebook, in its pixels.

    Returns
    -------
    Page
        With ``save(file)``.

    Raises
    ------
    Error
        For no frames, for such of different sizes, of kind "limit" where the page would have more than 200 MB, and of kind "device" where
        there is no command tofray, or one without its viewer's page.
    """
    all_frames = [frames] if isinstance(frames, Frame) else list(frames)
    if not all_frames:
        raise BadInput("explore: error: there are no frames\n  expected one at least, as in tofray.explore(frame)")
    for one in all_frames:
        if not isinstance(one, Frame):
            raise TypeError(f"frames: got {type(one).__name__}, expected tofray.Frame, or several of them")
    scene = all_frames[0]._scene
    with tempfile.TemporaryDirectory(prefix="tofray-") as place:
        name = _plain(getattr(scene, "name", "")) or "frames"
        folder = os.path.join(place, name)
        os.mkdir(folder)
        for i, one in enumerate(all_frames):
            with open(os.path.join(folder, f"frame_{i:06}.npz"), "wb") as file:
                file.write(_npz_of(one))
        words = [_command(), "view", "./" + name, "--export", "page.html", "--quiet", *(["--arrays", ",".join(arrays)] if arrays else [])]
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, cwd=place)
        if done.returncode != 0:
            raise _failed(done.returncode, done.stderr.decode("utf-8", "replace"))
        with open(os.path.join(place, "page.html"), encoding="utf-8") as file_of_page:
            return Page(file_of_page.read(), height)


def _plain(name: str) -> str:
    """A scene's name as a folder's."""
    return "".join(c if c.isalnum() or c in "-_ " else "_" for c in name)[:60].strip()
