// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the page asks for: arrays of the panes, the pixel under the cursor, frames.

import { effect } from "@preact/signals";
import { send } from "./connection";
import type { Fault, Pixel } from "./protocol";
import { cursor, frame, link, pixel, rate, shown, state } from "./store";

const rest_ms = 40;       // the cursor stands still
const pause_ms = 200;     // from one question to the next while frames pass by
const patience_ms = 2000; // an answer is not waited for longer

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

function ask_soon(): void {
  timer ??= setTimeout(ask, Math.max(rest_ms, last_asked_ms + pause_ms - performance.now()));
}

function is_old(answer: Pixel): boolean {
  const now = frame.value;
  return answer.u !== cursor.value?.u || answer.v !== cursor.value.v || answer.frame !== now?.frame || answer.generation !== now.generation;
}

export function pixel_arrived(answer: Pixel): void {
  if (asked?.id === answer.id) asked = undefined;
  pixel.value = answer;
  if (is_old(answer)) ask_soon();
}

export function fault_arrived(of: Fault): void {
  if (of.id !== null && of.id === asked?.id) asked = undefined;
}

export function opened_anew(): void {
  asked = undefined;
  want();
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
    const answer = pixel.peek();
    if (at !== undefined && now !== undefined && (answer === undefined || is_old(answer))) ask_soon();
  });
  document.addEventListener("visibilitychange", () => send({ type: "visible", visible: !document.hidden }));
}

let sought: number | undefined;

export function toggle_play(): void {
  sought = undefined;
  send({ type: state.value?.playing === true ? "pause" : "play" });
}

export function seek(to: number): void {
  if (!Number.isSafeInteger(to) || to < 0) return;
  sought = to;
  send({ type: "seek", frame: to });
}

/** From the frame that was asked for last, if that has not come yet: ten quick steps are ten frames. */
export function step(by: number): void {
  if (state.value?.playing === true) send({ type: "pause" });
  const now = frame.value?.frame ?? 0;
  if (sought === now || state.value?.playing === true) sought = undefined;
  seek(Math.max(0, (sought ?? now) + by));
}

export function fit(array: string | undefined): void {
  if (array !== undefined) send({ type: "fit", array });
}
