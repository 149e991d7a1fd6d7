// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Raw frames as pictures: what they are called, which arrays they are made of, and one scale of colours for all of them.

import { minus, number_text } from "./numbers";
import type { Frame, FrameArray, Numbers, Scale, Tick } from "./protocol";

export type RawKind = "raw" | "tap_a" | "tap_b" | "tap_difference";

interface KindInfo {
  kind: RawKind;
  said: string;
  title: string;
  /** Of the wire. */
  arrays: readonly string[];
  unit: string;
}

export const raw_kinds: readonly KindInfo[] = [
  { kind: "raw", said: "code", title: "Code of A − B", arrays: ["raw"], unit: "DN" },
  { kind: "tap_a", said: "tap A", title: "Tap A", arrays: ["tap_a"], unit: "e" },
  { kind: "tap_b", said: "tap B", title: "Tap B", arrays: ["tap_b"], unit: "e" },
  { kind: "tap_difference", said: "A − B", title: "A − B", arrays: ["tap_a", "tap_b"], unit: "e" },
];

/** What raw frames were made with. */
export const raw_lists = ["modulation_frequency_hz", "reference_phase_rad", "lit"];

/** What a pane shows of them: all, or the one of this number. */
export interface RawView {
  kind: RawKind;
  number: number | undefined;
}

export function raw_name(kind: RawKind, number?: number): string {
  return number === undefined ? kind : `${kind}[${number}]`;
}

/** Undefined: the name of an array of numbers as it is. */
export function raw_view(name: string): RawView | undefined {
  const parts = /^(raw|tap_a|tap_b|tap_difference)(?:\[(\d{1,4})\])?$/.exec(name);
  return parts === null ? undefined : { kind: parts[1] as RawKind, number: parts[2] === undefined ? undefined : Number(parts[2]) };
}

/** Whether it is the name of all raw frames of a kind. */
export function is_sheet(name: string): boolean {
  const view = raw_view(name);
  return view !== undefined && view.number === undefined;
}

export function kind_info(kind: RawKind): KindInfo {
  return raw_kinds.find((one) => one.kind === kind)!;
}

/** The arrays of the wire that a pane needs. */
export function arrays_for(name: string): readonly string[] {
  const view = raw_view(name);
  return view === undefined ? [name] : [...kind_info(view.kind).arrays, ...raw_lists];
}

function minus_each(a: Numbers, b: Numbers): Float32Array {
  const out = new Float32Array(a.length);
  for (let i = 0; i < out.length; ++i) out[i] = a[i]! - b[i]!;
  return out;
}

const made = new WeakMap<Frame, Map<string, FrameArray>>();

/** All raw frames of a kind, or one of them. The same for the same frame.
 *  @param array  an array of this frame by its name */
export function raw_array(of: Frame, view: RawView, array: (name: string) => FrameArray | undefined): FrameArray | undefined {
  const known = made.get(of) ?? new Map<string, FrameArray>();
  made.set(of, known);
  const name = raw_name(view.kind, view.number);
  const before = known.get(name);
  if (before !== undefined) return before;
  let out: FrameArray | undefined;
  if (view.number !== undefined) {
    const all = raw_array(of, { kind: view.kind, number: undefined }, array);
    const [count = 0, height = 0, width = 0] = all?.dims ?? [];
    if (all === undefined || view.number >= count) return undefined;
    const pixels = width * height;
    out = { id: all.id, dims: [height, width], values: all.values.subarray(view.number * pixels, (view.number + 1) * pixels) };
  } else {
    const [a, b] = kind_info(view.kind).arrays.map(array);
    if (a === undefined || a.dims.length !== 3) return undefined;
    if (view.kind !== "tap_difference") return a;
    if (b === undefined || b.values.length !== a.values.length) return undefined;
    out = { id: a.id, dims: a.dims, values: minus_each(a.values, b.values) };
  }
  known.set(name, out);
  return out;
}

/** How one of them was taken. */
export interface Exposure {
  number: number;
  lit: boolean;
  frequency_hz: number;
  phase_rad: number;
  /** Of another frequency than the one before. */
  first: boolean;
}

/** @param array  an array of the frame by its name; without lists all that is known is how many there are */
export function exposures_of(count: number, array: (name: string) => FrameArray | undefined): Exposure[] {
  const [frequency, phase, lit] = raw_lists.map((name) => array(name)?.values);
  return Array.from({ length: count }, (_, k) => ({
    number: k,
    lit: lit === undefined || lit[k] !== 0,
    frequency_hz: frequency?.[k] ?? NaN,
    phase_rad: phase?.[k] ?? NaN,
    first: k === 0 || frequency?.[k] !== frequency?.[k - 1],
  }));
}

function short(value: number, digits: number): string {
  return Number(value.toFixed(digits)).toString().replace("-", minus);
}

/** "80.32 MHz · 90°" */
export function exposure_text(of: Exposure | undefined): string {
  if (of === undefined || (of.lit && Number.isNaN(of.frequency_hz))) return "";
  return of.lit ? `${short(of.frequency_hz / 1e6, 3)} MHz · ${short((of.phase_rad * 180) / Math.PI, 1)}°` : "unlit";
}

// --- One scale for all ---

const low_share = 0.005, high_share = 0.995;   // as `raw.png` has them
const most_sampled = 200_000;

/** The step of ticks for about `count` of them: 1, 2 or 5 times a power of ten. */
function step_of(range: number, count: number): number {
  const rough = range / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5, 10].find((one) => one * power >= rough) ?? 10);
}

/** What nearly all of the lit raw frames' values lie in, those without light left out: in the sun they alone would set it. */
export function raw_scale(kind: RawKind, all: FrameArray, exposures: readonly Exposure[]): Scale | undefined {
  const [count = 0, height = 0, width = 0] = all.dims;
  const pixels = height * width;
  const lit = exposures.some((one) => one.lit) ? exposures.filter((one) => one.lit).map((one) => one.number) : Array.from({ length: count }, (_, k) => k);
  const stride = Math.max(1, Math.ceil((lit.length * pixels) / most_sampled));
  const sampled: number[] = [];
  for (let i = 0; i < lit.length * pixels; i += stride) {
    const value = all.values[lit[Math.floor(i / pixels)]! * pixels + (i % pixels)]!;
    if (Number.isFinite(value)) sampled.push(value);
  }
  if (sampled.length === 0) return undefined;
  const sorted = Float64Array.from(sampled).sort();
  const at = (share: number): number => sorted[Math.round(share * (sorted.length - 1))]!;
  let [low, high] = [at(low_share), at(high_share)];
  const signed = kind === "tap_difference";
  if (signed) [low, high] = [-Math.max(-low, high, 0), Math.max(-low, high, 0)];
  if (!(high > low)) [low, high] = [low - 1, high + 1];
  const step = step_of(high - low, 4);
  low = Math.floor(low / step) * step;
  high = Math.ceil(high / step) * step;
  const ticks: Tick[] = [];
  for (let i = Math.round(low / step); i <= Math.round(high / step); ++i) {
    const value = Number((i * step).toPrecision(12));
    ticks.push({ at: value, label: `${signed && value > 0 ? "+" : ""}${number_text(value)}` });
  }
  return { low, high, palette: signed ? "error" : "grey", curve: "linear", factor: 1, unit: kind_info(kind).unit, ticks };
}
