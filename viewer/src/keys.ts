// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The keyboard: one table, which the help shows, too. No key acts in a field, none with Alt; single letters can be switched off.

import { copy_command, find_control, toggle_other } from "./actions";
import { fit_pane, step, toggle_play } from "./ask";
import { reason_of } from "./colors";
import { difference_at, difference_unit } from "./compare";
import { save } from "./edit";
import { redo, undo } from "./history";
import { keep_open, take_screenshot } from "./keep";
import { number_text, with_unit } from "./numbers";
import { shown_array } from "./cloud";
import { is_sheet } from "./raw";
import { toggle_space } from "./space_state";
import { ask_temporal, choose_tool, drag_key, drop_something, measure_at, rectangle_key } from "./tools";
import { toggle_sheet } from "./sheet_state";
import { toggle_pin } from "./watch";
import { ask_pixel, drop_region, region_key } from "./why";
import type { Side } from "./protocol";
import {
  comparing, cursor, edited, extent, flipped, focused, hello, help_open, is_bits, letter_keys, other, point_at, scale_of, set_panes, show, shown, size, spoken, title_of,
  toggle_histogram, value_at, view, type Comparing,
} from "./store";
import { whole, zoomed } from "./view_port";

interface Key {
  keys: readonly string[];
  said: string;
  does: string;
  /** Only while a picture has the focus. */
  in_picture?: boolean;
  /** With Ctrl, or the Mac's Command. */
  ctrl?: boolean;
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

export const ways: readonly Comparing[] = ["beside", "wipe", "flip", "difference"];

function next_way(): void {
  if (other.value !== undefined) comparing.value = ways[(ways.indexOf(comparing.value) + 1) % ways.length]!;
}

/** B in the place of A, until the key comes up. */
function flip_while_held(event: KeyboardEvent): void {
  if (other.value === undefined || event.repeat) return;
  flipped.value = true;
  const back = (up: KeyboardEvent | FocusEvent): void => {
    if (up instanceof KeyboardEvent && up.key !== event.key) return;
    flipped.value = false;
    removeEventListener("keyup", back);
    removeEventListener("blur", back);
  };
  addEventListener("keyup", back);
  addEventListener("blur", back);
}

export const keys: readonly Key[] = [
  { keys: Object.keys(moves), said: "← ↑ → ↓", does: "move the pixel cursor, by 10 with Shift; a picture has the focus", in_picture: true, act: move_cursor },
  { keys: [" "], said: "Space", does: "play or pause", act: toggle_play },
  { keys: [","], said: ",", does: "one frame back", act: () => step(-1) },
  { keys: ["."], said: ".", does: "one frame on", act: () => step(1) },
  { keys: ["f"], said: "f", does: "fit the colours of this pane to the frame, once", act: () => fit_pane(focused.value) },
  { keys: [..."123456789"], said: "1 … 9", does: "what this pane shows, in the order of its list", act: choose_array },
  { keys: ["h"], said: "h", does: "histogram of this pane", act: () => toggle_histogram(focused.value) },
  { keys: ["t"], said: "t", does: "all raw frames in this pane, or back; Enter on one enlarges it", act: () => toggle_sheet(focused.value) },
  { keys: ["x"], said: "x", does: "points in space in this pane, or back", act: () => toggle_space(focused.value) },
  { keys: ["["], said: "[", does: "one pane less", act: () => set_panes(shown.value.length - 1) },
  { keys: ["]"], said: "]", does: "one pane more, up to four", act: () => set_panes(shown.value.length + 1) },
  { keys: ["+", "="], said: "+", does: "zoom in at the cursor", act: () => zoom_at_cursor(1.5) },
  { keys: ["-"], said: "−", does: "zoom out", act: () => zoom_at_cursor(1 / 1.5) },
  { keys: ["0"], said: "0", does: "the whole picture", act: () => void (view.value = whole) },
  { keys: ["p"], said: "p", does: "pin this pixel to the watch list, or take its pin away", act: toggle_pin },
  { keys: ["w"], said: "w", does: "why is this pixel wrong?", act: ask_pixel },
  { keys: ["e"], said: "e", does: "the same of a region: one corner, then the other one; Escape drops it", act: region_key },
  { keys: ["m"], said: "m", does: "measure: from here, then to here; Escape drops it", act: () => measure_at(cursor.value) },
  { keys: ["g"], said: "g", does: "statistics of a rectangle: one corner, then the other one; Escape drops it", act: rectangle_key },
  { keys: ["n"], said: "n", does: "200 frames now: the noise over time", act: ask_temporal },
  { keys: ["d"], said: "d", does: "move objects, or no more: Enter takes the one under the cursor, arrow keys move it, with Shift along the ray, with Ctrl they turn it, + and − scale it, Enter lets go", act: () => choose_tool("drag") },
  { keys: ["/"], said: "/", does: "search the controls", act: find_control },
  { keys: ["z"], said: "Ctrl+Z", does: "undo; in a field, what was typed", ctrl: true, act: (event) => (event.shiftKey ? redo() : undo()) },
  { keys: ["y"], said: "Ctrl+Y", does: "redo; also Ctrl+Shift+Z", ctrl: true, act: redo },
  { keys: ["a"], said: "a", does: "A | B: opens the second state, or closes it", act: toggle_other },
  { keys: ["v"], said: "v", does: "A | B: beside each other, wipe, flip, difference", act: next_way },
  { keys: ["b"], said: "b", does: "A | B: shows B while it is held down", act: flip_while_held },
  { keys: ["c"], said: "c", does: "copy the command", act: () => void copy_command() },
  { keys: ["s"], said: "s", does: "save the scene as YAML", act: () => save(edited.value) },
  { keys: ["r"], said: "r", does: "record frames, and what else can be taken along: a page, a screenshot, a film", act: () => void (keep_open.value = true) },
  { keys: ["i"], said: "i", does: "a screenshot of this frame, with the state in it", act: take_screenshot },
  { keys: ["?"], said: "?", does: "this list", act: () => void (help_open.value = !help_open.value) },
];

/** Letters are theirs. */
function is_field(target: Element | null): boolean {
  return target?.closest("input:not([type=checkbox], [type=range], [type=radio]), textarea, select, [contenteditable]") != null;
}

/** What was typed is theirs to undo. */
function is_text(target: Element | null): boolean {
  return target?.closest("input:not([type=checkbox], [type=range], [type=radio]), textarea, [contenteditable]") != null;
}

/** Space and arrows are theirs. */
function is_control(target: Element | null): boolean {
  return target?.closest("button, summary, a, input, dialog") != null;
}

function on_key(event: KeyboardEvent): void {
  if (event.altKey || event.isComposing || event.defaultPrevented || keep_open.value) return;
  const ctrl = event.ctrlKey || event.metaKey;
  const target = event.target instanceof Element ? event.target : null;
  if (ctrl ? is_text(target) : is_field(target)) return;
  if (event.key === "Escape" && !ctrl && !help_open.value && (drop_something() || drop_region())) return event.preventDefault();
  if (target?.closest(".stage:not(.space)") != null && !help_open.value && drag_key(event)) return event.preventDefault();
  const key = keys.find((one) => one.keys.includes(ctrl ? event.key.toLowerCase() : event.key) && (one.ctrl === true) === ctrl);
  if (key === undefined) return;
  const in_picture = target?.closest(".stage") != null;
  if (key.in_picture === true && !in_picture) return;
  if (event.key === " " && is_control(target)) return;
  if (!ctrl && event.key.length === 1 && event.key !== " " && !letter_keys.value) return;
  if (help_open.value && event.key !== "?") return;
  event.preventDefault();
  key.act(event);
}

export function start_keys(): void {
  addEventListener("keydown", on_key);
}

/** B − A at the cursor, with its sign; empty where one of them has no value, or it is of bits. */
export function difference_reading(array: string): string {
  const own = scale_of(array);
  const value = difference_at(array, cursor.value);
  if (own === undefined || value === undefined || !Number.isFinite(value)) return "";
  const scale = difference_unit(own);
  return with_unit(`${value > 0 ? "+" : ""}${number_text(value * (scale.factor ?? 1))}`, scale.unit);
}

/** What one pane shows at the cursor, in words: its value, or why there is none. */
export function reading(shows: string, side: Side = "a"): string {
  const array = shown_array(shows);
  const value = value_at(array, cursor.value, side);
  const greeting = hello.value;
  if (value === undefined || greeting === undefined) return "";
  const scale = scale_of(array);
  if (is_bits(array)) {
    const names = greeting.invalid.filter((reason) => ((value >>> reason.bit) & 1) !== 0).map((reason) => reason.name);
    return names.length === 0 ? "none" : names.join(", ");
  }
  if (Number.isFinite(value)) return with_unit(number_text(value * (scale?.factor ?? 1)), scale?.unit ?? "");
  const why = reason_of(greeting, value_at("flags", cursor.value, side) ?? 0);
  return why === undefined ? "invalid" : `invalid: ${why.name}`;
}

let timer: number | undefined;

/** Once the cursor rests: who holds an arrow key down hears where it ends, not the way. */
function say_pixel_soon(): void {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const at = cursor.value;
    if (at === undefined) return;
    const b = other.value !== undefined;
    const readings = [...new Set(shown.value.map(shown_array))].filter((array) => !is_sheet(array)).map((array) => `${title_of(array)} ${b ? `A ${reading(array)}, B ${reading(array, "b")}` : reading(array)}`);
    spoken.value = [`Pixel ${at.u}, ${at.v}`, ...readings].join(". ");
  }, 150);
}
