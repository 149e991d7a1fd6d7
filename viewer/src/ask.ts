// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the page asks for: arrays of the panes, the pixel under the cursor, frames.

import { effect } from "@preact/signals";
import { send } from "./connection";
import type { Fault, Pixel } from "./protocol";
import { cursor, frame, link, pixel, rate, shown, state } from "./store";

const rest_ms = 40;             // the cursor stands still
const pause_ms = 200;           // from one question to the next
const playing_pause_ms = 500;   // the same while frames pass by: each question takes a frame with all its arrays
const patience_ms = 2000;       // an answer is not waited for longer

let last_id = 0;
let asked: { id: number; at: number } | undefined;
let timer: number | undefined;
let last_asked_ms = -Infinity;

function ask(): void {
  timer = undefined;
  const at = cursor.value;
  if (at === undefined || link.value !== "open" || frame.value === undefined) return;
  const now = performance.now();
  if (asked !== undefined && now - asked.at < patience_ms) return;   // its answer asks again
  asked = { id: ++last_id, at: now };
  last_asked_ms = now;
  send({ type: "pixel", id: last_id, u: at.u, v: at.v });
}

function is_playing(): boolean {
  return state.value?.playing === true;
}

function ask_soon(): void {
  timer ??= setTimeout(ask, Math.max(rest_ms, last_asked_ms + (is_playing() ? playing_pause_ms : pause_ms) - performance.now()));
}

/** While frames pass by, an answer stays until the cursor moves; it says of which frame it is. */
function is_old(answer: Pixel): boolean {
  const now = frame.value;
  if (answer.u !== cursor.value?.u || answer.v !== cursor.value.v || answer.generation !== now?.generation) return true;
  return !is_playing() && answer.frame !== now.frame;
}

export function pixel_arrived(answer: Pixel): void {
  if (asked?.id === answer.id) asked = undefined;
  pixel.value = answer;
  if (is_old(answer)) ask_soon();
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
  const arrays = [...new Set([...shown.value, "flags"])];
  if (shown.value.length > 0) send({ type: "want", arrays, rate: rate.value });
}

export function start_asking(): void {
  effect(() => {
    void [shown.value, rate.value];
    want();
  });
  effect(() => {
    const at = cursor.value;
    const now = frame.value;
    void state.value;
    const answer = pixel.peek();
    if (at !== undefined && now !== undefined && (answer === undefined || is_old(answer))) ask_soon();
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

/** From the frame that was asked for last, if that has not come yet: ten quick steps are ten frames. */
export function step(by: number): void {
  if (is_playing()) send({ type: "pause" });
  const now = frame.value?.frame ?? 0;
  if (sought === now || is_playing()) sought = undefined;
  seek(Math.max(0, (sought ?? now) + by));
}

export function fit(array: string | undefined): void {
  if (array !== undefined) send({ type: "fit", array });
}
