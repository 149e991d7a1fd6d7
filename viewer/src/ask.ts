// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the page asks for: arrays of the panes, the pixel under the cursor, frames.

import { effect } from "@preact/signals";
import { fit_difference, shown_by } from "./compare";
import { next_id, send } from "./connection";
import type { Fault, Pixel, Side } from "./protocol";
import { shown_array } from "./cloud";
import { arrays_for, raw_view } from "./raw";
import { arrays_for_space } from "./space";
import { tool } from "./tools";
import { cursor, fit_raw, frame, frame_of, link, of_b, pixel, pixel_b, rate, shown, state, tab_shown, temporal_titles, type Cursor } from "./store";
import { arrays_to_watch } from "./watch";

const rest_ms = 40;             // the cursor stands still
const pause_ms = 200;           // from one question to the next
const playing_pause_ms = 500;   // the same while frames pass by: each question takes a frame with all its arrays
const patience_ms = 2000;       // an answer is not waited for longer

// Of a page's questions the newest counts: so one at a time, of A and B in turn.
let asked: { id: number; at: number } | undefined;
let timer: number | undefined;
let last_asked_ms = -Infinity;

const sides: readonly Side[] = ["a", "b"];

function answer_of(side: Side): Pixel | undefined {
  return (side === "a" ? pixel : pixel_b).peek();
}

/** Whether somebody reads it. */
function is_read(): boolean {
  return tab_shown.value === "pixel";
}

function ask(): void {
  timer = undefined;
  const at = cursor.value;
  if (at === undefined || link.value !== "open" || frame.value === undefined || !is_read()) return;
  const now = performance.now();
  if (asked !== undefined && now - asked.at < patience_ms) return;   // its answer asks again
  const side = sides.find(is_wanted);
  if (side !== undefined) ask_of(side, at, now);
}

function ask_of(side: Side, at: Cursor, now: number): void {
  const id = next_id();
  asked = { id, at: now };
  if (side === "a") last_asked_ms = now;
  const place = side === "a" ? at : of_b(at);
  send({ type: "pixel", id, u: place.u, v: place.v, ...(side === "b" ? { side } : {}) });
}

function is_playing(): boolean {
  return state.value?.playing === true;
}

function ask_soon(): void {
  timer ??= setTimeout(ask, Math.max(rest_ms, last_asked_ms + (is_playing() ? playing_pause_ms : pause_ms) - performance.now()));
}

/** While frames pass by, an answer stays until the cursor moves; it says of which frame it is. */
function is_wanted(side: Side): boolean {
  const now = frame_of(side);
  const here = cursor.value;
  if (now === undefined || here === undefined) return false;
  const answer = answer_of(side);
  if (answer === undefined) return true;
  const at = side === "a" ? here : of_b(here);
  if (answer.u !== at.u || answer.v !== at.v || answer.generation !== now.generation) return true;
  return !is_playing() && answer.frame !== now.frame;
}

export function pixel_arrived(answer: Pixel): void {
  const side = answer.side ?? "a";
  if (asked?.id === answer.id) asked = undefined;
  (side === "a" ? pixel : pixel_b).value = answer;
  const at = cursor.value;
  if (!is_read() || at === undefined) return;
  if (side === "a" && asked === undefined && is_wanted("b")) ask_of("b", at, performance.now());
  else if (sides.some(is_wanted)) ask_soon();
}

export function fault_arrived(of: Fault): void {
  if (of.id !== null && of.id === asked?.id) asked = undefined;
}

/** What is shown was chosen by the greeting, and so is asked for already. */
export function opened_anew(): void {
  asked = undefined;
  send({ type: "visible", visible: !document.hidden });
}

function want(): void {
  const of_objects = tool.value === "drag" ? ["gt_object_id"] : [];
  const arrays = [...new Set([...shown.value.flatMap((name) => arrays_for_space(name) ?? arrays_for(name)), "flags", ...arrays_to_watch(), ...of_objects])];
  const at = rate.value;
  if (shown.value.length > 0) send({ type: "want", arrays, rate: at });
}

export function start_asking(): void {
  effect(() => {
    want();
  });
  effect(() => {
    void state.value;
    if (is_read() && sides.some(is_wanted)) ask_soon();
  });
  document.addEventListener("visibilitychange", () => send({ type: "visible", visible: !document.hidden }));
}

let sought: number | undefined;

export function toggle_play(): void {
  sought = undefined;
  send({ type: is_playing() ? "pause" : "play" });
}

export function seek(to: number): void {
  if (!Number.isSafeInteger(to) || to < 0) return;
  sought = to;
  send({ type: "seek", frame: to });
}

/** Time stops at a frame. */
export function stand_at(frame: number): void {
  if (is_playing()) send({ type: "pause" });
  seek(frame);
}

/** From the frame that was asked for last, if that has not come yet: ten quick steps are ten frames. */
export function step(by: number): void {
  if (is_playing()) send({ type: "pause" });
  const now = frame.value?.frame ?? 0;
  if (sought === now || is_playing()) sought = undefined;
  seek(Math.max(0, (sought ?? now) + by));
}

/** The colours of a pane, for what it shows now. */
export function fit_pane(pane: number): void {
  const array = shown.value[pane];
  if (array === undefined) return;
  const raw = raw_view(array);
  if (shown_by("a") === "difference" && shown_array(array) === array) fit_difference(array);
  else if (raw !== undefined) fit_raw(raw.kind);
  else send({ type: "fit", array: array in temporal_titles ? "noise_m" : shown_array(array) });
}
