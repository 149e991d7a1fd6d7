// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Arrays out of a .npz file: what a test compares the page with. Little-endian numbers only.

import { readFileSync } from "node:fs";
import { inflateRawSync } from "node:zlib";

const kinds = {
  "|u1": Uint8Array, "|b1": Uint8Array, "<u2": Uint16Array, "<i2": Int16Array, "<u4": Uint32Array, "<i4": Int32Array,
  "<f4": Float32Array, "<f8": Float64Array,
};

function array_of(npy) {
  const length = npy[6] >= 2 ? npy.readUInt32LE(8) : npy.readUInt16LE(8);
  const start = (npy[6] >= 2 ? 12 : 10) + length;
  const header = npy.toString("latin1", start - length, start);
  const kind = kinds[/'descr': '([^']+)'/.exec(header)?.[1]];
  if (kind === undefined) return undefined;   // text
  const shape = /'shape': \(([^)]*)\)/.exec(header)[1].split(",").map((one) => one.trim()).filter((one) => one !== "").map(Number);
  const bytes = new Uint8Array(npy.subarray(start));   // a copy, so that it is aligned
  return { shape, values: new kind(bytes.buffer, 0, shape.reduce((a, b) => a * b, 1)) };
}

/** @return  name → {shape, values} */
export function read_npz(path) {
  const zip = readFileSync(path);
  const end = zip.lastIndexOf(Buffer.from("PK\x05\x06"));
  const arrays = {};
  let at = zip.readUInt32LE(end + 16);
  for (let i = 0; i < zip.readUInt16LE(end + 10); ++i) {
    const method = zip.readUInt16LE(at + 10);
    const size = zip.readUInt32LE(at + 20);
    const name_length = zip.readUInt16LE(at + 28);
    const local = zip.readUInt32LE(at + 42);
    const name = zip.toString("utf8", at + 46, at + 46 + name_length);
    const data = local + 30 + zip.readUInt16LE(local + 26) + zip.readUInt16LE(local + 28);
    const stored = zip.subarray(data, data + size);
    const array = array_of(method === 0 ? stored : inflateRawSync(stored));
    if (array !== undefined) arrays[name.replace(/\.npy$/, "")] = array;
    at += 46 + name_length + zip.readUInt16LE(at + 30) + zip.readUInt16LE(at + 32);
  }
  return arrays;
}
