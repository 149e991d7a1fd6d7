// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The keyboard: one table, which the help shows, too. No key acts in a field, none with Ctrl, Alt or Meta; single letters can be switched off.

import { fit, step, toggle_play } from "./ask";
import { reason_of } from "./colors";
import { number_text, with_unit } from "./numbers";
import {
  cursor, extent, focused, hello, help_open, letter_keys, point_at, scale_of, show, shown, size, spoken, title_of, value_at, view,
} from "./store";
import { whole, zoomed } from "./view_port";

interface Key {
  keys: readonly string[];
  said: string;
  does: string;
  /** Only while a picture has the focus. */
  in_picture?: boolean;
  act(event: KeyboardEvent): void;
}

const moves: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
};

function move_cursor(event: KeyboardEvent): void {
  const [du, dv] = moves[event.key] ?? [0, 0];
  const far = event.shiftKey ? 10 : 1;
  const { width, height } = size.value;
  const from = cursor.value;
  if (from === undefined) point_at(Math.floor(width / 2), Math.floor(height / 2), true);
  else point_at(from.u + far * du, from.v + far * dv, true);
  say_pixel_soon();
}

export function zoom_at_cursor(factor: number): void {
  const { width, height } = size.value;
  const at = cursor.value;
  const [u, v] = at === undefined ? [view.value.x * width, view.value.y * height] : [at.u + 0.5, at.v + 0.5];
  view.value = zoomed(view.value, factor, u, v, extent.value);
  if (at !== undefined) point_at(at.u, at.v, true);
}

function choose_array(event: KeyboardEvent): void {
  const pane = hello.value?.panes[Number(event.key) - 1];
  if (pane !== undefined) show(focused.value, pane.array);
}

export const keys: readonly Key[] = [
  { keys: Object.keys(moves), said: "← ↑ → ↓", does: "move the pixel cursor, by 10 with Shift; a picture has the focus", in_picture: true, act: move_cursor },
  { keys: [" "], said: "Space", does: "play or pause", act: toggle_play },
  { keys: [","], said: ",", does: "one frame back", act: () => step(-1) },
  { keys: ["."], said: ".", does: "one frame on", act: () => step(1) },
  { keys: ["f"], said: "f", does: "fit the colours of this pane to the frame, once", act: () => fit(shown.value[focused.value]) },
  { keys: [..."123456789"], said: "1 … 9", does: "what this pane shows, in the order of its list", act: choose_array },
  { keys: ["+", "="], said: "+", does: "zoom in at the cursor", act: () => zoom_at_cursor(1.5) },
  { keys: ["-"], said: "−", does: "zoom out", act: () => zoom_at_cursor(1 / 1.5) },
  { keys: ["0"], said: "0", does: "the whole picture", act: () => void (view.value = whole) },
  { keys: ["?"], said: "?", does: "this list", act: () => void (help_open.value = !help_open.value) },
];

function is_field(target: Element | null): boolean {
  return target?.closest("input:not([type=checkbox]), textarea, select, [contenteditable]") != null;
}

/** Space and arrows are theirs. */
function is_control(target: Element | null): boolean {
  return target?.closest("button, summary, a, input, dialog") != null;
}

function on_key(event: KeyboardEvent): void {
  if (event.ctrlKey || event.altKey || event.metaKey || event.isComposing || event.defaultPrevented) return;
  const target = event.target instanceof Element ? event.target : null;
  if (is_field(target)) return;
  const key = keys.find((one) => one.keys.includes(event.key));
  if (key === undefined) return;
  const in_picture = target?.closest(".stage") != null;
  if (key.in_picture === true && !in_picture) return;
  if (event.key === " " && is_control(target)) return;
  if (event.key.length === 1 && event.key !== " " && !letter_keys.value) return;
  if (help_open.value && event.key !== "?") return;
  event.preventDefault();
  key.act(event);
}

export function start_keys(): void {
  addEventListener("keydown", on_key);
}

/** What one pane shows at the cursor, in words: its value, or why there is none. */
export function reading(array: string): string {
  const value = value_at(array, cursor.value);
  const greeting = hello.value;
  if (value === undefined || greeting === undefined) return "";
  const scale = scale_of(array);
  if (scale === undefined) {
    const names = greeting.invalid.filter((reason) => ((value >>> reason.bit) & 1) !== 0).map((reason) => reason.name);
    return names.length === 0 ? "none" : names.join(", ");
  }
  if (Number.isFinite(value)) return with_unit(number_text(value * (scale.factor ?? 1)), scale.unit);
  const why = reason_of(greeting, value_at("flags", cursor.value) ?? 0);
  return why === undefined ? "invalid" : `invalid: ${why.name}`;
}

let timer: number | undefined;

/** Once the cursor rests: who holds an arrow key down hears where it ends, not the way. */
function say_pixel_soon(): void {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const at = cursor.value;
    if (at === undefined) return;
    const readings = [...new Set(shown.value)].map((array) => `${title_of(array)} ${reading(array)}`);
    spoken.value = [`Pixel ${at.u}, ${at.v}`, ...readings].join(". ");
  }, 150);
}
