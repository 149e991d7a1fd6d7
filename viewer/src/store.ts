// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the page knows: one place, read by all that is drawn.

import { computed, signal } from "@preact/signals";
import type { Fault, Frame, FrameArray, Hello, Pixel, Scale, State, Stats } from "./protocol";
import { showing, whole, type Extent, type ViewPort } from "./view_port";

/** `keyless`: this tab was opened without the address's key. `lost`: tried again; `gone`: nobody answers, still tried;
 *  `other`: a server that this key does not open. */
export type Link = "keyless" | "connecting" | "open" | "lost" | "gone" | "other";

export interface Cursor {
  u: number;
  v: number;
}

export const link = signal<Link>("connecting");
export const hello = signal<Hello | undefined>(undefined);
export const state = signal<State | undefined>(undefined);
export const stats = signal<Stats | undefined>(undefined);
export const fault = signal<Fault | undefined>(undefined);
export const fitted = signal<ReadonlyMap<string, Scale>>(new Map());   // scales since the greeting, by array
export const frame = signal<Frame | undefined>(undefined);             // the one that is drawn
export const pixel = signal<Pixel | undefined>(undefined);
export const drawn_rate = signal(0);

export const rate = signal<"own" | "max">("own");
export const shown = signal<readonly string[]>([]);                    // each pane's array
export const focused = signal(0);                                      // the pane that keys act on
export const view = signal<ViewPort>(whole);
export const cursor = signal<Cursor | undefined>(undefined);
export const spoken = signal("");                                      // said to who does not see the picture
export const help_open = signal(false);
export const letter_keys = signal(localStorage.getItem("tofray.letter_keys") !== "off");

export const size = computed(() => {
  const of = frame.value ?? hello.value;
  return of === undefined ? { width: 4, height: 3 } : { width: of.width, height: of.height };
});

/** How large a pane's canvas is [device px]: all panes have the same. */
export const canvas_size = signal({ width: 1, height: 1 });

export const extent = computed<Extent>(() => ({
  ...size.value, canvas_width: canvas_size.value.width, canvas_height: canvas_size.value.height,
}));

export function set_letter_keys(on: boolean): void {
  letter_keys.value = on;
  localStorage.setItem("tofray.letter_keys", on ? "on" : "off");
}

/** The scale of an array now; undefined where it holds bits. */
export function scale_of(array: string): Scale | undefined {
  return fitted.value.get(array) ?? hello.value?.panes.find((pane) => pane.array === array)?.scale ?? undefined;
}

export function title_of(array: string): string {
  return hello.value?.panes.find((pane) => pane.array === array)?.title ?? array;
}

/** This array of the frame that is drawn, where it came along. */
export function array_of(of: Frame | undefined, name: string): FrameArray | undefined {
  const id = hello.value?.arrays.findIndex((array) => array.name === name) ?? -1;
  return id < 0 ? undefined : of?.arrays.get(id);
}

/** The value of an image at the cursor; undefined where there is none. */
export function value_at(name: string, at: Cursor | undefined): number | undefined {
  const array = array_of(frame.value, name);
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

/** What the panes show: kept where the new server has it, else depth and amplitude, or what comes first. */
export function choose_arrays(of: Hello): void {
  const offered = of.panes.map((pane) => pane.array);
  const usual = [offered.includes("z_m") ? "z_m" : offered[0], offered.includes("amplitude_e") ? "amplitude_e" : offered[1] ?? offered[0]];
  shown.value = usual.map((array, i) => {
    const kept = shown.value[i];
    return kept !== undefined && offered.includes(kept) ? kept : array;
  }).filter((array): array is string => array !== undefined);
}

export function show(pane: number, array: string): void {
  shown.value = shown.value.map((one, i) => (i === pane ? array : one));
}
