# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.view() and tofray.explore(): the command's own viewer and page, and nothing of them that outlives Python."""

from __future__ import annotations

import html
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from typing import Iterator

import numpy as np
import pytest

import tofray
from tofray.__main__ import command

ELSEWHERE = ("JUPYTERHUB_SERVICE_PREFIX", "COLAB_RELEASE_TAG", "KAGGLE_KERNEL_RUN_TYPE", "BINDER_SERVICE_HOST", "CODESPACES", "VSCODE_IPC_HOOK_CLI", "SSH_CONNECTION")


def has_page() -> bool:
    found = command()
    if found is None:
        return False
    done = subprocess.run([found, "view", "demo", "--export", "/nowhere/x.html", "--quiet"], stdin=subprocess.DEVNULL, capture_output=True)
    return done.returncode != 5


pytestmark = pytest.mark.skipif(not has_page(), reason="no tofray with the viewer's page (Boost, npm)")


@pytest.fixture(autouse=True)
def here(monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path) -> Iterator[None]:
    for name in ELSEWHERE:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    yield


def answers(url: str) -> bool:
    try:
        return bool(urllib.request.urlopen(url.split("#")[0], timeout=5).status == 200)
    except (urllib.error.URLError, ConnectionError):
        return False


def ended(pid: int, within_s: float = 10.0) -> bool:
    end = time.monotonic() + within_s
    while time.monotonic() < end:
        try:
            state = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
        except (FileNotFoundError, ProcessLookupError):
            return True
        if state == "Z":
            return True
        time.sleep(0.02)
    return False


def test_a_view_is_there_until_its_block_ends() -> None:
    with tofray.view("card", seed=3, set={"camera.lens.f_number": 2}, open=False) as viewer:
        assert re.fullmatch(rf"http://127\.0\.0\.1:{viewer.port}/#t=[0-9a-f]{{64}}", viewer.url)
        assert answers(viewer.url) and not viewer.closed
        assert viewer.url in repr(viewer)
        words = pathlib.Path(f"/proc/{viewer._process.pid}/cmdline").read_text(encoding="utf-8").split("\0")
        assert words[1:7] == ["view", "card", "--set", "camera.lens.f_number=2", "--seed", "3"]
        assert not any(word in viewer.url for word in words if len(word) > 20), "the key is on no command line"
    assert viewer.closed and not answers(viewer.url)
    assert repr(viewer) == "<tofray.View closed>"
    assert "ended" in viewer._repr_html_()
    viewer.close()


@pytest.mark.parametrize("how", ["end", "kill"])
def test_a_view_ends_with_its_python(how: str) -> None:
    text = "import sys, time, tofray\nviewer = tofray.view('card', open=False)\nprint(viewer._process.pid, flush=True)\n"
    text += "time.sleep(100)\n" if how == "kill" else ""
    with subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True) as python:
        assert python.stdout is not None
        pid = int(python.stdout.readline())
        if how == "kill":
            python.send_signal(signal.SIGKILL)
        python.wait()
        assert ended(pid)


def test_what_the_command_refuses_is_an_error_of_its_kind() -> None:
    with pytest.raises(tofray.Error, match=r'unknown key "f_nmber"') as fault:
        tofray.view("card", set={"camera.lens.f_nmber": 2}, open=False)
    assert fault.value.kind == "bad_input" and isinstance(fault.value, ValueError)
    assert "did you mean" in str(fault.value)
    with pytest.raises(tofray.Error, match="no such file") as missing:
        tofray.view("nothing.npz", open=False)
    assert missing.value.kind == "io"
    with pytest.raises(TypeError, match=r"tofray\.explore\(frames\)"):
        tofray.view(tofray.demo(), open=False)  # type: ignore[arg-type]
    with pytest.raises(tofray.Error):
        tofray.view("--port", open=False)  # a name, whatever it looks like


def test_a_notebook_shows_a_view_where_its_browser_reaches_it(monkeypatch: pytest.MonkeyPatch) -> None:
    with tofray.view("card", embed=True) as viewer:
        assert f'<iframe title="tofray view" src="{html.escape(viewer.url)}"' in viewer._repr_html_()
        policy = urllib.request.urlopen(viewer.url.split("#")[0]).headers["Content-Security-Policy"]
        assert "frame-ancestors http://localhost:* http://127.0.0.1:*" in policy
        for name in ELSEWHERE:
            monkeypatch.setenv(name, "1")
            shown = viewer._repr_html_()
            assert "<iframe" not in shown and "tofray.explore(frames)" in shown and f"ssh -L {viewer.port}:127.0.0.1:{viewer.port}" in shown
            monkeypatch.delenv(name)
    with tofray.view("card", open=False) as viewer:
        assert "<iframe" not in viewer._repr_html_() and "embed=True" in viewer._repr_html_()
        policy = urllib.request.urlopen(viewer.url.split("#")[0]).headers["Content-Security-Policy"]
        assert "frame-ancestors 'none'" in policy


def test_block_waits_for_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    waited = []

    def wait(viewer: tofray.View) -> None:
        waited.append(viewer.url)
        viewer.close()

    monkeypatch.setattr(tofray.View, "wait", wait)
    viewer = tofray.view("card", open=False, block=True)
    assert waited == [viewer.url] and viewer.closed


def contents(page: tofray.Page) -> dict[str, object]:
    text = re.search(r'<script type="application/json" id="tofray-export">(.*?)</script>', page.text, re.S)
    assert text is not None
    out: dict[str, object] = json.loads(text[1])
    return out


def test_frames_become_a_page_that_is_that_of_the_command(tmp_path: pathlib.Path) -> None:
    simulator = tofray.Simulator(tofray.load_scene("card"), seed=7)
    frames = [simulator.frame(i) for i in range(2)]
    page = tofray.explore(frames)
    found = contents(page)
    assert found["frames"] == [0, 1]
    assert page.text.count('class="tofray-frame"') >= 2
    assert found["live"] == "tofray view ./card"
    # Frames of these numbers out of the command's files: the blocks of arrays are the same digits.
    for i, frame in enumerate(frames):
        frame.save(tmp_path / "saved")
        os.makedirs("card", exist_ok=True)
        os.replace(tmp_path / "saved/frame.npz", f"card/frame_{i:06}.npz")
    assert subprocess.run([str(command()), "view", "./card", "--export", "page.html", "-q"]).returncode == 0
    blocks = re.compile(r'class="tofray-frame">([^<]*)<')
    assert blocks.findall(page.text) == blocks.findall(pathlib.Path("page.html").read_text(encoding="utf-8"))
    assert pathlib.Path(page.save("kept.html")).read_text(encoding="utf-8") == page.text
    assert contents(frames[0].explore(arrays=["z_m", "flags"]))["frames"] == [0]
    assert len(frames[0].explore(arrays=["z_m", "flags"]).text) < len(page.text)


def test_a_frame_of_ones_own_becomes_a_page() -> None:
    z_m = np.full((3, 4), 1.5, np.float32)
    frame = tofray.Frame(depth=tofray.Depth(z_m=z_m, flags=np.zeros((3, 4), np.uint16)))
    hello = contents(frame.explore())["hello"]
    assert isinstance(hello, dict) and [hello["width"], hello["height"]] == [4, 3]
    assert [pane["array"] for pane in hello["panes"]] == ["z_m", "flags"]


def test_a_notebook_shows_a_page_that_reaches_nothing_of_it() -> None:
    page = tofray.Simulator(tofray.load_scene("card"), seed=7).frame(0).explore(arrays=["z_m"], height=300)
    shown = page._repr_html_()
    head = shown[:300]
    assert 'sandbox="allow-scripts allow-downloads"' in head and "height:300px" in head and "allow-same-origin" not in head
    source = re.search(r'srcdoc="([^"]*)"', shown)
    assert source is not None and html.unescape(source[1]) == page.text
    assert repr(page).startswith("<tofray.Page of ")


def test_no_frames_and_others_are_refused() -> None:
    with pytest.raises(tofray.Error, match="there are no frames"):
        tofray.explore([])
    with pytest.raises(TypeError, match="got str"):
        tofray.explore(["frame.npz"])  # type: ignore[list-item]
    small = tofray.Frame(depth=tofray.Depth(z_m=np.ones((3, 4), np.float32)))
    large = tofray.Frame(depth=tofray.Depth(z_m=np.ones((6, 8), np.float32)))
    with pytest.raises(tofray.Error, match="expected frames of one camera"):
        tofray.explore([small, large])
    frame = tofray.Simulator(tofray.load_scene("card")).frame(0)
    with pytest.raises(tofray.Error, match="z_n"):
        frame.explore(arrays=["z_n"])
    with pytest.raises(OSError, match="nowhere"):
        frame.explore(arrays=["z_m"]).save("nowhere/page.html")
