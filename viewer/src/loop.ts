// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Draws when something has changed, at most once for each picture of the screen. A frame is acknowledged when it was drawn, not before:
// so a page that is slow or hidden gets no more than it can show.

import { effect } from "@preact/signals";
import { send } from "./connection";
import type { Picture } from "./picture";
import type { Frame } from "./protocol";
import { cursor, drawn_rate, fitted, frame, hello, shown, view } from "./store";

export const counters = { received: 0, drawn: 0 };
export const pictures = new Map<number, Picture>();

let waiting: Frame | undefined;
let scheduled = false;

export function draw_soon(): void {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(draw);
}

/** The newest frame is drawn; one that was not drawn yet is passed over. */
export function frame_arrived(fresh: Frame): void {
  ++counters.received;
  waiting = fresh;
  draw_soon();
}

function draw(): void {
  scheduled = false;
  const fresh = waiting;
  waiting = undefined;
  if (fresh !== undefined) frame.value = fresh;
  for (const picture of pictures.values()) picture.draw(frame.value);
  if (fresh === undefined) return;
  ++counters.drawn;
  send({ type: "ack", sequence: fresh.sequence });
}

export function start_loop(): void {
  effect(() => {
    void [view.value, cursor.value, shown.value, fitted.value, hello.value];
    draw_soon();
  });
  let before = 0;
  setInterval(() => {
    drawn_rate.value = counters.drawn - before;
    before = counters.drawn;
  }, 1000);
}
