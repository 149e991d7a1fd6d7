// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A pane's picture: the image, unsmoothed, and above it, on a canvas of its own, the cursor, letters and numbers.

import { signal } from "@preact/signals";
import { css, ink_on, paint } from "./colors";
import { difference_of, difference_scale, fit_difference, image_of, shown_by, type Shows, type Values } from "./compare";
import { digits_for, fixed_text } from "./numbers";
import type { Hello, Reason, Rgb, Scale, Side } from "./protocol";
import { raw_view } from "./raw";
import { array_of, canvas_size, cursor, fit_raw, frame_of, hello, of_b, region, scale_of, size, view, wipe, type Cursor, type Region } from "./store";
import { measure_ends, rectangle } from "./tools";
import { pins } from "./watch";
import { placement, type Placement } from "./view_port";

const sides: readonly Side[] = ["a", "b"];

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

/** An image with its colours, made again where something has changed. */
class Coat {
  /** Why pixels have no value, and how many: each reason that has occurred, so that the legend does not jump. */
  readonly shares = signal<readonly Share[]>([]);
  image: ImageData | undefined;
  values: Values | undefined;
  readonly buffer = document.createElement("canvas");
  private readonly seen = new Set<Reason | undefined>();
  private made: { of: readonly unknown[]; array: string; generation: string } | undefined;

  /** @param of  what the image is made of: the same is not coloured again */
  color(greeting: Hello, of: readonly unknown[], array: string, generation: string, values: () => Values | undefined, scale: Scale | undefined): void {
    const before = this.made;
    const all = [...of, scale, array];
    if (before !== undefined && all.every((one, i) => one === before.of[i])) return;
    const fresh = values();
    if (fresh === undefined) return;
    const { width, height } = fresh;
    if (this.image?.width !== width || this.image.height !== height) {
      this.image = new ImageData(width, height);
      this.buffer.width = width;
      this.buffer.height = height;
    }
    if (before?.array !== array || before.generation !== generation) this.seen.clear();
    const counts = paint(this.image.data, greeting, fresh.values, fresh.flags, scale);
    context_of(this.buffer).putImageData(this.image, 0, 0);
    this.values = fresh;
    this.made = { of: all, array, generation };
    for (const reason of counts.keys()) this.seen.add(reason);
    this.shares.value = [...greeting.invalid, undefined]
      .filter((reason) => this.seen.has(reason))
      .map((reason) => ({ reason, share: (counts.get(reason) ?? 0) / fresh.values.length }));
  }
}

export class Picture {
  array = "";
  /** What it shows now: to be read by who shows its legend. */
  readonly shows = signal<Shows>("a");

  private readonly front: HTMLCanvasElement;
  private readonly over: HTMLCanvasElement;
  private readonly coats = { a: new Coat(), b: new Coat(), difference: new Coat() };

  /** @param name  the array that is to be shown
   *  @param tile  one of many in a pane: its size is not that of panes */
  constructor(private readonly name: () => string | undefined, readonly side: Side, front: HTMLCanvasElement, over: HTMLCanvasElement, private readonly tile = false) {
    this.front = front;
    this.over = over;
    this.shows.value = side;
  }

  resize(width: number, height: number): void {
    for (const canvas of [this.front, this.over]) {
      canvas.width = Math.max(1, width);
      canvas.height = Math.max(1, height);
    }
    if (this.side === "a" && !this.tile) canvas_size.value = { width, height };
  }

  private get coat(): Coat {
    const shows = this.shows.peek();
    return this.coats[shows === "wipe" ? "a" : shows];
  }

  /** The image as coloured. */
  get image(): ImageData | undefined {
    return this.coat.image;
  }

  get values(): Values | undefined {
    return this.coat.values;
  }

  get shares(): readonly Share[] {
    const shows = this.shows.value;
    return this.coats[shows === "wipe" ? "a" : shows].shares.value;
  }

  /** The scale of what it shows. */
  get scale(): Scale | undefined {
    return this.shows.value === "difference" ? difference_scale(this.array) : scale_of(this.array);
  }

  where(): Placement | undefined {
    if (this.image === undefined) return undefined;
    const { width, height } = this.image;
    return placement(view.value, { width, height, canvas_width: this.front.width, canvas_height: this.front.height });
  }

  /** The point at a place on the screen [pixels of A's image], also beyond its edges: pixel (0, 0) is 0 … 1. */
  point_at(client_x: number, client_y: number): Cursor | undefined {
    const at = this.where();
    const box = this.front.getBoundingClientRect();
    if (at === undefined || box.width === 0) return undefined;
    const ratio = this.front.width / box.width;
    const of_a = size.value;
    return {
      u: (((client_x - box.left) * ratio - at.left) / at.scale) * (of_a.width / (this.image?.width ?? of_a.width)),
      v: (((client_y - box.top) * ratio - at.top) / at.scale) * (of_a.height / (this.image?.height ?? of_a.height)),
    };
  }

  /** Colours what is to be seen, where that is not done yet, and draws it. */
  draw(): void {
    const greeting = hello.value;
    const array = this.name();
    if (greeting === undefined || array === undefined) return;
    const shows = shown_by(this.side);
    if (array_of(frame_of(this.side), array) !== undefined) {
      this.array = array;
      this.shows.value = shows;
      if (shows === "difference") this.color_difference(greeting, array);
      else for (const side of shows === "wipe" ? sides : [shows]) this.color(greeting, array, side);
    }
    const front = context_of(this.front);
    front.clearRect(0, 0, this.front.width, this.front.height);
    if (this.shows.peek() === "wipe") {
      const at = Math.round(wipe.value * this.front.width);
      this.draw_image(front, this.coats.a, 0, at);
      this.draw_image(front, this.coats.b, at, this.front.width);
    } else {
      this.draw_image(front, this.coat, 0, this.front.width);
    }
    this.draw_over(greeting);
  }

  private draw_image(front: CanvasRenderingContext2D, coat: Coat, from: number, to: number): void {
    if (coat.image === undefined || to <= from) return;
    const { width, height } = coat.image;
    const at = placement(view.value, { width, height, canvas_width: this.front.width, canvas_height: this.front.height });
    front.save();
    front.beginPath();
    front.rect(from, 0, to - from, this.front.height);
    front.clip();
    front.imageSmoothingEnabled = false;
    front.drawImage(coat.buffer, at.left, at.top, at.scale * width, at.scale * height);
    front.restore();
  }

  private color(greeting: Hello, array: string, side: Side): void {
    const frame = frame_of(side);
    if (frame === undefined) return;
    const raw = raw_view(array);
    if (raw !== undefined && scale_of(array) === undefined) fit_raw(raw.kind);
    if (raw !== undefined && scale_of(array) === undefined) return;
    this.coats[side].color(greeting, [frame], array, String(frame.generation), () => image_of(frame, array), scale_of(array));
  }

  private color_difference(greeting: Hello, array: string): void {
    const [a, b] = [frame_of("a"), frame_of("b")];
    if (a === undefined || b === undefined) return;
    const raw = raw_view(array);
    if (raw !== undefined && scale_of(array) === undefined) fit_raw(raw.kind);
    if (scale_of(array) !== undefined && difference_scale(array) === undefined) fit_difference(array);
    this.coats.difference.color(greeting, [a, b], array, `${a.generation} ${b.generation}`, () => difference_of(a, b, array), difference_scale(array));
  }

  /** The cursor alone, without the image again. */
  private draw_over(greeting: Hello): void {
    const over = context_of(this.over);
    over.clearRect(0, 0, this.over.width, this.over.height);
    const at = this.where();
    if (at === undefined || this.image === undefined) return;
    const ratio = devicePixelRatio;
    if (at.scale >= letter_room * ratio) this.draw_letters(over, greeting, at, ratio);
    this.draw_saturated(over, greeting, at, ratio);
    this.draw_region(over, at, ratio, region.value, [5, 3]);
    this.draw_region(over, at, ratio, rectangle.value, []);
    this.draw_measure(over, at, ratio);
    this.draw_pins(over, at, ratio);
    const point = cursor.value && (this.side === "b" ? of_b(cursor.value) : cursor.value);
    if (point !== undefined) this.draw_cursor(over, at, point, ratio);
  }

  /** A frame around pixels, white in black, which are those of A. */
  private draw_region(over: CanvasRenderingContext2D, at: Placement, ratio: number, of: Region | undefined, dashes: readonly number[]): void {
    if (of === undefined) return;
    const there = (u: number, v: number): Cursor => (this.side === "b" ? of_b({ u, v }) : { u, v });
    const first = there(of.u0, of.v0);
    const last = there(of.u1, of.v1);
    const [x, y] = [at.left + first.u * at.scale, at.top + first.v * at.scale];
    const [width, height] = [(last.u - first.u + 1) * at.scale, (last.v - first.v + 1) * at.scale];
    over.setLineDash([]);
    over.lineWidth = 3 * ratio;
    over.strokeStyle = "#000";
    over.strokeRect(x, y, width, height);
    over.lineWidth = 1.25 * ratio;
    over.strokeStyle = "#fff";
    over.setLineDash(dashes.map((one) => one * ratio));
    over.strokeRect(x, y, width, height);
    over.setLineDash([]);
  }

  /** Of raw frames: the pixels that were full in one of them at least, by colour and stroke. */
  private draw_saturated(over: CanvasRenderingContext2D, greeting: Hello, at: Placement, ratio: number): void {
    const shows = this.shows.peek();
    const flags = this.coat.values?.flags;
    if (raw_view(this.array) === undefined || flags === undefined || this.image === undefined || shows === "wipe" || shows === "difference") return;
    const of = saturation_of(greeting);
    if (of === undefined) return;
    const { width } = this.image;
    const side = Math.max(at.scale, 2 * ratio);
    for (let i = 0; i < flags.length; ++i) {
      if (((flags[i]! >>> of.bit) & 1) === 0) continue;
      const [x, y] = [at.left + ((i % width) + 0.5) * at.scale - side / 2, at.top + (Math.floor(i / width) + 0.5) * at.scale - side / 2];
      if (x > this.over.width || y > this.over.height || x + side < 0 || y + side < 0) continue;
      over.fillStyle = css(of.color);
      if (side < letter_room * ratio) over.fillRect(x, y, side, side);
      if (side < 4 * ratio) continue;
      const line = Math.max(1, 0.12 * side);
      over.lineWidth = line;
      over.strokeStyle = "#000";
      over.beginPath();
      over.moveTo(x, y + side);
      over.lineTo(x + side, y);
      over.stroke();
      over.strokeStyle = css(of.color);
      over.strokeRect(x + line / 2, y + line / 2, side - line, side - line);
    }
  }

  /** A line between two pixels, with a ring at each end. */
  private draw_measure(over: CanvasRenderingContext2D, at: Placement, ratio: number): void {
    const ends = measure_ends().map((one) => (this.side === "b" ? of_b(one) : one)).map((one) => [at.left + (one.u + 0.5) * at.scale, at.top + (one.v + 0.5) * at.scale] as const);
    const [a, b] = ends;
    for (const [width, style] of [[4, "#000"], [1.75, "#fff"]] as const) {
      over.lineWidth = width * ratio;
      over.strokeStyle = style;
      over.beginPath();
      if (a !== undefined && b !== undefined) over.moveTo(...a), over.lineTo(...b);
      for (const [x, y] of ends) over.moveTo(x + 5 * ratio, y), over.arc(x, y, 5 * ratio, 0, 2 * Math.PI);
      over.stroke();
    }
  }

  /** A flag with the pin's number, whose foot is in the pixel's middle. */
  private draw_pins(over: CanvasRenderingContext2D, at: Placement, ratio: number): void {
    const radius = (this.tile ? 6 : 9) * ratio;
    over.font = `650 ${Math.round(1.35 * radius)}px system-ui, sans-serif`;
    over.textAlign = "center";
    over.textBaseline = "middle";
    for (const pin of pins.value) {
      const of = this.side === "b" ? of_b(pin) : pin;
      const x = at.left + (of.u + 0.5) * at.scale;
      const y = at.top + (of.v + 0.5) * at.scale;
      const below = y - 2.6 * radius < 0;   // there is no room above
      const middle = below ? y + 1.8 * radius : y - 1.8 * radius;
      over.beginPath();
      over.moveTo(x, y);
      over.lineTo(x, middle);
      over.lineWidth = 3 * ratio;
      over.strokeStyle = "#000";
      over.stroke();
      over.lineWidth = 1.25 * ratio;
      over.strokeStyle = "#fff";
      over.stroke();
      over.beginPath();
      over.arc(x, middle, radius, 0, 2 * Math.PI);
      over.fillStyle = "#fff";
      over.fill();
      over.lineWidth = 1.5 * ratio;
      over.strokeStyle = "#000";
      over.stroke();
      over.fillStyle = "#000";
      over.fillText(String(pin.number), x, middle + 0.06 * radius);
    }
  }

  private draw_letters(over: CanvasRenderingContext2D, greeting: Hello, at: Placement, ratio: number): void {
    const { image, values: array } = this.coat;
    if (array === undefined || image === undefined || this.shows.peek() === "wipe") return;
    const flags = array.flags;
    const scale = this.scale;
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

/** Why a pixel is full. */
export function saturation_of(greeting: Hello): Reason | undefined {
  return greeting.invalid.find((one) => one.name === "saturated");
}

export function reason_color(greeting: Hello, reason: Reason | undefined): string {
  return css(reason?.color ?? greeting.invalid_color);
}
