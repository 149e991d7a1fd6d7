// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the page knows: one place, read by all that is drawn.

import { computed, signal, type Signal } from "@preact/signals";
import { cloud_color, shown_array } from "./cloud";
import type { Fault, Frame, FrameArray, Hello, Other, Pixel, Rate, Row, Scale, Side, State, Stats, Temporal, Why } from "./protocol";
import { exposure_text, exposures_of, kind_info, raw_array, raw_scale, raw_view, type Exposure, type RawKind } from "./raw";
import { showing, whole, type Extent, type ViewPort } from "./view_port";

/** `keyless`: this tab was opened without the address's key. `lost`: tried again; `gone`: nobody answers, still tried;
 *  `other`: a server that this key does not open;
 *  `empty`: a page that is a file without frames. */
export type Link = "keyless" | "connecting" | "open" | "lost" | "gone" | "other" | "empty";

export interface Cursor {
  u: number;
  v: number;
}

/** What this browser has kept; a page that is shown within another one may have no place to keep things. */
function kept(name: string): string | null {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

export const link = signal<Link>("connecting");
export const hello = signal<Hello | undefined>(undefined);
export const state = signal<State | undefined>(undefined);
export const other = signal<Other | undefined>(undefined);              // the second state, where one is open
export const stats = signal<Stats | undefined>(undefined);
export const fault = signal<Fault | undefined>(undefined);
export const fitted = signal<ReadonlyMap<string, Scale>>(new Map());   // scales since the greeting, by array
export const frame = signal<Frame | undefined>(undefined);             // the one that is drawn
export const frame_b = signal<Frame | undefined>(undefined);           // the second state's
export const pixel = signal<Pixel | undefined>(undefined);
export const pixel_b = signal<Pixel | undefined>(undefined);
export const why = signal<Why | undefined>(undefined);                 // the split of an error that came last
export const why_fault = signal<Fault | undefined>(undefined);
export const drawn_rate = signal(0);

/** The keys and their values in force, of the state of this generation. */
export interface Keys {
  generation: number;
  rows: readonly Row[];
  left_out: number;
  by_key: ReadonlyMap<string, Row>;
}

export const controls: Readonly<Record<Side, Signal<Keys | undefined>>> = { a: signal(undefined), b: signal(undefined) };
export const key_faults = signal<ReadonlyMap<string, Fault>>(new Map()); // beside the control at fault, by side and key
export const edited = signal<Side>("a");                               // the state that controls change
export const search = signal("");
export const open_groups = signal<ReadonlySet<string>>(new Set());

export type Tab = "controls" | "pixel" | "watch" | "measure" | "compare";
export const tab = signal<Tab>("controls");

/** How two states are looked at. */
export type Comparing = "beside" | "wipe" | "flip" | "difference";
export const comparing = signal<Comparing>("beside");
export const wipe = signal(0.5);                                       // A up to here, B behind it, in shares of a pane's width
export const flipped = signal(false);                                  // B in the place of A
export const difference_scales = signal<ReadonlyMap<string, Scale>>(new Map());

export const raw_scales = signal<ReadonlyMap<RawKind, Scale>>(new Map());   // one for all raw frames of a kind; once chosen, it stays

/** Pixels u0 … u1, v0 … v1 of A. */
export interface Region {
  u0: number;
  v0: number;
  u1: number;
  v1: number;
}

export const region = signal<Region | undefined>(undefined);           // drawn on the panes
export const region_from = signal<Cursor | undefined>(undefined);      // its first corner, while the keyboard looks for the other one

/** What many frames of one state say of each pixel. */
export interface TemporalResult {
  of: Temporal;
  arrays: ReadonlyMap<string, FrameArray>;
}

export const temporal = signal<Readonly<{ a: TemporalResult | undefined; b?: TemporalResult | undefined }>>({ a: undefined });

/** Panes of it, which have the colours of the noise that is estimated. */
export const temporal_titles: Readonly<Record<string, string>> = { temporal_sigma_m: "σ over time", temporal_predicted_m: "σ̂ over time" };

/** Why the source has no answer to a message of that type; undefined: it has. A scene as B beside files has all of them. */
export function cannot(type: string, side: Side = edited.value): string | undefined {
  const of = hello.value;
  const is_scene = side === "b" && of?.source !== undefined && other.value?.scene !== undefined && other.value.scene !== of.scene;
  return is_scene ? undefined : of?.cannot?.[type];
}

/** Whether it is of the state in force. */
export function is_current(side: Side): boolean {
  const of = temporal.value[side]?.of;
  return of !== undefined && of.generation === (side === "a" ? state.value : other.value)?.generation;
}

export const histograms = signal<ReadonlySet<number>>(new Set());      // the panes that have one below
export const rate = signal<Rate>("own");
export const shown = signal<readonly string[]>([]);                    // each pane's array
export const focused = signal(0);                                      // the pane that keys act on
export const view = signal<ViewPort>(whole);
export const cursor = signal<Cursor | undefined>(undefined);
export const spoken = signal("");                                      // said to who does not see the picture
export const help_open = signal(false);
export const letter_keys = signal(kept("tofray.letter_keys") !== "off");

export const size = computed(() => {
  const of = frame.value ?? hello.value;
  return of === undefined ? { width: 4, height: 3 } : { width: of.width, height: of.height };
});

/** Whether there is room for the controls beside everything else: then they are no tab. */
const room = matchMedia("(min-width: 112rem)");
export const wide = signal(room.matches);
room.addEventListener("change", () => (wide.value = room.matches));

export const controls_open = computed(() => wide.value || tab.value === "controls");
/** What is looked at beside the pictures. */
export const tab_shown = computed<Tab>(() => (wide.value && tab.value === "controls" ? "pixel" : tab.value));

/** How large a pane's canvas is [device px]: all panes have the same. */
export const canvas_size = signal({ width: 1, height: 1 });

export const extent = computed<Extent>(() => ({
  ...size.value, canvas_width: canvas_size.value.width, canvas_height: canvas_size.value.height,
}));

export function set_letter_keys(on: boolean): void {
  letter_keys.value = on;
  try {
    localStorage.setItem("tofray.letter_keys", on ? "on" : "off");
  } catch {
    // It holds until the page is closed.
  }
}

/** The scale of an array now; undefined where it holds bits. */
export function scale_of(name: string): Scale | undefined {
  const array = name in temporal_titles ? "noise_m" : shown_array(name);
  const raw = raw_view(array);
  if (raw !== undefined) return raw_scales.value.get(raw.kind);
  return fitted.value.get(array) ?? hello.value?.panes.find((pane) => pane.array === array)?.scale ?? undefined;
}

export function is_bits(array: string): boolean {
  return raw_view(array) === undefined && scale_of(array) === undefined;
}

export function title_of(array: string): string {
  const color = cloud_color(array);
  if (color !== undefined) return `3D, coloured by ${title_of(color).toLowerCase()}`;
  const titled = temporal_titles[array];
  if (titled !== undefined) return titled;
  const raw = raw_view(array);
  if (raw !== undefined) {
    const title = kind_info(raw.kind).title;
    if (raw.number === undefined) return `${title}, all raw frames`;
    return [title, `raw frame ${raw.number}`, exposure_text(exposures("a")[raw.number])].filter((one) => one !== "").join(", ");
  }
  return hello.value?.panes.find((pane) => pane.array === array)?.title ?? array;
}

/** This array of the frame that is drawn, where it came along. */
export function array_of(of: Frame | undefined, shows: string): FrameArray | undefined {
  const name = shown_array(shows);
  if (name in temporal_titles) return of !== undefined && is_current(of.side) ? temporal.value[of.side]?.arrays.get(name) : undefined;
  const raw = raw_view(name);
  if (raw !== undefined) return of && raw_array(of, raw, (one) => wire_array(of, one));
  return wire_array(of, name);
}

function wire_array(of: Frame | undefined, name: string): FrameArray | undefined {
  const id = hello.value?.arrays.findIndex((array) => array.name === name) ?? -1;
  return id < 0 ? undefined : of?.arrays.get(id);
}

export function frame_of(side: Side): Frame | undefined {
  return side === "a" ? frame.value : frame_b.value;
}

/** The raw frames of what is drawn. */
export function exposures(side: Side): Exposure[] {
  const of = frame_of(side);
  const count = wire_array(of, "lit")?.values.length ?? hello.value?.phases ?? 0;
  return exposures_of(count, (name) => wire_array(of, name));
}

/** One scale for all raw frames of a kind, as the frame that is drawn needs it. */
export function fit_raw(kind: RawKind): void {
  const of = frame.peek();
  const all = array_of(of, kind);
  const scale = all && raw_scale(kind, all, exposures_of(all.dims[0] ?? 0, (name) => wire_array(of, name)));
  if (scale !== undefined) raw_scales.value = new Map(raw_scales.peek()).set(kind, scale);
}

/** The pixel of B at the same place: the same one where both have as many. */
export function of_b(at: Cursor): Cursor {
  const b = frame_b.value;
  const a = size.value;
  if (b === undefined || (b.width === a.width && b.height === a.height)) return at;
  return { u: Math.floor(((at.u + 0.5) * b.width) / a.width), v: Math.floor(((at.v + 0.5) * b.height) / a.height) };
}

/** The value of an image at the cursor, which is one of A; undefined where there is none. */
export function value_at(name: string, where: Cursor | undefined, side: Side = "a"): number | undefined {
  const array = array_of(frame_of(side), name);
  const at = where !== undefined && side === "b" ? of_b(where) : where;
  const [height, width] = array?.dims ?? [];
  if (array === undefined || at === undefined || height === undefined || width === undefined) return undefined;
  return at.u < width && at.v < height ? array.values[at.v * width + at.u] : undefined;
}

/** Puts the cursor on a pixel of the image, the nearest one to this. */
export function point_at(u: number, v: number, keep_in_view: boolean): void {
  const { width, height } = size.value;
  const inside = (at: number, count: number): number => Math.min(count - 1, Math.max(0, at));
  const to = { u: inside(u, width), v: inside(v, height) };
  if (cursor.value?.u !== to.u || cursor.value.v !== to.v) cursor.value = to;
  if (keep_in_view) view.value = showing(view.value, to.u, to.v, extent.value);
}

export const most_panes = 4;

/** What panes show that nobody has chosen for: depth, amplitude, error and flags, or what comes first. */
function usual(of: Hello, pane: number): string | undefined {
  const offered = of.panes.map((one) => one.array);
  const wanted = ["z_m", "amplitude_e", "z_error_m", "flags"][pane];
  return wanted !== undefined && offered.includes(wanted) ? wanted : offered[pane] ?? offered[0];
}

function is_array(name: string | undefined): name is string {
  return name !== undefined;
}

/** What the panes show: kept where the new server has it. */
export function choose_arrays(of: Hello): void {
  const before = shown.value.length === 0 ? [undefined, undefined] : shown.value;
  const offered = (name: string): boolean => raw_view(name) !== undefined || of.panes.some((one) => one.array === shown_array(name));
  shown.value = before.map((kept, i) => (kept !== undefined && offered(kept) ? kept : usual(of, i))).filter(is_array);
}

export function set_panes(count: number): void {
  const of = hello.value;
  if (of === undefined || count < 1 || count > most_panes) return;
  shown.value = Array.from({ length: count }, (_, i) => shown.value[i] ?? usual(of, i)).filter(is_array);
  focused.value = Math.min(focused.value, count - 1);
}

export function toggle_histogram(pane: number): void {
  const open = new Set(histograms.value);
  if (!open.delete(pane)) open.add(pane);
  histograms.value = open;
}

export function show(pane: number, array: string): void {
  shown.value = shown.value.map((one, i) => (i === pane ? array : one));
}
