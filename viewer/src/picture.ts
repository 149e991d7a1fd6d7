// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A pane's picture: the image, unsmoothed, and above it, on a canvas of its own, the cursor, letters and numbers.

import { signal } from "@preact/signals";
import { css, ink_on, paint } from "./colors";
import { digits_for, fixed_text } from "./numbers";
import type { Frame, Hello, Reason, Rgb, Scale } from "./protocol";
import { array_of, canvas_size, cursor, hello, scale_of, shown, view, type Cursor } from "./store";
import { placement, type Placement } from "./view_port";

/** How wide a pixel has to be, in CSS pixels, for a letter or a number to be read in it. */
const letter_room = 11;
const number_room = 34;

export interface Share {
  reason: Reason | undefined;
  share: number;
}

function context_of(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("this browser gives no 2D canvas");
  return context;
}

export class Picture {
  /** Why pixels have no value, and how many: each reason that has occurred, so that the legend does not jump. */
  readonly shares = signal<readonly Share[]>([]);
  /** The image as coloured. */
  image: ImageData | undefined;
  array = "";

  private readonly front: HTMLCanvasElement;
  private readonly over: HTMLCanvasElement;
  private readonly buffer = document.createElement("canvas");
  private readonly seen = new Set<Reason | undefined>();
  private painted: { frame: Frame; scale: Scale | undefined; array: string } | undefined;

  constructor(readonly pane: number, front: HTMLCanvasElement, over: HTMLCanvasElement) {
    this.front = front;
    this.over = over;
  }

  resize(width: number, height: number): void {
    for (const canvas of [this.front, this.over]) {
      canvas.width = Math.max(1, width);
      canvas.height = Math.max(1, height);
    }
    canvas_size.value = { width, height };
  }

  where(): Placement | undefined {
    if (this.image === undefined) return undefined;
    const { width, height } = this.image;
    return placement(view.value, { width, height, canvas_width: this.front.width, canvas_height: this.front.height });
  }

  /** The point of the image at a place on the screen [pixels], also beyond its edges: pixel (0, 0) is 0 … 1. */
  point_at(client_x: number, client_y: number): Cursor | undefined {
    const at = this.where();
    const box = this.front.getBoundingClientRect();
    if (at === undefined || box.width === 0) return undefined;
    const ratio = this.front.width / box.width;
    return {
      u: ((client_x - box.left) * ratio - at.left) / at.scale,
      v: ((client_y - box.top) * ratio - at.top) / at.scale,
    };
  }

  /** Colours the frame where that is not done yet, and draws it. */
  draw(frame: Frame | undefined): void {
    const greeting = hello.value;
    const array = shown.value[this.pane];
    if (greeting === undefined || array === undefined) return;
    if (frame !== undefined) this.color(greeting, frame, array);
    const front = context_of(this.front);
    front.clearRect(0, 0, this.front.width, this.front.height);
    const at = this.where();
    if (at !== undefined && this.image !== undefined) {
      front.imageSmoothingEnabled = false;
      front.drawImage(this.buffer, at.left, at.top, at.scale * this.image.width, at.scale * this.image.height);
    }
    this.draw_over(greeting, frame);
  }

  private color(greeting: Hello, frame: Frame, name: string): void {
    const scale = scale_of(name);
    const before = this.painted;
    if (before?.frame === frame && before.scale === scale && before.array === name) return;
    const array = array_of(frame, name);
    const [height, width] = array?.dims ?? [];
    if (array === undefined || array.dims.length !== 2 || height === undefined || width === undefined || width * height === 0) return;
    if (this.image?.width !== width || this.image.height !== height) {
      this.image = new ImageData(width, height);
      this.buffer.width = width;
      this.buffer.height = height;
    }
    if (before?.array !== name || before.frame.generation !== frame.generation) this.seen.clear();
    const counts = paint(this.image.data, greeting, array.values, array_of(frame, "flags")?.values, scale);
    context_of(this.buffer).putImageData(this.image, 0, 0);
    this.array = name;
    this.painted = { frame, scale, array: name };
    for (const reason of counts.keys()) this.seen.add(reason);
    this.shares.value = [...greeting.invalid, undefined]
      .filter((reason) => this.seen.has(reason))
      .map((reason) => ({ reason, share: (counts.get(reason) ?? 0) / array.values.length }));
  }

  /** The cursor alone, without the image again. */
  private draw_over(greeting: Hello, frame: Frame | undefined): void {
    const over = context_of(this.over);
    over.clearRect(0, 0, this.over.width, this.over.height);
    const at = this.where();
    if (at === undefined || this.image === undefined) return;
    const ratio = devicePixelRatio;
    if (frame !== undefined && at.scale >= letter_room * ratio) this.draw_letters(over, greeting, frame, at, ratio);
    const point = cursor.value;
    if (point !== undefined) this.draw_cursor(over, at, point, ratio);
  }

  private draw_letters(over: CanvasRenderingContext2D, greeting: Hello, frame: Frame, at: Placement, ratio: number): void {
    const array = array_of(frame, this.array);
    const image = this.image;
    if (array === undefined || image === undefined) return;
    const flags = array_of(frame, "flags")?.values;
    const scale = scale_of(this.array);
    const factor = scale?.factor ?? 1;
    const numbers = scale !== undefined && at.scale >= number_room * ratio;
    const digits = scale === undefined ? 0 : digits_for(factor * (scale.high - scale.low));
    const letters = `600 ${Math.round(Math.min(0.62 * at.scale, 26 * ratio))}px system-ui, sans-serif`;
    const small = `${Math.round(Math.min(0.27 * at.scale, 15 * ratio))}px system-ui, sans-serif`;
    over.textAlign = "center";
    over.textBaseline = "middle";
    const first = (edge: number): number => Math.max(0, Math.floor(-edge / at.scale));
    const end = (edge: number, canvas: number, count: number): number => Math.min(count, Math.ceil((canvas - edge) / at.scale));
    for (let v = first(at.top); v < end(at.top, this.over.height, image.height); ++v) {
      for (let u = first(at.left); u < end(at.left, this.over.width, image.width); ++u) {
        const i = v * image.width + u;
        const value = array.values[i]!;
        const valid = scale !== undefined && Number.isFinite(value);
        if (valid && !numbers) continue;
        const bits = scale === undefined ? value : (flags?.[i] ?? 0);
        const text = valid ? fixed_text(value * factor, digits) : this.letters_of(greeting, bits, scale !== undefined);
        if (text === "") continue;
        const rgb: Rgb = [image.data[4 * i]!, image.data[4 * i + 1]!, image.data[4 * i + 2]!];
        over.font = valid || text.length > 2 ? small : letters;
        over.fillStyle = ink_on(rgb);
        over.fillText(text, at.left + (u + 0.5) * at.scale, at.top + (v + 0.54) * at.scale, 0.94 * at.scale);
      }
    }
  }

  /** Of a value that is not there the reason's letter; of bits the letters of all that are set. */
  private letters_of(greeting: Hello, bits: number, first_only: boolean): string {
    const set = greeting.invalid.filter((reason) => ((bits >>> reason.bit) & 1) !== 0).map((reason) => reason.letter);
    return first_only ? (set[0] ?? "?") : set.join("");
  }

  /** A frame around the pixel, white in black, and a cross of thin lines that leaves its surroundings free. */
  private draw_cursor(over: CanvasRenderingContext2D, at: Placement, point: Cursor, ratio: number): void {
    const side = Math.max(at.scale, 5 * ratio);
    const x = at.left + (point.u + 0.5) * at.scale;
    const y = at.top + (point.v + 0.5) * at.scale;
    const gap = side / 2 + 7 * ratio;
    const left = at.left;
    const right = at.left + (this.image?.width ?? 0) * at.scale;
    const top = at.top;
    const bottom = at.top + (this.image?.height ?? 0) * at.scale;
    const lines = (width: number, style: string): void => {
      over.lineWidth = width;
      over.strokeStyle = style;
      over.beginPath();
      if (x - gap > left) over.moveTo(left, y), over.lineTo(x - gap, y);
      if (x + gap < right) over.moveTo(x + gap, y), over.lineTo(right, y);
      if (y - gap > top) over.moveTo(x, top), over.lineTo(x, y - gap);
      if (y + gap < bottom) over.moveTo(x, y + gap), over.lineTo(x, bottom);
      over.stroke();
    };
    lines(3 * ratio, "rgb(0 0 0 / 0.22)");
    lines(1 * ratio, "rgb(255 255 255 / 0.6)");
    const frame = (grow: number, width: number, style: string): void => {
      over.lineWidth = width;
      over.strokeStyle = style;
      over.strokeRect(x - side / 2 - grow, y - side / 2 - grow, side + 2 * grow, side + 2 * grow);
    };
    frame(2 * ratio, 1.5 * ratio, "#000");
    frame(0.75 * ratio, 1.5 * ratio, "#fff");
  }
}

export function reason_color(greeting: Hello, reason: Reason | undefined): string {
  return css(reason?.color ?? greeting.invalid_color);
}
