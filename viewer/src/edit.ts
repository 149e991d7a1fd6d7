// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Changes on their way to the server, which alone decides whether they hold: a refused one leaves everything as it was, and is told beside
// its control.

import { batch, effect, signal } from "@preact/signals";
import { next_id, send } from "./connection";
import { offer } from "./download";
import type { Controls, Done, Fault, Override, Row, Saved, Side } from "./protocol";
import { cannot, controls, controls_open, edited, key_faults, link, other, state, tab_shown, type Keys } from "./store";

interface Sent {
  side: Side;
  /** Of one key; undefined: of a whole state. */
  key: string | undefined;
  /** A step of undo or redo. */
  restoring: boolean;
  at: number;
}

const patience_ms = 5000;   // an answer is not waited for longer
const outstanding = new Map<number, Sent>();
const answered = new Set<number>();
const held_back = new Map<string, string>();   // by side and key: what a drag wants since
export const unanswered = signal(0);
export const refused_restoring = signal(0);

/** The generation that the last accepted change of a side made. */
export const accepted: Record<Side, number> = { a: 0, b: 0 };

export function fault_place(side: Side, key: string): string {
  return `${side} ${key}`;
}

export function forget_fault(side: Side, key: string): void {
  const place = fault_place(side, key);
  if (!key_faults.peek().has(place)) return;
  const faults = new Map(key_faults.peek());
  faults.delete(place);
  key_faults.value = faults;
}

function note(sent: Omit<Sent, "at">): number {
  const id = next_id();
  outstanding.set(id, { ...sent, at: performance.now() });
  unanswered.value = outstanding.size;
  return id;
}

export function set_key(side: Side, key: string, text: string): void {
  held_back.delete(fault_place(side, key));
  send({ type: "set", id: note({ side, key, restoring: false }), side, key, text });
}

export function unset_key(side: Side, key: string): void {
  held_back.delete(fault_place(side, key));
  forget_fault(side, key);
  send({ type: "unset", id: note({ side, key, restoring: false }), side, key });
}

/** As a slider moves: one change is on its way, and then the newest. */
export function drag_key(side: Side, key: string, text: string): void {
  const now = performance.now();
  const busy = [...outstanding.values()].some((one) => one.side === side && one.key === key && now - one.at < patience_ms);
  if (busy) held_back.set(fault_place(side, key), text);
  else set_key(side, key, text);
}

export function set_seed(side: Side, seed: number): void {
  send({ type: "seed", id: note({ side, key: undefined, restoring: false }), side, seed });
}

/** Frames in files have none. */
function with_seed(side: Side, seed: number): { seed?: number } {
  return cannot("seed", side) === undefined ? { seed } : {};
}

export function set_state(side: Side, overrides: readonly Override[], seed: number, restoring = false): void {
  send({ type: "state", id: note({ side, key: undefined, restoring }), side, overrides, ...with_seed(side, seed) });
}

/** Opens the second state. @param scene  a built-in scene's or profile's name; the first one's unless given */
export function open_other(overrides: readonly Override[], seed: number, scene?: string, restoring = false): void {
  const id = note({ side: "b", key: undefined, restoring });
  send({ type: "other", id, overrides, ...with_seed(scene === undefined ? "a" : "b", seed), ...(scene === undefined ? {} : { scene }) });
}

export function close_other(restoring = false): void {
  send({ type: "other", id: note({ side: "b", key: undefined, restoring }), overrides: null });
}

/** Whether a step of undo or redo of this side has no answer yet. */
export function is_restoring(side: Side): boolean {
  const now = performance.now();
  return [...outstanding.values()].some((one) => one.restoring && one.side === side && now - one.at < patience_ms);
}

export function is_waiting(): boolean {
  const now = performance.now();
  return held_back.size > 0 || [...outstanding.values()].some((one) => now - one.at < patience_ms);
}

function settle(id: number): void {
  outstanding.delete(id);
  answered.add(id);
}

function next_of_drag(sent: Sent): void {
  if (sent.key === undefined) return;
  const place = fault_place(sent.side, sent.key);
  const text = held_back.get(place);
  if (text !== undefined) set_key(sent.side, sent.key, text);
}

/** Also answers those before it: of several that came at once the server may say the last one alone. */
export function done_arrived(of: Done): void {
  const sent = outstanding.get(of.id);
  if (sent === undefined) return;
  accepted[sent.side] = Math.max(accepted[sent.side], of.generation);
  for (const [id, one] of [...outstanding]) if (id <= of.id && one.side === sent.side) settle(id);
  unanswered.value = outstanding.size;
  if (sent.key !== undefined) forget_fault(sent.side, sent.key);
  next_of_drag(sent);
}

/** @return  whether it is told beside a control, or not told at all */
export function change_refused(of: Fault): boolean {
  const sent = of.id === null ? undefined : outstanding.get(of.id);
  if (of.id === null || sent === undefined) return of.id !== null && answered.has(of.id);
  settle(of.id);
  unanswered.value = outstanding.size;
  if (sent.restoring) ++refused_restoring.value;
  if (other.peek() === undefined) edited.value = "a";
  if (sent.key === undefined) return false;
  key_faults.value = new Map(key_faults.peek()).set(fault_place(sent.side, sent.key), of);
  next_of_drag(sent);
  return true;
}

export function forget_unanswered(): void {
  outstanding.clear();
  held_back.clear();
  accepted.a = accepted.b = 0;   // another server counts anew
  unanswered.value = 0;
}

// --- The keys and their values ---

const rest_ms = 300;
const timers: Partial<Record<Side, number>> = {};

export function controls_arrived(of: Controls): void {
  const side = of.side ?? "a";
  const before = controls[side].peek()?.by_key;
  // A row that says the same stays the same object, so that what shows it need not be made again.
  const rows = of.controls.map((row) => {
    const old = before?.get(row.key);
    return old !== undefined && JSON.stringify(old) === JSON.stringify(row) ? old : row;
  });
  controls[side].value = { generation: of.generation, rows, left_out: of.left_out ?? 0, by_key: new Map(rows.map((row) => [row.key, row])) };
}

function ask_controls(side: Side): void {
  delete timers[side];
  if (link.peek() === "open") send({ type: "controls", id: next_id(), side });
}

function is_old(of: Keys | undefined, generation: number): boolean {
  return of === undefined || of.generation < generation;
}

export function start_editing(): void {
  // Once changes have come to rest, and while somebody looks.
  effect(() => {
    const wanted: Record<Side, number | undefined> = {
      a: (controls_open.value && edited.value === "a") || (tab_shown.value === "compare" && other.value !== undefined) ? state.value?.generation : undefined,
      b: (controls_open.value && edited.value === "b") || tab_shown.value === "compare" ? other.value?.generation : undefined,
    };
    if (link.value !== "open") return;
    for (const side of ["a", "b"] as const) {
      const generation = wanted[side];
      const has = controls[side].peek();
      if (generation === undefined || !is_old(has, generation)) continue;
      clearTimeout(timers[side]);
      timers[side] = setTimeout(() => ask_controls(side), has === undefined ? 0 : rest_ms);
    }
  });
  effect(() => {
    if (other.value !== undefined) return;
    accepted.b = 0;
    batch(() => {
      edited.value = "a";
      controls.b.value = undefined;
    });
  });
}

// --- Files ---

export function save(side: Side): void {
  send({ type: "save", id: next_id(), side });
}

export function saved_arrived(of: Saved): void {
  offer(of.name, of.text, "application/yaml");
}

/** A row's text as the state has it now: the rows come a little later. */
export function text_now(row: Row, side: Side): string {
  const overrides = (side === "a" ? state.value : other.value)?.overrides ?? [];
  const keys = controls[side].value;
  const generation = (side === "a" ? state.value : other.value)?.generation ?? 0;
  const own = overrides.filter((one) => one.key === row.key).at(-1);
  return own !== undefined && (keys === undefined || keys.generation < generation) ? own.text : row.text ?? "";
}

