// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A question that stays: asked anew of each frame that is drawn and of each state, one at a time.

import { effect, signal } from "@preact/signals";
import { ask, drop, type Arrays, type Question } from "./questions";
import type { Fault, ServerMessage, Side } from "./protocol";
import { frame_of, link, other, state } from "./store";

type Answer = Extract<ServerMessage, { id: number }>;

const patience_ms = 5000;

export class Following<Q, A extends Answer> {
  readonly question = signal<Q | undefined>(undefined);
  readonly answer = signal<A | undefined>(undefined);
  readonly fault = signal<Fault | undefined>(undefined);
  private asked: { id: number; of: Q; generation: number; frame: number; at: number } | undefined;
  private done: { of: Q; generation: number; frame: number } | undefined;
  private timer: number | undefined;
  private last_ms = -Infinity;

  /** @param message   what is asked
   *  @param side      of which state; it may read signals
   *  @param pause_ms  from one to the next
   *  @param read      whether somebody reads it; it may read signals */
  constructor(
    private readonly message: (of: Q, side: Side) => Question, private readonly side: (of: Q) => Side, private readonly pause_ms: number,
    private readonly read: () => boolean = () => true, private readonly arrived: (of: A, arrays: Arrays | undefined) => void = () => undefined,
  ) {}

  start(): void {
    effect(() => this.look());
  }

  /** Asks at once, also what was asked before. */
  put(of: Q | undefined): void {
    this.done = undefined;
    this.fault.value = undefined;
    if (of === undefined) this.answer.value = undefined;
    this.question.value = of;
  }

  forget(): void {
    drop(this.asked?.id);
    this.asked = this.done = undefined;
    this.answer.value = this.fault.value = undefined;
  }

  private look(): void {
    const of = this.question.value;
    if (of === undefined || link.value !== "open" || !this.read()) return;
    const side = this.side(of);
    const drawn = frame_of(side);
    const generation = (side === "a" ? state.value : other.value)?.generation;
    if (drawn === undefined || drawn.generation !== generation) return;
    const now = performance.now();
    if (this.asked !== undefined && now - this.asked.at < patience_ms) return;   // its answer looks again
    const { done } = this;
    if (done?.of === of && done.generation === generation && done.frame === drawn.frame) return;
    const rest = this.last_ms + this.pause_ms - now;
    clearTimeout(this.timer);
    if (rest > 0) this.timer = setTimeout(() => this.look(), rest);
    else this.send(of, side, generation, drawn.frame, now);
  }

  private send(of: Q, side: Side, generation: number, frame: number, at: number): void {
    drop(this.asked?.id);
    this.last_ms = at;
    const id = ask<A>(this.message(of, side), {
      answered: (answer, arrays) => {
        if (this.asked?.id === id) this.settle();
        if (this.question.peek() !== undefined) {
          this.fault.value = undefined;
          this.arrived(answer, arrays);
          this.answer.value = answer;
        }
        this.look_later();
      },
      refused: (fault) => {
        if (this.asked?.id === id) this.settle();
        if (fault.text !== "") this.fault.value = fault;
        this.look_later();
      },
    });
    this.asked = { id, of, generation, frame, at };
  }

  private settle(): void {
    this.done = this.asked;
    this.asked = undefined;
  }

  private look_later(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.look(), 0);
  }
}
