// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Colours of values. Tables, ranges and the reasons of invalid pixels come from the server: here numbers only become colours.

import type { Hello, Numbers, Reason, Rgb, Scale } from "./protocol";

/** Where a pane of bits has none set. */
export const no_bit: Rgb = [244, 244, 241];

export type Color = (value: number) => Rgb;

/** Between the two stops beside t, in doubles, rounded as the server's own pictures are. */
function of_table(table: readonly Rgb[], t: number): Rgb {
  const last = table.length - 1;
  if (!(t > 0)) return table[0]!;
  if (t >= 1) return table[last]!;
  const at = t * last;
  const i = Math.floor(at);
  const a = table[i]!;
  const b = table[i + 1]!;
  const share = at - i;
  const mixed = (x: number, y: number): number => Math.floor(x + share * (y - x) + 0.5);
  return [mixed(a[0], b[0]), mixed(a[1], b[1]), mixed(a[2], b[2])];
}

/** Where a value stands on its scale: 0 at its low end, 1 at its high one. Clamped. */
export function place_of(value: number, scale: Scale): number {
  let t = (value - scale.low) / (scale.high - scale.low);
  if (scale.curve === "sqrt") t = t > 0 ? Math.sqrt(t) : 0;
  return Math.min(1, Math.max(0, t));
}

export function color_of(hello: Hello, scale: Scale): Color {
  const { depth, grey, error_near, error_far } = hello.palettes;
  if (scale.palette === "error") {
    return (value) => {
      const s = value / scale.high;
      return s < 0 ? of_table(error_near, -s) : of_table(error_far, s);
    };
  }
  const table = scale.palette === "depth" ? depth : grey;
  return (value) => {
    const t = place_of(value, scale);
    return of_table(table, scale.reverse === true ? 1 - t : t);
  };
}

/** The reason that explains best why a pixel is invalid: the first of the server's list whose bit is set. */
export function reason_of(hello: Hello, flags: number): Reason | undefined {
  return hello.invalid.find((reason) => ((flags >>> reason.bit) & 1) !== 0);
}

const whole_numbers = new WeakMap<Scale, Map<Hello["palettes"], Uint8Array>>();

/** The colours of 0 … 65535, each worked out when it is needed first: RGB and whether it is known. */
function table_of(hello: Hello, scale: Scale): Uint8Array {
  const of_scale = whole_numbers.get(scale) ?? new Map<Hello["palettes"], Uint8Array>();
  whole_numbers.set(scale, of_scale);
  const table = of_scale.get(hello.palettes) ?? new Uint8Array(4 * 65536);
  of_scale.set(hello.palettes, table);
  return table;
}

function paint_whole_numbers(pixels: Uint8ClampedArray, hello: Hello, values: Uint8Array | Uint16Array, scale: Scale): void {
  const table = table_of(hello, scale);
  const color = color_of(hello, scale);
  for (let i = 0; i < values.length; ++i) {
    const from = 4 * values[i]!;
    if (table[from + 3] === 0) table.set([...color(values[i]!), 255], from);
    const at = 4 * i;
    pixels[at] = table[from]!;
    pixels[at + 1] = table[from + 1]!;
    pixels[at + 2] = table[from + 2]!;
    pixels[at + 3] = 255;
  }
}

/** Colours all pixels.
 *  @param pixels  RGBA, as ImageData has them
 *  @param scale   undefined: the values are bits
 *  @return        how many pixels show each reason; without a reason: `undefined` */
export function paint(
  pixels: Uint8ClampedArray,
  hello: Hello,
  values: Numbers,
  flags: Numbers | undefined,
  scale: Scale | undefined,
): Map<Reason | undefined, number> {
  const counts = new Map<Reason | undefined, number>();
  if (scale !== undefined && (values instanceof Uint16Array || values instanceof Uint8Array)) {
    paint_whole_numbers(pixels, hello, values, scale);
    return counts;
  }
  const color = scale === undefined ? undefined : color_of(hello, scale);
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    let rgb: Rgb;
    if (color !== undefined && Number.isFinite(value)) {
      rgb = color(value);
    } else {
      const bits = color === undefined ? value : (flags?.[i] ?? 0);
      const reason = reason_of(hello, bits);
      if (reason !== undefined || color !== undefined) counts.set(reason, (counts.get(reason) ?? 0) + 1);
      rgb = reason !== undefined ? reason.color : color !== undefined ? hello.invalid_color : no_bit;
    }
    const at = 4 * i;
    pixels[at] = rgb[0];
    pixels[at + 1] = rgb[1];
    pixels[at + 2] = rgb[2];
    pixels[at + 3] = 255;
  }
  return counts;
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
