// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A binary message: a frame, or the arrays of an answer. Little-endian, 8-byte aligned.

import type { Side } from "./protocol";

export type Numbers = Uint8Array | Uint16Array | Int16Array | Uint32Array | Int32Array | Float32Array | Float64Array;

export interface FrameArray {
  id: number;
  dims: number[];
  values: Numbers;
}

export interface Frame {
  side: Side;
  /** No frame, but the arrays of the answer whose id is in `sequence`. */
  answers: boolean;
  generation: number;
  sequence: number;
  frame: number;
  time_s: number;
  width: number;
  height: number;
  draft: boolean;
  compute_ms: number;
  arrays: Map<number, FrameArray>;
}

const types = [Uint8Array, Uint16Array, Int16Array, Uint32Array, Float32Array, Int32Array, Float64Array] as const;
const header_bytes = 64;
const entry_bytes = 32;

function need(condition: boolean, what: string): asserts condition {
  if (!condition) throw new RangeError(`a frame that cannot be read: ${what}`);
}

/** The arrays are views of the message: nothing is copied.
 *  @throws RangeError where the message is not a whole frame */
export function read_frame(message: ArrayBuffer): Frame {
  need(message.byteLength >= header_bytes, `${message.byteLength} bytes`);
  const view = new DataView(message);
  const u16 = (at: number): number => view.getUint16(at, true);
  const u32 = (at: number): number => view.getUint32(at, true);
  need(u32(0) === 0x31564654, "it does not begin with TFV1");
  const header = u16(4);
  const count = u16(44);
  const channel = view.getUint8(6);
  need(header >= header_bytes && header + count * entry_bytes <= message.byteLength, `${count} arrays do not fit in`);
  const arrays = new Map<number, FrameArray>();
  for (let i = 0; i < count; ++i) {
    const at = header + i * entry_bytes;
    const id = u16(at);
    const type = types[view.getUint8(at + 2) - 1];
    const rank = view.getUint8(at + 3);
    const place = u32(at + 4);
    const bytes = u32(at + 8);
    need(type !== undefined, `array ${id} is of an unknown type`);
    need(rank <= 3, `array ${id} has ${rank} dimensions`);
    need(place % 8 === 0 && place + bytes <= message.byteLength, `array ${id} ends behind it`);
    const dims = [u32(at + 12), u32(at + 16), u32(at + 20)].slice(0, rank);
    const elements = dims.reduce((product, dim) => product * dim, 1);
    need(elements * type.BYTES_PER_ELEMENT === bytes, `array ${id} has ${bytes} bytes, its shape is ${dims.join(" × ")}`);
    arrays.set(id, { id, dims, values: new type(message, place, elements) });
  }
  return {
    side: (channel & 1) === 1 ? "b" : "a",
    answers: channel >= 2,
    generation: u32(8),
    sequence: u32(12),
    frame: Number(view.getBigUint64(16, true)),
    time_s: view.getFloat64(24, true),
    width: u32(32),
    height: u32(36),
    draft: (view.getUint8(7) & 1) !== 0,
    compute_ms: view.getFloat32(48, true),
    arrays,
  };
}
