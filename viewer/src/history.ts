// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Undo and redo: the states that were, each a list of `--set` and a seed for either side. What the server says makes the steps, so that
// a change which another page has made can be taken back, too. All of a drag is one step.

import { effect, signal } from "@preact/signals";
import { accepted, close_other, is_restoring, is_waiting, open_other, refused_restoring, set_state, unanswered } from "./edit";
import type { Hello, Override } from "./protocol";
import { other, state } from "./store";

interface Half {
  overrides: readonly Override[];
  seed: number;
  scene?: string | undefined;
}

interface Snapshot {
  a: Half;
  b: Half | undefined;
}

const most_steps = 1000;

export const past = signal<readonly Snapshot[]>([]);
export const future = signal<readonly Snapshot[]>([]);
/** How many changes were set again on a server that was started anew. */
export const restored = signal<number | undefined>(undefined);

let present: Snapshot | undefined;
let start: Snapshot | undefined;   // of the command line that the server was started with
let gesture: { kept: boolean; ended: boolean } | undefined;

function snapshot(): Snapshot | undefined {
  const a = state.peek();
  const b = other.peek();
  if (a === undefined) return undefined;
  return {
    a: { overrides: a.overrides, seed: a.seed },
    b: b === undefined ? undefined : { overrides: b.overrides, seed: b.seed, scene: b.scene },
  };
}

function same(a: unknown, b: unknown): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

function keep(step: Snapshot): void {
  past.value = [...past.peek(), step].slice(-most_steps);
  future.value = [];
}

export function begin_gesture(): void {
  gesture = { kept: false, ended: false };
}

/** The changes that are still on their way belong to it. */
export function end_gesture(): void {
  if (gesture !== undefined) gesture.ended = true;
  close_gesture();
}

function close_gesture(): void {
  if (gesture?.ended === true && !is_waiting() && (state.peek()?.generation ?? 0) >= accepted.a && (other.peek()?.generation ?? Infinity) >= accepted.b) gesture = undefined;
}

/** A state came. */
export function history_goes_on(): void {
  const now = snapshot();
  if (now === undefined) return;
  if (present === undefined) {
    present = start = now;
  } else if (!same(now, present)) {
    const ours = {
      a: is_restoring("a") || (state.peek()?.generation ?? 0) < accepted.a,
      b: is_restoring("b") || (other.peek()?.generation ?? Infinity) < accepted.b,
    };
    const next = { a: ours.a ? present.a : now.a, b: ours.b ? present.b : now.b };
    if (!same(next, present)) {
      if (gesture === undefined || !gesture.kept) keep(present);
      if (gesture !== undefined) gesture.kept = true;
      present = next;
    }
  }
  close_gesture();
}

/** Tells the server what differs. */
function go(to: Snapshot): void {
  const from = present;
  present = to;
  if (!same(from?.a, to.a)) set_state("a", to.a.overrides, to.a.seed, true);
  if (same(from?.b, to.b)) return;
  if (to.b === undefined) close_other(true);
  else if (from?.b !== undefined && from.b.scene === to.b.scene) set_state("b", to.b.overrides, to.b.seed, true);
  else open_other(to.b.overrides, to.b.seed, to.b.scene === state.peek()?.scene ? undefined : to.b.scene, true);
}

function move(from: typeof past, to: typeof past): void {
  const target = from.peek().at(-1);
  if (target === undefined || present === undefined) return;
  gesture = undefined;
  restored.value = undefined;
  from.value = from.peek().slice(0, -1);
  to.value = [...to.peek(), present];
  go(target);
}

export function undo(): void {
  move(past, future);
}

export function redo(): void {
  move(future, past);
}

/** A greeting. The state is the server's; but on one that was started anew by the same words, what was changed is set again.
 *  @param anew  another server than before */
export function history_of_greeting(of: Hello, before: Hello | undefined, anew: boolean): void {
  const now = snapshot();
  gesture = undefined;
  if (now === undefined || present === undefined || !anew) return history_goes_on();
  const wanted = present;
  const as_before = of.scene === before?.scene && same(now, start) && !same(wanted, start);
  if (!as_before) {
    past.value = future.value = [];
    present = start = now;
    return;
  }
  keep(now);
  present = now;
  restored.value = wanted.a.overrides.length;
  go(wanted);
}

export function start_history(): void {
  // Refused: what the server has holds.
  effect(() => {
    if (refused_restoring.value > 0) present = snapshot() ?? present;
  });
  effect(() => {
    if (unanswered.value === 0) close_gesture();
  });
}
