// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Questions that are answered once, by their id: by a text, by a text and arrays, or by a fault.

import { next_id, send } from "./connection";
import type { ClientMessage, Fault, Frame, FrameArray, ServerMessage } from "./protocol";

export type Arrays = ReadonlyMap<string, FrameArray>;

interface Asked<T> {
  answered(of: T, arrays: Arrays | undefined): void;
  refused(of: Fault): void;
}

type Answer = Extract<ServerMessage, { id: number }>;
type Numbered = Extract<ClientMessage, { id: number }>;
type WithoutId<T> = T extends unknown ? Omit<T, "id"> : never;
/** Without its id. */
export type Question = WithoutId<Numbered>;

const open = new Map<number, Asked<Answer>>();
const without_arrays = new Map<number, { text: Answer; names: readonly string[] }>();

/** @return  its id */
export function ask<T extends Answer>(question: Question, to: Asked<T>): number {
  const id = next_id();
  open.set(id, to as unknown as Asked<Answer>);
  send({ ...question, id } as Numbered);
  return id;
}

/** What it says is of no use any more. */
export function drop(id: number | undefined): void {
  if (id === undefined) return;
  open.delete(id);
  without_arrays.delete(id);
}

/** @param arrays  the names of those that follow; none do where there are none
 *  @param more    another text comes with the same id */
export function answer_arrived(text: Answer, arrays: readonly string[] = [], more = false): void {
  const to = open.get(text.id);
  if (to === undefined) return;
  if (arrays.length > 0) return void without_arrays.set(text.id, { text, names: arrays });
  if (!more) open.delete(text.id);
  to.answered(text, undefined);
}

export function arrays_arrived(of: Frame): void {
  const kept = without_arrays.get(of.sequence);
  const to = open.get(of.sequence);
  without_arrays.delete(of.sequence);
  open.delete(of.sequence);
  if (kept === undefined || to === undefined) return;
  const named = kept.names.map((name, number) => [name, of.arrays.get(number)] as const).filter((one): one is readonly [string, FrameArray] => one[1] !== undefined);
  to.answered(kept.text, new Map(named));
}

/** @return  whether it answers one of them */
export function question_refused(of: Fault): boolean {
  const to = of.id === null ? undefined : open.get(of.id);
  if (of.id === null || to === undefined) return false;
  drop(of.id);
  to.refused(of);
  return true;
}

/** Another server knows of none. */
export function forget_questions(): void {
  const all = [...open.entries()];
  open.clear();
  without_arrays.clear();
  for (const [id, to] of all) to.refused({ type: "fault", id, text: "" });
}
