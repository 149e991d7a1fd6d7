// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Draws when something has changed, at most once for each picture of the screen. A frame is acknowledged when it was drawn, not before:
// so a page that is slow or hidden gets no more than it can show.

import { batch, effect } from "@preact/signals";
import { send } from "./connection";
import type { Picture } from "./picture";
import type { Frame } from "./protocol";
import {
  comparing, cursor, difference_scales, drawn_rate, fitted, flipped, frame, frame_b, hello, other, raw_scales, region, shown, temporal, view, wipe,
} from "./store";
import { measure_from, measuring, rectangle } from "./tools";
import { pins } from "./watch";

export const counters = { received: 0, drawn: 0 };
/** By pane and side; of a sheet also by raw frame. */
export const pictures = new Map<string, Picture>();

/** The 3D panes, by pane. */
export const spaces = new Map<number, { draw(): void; readout(pixels: boolean): unknown }>();

const patience_ms = 500;   // one of two states is not waited for longer

const waiting: { a: Frame | undefined; b: Frame | undefined } = { a: undefined, b: undefined };
let waiting_since: number | undefined;
let scheduled = false;
let timer: number | undefined;

export function draw_soon(): void {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(draw);
}

/** The newest frame is drawn; one that was not drawn yet is passed over. */
export function frame_arrived(fresh: Frame): void {
  ++counters.received;
  waiting[fresh.side] = fresh;
  draw_soon();
}

/** What came is shown; of two states only together, so that both show the same frame. */
function take(): Frame[] {
  const fresh = [waiting.a, waiting.b].filter((one) => one !== undefined);
  if (fresh.length === 0) return fresh;
  clearTimeout(timer);
  const a = waiting.a ?? frame.peek();
  const b = waiting.b ?? frame_b.peek();
  if (other.peek() !== undefined && a?.frame !== b?.frame) {
    waiting_since ??= performance.now();
    const left = waiting_since + patience_ms - performance.now();
    if (left > 0) {
      timer = setTimeout(draw_soon, left);
      return [];
    }
  }
  waiting_since = waiting.a = waiting.b = undefined;
  return fresh;
}

function draw(): void {
  scheduled = false;
  const fresh = take();
  batch(() => {
    for (const one of fresh) (one.side === "a" ? frame : frame_b).value = one;
  });
  for (const picture of pictures.values()) picture.draw();
  for (const space of spaces.values()) space.draw();
  if (fresh.length === 0) return;
  ++counters.drawn;
  for (const { side, sequence } of fresh) send(side === "a" ? { type: "ack", sequence } : { type: "ack", sequence, channel: 1 });
}

/** Another state is no longer there. */
export function forget_b(): void {
  waiting.b = undefined;
  frame_b.value = undefined;
}

export function start_loop(): void {
  effect(() => {
    void [view.value, cursor.value, shown.value, fitted.value, hello.value, other.value, comparing.value, flipped.value, wipe.value, difference_scales.value, raw_scales.value, region.value, pins.value, temporal.value];
    void [rectangle.value, measuring.question.value, measure_from.value];
    draw_soon();
  });
  let before = 0;
  setInterval(() => {
    drawn_rate.value = counters.drawn - before;
    before = counters.drawn;
  }, 1000);
}
