// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Asks why a pixel, or the pixels of a region, are wrong: the server switches off one cause after the other.

import { effect, signal } from "@preact/signals";
import { next_id, send } from "./connection";
import type { Fault, Side, Why } from "./protocol";
import {
  cursor, edited, frame_of, link, of_b, other, region, region_from, size, spoken, state, tab, tab_shown, why, why_fault, type Cursor, type Region,
} from "./store";

export const most_side = 64;    // pixels of a region, across and down
const rest_ms = 300;

export interface Question {
  side: Side;
  /** Pixels of A, as all that is pointed at. */
  of: Cursor | Region;
}

/** What was asked last, and stays asked while the state changes. */
export const question = signal<Question | undefined>(undefined);
export const why_waiting = signal(false);

/** The next drag over a picture chooses a region, without Alt. */
export const drag_chooses = signal(false);

let asked: { id: number; generation: number | undefined; frame: number | undefined } | undefined;
let timer: number | undefined;

export function is_region(of: Cursor | Region): of is Region {
  return "u0" in of;
}

/** Corners in order, within the image, and no larger than is answered: it ends where the second corner is pulled away too far. */
export function region_between(from: Cursor, to: Cursor): Region {
  const { width, height } = size.value;
  const span = (a: number, b: number, count: number): [number, number] => {
    const near = (at: number): number => Math.min(count - 1, Math.max(0, at));
    const end = near(Math.min(a + most_side - 1, Math.max(a - most_side + 1, b)));
    return [Math.min(near(a), end), Math.max(near(a), end)];
  };
  const [u0, u1] = span(from.u, to.u, width);
  const [v0, v1] = span(from.v, to.v, height);
  return { u0, v0, u1, v1 };
}

function ask(): void {
  clearTimeout(timer);
  const now = question.peek();
  if (now === undefined || link.peek() !== "open") return;
  const { side, of } = now;
  const id = next_id();
  const drawn = frame_of(side);
  asked = { id, generation: (side === "a" ? state.peek() : other.peek())?.generation, frame: drawn?.frame };
  why_waiting.value = true;
  const whose = side === "b" ? { side } : {};
  const there = (at: Cursor): Cursor => (side === "b" ? of_b(at) : at);
  if (!is_region(of)) {
    const at = there(of);
    return send({ type: "why", id, ...whose, u: at.u, v: at.v });
  }
  const first = there({ u: of.u0, v: of.v0 });
  const last = there({ u: of.u1, v: of.v1 });
  const end = (from: number, to: number): number => Math.min(to, from + most_side - 1);
  send({ type: "why", id, ...whose, region: [first.u, first.v, end(first.u, last.u), end(first.v, last.v)] });
}

function ask_now(of: Cursor | Region): void {
  clearTimeout(timer);
  why.value = why_fault.value = undefined;
  question.value = { side: edited.value, of };
  tab.value = "pixel";
  ask();
}

export function ask_pixel(): void {
  const at = cursor.value;
  if (at === undefined) return void (spoken.value = "No pixel is pointed at");
  region.value = region_from.value = undefined;
  ask_now(at);
}

export function ask_region(of: Region): void {
  region.value = of;
  region_from.value = undefined;
  if (of.u0 === of.u1 && of.v0 === of.v1) return ask_now({ u: of.u0, v: of.v0 });
  ask_now(of);
}

/** By keys: the first time a corner, the second time the one across. */
export function region_key(): void {
  const at = cursor.value;
  if (at === undefined) return void (spoken.value = "No pixel is pointed at");
  const from = region_from.value;
  if (from !== undefined) return ask_region(region_between(from, at));
  region_from.value = at;
  region.value = region_between(at, at);
  spoken.value = `A region begins at pixel ${at.u}, ${at.v}. Move the cursor to its other corner and press e again; Escape drops it.`;
}

/** @return  whether there was a region to drop */
export function drop_region(): boolean {
  if (region.value === undefined && region_from.value === undefined) return false;
  region.value = region_from.value = undefined;
  spoken.value = "No region";
  return true;
}

export function close_why(): void {
  clearTimeout(timer);
  asked = undefined;
  question.value = why.value = why_fault.value = region.value = region_from.value = undefined;
  why_waiting.value = false;
}

/** Another server knows of no question. */
export function forget_why(): void {
  clearTimeout(timer);
  asked = undefined;
  why.value = why_fault.value = undefined;
  why_waiting.value = false;
}

export function why_arrived(answer: Why): void {
  if (asked?.id !== answer.id) return;
  why_waiting.value = false;
  why_fault.value = undefined;
  why.value = answer;
}

/** @return  whether it answers such a question */
export function why_refused(of: Fault): boolean {
  if (of.id === null || asked?.id !== of.id) return false;
  why_waiting.value = false;
  why.value = undefined;
  why_fault.value = of;
  return true;
}

export function start_why(): void {
  // The question stays: a changed state, or another frame that stands still, is asked anew.
  effect(() => {
    const now = question.value;
    const playing = state.value?.playing === true;
    if (now === undefined || link.value !== "open" || tab_shown.value !== "pixel") return;
    if (now.side === "b" && other.value === undefined) return;
    const drawn = frame_of(now.side);
    const generation = (now.side === "a" ? state.value : other.value)?.generation;
    if (drawn === undefined || drawn.generation !== generation) return;
    const same = asked !== undefined && asked.generation === generation && (playing || asked.frame === drawn.frame);
    clearTimeout(timer);
    if (!same) timer = setTimeout(ask, rest_ms);
  });
  // While the keyboard looks for the second corner, the region follows the cursor.
  effect(() => {
    const from = region_from.value;
    const at = cursor.value;
    if (from !== undefined && at !== undefined) region.value = region_between(from, at);
  });
}
