// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Two states: which of them a picture shows, and B − A.

import { minus } from "./numbers";
import type { Frame, Numbers, Scale, Side, Tick } from "./protocol";
import { raw_view } from "./raw";
import { array_of, comparing, difference_scales, flipped, frame, frame_b, hello, is_bits, other, scale_of, value_at, type Cursor } from "./store";

export interface Values {
  values: Numbers;
  flags: Numbers | undefined;
  width: number;
  height: number;
}

/** What a picture shows: one state, A to a line and B behind it, or their difference. */
export type Shows = Side | "wipe" | "difference";

/** @param side  whose picture it is: B has one of its own only where both stand beside each other */
export function shown_by(side: Side): Shows {
  if (side === "b" || other.value === undefined || frame_b.value === undefined) return side;
  const how = comparing.value;
  if (how === "difference" && !has_difference()) return "a";
  if (how === "flip") return flipped.value ? "b" : "a";
  return how === "beside" ? (flipped.value ? "b" : "a") : flipped.value ? "b" : how;
}

/** The image of an array; undefined where the frame has none. */
export function image_of(of: Frame | undefined, name: string): Values | undefined {
  const array = array_of(of, name);
  const [height, width] = array?.dims ?? [];
  if (array === undefined || array.dims.length !== 2 || height === undefined || width === undefined || width * height === 0) return undefined;
  return { values: array.values, flags: array_of(of, "flags")?.values, width, height };
}

/** Whether both have the same pixels. */
export function has_difference(): boolean {
  const a = frame.value;
  const b = frame_b.value;
  return a !== undefined && b !== undefined && a.width === b.width && a.height === b.height;
}

/** B − A of numbers; of bits those that only one of them has. A pixel that lacks one of both values has that one's flags. */
export function difference_of(a: Frame | undefined, b: Frame | undefined, name: string): Values | undefined {
  const from = image_of(a, name);
  const to = image_of(b, name);
  if (from === undefined || to === undefined || from.width !== to.width || from.height !== to.height) return undefined;
  const { width, height } = from;
  const count = width * height;
  if (is_bits(name)) {
    const bits = new Uint32Array(count);
    for (let i = 0; i < count; ++i) bits[i] = from.values[i]! ^ to.values[i]!;
    return { values: bits, flags: undefined, width, height };
  }
  const values = new Float64Array(count);
  const flags = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    values[i] = to.values[i]! - from.values[i]!;
    if (!Number.isFinite(values[i]!)) flags[i] = (Number.isFinite(from.values[i]!) ? to.flags : from.flags)?.[i] ?? 0;
  }
  return { values, flags, width, height };
}

/** B − A at the cursor; NaN where one has no value, undefined where there is none to compare. */
export function difference_at(name: string, at: Cursor | undefined): number | undefined {
  const a = value_at(name, at);
  const b = value_at(name, at, "b");
  return a === undefined || b === undefined || !has_difference() ? undefined : b - a;
}

/** 1, 2 or 5 times a power of ten, not below this. */
function round_up(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * ([1, 2, 5, 10].find((one) => one * power >= value * (1 - 1e-9)) ?? 10);
}

/** In what differences are read: those of lengths as errors are. */
export function difference_unit(own: Scale): { unit: string; factor: number } {
  const error = hello.value?.panes.find((one) => one.array === "z_error_m")?.scale;
  const { unit, factor } = own.unit === "m" && error != null ? error : own;
  return { unit, factor: factor ?? 1 };
}

/** Differences of a pane have the colours of errors, to either side as far as all but one in twenty reach. */
export function fitted_difference(name: string, values: Numbers): Scale | undefined {
  const own = scale_of(name);
  if (own === undefined) return undefined;
  const { unit, factor } = difference_unit(own);
  const sizes = Array.from(values, Math.abs).filter((one) => one > 0 && Number.isFinite(one)).sort((x, y) => x - y);
  const most = sizes[Math.floor(0.95 * (sizes.length - 1))];
  const high = (most === undefined ? round_up((factor * (own.high - own.low)) / 100) : round_up(factor * most)) / factor;
  const ticks: Tick[] = [-1, -0.5, 0, 0.5, 1].map((share) => {
    const shown = Number((share * high * factor).toPrecision(3));
    return { at: share * high, label: `${shown < 0 ? minus : shown > 0 ? "+" : ""}${Math.abs(shown)}` };
  });
  return { low: -high, high, palette: "error", curve: "linear", factor, unit, ticks };
}

/** Raw frames of a kind have one scale. */
function kind_of(name: string): string {
  return raw_view(name)?.kind ?? name;
}

/** The scale of a pane's differences: once chosen, it stays. */
export function difference_scale(name: string): Scale | undefined {
  return difference_scales.value.get(kind_of(name));
}

/** Of raw frames those of all of them. */
function all_differences(name: string): Numbers | undefined {
  const raw = raw_view(name);
  if (raw === undefined) return difference_of(frame.peek(), frame_b.peek(), name)?.values;
  const [a, b] = [array_of(frame.peek(), raw.kind)?.values, array_of(frame_b.peek(), raw.kind)?.values];
  return a === undefined || b === undefined || a.length !== b.length ? undefined : Float64Array.from(a, (one, i) => b[i]! - one);
}

export function fit_difference(name: string): void {
  const values = all_differences(name);
  const scale = values && fitted_difference(name, values);
  if (scale !== undefined) difference_scales.value = new Map(difference_scales.peek()).set(kind_of(name), scale);
}
