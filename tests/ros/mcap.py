# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A reader of MCAP files and of their ROS 2 messages that shares no line with tofray's: records by the specification (mcap.dev/spec), messages
by the definitions that the file itself carries. Chunks that are packed are not read: Python has no zstd."""

from __future__ import annotations

import pathlib
import struct
import zlib
from typing import Any, Iterator

import numpy as np

MAGIC = b"\x89MCAP0\r\n"
NUMBERS = {"bool": "?", "byte": "B", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
           "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}


class Fields:
    """Takes numbers and texts off a record."""

    def __init__(self, data: bytes):
        self.data, self.at = data, 0

    def number(self, form: str) -> int:
        value, = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return value

    def bytes(self, count: int) -> bytes:
        assert self.at + count <= len(self.data), "a record is longer than it says"
        self.at += count
        return self.data[self.at - count:self.at]

    def text(self) -> str:
        return self.bytes(self.number("I")).decode()

    def pairs(self, key: str, value: str) -> dict:
        """A map; key and value are "text" or a number's form."""
        inner, out = Fields(self.bytes(self.number("I"))), {}
        take = lambda form: inner.text() if form == "text" else inner.number(form)
        while inner.at < len(inner.data):
            name = take(key)
            assert name not in out, "a key stands twice"
            out[name] = take(value)
        return out

    def end(self) -> None:
        assert self.at == len(self.data), "a record is shorter than its length"


def records(data: bytes, start: int = 0) -> Iterator[tuple[int, bytes, int]]:
    """Opcode, content and place of each record."""
    while start < len(data):
        opcode, size = struct.unpack_from("<BQ", data, start)
        yield opcode, data[start + 9:start + 9 + size], start
        start += 9 + size
    assert start == len(data)


class Message:
    def __init__(self, file: "Mcap", content: bytes):
        fields = Fields(content)
        self.channel, self.sequence, self.log, self.publish = (fields.number(form) for form in "HIQQ")
        self.data = content[fields.at:]
        self.topic = file.channels[self.channel]["topic"]
        self._file = file

    @property
    def value(self) -> dict[str, Any]:
        return decode(self.data, self._file.definition(self.channel))


class Mcap:
    """All of a file, with every sum and every index checked against what they are of."""

    def __init__(self, path: pathlib.Path):
        self.bytes = data = pathlib.Path(path).read_bytes()
        assert data[:8] == MAGIC and data[-8:] == MAGIC
        self.schemas: dict[int, dict] = {}
        self.channels: dict[int, dict] = {}
        self.messages: list[Message] = []
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, dict] = {}
        self.chunks: list[dict] = []
        self.summary: dict[int, list[bytes]] = {}
        self._definitions: dict[int, dict] = {}
        self.order: list[int] = []
        data_end = None
        for opcode, content, at in records(data[8:-8]):
            at += 8
            self.order.append(opcode)
            if data_end is None:
                data_end = self._data(opcode, content, at)
            else:
                self.summary.setdefault(opcode, []).append(content)
                if opcode == 0x02:
                    self._footer(content, at)
        self._check_summary()

    def _data(self, opcode: int, content: bytes, at: int) -> int | None:
        fields = Fields(content)
        if opcode == 0x01:
            self.profile, self.library = fields.text(), fields.text()
        elif opcode == 0x03:
            schema = {"id": fields.number("H"), "name": fields.text(), "encoding": fields.text(), "data": fields.text()}
            self.schemas[schema["id"]] = schema
        elif opcode == 0x04:
            channel = {"id": fields.number("H"), "schema": fields.number("H"), "topic": fields.text(), "encoding": fields.text(),
                       "metadata": fields.pairs("text", "text")}
            self.channels[channel["id"]] = channel
        elif opcode == 0x06:
            return self._chunk(fields, content, at)
        elif opcode == 0x07:
            self._index(fields)
        elif opcode == 0x09:
            fields.number("Q"), fields.number("Q")
            name, _, body = fields.text(), fields.text(), fields.bytes(fields.number("Q"))
            assert zlib.crc32(content[:fields.at]) == fields.number("I"), "an attachment's sum"
            self.attachments[name] = body
        elif opcode == 0x0c:
            name = fields.text()
            self.metadata[name] = fields.pairs("text", "text")
        elif opcode == 0x0f:
            assert zlib.crc32(self.bytes[:at]) == fields.number("I"), "the data section's sum"
            return at
        else:
            raise AssertionError(f"record {opcode:#x} in the data section")
        fields.end()
        return None

    def _chunk(self, fields: Fields, content: bytes, at: int) -> None:
        chunk = dict(zip(("start", "end", "size"), (fields.number("Q") for _ in range(3))), at=at, length=9 + len(content))
        crc, chunk["compression"] = fields.number("I"), fields.text()
        body = fields.bytes(fields.number("Q"))
        fields.end()
        assert chunk["compression"] == "", "this reader has no zstd"
        assert zlib.crc32(body) == crc and len(body) == chunk["size"], "a chunk's sum"
        chunk["messages"] = {}
        for opcode, message, place in records(body):
            assert opcode == 0x05
            self.messages.append(Message(self, message))
            chunk["messages"].setdefault(self.messages[-1].channel, []).append((self.messages[-1].log, place))
        times = [log for places in chunk["messages"].values() for log, _ in places]
        assert (chunk["start"], chunk["end"]) == (min(times), max(times)), "a chunk's times"
        chunk["indexed"] = set()
        self.chunks.append(chunk)

    def _index(self, fields: Fields) -> None:
        channel, inner = fields.number("H"), Fields(fields.bytes(fields.number("I")))
        entries = [(inner.number("Q"), inner.number("Q")) for _ in range(len(inner.data) // 16)]
        inner.end()
        assert entries == self.chunks[-1]["messages"][channel], "an index of messages"
        self.chunks[-1]["indexed"].add(channel)

    def _footer(self, content: bytes, at: int) -> None:
        fields = Fields(content)
        start, self.offsets_start, crc = fields.number("Q"), fields.number("Q"), fields.number("I")
        fields.end()
        assert zlib.crc32(self.bytes[start:at + 9 + 16]) == crc, "the summary's sum"
        self.summary_start = start

    def _check_summary(self) -> None:
        for opcode, known in ((0x03, self.schemas), (0x04, self.channels)):
            assert len(self.summary[opcode]) == len(known), "schemas and channels stand in the summary again"
        for chunk, content in zip(self.chunks, self.summary[0x08], strict=True):
            assert chunk["indexed"] == set(chunk["messages"]), "every channel of a chunk has its index"
            fields = Fields(content)
            assert [fields.number("Q") for _ in range(4)] == [chunk["start"], chunk["end"], chunk["at"], chunk["length"]]
            places = fields.pairs("H", "Q")
            assert set(places) == set(chunk["messages"])
            for channel, place in places.items():
                assert self.bytes[place] == 0x07 and struct.unpack_from("<H", self.bytes, place + 9) == (channel,)
            length = fields.number("Q")
            assert min(places.values()) == chunk["at"] + chunk["length"]
            assert self.bytes[chunk["at"] + chunk["length"] + length] != 0x07, "the length of a chunk's indexes"
            assert fields.text() == chunk["compression"] and [fields.number("Q"), fields.number("Q")] == [chunk["size"]] * 2
            fields.end()
        fields = Fields(self.summary[0x0b][0])
        assert fields.number("Q") == len(self.messages)
        assert [fields.number("H"), *(fields.number("I") for _ in range(4))] == [len(self.schemas), len(self.channels), len(self.attachments),
                                                                             len(self.metadata), len(self.chunks)]
        logs = [one.log for one in self.messages]
        assert [fields.number("Q"), fields.number("Q")] == [min(logs), max(logs)]
        counts = fields.pairs("H", "Q")
        assert counts == {channel: sum(one.channel == channel for one in self.messages) for channel in {one.channel for one in self.messages}}
        fields.end()
        for content in self.summary[0x0a] + self.summary[0x0d]:
            place, length = struct.unpack_from("<QQ", content)
            opcode, size = struct.unpack_from("<BQ", self.bytes, place)
            assert opcode in (0x09, 0x0c) and length == size + 9, "an index of attachments or metadata"
        for content in self.summary[0x0e]:
            opcode, start, length = struct.unpack("<BQQ", content)
            group = list(records(self.bytes[start:start + length]))
            assert [one[0] for one in group] == [opcode] * len(self.summary[opcode]), "an offset in the summary"

    def definition(self, channel: int) -> dict:
        schema = self.schemas[self.channels[channel]["schema"]]
        assert schema["encoding"] == "ros2msg" and self.channels[channel]["encoding"] == "cdr"
        if schema["id"] not in self._definitions:
            self._definitions[schema["id"]] = parse(schema["name"], schema["data"])
        return self._definitions[schema["id"]]

    def on(self, topic: str) -> list[Message]:
        return [one for one in self.messages if one.topic == topic]

    def topics(self) -> dict[str, str]:
        return {one["topic"]: self.schemas[one["schema"]]["name"] for one in self.channels.values()}


def parse(name: str, text: str) -> dict:
    """Types and their members out of a definition with all that it depends on."""
    package = name.split("/")[0]
    types: dict[str, list[tuple[str, str]]] = {}
    for index, part in enumerate(text.split("=" * 80 + "\n")):
        lines = part.splitlines()
        if index > 0:
            assert lines[0].startswith("MSG: ")
        here = lines.pop(0)[5:] if index > 0 else ""
        in_package = here.split("/")[0] if here else package
        members = []
        for line in lines:
            if "=" in line.split("#")[0] or not line.strip():
                continue  # a constant
            kind, member = line.split()[:2]
            base = kind.split("[")[0]
            if base not in NUMBERS and base != "string" and "/" not in base:
                kind = f"{in_package}/{kind}"
            members.append((member, kind))
        types[here] = members
    return types


def decode(data: bytes, types: dict) -> dict[str, Any]:
    """CDR of version 1, little endian."""
    assert data[:4] == b"\0\1\0\0"
    body, at = data[4:], 0

    def number(kind: str) -> Any:
        nonlocal at
        size = struct.calcsize(NUMBERS[kind])
        padding = -at % size
        assert not any(body[at:at + padding]), "padding is 0"
        at += padding + size
        return struct.unpack_from("<" + NUMBERS[kind], body, at - size)[0]

    def value(kind: str) -> Any:
        nonlocal at
        if kind.endswith("]"):
            base, count = kind[:-1].split("[")
            length = int(count) if count else number("uint32")
            if base in ("uint8", "byte"):
                at += length
                assert at <= len(body)
                return np.frombuffer(body[at - length:at], np.uint8)
            return [value(base) for _ in range(length)]
        if kind == "string":
            length = number("uint32")
            at += length
            assert body[at - 1] == 0, "a text ends with 0"
            return body[at - length:at - 1].decode()
        return number(kind) if kind in NUMBERS else {name: value(inner) for name, inner in types[kind]}

    out = {name: value(kind) for name, kind in types[""]}
    assert at == len(body), "bytes are left"
    return out


def stamp_ns(header: dict) -> int:
    return header["stamp"]["sec"] * 10**9 + header["stamp"]["nanosec"]


def image(message: dict) -> np.ndarray:
    """The pixels, rows by `step`."""
    kind = {"32FC1": "f4", "16UC1": "u2", "mono16": "u2", "mono8": "u1", "32SC1": "i4"}[message["encoding"]]
    kind = (">" if message["is_bigendian"] else "<") + kind
    width, height, step = message["width"], message["height"], message["step"]
    assert len(message["data"]) == step * height and step >= width * np.dtype(kind).itemsize
    rows = message["data"].reshape(height, step)[:, :width * np.dtype(kind).itemsize]
    return np.ascontiguousarray(rows).view(kind)


def cloud(message: dict) -> dict[str, np.ndarray]:
    """Each field as an image."""
    kinds = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
    order = ">" if message["is_bigendian"] else "<"
    height, width, step = message["height"], message["width"], message["point_step"]
    assert message["row_step"] == step * width and len(message["data"]) == height * message["row_step"]
    points = message["data"].reshape(height, width, step)
    out = {}
    for field in message["fields"]:
        kind = np.dtype(order + kinds[field["datatype"]])
        out[field["name"]] = np.ascontiguousarray(points[:, :, field["offset"]:field["offset"] + kind.itemsize]).view(kind)[:, :, 0]
    return out
