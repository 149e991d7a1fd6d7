// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// `tofray stream --to foxglove`, read by npm's @foxglove/ws-protocol, the client of Foxglove's own protocol: every byte of every message is
// that of `tofray render --emit mcap`; and who may read, who comes late, who says nonsense, and who does not read at all.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { request } from "node:http";
import { createRequire } from "node:module";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after, test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader } from "@mcap/core";

const require = createRequire(import.meta.url);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");

const folder = mkdtempSync(join(tmpdir(), "tofray-foxglove-"));
const running = new Set();
after(() => {
  for (const one of running) one.kill("SIGKILL");
  rmSync(folder, { recursive: true });
});
const small = ["--set", "camera.readout.binning=4", "--seed", "5"];   // 56 x 43 pixels
const spoken = ["foxglove.sdk.v1", "foxglove.websocket.v1"];
const patience_ms = 60_000;

/** Waits for a condition, as long as tests wait. */
async function until(come, what) {
  for (const end = performance.now() + patience_ms; !come();) {
    assert.ok(performance.now() < end, `waited for ${what}`);
    await new Promise((again) => setTimeout(again, 10));
  }
}

/** A stream on a port of its own. @return {port, child, said, told: its --json, once it has ended} */
async function stream(scene, ...words) {
  const child = spawn(process.env.TOFRAY, ["stream", scene, "--to", "foxglove", "--port", "0", "--json", ...words]);
  running.add(child);
  const out = { child, said: [] };
  let answer = "";
  child.stdout.on("data", (text) => (answer += text));
  createInterface({ input: child.stderr }).on("line", (line) => out.said.push(line));
  out.told = new Promise((resolve) => child.on("close", (code, signal) => {
    running.delete(child);
    resolve({ code: code ?? signal, ...(answer === "" ? {} : JSON.parse(answer)) });
  }));
  await until(() => out.said.some((line) => line.includes("ws://")) || child.exitCode !== null, "its address");
  assert.equal(child.exitCode, null, out.said.join("\n"));
  out.port = Number(/ws:\/\/localhost:(\d+)/.exec(out.said.join("\n"))?.[1]);
  return out;
}

/** A reader of all topics, or of those that are wanted. */
function reader({ port }, { wanted = () => true, protocols = [FoxgloveClient.SUPPORTED_SUBPROTOCOL], ...options } = {}) {
  const socket = new WebSocket(`ws://localhost:${port}/`, protocols, options);
  const client = new FoxgloveClient({ ws: socket });
  const out = { client, socket, channels: new Map(), messages: new Map(), times: [], statuses: [] };
  const topics = new Map();   // by the reader's own numbers
  client.on("serverInfo", (info) => (out.info = info));
  client.on("status", (one) => out.statuses.push(one));
  client.on("time", (one) => out.times.push(one.timestamp));
  client.on("close", (one) => (out.closed = one));
  client.on("error", (error) => (out.error = error));
  client.on("advertise", (all) => {
    for (const one of all) {
      out.channels.set(one.topic, one);
      if (wanted(one.topic)) topics.set(client.subscribe(one.id), one.topic);
    }
  });
  client.on("message", ({ subscriptionId, timestamp, data }) => {
    const topic = topics.get(subscriptionId);
    out.messages.set(topic, [...(out.messages.get(topic) ?? []), { timestamp, data: Buffer.from(data.buffer, data.byteOffset, data.byteLength) }]);
  });
  out.has = (topic, count) => until(() => (out.messages.get(topic) ?? []).length >= count, `${count} messages of ${topic}`);
  return out;
}

/** What render writes of the same frames: {topic: {type, schema, messages: [{timestamp, data}]}} */
async function rendered(scene, frames, ...words) {
  const into = mkdtempSync(join(folder, "film-"));
  execFileSync(process.env.TOFRAY, ["render", scene, "-o", into, "--frames", String(frames), "--emit", "mcap", "--mcap-compression", "none", "--quiet", ...words]);
  const bytes = readFileSync(join(into, "run.mcap"));
  const readable = { size: async () => BigInt(bytes.length), read: async (at, size) => bytes.subarray(Number(at), Number(at + size)) };
  const film = await McapIndexedReader.Initialize({ readable });
  const out = new Map();
  for await (const { channelId, publishTime, data } of film.readMessages()) {
    const channel = film.channelsById.get(channelId), schema = film.schemasById.get(channel.schemaId);
    if (!out.has(channel.topic)) out.set(channel.topic, { type: schema.name, schema: new TextDecoder().decode(schema.data), messages: [] });
    out.get(channel.topic).messages.push({ timestamp: publishTime, data: Buffer.from(data) });
  }
  return out;
}

/** The head of an answer to a request for the socket. */
function asked(port, headers, path = "/") {
  return new Promise((resolve, reject) => {
    const one = request({ host: "127.0.0.1", port, path, headers: {
      Host: `localhost:${port}`, Upgrade: "websocket", Connection: "Upgrade", "Sec-WebSocket-Version": "13",
      "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==", "Sec-WebSocket-Protocol": spoken[1], ...headers,
    } });
    one.on("upgrade", ({ statusCode, headers: answered }, socket) => (socket.destroy(), resolve({ status: statusCode, speaks: answered["sec-websocket-protocol"] })));
    one.on("response", (answer) => {
      let text = "";
      answer.on("data", (more) => (text += more)).on("end", () => resolve({ status: answer.statusCode, text }));
    });
    one.on("error", reject);
    one.end();
  });
}

test("every message is that of render's film, byte for byte and with its time, of the types that are said", async () => {
  const words = ["--driver", "pico_flexx", "--topics", "depth,amplitude,noise,points,raw,clock", ...small];
  const points_topic = "/pico_flexx/points";
  const expected = await rendered("flying-ball", 12, "--fps", "5", ...words);
  const running = await stream("flying-ball", ...words, "--rate", "5", "--frames", "12", "--wait-readers", String(2 * expected.size));
  const readers = [reader(running), reader(running)];
  const told = await running.told;
  assert.equal(told.code, 0, running.said.join("\n"));
  const [camera] = told.cameras;
  assert.equal(camera.sent + camera.dropped, 12);
  assert.deepEqual([told.not_sent, told.delivered, told.to, told.readers], [0, true, "foxglove", 2 * expected.size]);
  for (const one of readers) {
    await until(() => one.closed !== undefined, "its end");
    assert.equal(one.closed.code, 1001);
    assert.equal([...one.messages.values()].flat().length, told.messages);
    assert.deepEqual([...one.channels.keys()].sort(), [...expected.keys()].sort());
    for (const [topic, { type, schema, messages }] of expected) {
      const channel = one.channels.get(topic);
      assert.deepEqual([channel.schemaName, channel.schema, channel.encoding, channel.schemaEncoding], [type, schema, "cdr", "ros2msg"]);
      const seen = one.messages.get(topic) ?? [];
      if (topic.startsWith("/pico_flexx/")) assert.equal(seen.length, camera.sent, topic);
      let from = 0;
      for (const message of seen) {   // in order, with what was dropped left out
        const at = messages.findIndex((known, i) => i >= from && known.timestamp === message.timestamp && known.data.equals(message.data));
        assert.ok(at >= 0, `${topic} at ${message.timestamp}`);
        from = at + 1;
      }
    }
    assert.deepEqual(one.times, [...one.times].sort((a, b) => Number(a - b)));
    assert.equal(new Set(one.times).size, one.times.length);
    assert.equal(one.times.at(-1), one.messages.get(points_topic).at(-1).timestamp);
  }
  const points = readers[0].channels.get(points_topic);
  const cloud = new MessageReader(parse(points.schema, { ros2: true })).readMessage(readers[0].messages.get(points_topic)[0].data);
  assert.deepEqual([cloud.width, cloud.height], [56, 43]);
});

test("who comes later gets what is kept, at once, and all topics; who has had enough says so", async () => {
  const [expected, running] = [await rendered("room", 1, "--fps", "0.01", ...small), await stream("room", ...small, "--rate", "0.01")];
  for (let i = 0; i < 2; ++i) {   // the second frame comes in 100 s
    const one = reader(running, { wanted: (topic) => ["/camera/points", "/tf_static"].includes(topic) });
    await one.has("/camera/points", 1);
    await one.has("/tf_static", 1);
    assert.ok(one.messages.get("/camera/points")[0].data.equals(expected.get("/camera/points").messages[0].data));
    assert.ok(one.times.length >= 1);
    one.client.unsubscribe(0);
    one.socket.send(JSON.stringify({ op: "unsubscribe", subscriptionIds: [0] }));
    await until(() => one.statuses.some((status) => status.message === "there is no subscription 0"), "a word on what there is not");
    one.client.close();
  }
  running.child.kill("SIGINT");
  const told = await running.told;
  assert.deepEqual([told.code, told.interrupted], [0, false]);   // it had no end of its own
});

test("with --qos sensor images are not kept, transforms are", async () => {
  const running = await stream("room", ...small, "--rate", "0.01", "--qos", "sensor", "--wait-readers", "1");
  await reader(running, { wanted: (topic) => topic === "/camera/points" }).has("/camera/points", 1);
  const later = reader(running);
  await later.has("/tf_static", 1);
  await later.has("/tf", 1);
  assert.equal(later.messages.has("/camera/points"), false);
  running.child.kill("SIGTERM");
  assert.equal((await running.told).code, 0);
});

test("both subprotocols are spoken, the newer one first, and no other", async () => {
  const running = await stream("room", ...small, "--rate", "1");
  for (const [named, speaks] of [[spoken[0], spoken[0]], [spoken[1], spoken[1]], [`${spoken[1]}, ${spoken[0]}`, spoken[0]], [`a, ${spoken[1]}`, spoken[1]]])
    assert.deepEqual(await asked(running.port, { "Sec-WebSocket-Protocol": named }), { status: 101, speaks });
  const other = await asked(running.port, { "Sec-WebSocket-Protocol": "tofray.v1" });
  assert.equal(other.status, 400);
  assert.match(other.text, /foxglove\.sdk\.v1 or foxglove\.websocket\.v1/);
  running.child.kill("SIGINT");
  await running.told;
});

test("pages of elsewhere and other hosts' names are refused, with the way out, unless they are allowed", async () => {
  const running = await stream("room", ...small, "--rate", "1", "--allow-origin", "https://app.example.org", "--allow-host", "lab7");
  const { port } = running;
  const status = async (headers, path) => (await asked(port, headers, path)).status;
  for (const origin of ["https://APP.example.org", "http://localhost:8080", "https://127.0.0.1", "file://", "http://[::1]:3000"]) assert.equal(await status({ Origin: origin }), 101, origin);
  for (const origin of ["https://evil.example", "https://app.example.org.evil.example", "http://localhost.evil.example", "null", "https://app.example.org:444", "http://app.example.org", "http://127.0.0.1.evil.example"])
    assert.equal(await status({ Origin: origin }), 403, origin);
  await until(() => running.said.some((line) => line.includes('--allow-origin "https://evil.example" lets it in')), "a word on the terminal");
  for (const host of [`localhost:${port}`, `127.0.0.1:${port}`, `lab7:${port}`]) assert.equal(await status({ Host: host }), 101, host);
  for (const host of [`evil.example:${port}`, "localhost", `localhost:${port + 1}`]) assert.equal(await status({ Host: host }), 421, host);
  assert.equal(await status({}, "/any?path"), 101);
  assert.equal(await status({ Upgrade: "h2c" }), 426);
  assert.equal(await status({ "Sec-WebSocket-Version": "12" }), 426);
  assert.equal(await status({ "Sec-WebSocket-Key": "short" }), 400);
  running.child.kill("SIGINT");
  await running.told;
});

test("what is no message of the protocol is answered, and the stream goes on for all", async () => {
  const running = await stream("room", ...small, "--rate", "20");
  const good = reader(running, { wanted: (topic) => topic === "/camera/points" });
  const bad = reader(running, { wanted: () => false });
  await until(() => bad.channels.size > 0, "topics");
  const id = bad.channels.get("/camera/points").id;
  const nonsense = [
    ["no json", 2, /a reader's message/], ["[]", 2, /no text op/], ['{"op":7}', 2, /no text op/], ['{"op":"subscribe"}', 2, /no list subscriptions/],
    ['{"op":"subscribe","subscriptions":[7]}', 2, /is no object/], ['{"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]}', 2, /id is no whole number/],
    ['{"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]}', 2, /channelId is no whole number/],
    ['{"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]}', 2, /no such channel/], ['{"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]}', 2, /no such channel/],
    [`{"op":"subscribe","subscriptions":[{"id":1,"channelId":${id}},{"id":2,"channelId":${id}}]}`, 1, /subscribed to already/],
    [`{"op":"subscribe","subscriptions":[{"id":1,"channelId":${id + 1}}]}`, 1, /in use/], ['{"op":"unsubscribe","subscriptionIds":[9]}', 1, /no subscription 9/],
    ['{"op":"unsubscribe","subscriptionIds":["a"]}', 2, /subscriptionId is no whole number/], ['{"op":"getParameters","parameterNames":[]}', 1, /does not know "getParameters"/],
    [Buffer.from([1, 0, 0, 0, 0, 9]), 1, /does not know "publish"/], ["[".repeat(2000), 2, /./],
  ];
  for (const [text, level, message] of nonsense) {
    const before = bad.statuses.length;
    bad.socket.send(text);
    await until(() => bad.statuses.length > before, `an answer to ${text}`);
    assert.equal(bad.statuses.at(-1).level, level, String(text));
    assert.match(bad.statuses.at(-1).message, message, String(text));
  }
  bad.socket.send("x".repeat(70_000));   // longer than any message
  await until(() => bad.closed !== undefined, "an end");
  assert.equal(bad.closed.code, 1009);
  const before = good.messages.get("/camera/points")?.length ?? 0;
  await good.has("/camera/points", before + 3);
  running.child.kill("SIGINT");
  assert.equal((await running.told).code, 0);
});

test("who does not read is left behind, and counted; the others get all", async () => {
  const running = await stream("flying-ball", "--topics", "depth,points", "--frames", "75", "--wait-readers", "2");
  const good = reader(running, { wanted: (topic) => topic === "/camera/points" });
  const idle = connect(running.port, "127.0.0.1");
  idle.on("error", () => undefined);
  idle.write(`GET / HTTP/1.1\r\nHost: localhost:${running.port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n`
    + `Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Protocol: ${spoken[0]}\r\n\r\n`);
  await new Promise((then) => idle.once("data", then));
  await until(() => good.channels.has("/camera/points"), "topics");
  idle.pause();
  const text = Buffer.from(JSON.stringify({ op: "subscribe", subscriptions: [{ id: 1, channelId: good.channels.get("/camera/points").id }] }));
  idle.write(Buffer.concat([Buffer.from([0x81, 0x80 | text.length, 0, 0, 0, 0]), text]));   // a mask of zeros
  const told = await running.told;
  idle.destroy();
  assert.equal(told.code, 0, running.said.join("\n"));
  const { sent } = told.cameras[0];
  assert.ok(sent > 30, `${sent} frames`);
  assert.ok(told.not_sent > 0 && told.not_sent < sent, `${told.not_sent} of ${sent}`);
  assert.equal(told.delivered, false);
  assert.ok(told.warnings.some((line) => line.includes("too far behind")), JSON.stringify(told.warnings));
  assert.equal(good.messages.get("/camera/points").length, sent);
});

test("options of the other carrier, origins that are none and ports that are taken are refused", async () => {
  const running = await stream("room", ...small, "--rate", "1");
  const refused = (...words) => {
    try {
      execFileSync(process.env.TOFRAY, ["stream", "room", ...small, "--frames", "1", ...words], { encoding: "utf8", stdio: "pipe", timeout: patience_ms });
    } catch (error) {
      return `${error.status} ${error.stderr}`;
    }
    throw new Error(`${words.join(" ")} was taken`);
  };
  assert.match(refused("--to", "foxglove", "--domain", "7"), /^2 error: --domain is of --to dds alone/);
  assert.match(refused("--to", "foxglove", "--interface", "eth0"), /^2 error: --interface is of --to dds alone/);
  for (const [option, value] of [["--port", "0"], ["--host", "::1"], ["--allow-host", "lab7"], ["--allow-origin", "https://a.example"]])
    assert.match(refused("--to", "dds", option, value), new RegExp(`^2 error: ${option} is of --to foxglove alone`));
  for (const origin of ["app.example.org", "https://app.example.org/", "https://a b", "://x"]) assert.match(refused("--to", "foxglove", "--allow-origin", origin), /^2 error: --allow-origin/);
  assert.match(refused("--to", "foxglove", "--host", "lab7"), /^2 error: --host lab7 is no address/);
  assert.match(refused("--to", "foxglove", "--port", String(running.port)), new RegExp(`^3 error: the stream cannot listen on 127.0.0.1 port ${running.port}`));
  running.child.kill("SIGINT");
  await running.told;
});
