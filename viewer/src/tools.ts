// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a press on a picture does: it is looked at, an object is dragged, two points are measured, or a rectangle is chosen.

import { effect, signal } from "@preact/signals";
import { is_waiting } from "./edit";
import { Following } from "./follow";
import { begin_move, end_move, move, moving, what } from "./hands";
import { ask, drop } from "./questions";
import type { Measured, RegionStatistics, Side, Temporal } from "./protocol";
import {
  array_of, cursor, edited, frame_of, is_current, link, of_b, other, point_at, set_panes, show, shown, size, spoken, state, tab, tab_shown, temporal, temporal_titles, type Cursor, type Region,
} from "./store";

export type Tool = "look" | "drag" | "measure" | "rectangle";
export const tool = signal<Tool>("look");

export function choose_tool(of: Tool): void {
  let_go();
  tool.value = tool.peek() === of ? "look" : of;
  if (tool.peek() === "measure" || tool.peek() === "rectangle") tab.value = "measure";
}

function of_side(at: Cursor, side: Side): [number, number] {
  const there = side === "b" ? of_b(at) : at;
  return [there.u, there.v];
}

// --- Objects, by the pointer and by keys ---

export type How = "parallel" | "along" | "turn" | "scale";

/** Of A's image, also beyond its edges. */
export interface Point {
  u: number;
  v: number;
}

interface Grab {
  side: Side;
  object: number;
  from: Cursor;
  to: Point;
  how: How;
}

/** By keys: an object that arrow keys move until Enter or Escape. */
export const grabbed = signal<Grab | undefined>(undefined);
let dragged: Grab | undefined;

export function how_of(event: { shiftKey: boolean; ctrlKey: boolean; metaKey?: boolean }): How {
  return event.ctrlKey || event.metaKey === true ? "turn" : event.shiftKey ? "along" : "parallel";
}

/** The object that a pixel sees; undefined: none, or nothing is known of it yet. */
function object_at(at: Cursor, side: Side): number | undefined {
  const ids = array_of(frame_of(side), "gt_object_id");
  const [height = 0, width = 0] = ids?.dims ?? [];
  const [u, v] = of_side(at, side);
  if (ids === undefined || u < 0 || v < 0 || u >= width || v >= height) return undefined;
  const id = ids.values[v * width + u]!;
  return id >= 0 ? id : undefined;
}

/** @return  whether there is something to drag */
export function begin_drag(at: Cursor, how: How, side: Side): boolean {
  const object = object_at(at, side);
  if (object === undefined) {
    spoken.value = what.value = "Nothing to move there";
    return false;
  }
  begin_move(side);
  dragged = { side, object, from: at, to: at, how };
  return true;
}

function send_drag(of: Grab): void {
  const scale = (to: Point): [number, number] => {
    const [u, v] = of_side({ u: Math.floor(to.u), v: Math.floor(to.v) }, of.side);
    return of.side === "b" ? [u, v] : [to.u, to.v];
  };
  move({ type: "drag", object: of.object, from: of_side(of.from, of.side), to: scale(of.to), how: of.how });
}

/** Another way of moving begins where the one before ended. */
export function drag_to(to: Point): void {
  if (dragged === undefined) return;
  dragged.to = to;
  send_drag(dragged);
}

export function end_drag(): void {
  dragged = undefined;
  end_move();
}

let wheel_timer: number | undefined;

/** Steps of the wheel over an object make it larger or smaller; those that follow each other are one gesture. */
export function wheel_scales(at: Cursor, lines: number, side: Side): void {
  if (wheel_timer === undefined) {
    if (!begin_drag(at, "scale", side)) return;
  }
  clearTimeout(wheel_timer);
  wheel_timer = setTimeout(() => {
    wheel_timer = undefined;
    end_drag();
  }, 400);
  if (dragged !== undefined) drag_to({ u: dragged.to.u, v: dragged.to.v + 6 * lines });
}

const key_moves: Readonly<Record<string, readonly [number, number]>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** What keys hold is where it is now. */
function let_go(): void {
  if (grabbed.peek() === undefined) return;
  grabbed.value = undefined;
  end_drag();
}

/** Keys while objects are moved and a picture has the focus. @return  whether the key was one of them */
export function drag_key(event: KeyboardEvent): boolean {
  if (tool.value !== "drag") return false;
  const held = grabbed.value;
  const side = edited.value;
  if (event.key === "Enter" && held === undefined) {
    const at = cursor.value;
    if (at === undefined || !begin_drag(at, "parallel", side) || dragged === undefined) return true;
    grabbed.value = dragged;
    spoken.value = "Held: arrow keys move it, with Shift up and down along the ray, with Ctrl they turn it, plus and minus scale it. Enter lets go.";
    return true;
  }
  if (held === undefined) return false;
  if (event.key === "Enter" || event.key === "Escape") {
    let_go();
    return true;
  }
  const by = key_moves[event.key] ?? { "+": [0, -5], "=": [0, -5], "-": [0, 5] }[event.key];
  if (by === undefined) return false;
  const how: How = key_moves[event.key] === undefined ? "scale" : how_of(event);
  const far = how === "parallel" ? 1 : how === "turn" ? 4 : 2;
  // (The server knows what the keys were when the gesture began: another way begins a gesture of its own.)
  const same = how === held.how && moving.value;
  if (!same && is_waiting()) return true;   // until that one has ended
  if (!same) {
    end_drag();
    begin_move(held.side);
  }
  const at = held.how === "parallel" ? { u: Math.round(held.to.u), v: Math.round(held.to.v) } : held.from;
  const from = same ? held.from : at;
  const before = same ? held.to : at;
  const next: Grab = { ...held, how, from, to: { u: before.u + far * by[0]!, v: before.v + (how === "scale" ? 1 : far) * by[1]! } };
  dragged = next;
  grabbed.value = next;
  send_drag(next);
  if (how === "parallel") point_at(Math.round(next.to.u), Math.round(next.to.v), true);
  return true;
}

// --- Two points ---

export interface Ends {
  a: Cursor;
  b: Cursor;
}

export const measure_from = signal<Cursor | undefined>(undefined);
const read_here = (): boolean => tab_shown.value === "measure";
const side_edited = (): Side => (other.value === undefined ? "a" : edited.value);
const whose = (side: Side): { side?: Side } => (side === "b" ? { side } : {});

export const measuring = new Following<Ends, Measured>(
  ({ a, b }, side) => ({ type: "measure", ...whose(side), a: of_side(a, side), b: of_side(b, side) }), side_edited, 150, read_here);

/** The first time from here, the second time to here. */
export function measure_at(at: Cursor | undefined): void {
  if (at === undefined) return void (spoken.value = "No pixel is pointed at");
  tab.value = "measure";
  const from = measure_from.value;
  if (from === undefined) {
    measure_from.value = at;
    measuring.put(undefined);
    spoken.value = `Measured from pixel ${at.u}, ${at.v}. Point at the other end and press m again; Escape drops it.`;
    return;
  }
  measure_from.value = undefined;
  measuring.put({ a: from, b: at });
}

/** What is drawn of it. */
export function measure_ends(): Cursor[] {
  const now = measuring.question.value;
  if (now !== undefined) return [now.a, now.b];
  return measure_from.value === undefined ? [] : [measure_from.value];
}

// --- A rectangle ---

export const rectangle = signal<Region | undefined>(undefined);
export const rectangle_from = signal<Cursor | undefined>(undefined);
export const statistics = new Following<Region, RegionStatistics>((of, side) => {
  const [u0, v0] = of_side({ u: of.u0, v: of.v0 }, side);
  const [u1, v1] = of_side({ u: of.u1, v: of.v1 }, side);
  return { type: "region", ...whose(side), region: [u0, v0, u1, v1] };
}, side_edited, 200, read_here);

export function rectangle_between(a: Cursor, b: Cursor): Region {
  const { width, height } = size.peek();
  const near = (at: number, count: number): number => Math.min(count - 1, Math.max(0, at));
  return {
    u0: near(Math.min(a.u, b.u), width), v0: near(Math.min(a.v, b.v), height), u1: near(Math.max(a.u, b.u), width), v1: near(Math.max(a.v, b.v), height),
  };
}

export function ask_rectangle(of: Region): void {
  rectangle.value = of;
  rectangle_from.value = undefined;
  tab.value = "measure";
  statistics.put(of);
}

export function rectangle_key(): void {
  const at = cursor.value;
  if (at === undefined) return void (spoken.value = "No pixel is pointed at");
  const from = rectangle_from.value;
  if (from !== undefined) return ask_rectangle(rectangle_between(from, at));
  rectangle_from.value = at;
  rectangle.value = rectangle_between(at, at);
  tab.value = "measure";
  spoken.value = `A rectangle begins at pixel ${at.u}, ${at.v}. Move the cursor to its other corner and press g again; Escape drops it.`;
}

export function drop_rectangle(): void {
  rectangle.value = rectangle_from.value = undefined;
  statistics.put(undefined);
}

export function drop_measure(): void {
  measure_from.value = undefined;
  measuring.put(undefined);
}

/** Escape: one thing at a time, the one that is half done first. @return  whether there was one */
export function drop_something(): boolean {
  if (grabbed.value !== undefined) let_go();
  else if (measure_from.value !== undefined) drop_measure();
  else if (rectangle_from.value !== undefined) drop_rectangle();
  else if (tool.value !== "look") tool.value = "look";
  else if (measuring.question.value !== undefined) drop_measure();
  else if (rectangle.value !== undefined) drop_rectangle();
  else return false;
  return true;
}

// --- Many frames now ---

export const temporal_frames = 200;

export const temporal_progress = signal<Temporal | undefined>(undefined);
export const temporal_fault = signal<string | undefined>(undefined);
let temporal_id: number | undefined;
let anew_timer: number | undefined;
const anew_ms = 700;

/** By hand: the numbers are shown, too. */
export function ask_temporal(): void {
  tab.value = "measure";
  ask_temporal_of(side_edited());
}

function generation_of(side: Side): number | undefined {
  return (side === "a" ? state.value : other.value)?.generation;
}

let refused_for: number | undefined;   // the generation that was not answered

function ask_temporal_of(side: Side): void {
  const of_generation = generation_of(side);
  clearTimeout(anew_timer);
  drop(temporal_id);
  temporal_fault.value = undefined;
  temporal_progress.value = { type: "temporal", id: 0, side, frames: temporal_frames, done: 0 };
  temporal_id = ask<Temporal>({ type: "temporal", ...whose(side), frames: temporal_frames }, {
    answered: (of, arrays) => {
      if (arrays === undefined) return void (temporal_progress.value = of);
      temporal_progress.value = temporal_id = undefined;
      temporal.value = { ...temporal.peek(), [side]: { of, arrays } };
      spoken.value = `${of.frames} frames are done`;
    },
    refused: (of) => {
      refused_for = of_generation;
      temporal_progress.value = temporal_id = undefined;
      if (of.text !== "" && generation_of(side) === of_generation) temporal_fault.value = [of.text, of.more ?? ""].join(" ").trim();
    },
  });
}

/** σ over time beside σ̂ in the first two panes. */
export function show_temporal(): void {
  if (shown.peek().length < 2) set_panes(2);
  show(0, "temporal_sigma_m");
  show(1, "temporal_predicted_m");
}

export function forget_tools(): void {
  measuring.forget();
  statistics.forget();
  drop(temporal_id);
  temporal_id = undefined;
  temporal_progress.value = undefined;
  temporal.value = { a: undefined };
}

/** While panes show what many frames say, a changed state is asked anew, once it rests. */
function ask_anew(): void {
  const sides = other.value === undefined ? (["a"] as const) : (["a", "b"] as const);
  const old = sides.find((side) => temporal.value[side] !== undefined && !is_current(side));
  clearTimeout(anew_timer);
  const now = old === undefined ? undefined : generation_of(old);
  if (old === undefined || now === refused_for || temporal_progress.value !== undefined || link.value !== "open" || !shown.value.some((name) => name in temporal_titles)) return;
  anew_timer = setTimeout(() => ask_temporal_of(old), anew_ms);
}

export function start_tools(): void {
  effect(ask_anew);
  measuring.start();
  statistics.start();
  effect(() => {
    const from = rectangle_from.value;
    const at = cursor.value;
    if (from !== undefined && at !== undefined) rectangle.value = rectangle_between(from, at);
  });
  effect(() => {
    if (link.value !== "open") temporal_progress.value = undefined;
    if (other.value === undefined && temporal.peek().b !== undefined) temporal.value = { a: temporal.peek().a };
  });
}
