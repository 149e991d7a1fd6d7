// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// MCAP files of `tofray render`, read by npm's @mcap/core and @foxglove/rosmsg2-serialization: 300 frames against frame.npz, bit for bit, and
// what is left of files that were cut.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import { read_npz } from "./npz.mjs";

const frames = 300;
const folder = mkdtempSync(join(tmpdir(), "tofray-mcap-"));
after(() => rmSync(folder, { recursive: true }));
const small = ["--set", "camera.readout.binning=4", "--seed", "5"];   // 56 x 43 pixels
const arrays = "raw,z_m,points_m,amplitude_e,noise_m,confidence,flags";

function render(name, ...words) {
  execFileSync(process.env.TOFRAY, ["render", "flying-ball", "-o", join(folder, name), "--quiet", ...small, ...words]);
  return join(folder, name, "run.mcap");
}
const film = render("a", "--frames", String(frames), "--emit", "npz,mcap", "--arrays", arrays);

const decompressHandlers = { zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size))) };
const sha256 = (path) => createHash("sha256").update(readFileSync(path)).digest("hex");

/** Topic, type and value of each message; sums are checked. */
class Decoder {
  #schemas = new Map();
  #channels = new Map();
  #readers = new Map();
  messages = [];
  attachments = [];
  add(record) {
    if (record.type === "Schema") this.#schemas.set(record.id, record);
    if (record.type === "Channel") this.#channels.set(record.id, record);
    if (record.type === "Attachment") this.attachments.push(record.name);
    if (record.type !== "Message") return;
    const channel = this.#channels.get(record.channelId), schema = this.#schemas.get(channel.schemaId);
    if (!this.#readers.has(channel.schemaId))
      this.#readers.set(channel.schemaId, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
    this.messages.push({ topic: channel.topic, type: schema.name, log: record.logTime,
      value: this.#readers.get(channel.schemaId).readMessage(record.data) });
  }
}

/** What a reader of streams finds in these bytes, up to where they end. */
function streamed(bytes) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const decoder = new Decoder();
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()) !== undefined;) decoder.add(record);
  return { ...decoder, done: reader.done() };
}

async function indexed(path) {
  const bytes = readFileSync(path);
  const readable = { size: async () => BigInt(bytes.length), read: async (at, size) => bytes.subarray(Number(at), Number(at + size)) };
  return McapIndexedReader.Initialize({ readable, decompressHandlers });
}

function plain(value, element) {
  const bytes = new Uint8Array(value);   // a copy, so that it is aligned
  return new element(bytes.buffer);
}
function same(a, b) {
  return Buffer.compare(Buffer.from(a.buffer, a.byteOffset, a.byteLength), Buffer.from(b.buffer, b.byteOffset, b.byteLength)) === 0;
}

test(`${frames} frames: every array has the bits of frame.npz`, () => {
  const { messages, done } = streamed(readFileSync(film));
  assert.ok(done);
  const on = (topic) => messages.filter((one) => one.topic === topic).map((one) => one.value);
  const all = Object.fromEntries(["depth_image", "amplitude_image", "noise_image", "confidence_image", "points", "camera_info", "raw/meta"]
    .map((name) => [name, on(`/camera/${name}`)]));
  const phases = JSON.parse(all["raw/meta"][0].data).topics;
  const raw = phases.map(on);
  for (const list of [...Object.values(all), ...raw]) assert.equal(list.length, frames);
  let valid = 0;
  for (let i = 0; i < frames; ++i) {
    const npz = read_npz(join(folder, "a", `frame_${String(i).padStart(4, "0")}.npz`));
    const [height, width] = npz.z_m.shape, pixels = width * height;
    assert.ok(same(plain(all.depth_image[i].data, Float32Array), npz.z_m.values), `z of frame ${i}`);
    assert.ok(same(plain(all.noise_image[i].data, Float32Array), npz.noise_m.values), `noise of frame ${i}`);
    assert.ok(same(plain(all.confidence_image[i].data, Uint8Array), npz.confidence.values), `confidence of frame ${i}`);
    phases.forEach((topic, k) => assert.ok(
      same(plain(raw[k][i].data, Uint16Array), npz.raw.values.subarray(k * pixels, (k + 1) * pixels)), `${topic} of frame ${i}`));
    const { data, point_step } = all.points[i];
    const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    for (let p = 0; p < pixels; ++p) {
      const at = p * point_step;
      for (let c = 0; c < 3; ++c) assert.ok(Object.is(view.getFloat32(at + 4 * c, true), npz.points_m.values[3 * p + c]), `point ${p} of frame ${i}`);
      assert.ok(Object.is(view.getFloat32(at + 12, true), npz.amplitude_e.values[p]));
      assert.ok(Object.is(view.getFloat32(at + 16, true), npz.noise_m.values[p]));
      assert.equal(view.getUint16(at + 20, true), npz.flags.values[p]);
      assert.equal(view.getUint8(at + 22), npz.confidence.values[p]);
      if (!Number.isNaN(npz.z_m.values[p])) ++valid;
    }
  }
  assert.ok(valid > frames * 100);
});

test("times ascend, and all messages of a frame have one stamp, before it could be sent", () => {
  const { messages } = streamed(readFileSync(film));
  const ns = (stamp) => BigInt(stamp.sec) * 1000000000n + BigInt(stamp.nanosec ?? stamp.nsec);
  const stamps = new Map();
  for (let i = 1; i < messages.length; ++i) assert.ok(messages[i].log >= messages[i - 1].log);
  for (const { value, log, topic } of messages)
    if (value.header !== undefined) {
      if (!stamps.has(log)) stamps.set(log, ns(value.header.stamp));
      assert.equal(ns(value.header.stamp), stamps.get(log), topic);
      assert.ok(ns(value.header.stamp) < log, topic);
    }
  assert.equal(stamps.size, frames);
});

test("the index leads to the same messages, and the summary counts them", async () => {
  const { messages, attachments } = streamed(readFileSync(film));
  const reader = await indexed(film);
  assert.equal(reader.header.profile, "ros2");
  assert.equal(Number(reader.statistics.messageCount), messages.length);
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  assert.deepEqual(reader.attachmentIndexes.map((one) => one.name), attachments);
  assert.deepEqual(attachments, ["camera.yaml", "scene.yaml", "manifest.json"]);
  assert.ok([...reader.metadataIndexes].some((one) => one.name === "tofray"));
  let count = 0;
  for await (const message of reader.readMessages({ topics: ["/camera/depth_image"], startTime: messages.at(-1).log, validateCrcs: true })) {
    ++count;
    assert.equal(message.logTime, messages.at(-1).log);
  }
  assert.equal(count, 1);
  const packed = JSON.parse(execFileSync(process.env.TOFRAY, ["inspect", film, "--json"])).compression;   // none in a build without libzstd
  for (const chunk of reader.chunkIndexes) assert.equal(chunk.compression || "none", packed);
});

test("a second run has the same SHA-256, and manifest.json lists it", () => {
  const again = render("b", "--frames", String(frames), "--emit", "mcap", "--threads", "1");
  assert.equal(sha256(again), sha256(film));
  const listed = JSON.parse(readFileSync(join(folder, "b", "manifest.json"), "utf8")).files;
  assert.deepEqual(listed, [{ name: "run.mcap", bytes: statSync(again).size, sha256: sha256(again) }]);
});

test("a file that was cut anywhere is read up to its last whole chunk", async () => {
  const bytes = readFileSync(film), whole = streamed(bytes).messages;
  const { chunkIndexes } = await indexed(film);
  assert.ok(chunkIndexes.length > 20);
  for (const chunk of [chunkIndexes[0], chunkIndexes[7], chunkIndexes.at(-1)]) {
    const end = Number(chunk.chunkStartOffset + chunk.chunkLength);
    const full = streamed(bytes.subarray(0, end)).messages.length;
    for (const [at, messages] of [[end, full], [end + 5, full], [end - 1, undefined]]) {
      const cut = streamed(bytes.subarray(0, at));
      assert.equal(cut.done, false);
      if (messages !== undefined) assert.equal(cut.messages.length, messages);
      else assert.ok(cut.messages.length < full);
      cut.messages.forEach((one, i) => assert.deepEqual([one.topic, one.log], [whole[i].topic, whole[i].log]));
    }
  }
});

test("a run that is killed leaves a file that is read, and an earlier one of the name is intact", async () => {
  const earlier = render("c", "--frames", "2", "--emit", "mcap"), sum = sha256(earlier);
  const part = join(folder, "c", "run.part.mcap");
  const run = spawn(process.env.TOFRAY, ["render", "flying-ball", "-o", join(folder, "c"), "--quiet", ...small, "--frames", "1000000", "--emit", "mcap"]);
  const ended = new Promise((resolve) => run.on("exit", resolve));
  for (let i = 0; i < 600 && !(existsSync(part) && statSync(part).size > 3_000_000); ++i) await new Promise((resolve) => setTimeout(resolve, 50));
  run.kill("SIGKILL");
  await ended;
  const { messages, attachments } = streamed(readFileSync(part));
  const depth = messages.filter((one) => one.topic === "/camera/depth_image");
  assert.ok(depth.length > 5);
  assert.deepEqual(attachments, ["camera.yaml", "scene.yaml", "manifest.json"]);
  const whole = streamed(readFileSync(film)).messages.filter((one) => one.topic === "/camera/depth_image");
  depth.slice(0, frames).forEach((one, i) => assert.ok(same(plain(one.value.data, Float32Array), plain(whole[i].value.data, Float32Array)), `frame ${i}`));
  assert.equal(sha256(earlier), sum);
});
