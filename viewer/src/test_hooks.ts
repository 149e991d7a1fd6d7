// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What tests may read, where the server was started for them: numbers and pixels as drawn, no more.

import { counters, pictures } from "./loop";
import { frame, state, stats } from "./store";

interface ForTests {
  readonly generation: number | undefined;
  readonly playing: boolean | undefined;
  readonly stats: unknown;
  readonly counters: { received: number; drawn: number };
  readonly last: { frame: number; generation: number } | undefined;
  pane(i: number): { array: string; width: number; height: number; pixels: Uint8ClampedArray } | undefined;
  placement(i: number): { left: number; top: number; scale: number } | undefined;
}

declare global {
  interface Window {
    tofray?: ForTests;
  }
}

export function offer_to_tests(): void {
  window.tofray = Object.freeze<ForTests>({
    get generation() { return state.peek()?.generation; },
    get playing() { return state.peek()?.playing; },
    get stats() { return stats.peek(); },
    get counters() { return { ...counters }; },
    get last() {
      const now = frame.peek();
      return now && { frame: now.frame, generation: now.generation };
    },
    pane(i) {
      const picture = pictures.get(i);
      const image = picture?.image;
      return picture && image && { array: picture.array, width: image.width, height: image.height, pixels: image.data.slice() };
    },
    placement: (i) => pictures.get(i)?.where(),
  });
}
