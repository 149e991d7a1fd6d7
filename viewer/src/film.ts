// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The panes as a film: each frame is gone to, drawn, and shown to the browser's MediaRecorder for its share of a second. The frames are
// computed, so none is left out, however long one takes.

import { signal } from "@preact/signals";
import { seek } from "./ask";
import { file_name, offer } from "./download";
import { spaces } from "./loop";
import { send } from "./connection";
import { frame, shown, state, title_of } from "./store";

const types = ["video/mp4;codecs=avc1.640028", "video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
const patience_ms = 60_000;
const caption_px = 30;
const gap_px = 8;
const bits_a_second = 12e6;

export const filming = signal<{ done: number; frames: number } | undefined>(undefined);
export const film_result = signal<string | undefined>(undefined);
export const film_fault = signal<string | undefined>(undefined);
let stopped = false;

function film_type(): string | undefined {
  return typeof MediaRecorder === "undefined" ? undefined : types.find((one) => MediaRecorder.isTypeSupported(one));
}

/** Why this browser makes no film; undefined: it does. */
export function no_film(): string | undefined {
  if (film_type() !== undefined && "captureStream" in HTMLCanvasElement.prototype) return undefined;
  return "This browser has no MediaRecorder for pictures, so it makes no film. Record the frames, and make one of their preview.png.";
}

interface Cell {
  pane: Element;
  canvases: readonly HTMLCanvasElement[];
  width: number;
  height: number;
}

function cells(): Cell[] {
  return [...document.querySelectorAll(".pane")].flatMap((pane) => {
    const stages = pane.querySelector(".stages")?.getBoundingClientRect();
    const canvases = [...pane.querySelectorAll<HTMLCanvasElement>(".stages canvas")].filter((one) => !one.hidden && one.clientWidth > 0);
    return stages === undefined || canvases.length === 0 ? [] : [{ pane, canvases, width: stages.width, height: Math.max(...canvases.map((one) => one.getBoundingClientRect().bottom)) - stages.top }];
  });
}

interface Sheet {
  canvas: HTMLCanvasElement;
  columns: number;
  width: number;
  height: number;
}

function even(px: number): number {
  return 2 * Math.ceil(px / 2);   // as encoders want it
}

function sheet_for(all: readonly Cell[]): Sheet {
  const columns = all.length === 1 ? 1 : 2;
  const width = Math.max(...all.map((one) => one.width));
  const height = caption_px + Math.max(...all.map((one) => one.height));
  const canvas = document.createElement("canvas");
  canvas.width = even((columns * (width + gap_px) + gap_px) * devicePixelRatio);
  canvas.height = even((Math.ceil(all.length / columns) * (height + gap_px) + gap_px) * devicePixelRatio);
  return { canvas, columns, width, height };
}

/** The panes as they are on the screen, each with its title. */
function draw(on: Sheet, number: number): void {
  const context = on.canvas.getContext("2d");
  if (context === null) return;
  const style = getComputedStyle(document.documentElement);
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = style.getPropertyValue("--surface");
  context.fillRect(0, 0, on.canvas.width, on.canvas.height);
  context.scale(devicePixelRatio, devicePixelRatio);
  for (const space of spaces.values()) space.draw();   // a GPU's picture is there until this turn ends
  cells().forEach((cell, i) => {
    const left = gap_px + (i % on.columns) * (on.width + gap_px);
    const top = gap_px + Math.floor(i / on.columns) * (on.height + gap_px);
    context.fillStyle = style.getPropertyValue("--ink");
    context.font = "600 15px system-ui, sans-serif";
    context.textBaseline = "middle";
    const time = frame.peek()?.time_s ?? 0;
    context.fillText(`${title_of(shown.peek()[i] ?? "")} · frame ${number}, ${time.toFixed(3)} s`, left, top + caption_px / 2, on.width);
    const corner = cell.pane.querySelector(".stages")!.getBoundingClientRect();
    for (const one of cell.canvases) {
      const box = one.getBoundingClientRect();
      context.imageSmoothingEnabled = false;
      context.drawImage(one, left + box.left - corner.left, top + caption_px + box.top - corner.top, box.width, box.height);
    }
  });
}

const next_picture = (): Promise<unknown> => new Promise((then) => requestAnimationFrame(then));
const after = (ms: number): Promise<unknown> => new Promise((then) => setTimeout(then, ms));

/** @return whether it was drawn, by itself, not as a draft */
async function gone_to(number: number): Promise<boolean> {
  seek(number);
  const end = performance.now() + patience_ms;
  while (!stopped && performance.now() < end) {
    await next_picture();
    const now = frame.peek();
    if (now?.frame === number && !now.draft && now.generation === state.peek()?.generation) return true;
  }
  return false;
}

/** @param hz  pictures a second */
export async function make_film(first: number, frames: number, hz: number): Promise<void> {
  const type = film_type();
  const all = cells();
  if (type === undefined || all.length === 0 || filming.peek() !== undefined) return;
  stopped = false;
  film_result.value = film_fault.value = undefined;
  filming.value = { done: 0, frames };
  if (state.peek()?.playing === true) send({ type: "pause" });
  const sheet = sheet_for(all);
  const chunks: Blob[] = [];
  try {
    const recorder = new MediaRecorder(sheet.canvas.captureStream(), { mimeType: type, videoBitsPerSecond: bits_a_second });
    recorder.ondataavailable = ({ data }) => chunks.push(data);
    const ended = new Promise<void>((then, fail) => {
      recorder.onstop = () => then();
      recorder.onerror = () => fail(new Error("the browser's recorder gave up"));
    });
    for (let i = 0; i < frames && !stopped; ++i) {
      if (!await gone_to(first + i)) break;
      if (i === 0) recorder.start();
      else recorder.resume();
      const begun = performance.now();
      draw(sheet, first + i);
      await next_picture();
      await after(Math.max(0, 1000 / hz - (performance.now() - begun)));
      recorder.pause();   // while the next frame is computed
      filming.value = { done: i + 1, frames };
    }
    if (recorder.state !== "inactive") {
      recorder.stop();
      await ended;
    }
    const { done } = filming.peek() ?? { done: 0 };
    if (stopped || done < frames) throw new Error(stopped ? "it was stopped" : `frame ${first + done} did not come`);
    const name = file_name(`film_${frames}_frames`, type.startsWith("video/mp4") ? "mp4" : "webm", first);
    offer(name, new Blob(chunks, { type }), type);
    film_result.value = name;
  } catch (error) {
    film_fault.value = `There is no film: ${error instanceof Error ? error.message : String(error)}.`;
  }
  filming.value = undefined;
}

export function stop_film(): void {
  stopped = true;
}
