// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What tests may read, where the server was started for them: numbers and pixels as drawn, no more.

import { unanswered } from "./edit";
import { future, past } from "./history";
import { counters, pictures, spaces } from "./loop";
import type { Side } from "./protocol";
import { frame, frame_b, other, state, stats } from "./store";

interface ForTests {
  readonly generation: number | undefined;
  readonly generation_b: number | undefined;
  readonly playing: boolean | undefined;
  readonly stats: unknown;
  readonly counters: { received: number; drawn: number };
  readonly last: { frame: number; generation: number; draft: boolean } | undefined;
  readonly last_b: { frame: number; generation: number; draft: boolean } | undefined;
  readonly overrides: unknown;
  readonly overrides_b: unknown;
  readonly steps: { past: number; future: number };
  readonly unanswered: number;
  pane(i: number, side?: Side, raw_frame?: number): { array: string; shows: string; width: number; height: number; pixels: Uint8ClampedArray } | undefined;
  /** A pane of points: what is on the screen, from where it is seen, and by which of the two it was drawn. */
  space(i: number, pixels?: boolean): unknown;
  placement(i: number, side?: Side): { left: number; top: number; scale: number } | undefined;
}

declare global {
  interface Window {
    tofray?: ForTests;
  }
}

export function offer_to_tests(): void {
  window.tofray = Object.freeze<ForTests>({
    get generation() { return state.peek()?.generation; },
    get generation_b() { return other.peek()?.generation; },
    get playing() { return state.peek()?.playing; },
    get stats() { return stats.peek(); },
    get counters() { return { ...counters }; },
    get last() {
      const now = frame.peek();
      return now && { frame: now.frame, generation: now.generation, draft: now.draft };
    },
    get last_b() {
      const now = frame_b.peek();
      return now && { frame: now.frame, generation: now.generation, draft: now.draft };
    },
    get overrides() { return state.peek()?.overrides; },
    get overrides_b() { return other.peek()?.overrides; },
    get steps() { return { past: past.peek().length, future: future.peek().length }; },
    get unanswered() { return unanswered.peek(); },
    pane(i, side = "a", raw_frame) {
      const picture = pictures.get(raw_frame === undefined ? `${i}${side}` : `${i}${side} ${raw_frame}`);
      const image = picture?.image;
      return picture && image && { array: picture.array, shows: picture.shows.peek(), width: image.width, height: image.height, pixels: image.data.slice() };
    },
    space: (i, pixels = true) => spaces.get(i)?.readout(pixels),
    placement: (i, side = "a") => pictures.get(`${i}${side}`)?.where(),
  });
}
