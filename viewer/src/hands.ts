// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Things moved by hand: what a gesture means in keys is the server's word, and is then set as any other change. All of a gesture is one step
// of undo; of its moves the newest counts, one at a time.

import { effect, signal } from "@preact/signals";
import { accepted, is_waiting, set_state, unanswered } from "./edit";
import { begin_gesture, end_gesture } from "./history";
import { ask, type Question } from "./questions";
import type { ClientMessage, Fault, Override, Sets, Side } from "./protocol";
import { fault, other, spoken, state } from "./store";

type Hand = Extract<ClientMessage, { type: "drag" | "place" | "camera" }>;
type Move = Hand extends infer T ? (T extends unknown ? Omit<T, "id" | "base" | "side"> : never) : never;

interface Gesture {
  side: Side;
  base: number;
  next: Move | undefined;
  asked: number | undefined;
  asked_ms: number;
  ended: boolean;
}

const patience_ms = 3000;

let gesture: Gesture | undefined;
/** What the last move made, in words. */
export const what = signal("");
export const moving = signal(false);

function of_side(side: Side) {
  return side === "a" ? state.peek() : other.peek();
}

/** The list with what a gesture says in it: a key that is there keeps its place. */
function with_sets(overrides: readonly Override[], { sets, unsets = [] }: Pick<Sets, "sets" | "unsets">): Override[] {
  const out = overrides.filter((one) => !unsets.includes(one.key));
  for (const { key, text } of sets) {
    const at = out.map((one) => one.key).lastIndexOf(key);
    if (at < 0) out.push({ key, text });
    else out[at] = { key, text };
  }
  return out;
}

export function begin_move(side: Side): void {
  const now = of_side(side);
  if (now === undefined) return;
  if (gesture !== undefined) finish();
  begin_gesture();
  gesture = { side, base: Math.max(now.generation, accepted[side]), next: undefined, asked: undefined, asked_ms: 0, ended: false };
  moving.value = true;
}

export function move(by: Move): void {
  if (gesture === undefined) return;
  gesture.next = by;
  pump();
}

/** What is still on its way belongs to it. */
export function end_move(): void {
  if (gesture === undefined) return;
  gesture.ended = true;
  pump();
}

function finish(): void {
  gesture = undefined;
  moving.value = false;
  end_gesture();
}

function pump(): void {
  const now = gesture;
  if (now === undefined) return;
  if (now.asked !== undefined && performance.now() - now.asked_ms < patience_ms) return;
  if (now.next === undefined) {
    if (now.ended && !is_waiting()) finish();
    return;
  }
  if (is_waiting()) return;   // what came of the move before is not there yet
  const by = now.next;
  now.next = undefined;
  now.asked_ms = performance.now();
  now.asked = ask<Sets>({ ...by, base: now.base, ...(now.side === "b" ? { side: now.side } : {}) } as Question, {
    answered: (answer) => {
      if (gesture !== now) return;
      now.asked = undefined;
      const of = of_side(now.side);
      if (of !== undefined && (answer.sets.length > 0 || (answer.unsets ?? []).length > 0)) set_state(now.side, with_sets(of.overrides, answer), of.seed);
      what.value = answer.what ?? "";
      if (now.ended && now.next === undefined) spoken.value = what.value;
      pump();
    },
    refused: (of) => refused(now, of),
  });
}

function refused(now: Gesture, of: Fault): void {
  if (gesture !== now) return;
  finish();
  if (of.text === "") return;
  what.value = "";
  fault.value = of;
}

export function forget_moves(): void {
  gesture = undefined;
  moving.value = false;
  what.value = "";
}

export function start_hands(): void {
  effect(() => {
    void [unanswered.value, state.value, other.value];
    pump();
  });
}
