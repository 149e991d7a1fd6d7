// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pinned pixels: mean, σ, least and greatest value of what frames bring of them, each frame once. A new state begins anew: frames of two
// cameras have no σ.

import { effect, signal } from "@preact/signals";
import { copy } from "./download";
import type { Frame, Side } from "./protocol";
import { array_of, cursor, hello, of_b, other, size, spoken } from "./store";

export const most_pins = 8;

export interface Pin {
  number: number;
  u: number;
  v: number;
}

export const pins = signal<readonly Pin[]>([]);
/** What is watched beside depth. */
export const second = signal("amplitude_e");
/** Another number where statistics have changed. */
export const counted = signal(0);

/** Running moments (Welford). */
export interface Moments {
  generation: number;
  since: number;
  frames: number;
  n: number;
  mean: number;
  squares: number;
  low: number;
  high: number;
  /** Sum of the squares of the noise that the camera predicts, over the frames with a value. */
  predicted: number;
  /** The latest one; NaN: none. */
  last: number;
  readonly seen: Set<number>;
  newest: number;
}

const moments = new Map<string, Moments>();
const most_seen = 200_000;   // frames that are remembered one by one; then only later ones count

function place(pin: Pin, array: string, side: Side): string {
  return `${pin.number} ${side} ${array}`;
}

/** The states whose frames are counted. */
export function watched_sides(): readonly Side[] {
  return other.value === undefined ? ["a"] : ["a", "b"];
}

export function watched_arrays(): string[] {
  return pins.value.length === 0 ? [] : [...new Set(["z_m", second.value])];
}

/** The noise that is predicted is along the ray: depth's is that times z / range. */
export function arrays_to_watch(): string[] {
  return pins.value.length === 0 ? [] : [...watched_arrays(), "noise_m", "range_m"];
}

export function moments_of(pin: Pin, array: string, side: Side = "a"): Moments | undefined {
  return moments.get(place(pin, array, side));
}

/** Of the values' n − 1; NaN below two. */
export function sigma_of(of: Moments): number {
  return of.n < 2 ? NaN : Math.sqrt(of.squares / (of.n - 1));
}

/** Root of the mean square of what the camera predicted; NaN where it predicts none. */
export function predicted_of(of: Moments): number {
  return of.n === 0 ? NaN : Math.sqrt(of.predicted / of.n);
}

function predicted(array: string, noise: number, z: number, range: number): number {
  return array === "z_m" ? (noise * z) / range : array === "range_m" ? noise : NaN;
}

function add(of: Moments, value: number, noise: number): void {
  ++of.frames;
  of.last = value;
  if (!Number.isFinite(value)) return;
  ++of.n;
  const off = value - of.mean;
  of.mean += off / of.n;
  of.squares += off * (value - of.mean);
  of.low = Math.min(of.low, value);
  of.high = Math.max(of.high, value);
  of.predicted += noise * noise;
}

function fresh(of: Frame): Moments {
  return {
    generation: of.generation, since: of.frame, frames: 0, n: 0, mean: 0, squares: 0, low: Infinity, high: -Infinity, predicted: 0, last: NaN,
    seen: new Set(), newest: -1,
  };
}

let timer: number | undefined;

function say_soon(): void {
  timer ??= setTimeout(() => {
    timer = undefined;
    ++counted.value;
  }, 100);
}

/** The pin's pixel in a frame: the one at the same place, where B has more or fewer. */
function at_of(pin: Pin, of: Frame): { u: number; v: number } {
  const { width, height } = size.peek();
  if (of.side === "a" || (of.width === width && of.height === height)) return pin;
  return { u: Math.floor(((pin.u + 0.5) * of.width) / width), v: Math.floor(((pin.v + 0.5) * of.height) / height) };
}

/** The latest that came, drawn or not. Drafts are other pictures. */
const newest: Record<Side, Frame | undefined> = { a: undefined, b: undefined };

/** What a frame that has come has of the pinned pixels. */
export function frame_came(of: Frame): void {
  if (of.draft) return;
  newest[of.side] = of;
  count(of);
}

function count(of: Frame): void {
  if (pins.peek().length === 0) return;
  const [z, noise, range] = ["z_m", "noise_m", "range_m"].map((name) => array_of(of, name)?.values);
  if (z === undefined || noise === undefined || range === undefined) return;
  for (const array of watched_arrays()) {
    const values = array_of(of, array)?.values;
    if (values === undefined) continue;
    for (const pin of pins.peek()) {
      const there = at_of(pin, of);
      if (there.u >= of.width || there.v >= of.height) continue;
      const key = place(pin, array, of.side);
      let to = moments.get(key);
      if (to === undefined || to.generation !== of.generation) moments.set(key, to = fresh(of));
      if (to.seen.has(of.frame) || (to.seen.size >= most_seen && of.frame <= to.newest)) continue;
      if (to.seen.size < most_seen) to.seen.add(of.frame);
      to.newest = Math.max(to.newest, of.frame);
      const at = there.v * of.width + there.u;
      add(to, values[at]!, predicted(array, noise[at]!, z[at]!, range[at]!));
    }
  }
  say_soon();
}

export function statistics_anew(): void {
  moments.clear();
  ++counted.value;
}

function forget(pin: Pin): void {
  for (const key of [...moments.keys()]) if (key.startsWith(`${pin.number} `)) moments.delete(key);
}

export function unpin(pin: Pin): void {
  forget(pin);
  pins.value = pins.value.filter((one) => one !== pin);
  spoken.value = `Pin ${pin.number} removed`;
}

export function unpin_all(): void {
  moments.clear();
  pins.value = [];
}

export function pin_at(u: number, v: number): Pin | undefined {
  return pins.value.find((one) => one.u === u && one.v === v);
}

/** Pins the pixel under the cursor, or takes its pin away. */
export function toggle_pin(): void {
  const at = cursor.value;
  if (at === undefined) return void (spoken.value = "No pixel is pointed at");
  const known = pin_at(at.u, at.v);
  if (known !== undefined) return unpin(known);
  if (pins.value.length >= most_pins) return void (spoken.value = `${most_pins} pixels are pinned, which is the most: remove one first`);
  let number = 1;
  while (pins.value.some((one) => one.number === number)) ++number;
  pins.value = [...pins.value, { number, u: at.u, v: at.v }].sort((a, b) => a.number - b.number);
  spoken.value = `Pixel ${at.u}, ${at.v} is pin ${number}`;
  for (const came of [newest.a, newest.b]) if (came !== undefined) count(came);   // if it has what is watched; else it comes again, with that
}

/** Another array than before begins to be counted. */
export function watch_also(array: string): void {
  const before = second.peek();
  if (array === before) return;
  for (const pin of pins.peek()) for (const side of ["a", "b"] as const) moments.delete(place(pin, before, side));
  second.value = array;
}

export function is_outside(pin: Pin): boolean {
  return pin.u >= size.value.width || pin.v >= size.value.height;
}

/** Of depth, and of what is beside it. */
export interface Watched {
  pin: Pin;
  side: Side;
  array: string;
  of: Moments;
}

export function all_watched(): Watched[] {
  return pins.value.flatMap((pin) => watched_arrays().flatMap((array) => watched_sides().flatMap((side) => {
    const of = moments_of(pin, array, side);
    return of === undefined ? [] : [{ pin, side, array, of }];
  })));
}

/** Numbers as they are, in the arrays' own units. */
export function csv(): string {
  const number = (value: number): string => (Number.isFinite(value) ? String(value) : "");
  const rows = pins.value.flatMap((pin) => watched_arrays().flatMap((array) => watched_sides().map((side) => {
    const of = moments_of(pin, array, side);
    const unit = hello.value?.arrays.find((one) => one.name === array)?.unit ?? "";
    const numbers = of === undefined ? ["", 0, 0, "", "", "", "", ""]
      : [of.since, of.frames, of.n, ...[of.n === 0 ? NaN : of.mean, sigma_of(of), predicted_of(of), of.low, of.high].map(number)];
    const at = side === "b" ? of_b(pin) : pin;
    return [pin.number, side.toUpperCase(), at.u, at.v, array, unit, ...numbers].join(",");
  })));
  return ["pin,state,u,v,array,unit,first_frame,frames,n,mean,sigma,sigma_predicted,min,max", ...rows, ""].join("\n");
}

export const csv_copied = signal(false);

export async function copy_csv(): Promise<void> {
  if (!await copy(csv())) return;
  csv_copied.value = true;
  setTimeout(() => (csv_copied.value = false), 2000);
}

/** Another second state than before begins anew. */
export function forget_watched_b(): void {
  newest.b = undefined;
  for (const key of [...moments.keys()]) if (key.split(" ")[1] === "b") moments.delete(key);
}

export function start_watching(): void {
  effect(() => {
    if (other.value === undefined) forget_watched_b();
  });
  // Where the server has no such array, what it has comes in its place.
  hello.subscribe((of) => {
    if (of === undefined || of.panes.some((one) => one.array === second.peek())) return;
    second.value = of.panes.find((one) => one.scale != null && one.array !== "z_m")?.array ?? "z_m";
  });
}
