// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Colours of values. Tables, ranges and the reasons of invalid pixels come from the server: here numbers only become colours.

import type { Hello, Numbers, Reason, Rgb, Scale } from "./protocol";

/** Where a pane of bits has none set. */
export const no_bit: Rgb = [244, 244, 241];

export type Color = (value: number) => Rgb;

/** A palette's stops, one after the other: numbers alone, so that a picture's hundred thousands of colours take no memory of their own. */
const flat_tables = new WeakMap<readonly Rgb[], Float64Array>();

function flat(table: readonly Rgb[]): Float64Array {
  const before = flat_tables.get(table);
  if (before !== undefined) return before;
  const stops = Float64Array.from(table.flat());
  flat_tables.set(table, stops);
  return stops;
}

/** Between the two stops beside t, in doubles, rounded as the server's own pictures are. @return  0xBBGGRR */
function mixed(stops: Float64Array, t: number): number {
  const last = stops.length / 3 - 1;
  const at = t > 0 ? Math.min(1, t) * last : 0;
  const i = Math.min(last, Math.floor(at));
  const a = 3 * i;
  const b = 3 * Math.min(last, i + 1);
  const share = at - i;
  const red = Math.floor(stops[a]! + share * (stops[b]! - stops[a]!) + 0.5);
  const green = Math.floor(stops[a + 1]! + share * (stops[b + 1]! - stops[a + 1]!) + 0.5);
  const blue = Math.floor(stops[a + 2]! + share * (stops[b + 2]! - stops[a + 2]!) + 0.5);
  return (blue << 16) | (green << 8) | red;
}

function packed([red, green, blue]: Rgb): number {
  return (blue << 16) | (green << 8) | red;
}

/** Where a value stands on its scale: 0 at its low end, 1 at its high one. Clamped. */
export function place_of(value: number, scale: Scale): number {
  let t = (value - scale.low) / (scale.high - scale.low);
  if (scale.curve === "sqrt") t = t > 0 ? Math.sqrt(t) : 0;
  return Math.min(1, Math.max(0, t));
}

/** @return  0xBBGGRR of a value */
function packed_color_of(hello: Hello, scale: Scale): (value: number) => number {
  if (scale.palette === "error") {
    const [near, far] = [flat(hello.palettes.error_near), flat(hello.palettes.error_far)];
    return (value) => {
      const s = value / scale.high;
      return s < 0 ? mixed(near, -s) : mixed(far, s);
    };
  }
  const table = flat(scale.palette === "depth" ? hello.palettes.depth : hello.palettes.grey);
  const reverse = scale.reverse === true;
  return (value) => {
    const t = place_of(value, scale);
    return mixed(table, reverse ? 1 - t : t);
  };
}

export function color_of(hello: Hello, scale: Scale): Color {
  const of = packed_color_of(hello, scale);
  return (value) => {
    const color = of(value);
    return [color & 255, (color >> 8) & 255, color >> 16];
  };
}

/** The reason that explains best why a pixel is invalid: the first of the server's list whose bit is set. */
export function reason_of(hello: Hello, flags: number): Reason | undefined {
  return hello.invalid.find((reason) => ((flags >>> reason.bit) & 1) !== 0);
}

const opaque = 255 << 24;
const whole_numbers = new WeakMap<Scale, Map<Hello["palettes"], Int32Array>>();

/** The colours of 0 … 65535, each worked out when it is needed first; 0: it is not known yet. */
function table_of(hello: Hello, scale: Scale): Int32Array {
  const of_scale = whole_numbers.get(scale) ?? new Map<Hello["palettes"], Int32Array>();
  whole_numbers.set(scale, of_scale);
  const table = of_scale.get(hello.palettes) ?? new Int32Array(65536);
  of_scale.set(hello.palettes, table);
  return table;
}

function paint_whole_numbers(pixels: Int32Array, hello: Hello, values: Uint8Array | Uint16Array, scale: Scale): void {
  const table = table_of(hello, scale);
  const color = packed_color_of(hello, scale);
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    pixels[i] = table[value]! || (table[value] = color(value) | opaque);
  }
}

/** Colours all pixels.
 *  @param image   RGBA, as ImageData has them
 *  @param scale   undefined: the values are bits
 *  @return        how many pixels show each reason; without a reason: `undefined` */
export function paint(
  image: Uint8ClampedArray,
  hello: Hello,
  values: Numbers,
  flags: Numbers | undefined,
  scale: Scale | undefined,
): Map<Reason | undefined, number> {
  const pixels = new Int32Array(image.buffer, image.byteOffset, values.length);   // (browsers are little endian)
  if (scale !== undefined && (values instanceof Uint16Array || values instanceof Uint8Array)) {
    paint_whole_numbers(pixels, hello, values, scale);
    return new Map();
  }
  const reasons: readonly (Reason | undefined)[] = [...hello.invalid, undefined];
  const none = hello.invalid.length;
  const masks = hello.invalid.map((reason) => 1 << reason.bit);
  const colors = reasons.map((reason) => packed(reason?.color ?? (scale === undefined ? no_bit : hello.invalid_color)) | opaque);
  const counts = new Float64Array(reasons.length);
  const color = scale === undefined ? undefined : packed_color_of(hello, scale);
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    if (color !== undefined && Number.isFinite(value)) {
      pixels[i] = color(value) | opaque;
      continue;
    }
    const bits = color === undefined ? value : (flags?.[i] ?? 0);
    let at = 0;
    while (at < none && (bits & masks[at]!) === 0) ++at;
    pixels[i] = colors[at]!;
    counts[at]! += 1;
  }
  if (scale === undefined) counts[none] = 0;   // a pixel without a bit is nothing to be explained
  return new Map(reasons.map((reason, at) => [reason, counts[at]!] as const).filter(([, count]) => count > 0));
}

/** Black or white, whichever reads better on this colour (relative luminance, WCAG 2). */
export function ink_on(rgb: Rgb): string {
  const linear = (c: number): number => (c <= 10 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = 0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]);
  return luminance > 0.18 ? "#000" : "#fff";
}

export function css(rgb: Rgb): string {
  return `rgb(${rgb[0]} ${rgb[1]} ${rgb[2]})`;
}
