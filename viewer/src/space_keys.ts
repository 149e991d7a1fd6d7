// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0

/** Keys of a pane of points in space, while it has the focus (space_view.ts acts on them). */
export const space_keys: readonly { said: string; does: string }[] = [
  { said: "← ↑ → ↓", does: "turn the view; with Shift move it" },
  { said: "+ −", does: "nearer, farther" },
  { said: "0", does: "as it was first seen" },
  { said: "t", does: "through the camera, or from beside it" },
  { said: "W A S D", does: "move the camera forward, left, backward, right by 2 cm; with Shift by 20 cm" },
  { said: "R F", does: "move the camera up, down" },
  { said: "o", does: "choose the next object; Escape: none" },
  { said: "Ctrl+← ↑ → ↓", does: "move the chosen object by 2 cm; Ctrl+PageUp and Ctrl+PageDown: forward, backward" },
];
