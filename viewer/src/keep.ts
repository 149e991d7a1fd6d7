// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What is taken along: frames as files, a page, a picture with the state in it, and such a picture that brings its state back.

import { signal } from "@preact/signals";
import { stand_at } from "./ask";
import { next_id, send } from "./connection";
import { offer } from "./download";
import { set_state } from "./edit";
import { text_of_png } from "./png_text";
import { ask, drop, type Question } from "./questions";
import type { Exported, Fault, Recorded, Restored, Screenshot, Side } from "./protocol";
import { cannot, edited, fault, frame, other, spoken } from "./store";

export const keep_open = signal(false);
/** What came with a picture's state. */
export const brought_back = signal<string | undefined>(undefined);

/** The state that controls change. */
export function kept_side(): Side {
  return other.value === undefined ? "a" : edited.value;
}

/** Something that takes its time, says how far it is, and can be stopped. */
export class Job<A extends Recorded | Exported> {
  readonly progress = signal<{ done: number; frames: number } | undefined>(undefined);
  readonly result = signal<A | undefined>(undefined);
  readonly fault = signal<Fault | undefined>(undefined);
  private id: number | undefined;

  constructor(private readonly is_end: (of: A) => boolean) {}

  start(question: Question, frames: number): void {
    drop(this.id);
    this.result.value = this.fault.value = undefined;
    this.progress.value = { done: 0, frames };
    this.id = ask<A>(question, {
      answered: (of) => {
        if (!this.is_end(of)) return void (this.progress.value = { done: of.done, frames: of.frames });
        this.progress.value = undefined;
        this.result.value = of;
      },
      refused: (of) => {
        this.progress.value = undefined;
        this.fault.value = of.text === "" ? { ...of, text: "The connection broke off; what was half done is gone." } : of;
      },
    });
  }

  stop(): void {
    if (this.progress.peek() !== undefined) send({ type: "record_stop", id: next_id() });
  }
}

export const recording = new Job<Recorded>((of) => of.files !== undefined);
export const exporting = new Job<Exported>((of) => of.file !== undefined);

export function record(first: number, frames: number): void {
  recording.start({ type: "record", side: kept_side(), first, frames }, frames);
}

export function write_page(first: number, frames: number): void {
  exporting.start({ type: "export", first, frames }, frames);
}

/** As `sha256sum --check` reads it. */
export function checksums(of: Recorded): string {
  return (of.files ?? []).map(({ name, sha256 }) => `${sha256}  ${name}\n`).join("");
}

export function take_screenshot(): void {
  const why = cannot("screenshot");
  if (why !== undefined) return void (fault.value = { type: "fault", id: null, text: "There is no picture to be taken here.", more: why });
  ask<Screenshot>({ type: "screenshot", side: kept_side() }, {
    answered: ({ name }, arrays) => {
      const png = arrays?.get("png")?.values;
      if (png instanceof Uint8Array) offer(name, png.slice(), "image/png");
    },
    refused: (of) => of.text !== "" && void (fault.value = of),
  });
}

/** The state that a picture has with it, and its frame. */
export async function restore_from(file: File): Promise<void> {
  brought_back.value = undefined;
  let text: string;
  try {
    text = text_of_png(await file.arrayBuffer(), "tofray");
  } catch (error) {
    fault.value = { type: "fault", id: null, text: `${file.name} brings no state back.`, more: error instanceof RangeError ? `${error.message}.` : "It cannot be read." };
    return;
  }
  ask<Restored>({ type: "restore", text }, {
    answered: (of) => {
      set_state("a", of.overrides, of.seed);
      stand_at(of.frame);
      brought_back.value = `The state of ${file.name}: frame ${of.frame}, ${of.overrides.length === 1 ? "1 changed key" : `${of.overrides.length} changed keys`}.${of.note === undefined ? "" : ` ${of.note}`}`;
      spoken.value = brought_back.value;
      keep_open.value = false;
    },
    refused: (of) => of.text !== "" && void (fault.value = of),
  });
}

export function frame_now(): number {
  return frame.peek()?.frame ?? 0;
}

/** A picture that is dropped anywhere on the page. */
export function start_keeping(): void {
  const has_file = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") === true;
  addEventListener("dragover", (event) => {
    if (has_file(event)) event.preventDefault();
  });
  addEventListener("drop", (event) => {
    if (!has_file(event)) return;
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file !== undefined) void restore_from(file);
  });
}
