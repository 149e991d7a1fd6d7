// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// node dds_reader.mjs DOMAIN TOPIC=TYPE…: subscribes by npm's @foxglove/ros2, ROS 2's protocol in TypeScript, on loopback. Says on stdout
// "ready"; then, of each writer, "writer TOPIC TYPE USER_DATA", and, of each message, "message TOPIC BYTES SHA256", of the bytes with zeros
// up to a multiple of 4; when its input ends, "topic TOPIC TYPE" for all that there are, and "end". TOPIC and TYPE are ROS's names.

import { createHash } from "node:crypto";
import { createRequire } from "node:module";

const require = createRequire(import.meta.url);
const { RosNode } = require("@foxglove/ros2");
const { UdpSocketNode } = require("@foxglove/ros2/nodejs");

const [domain, ...wanted] = process.argv.slice(2);
const say = (...words) => process.stdout.write(`${words.join(" ")}\n`);
const node = new RosNode({ name: "tofray_test", domainId: Number(domain), addresses: ["127.0.0.1"], udpSocketCreate: UdpSocketNode.Create });
node.on("discoveredPublication", (one) => say("writer", one.topicName, one.typeName, one.userData ?? "-"));

function padded(bytes) {
  const out = Buffer.alloc(Math.ceil(bytes.length / 4) * 4);
  out.set(bytes);
  return out;
}
await node.start();
for (const word of wanted) {
  const [topic, dataType] = word.split("=");
  node.subscribe({ topic, dataType, skipParsing: true }).on("message", (_time, _message, bytes) => {
    const all = padded(bytes);
    say("message", topic, all.length, createHash("sha256").update(all).digest("hex"));
  });
}
say("ready");
process.stdin.resume();
process.stdin.on("end", () => {
  for (const [topic, type] of node.getPublishedTopics()) say("topic", topic, type);
  say("end");
  process.exit(0);
});
