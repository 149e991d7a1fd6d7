// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What answers in a page that is one file: frames and answers that `tofray view --export` has put into it, in the place of a server's.
// Nothing is fetched, and nothing is computed but which frame is next.

import type { Receiver } from "./connection";
import type { ClientMessage, Controls, Hello, NamedValue, Pixel, Saved, ScaleMessage, ServerMessage, View3d } from "./protocol";
import { read_frame } from "./wire";

interface Contents {
  format: number;
  hello: Hello;
  /** The numbers of the frames, in order. */
  frames: number[];
  encoding: "base64" | "deflate";
  /** Of each frame what `fit` would have said. */
  scales?: Omit<ScaleMessage, "type">[][];
  controls?: Controls | null;
  saved?: Saved | null;
  /** Of each frame. */
  view3d?: View3d[];
  /** The command that shows the same live. */
  live: string;
}

/** Messages that only a running program has answers to. */
const live_only = ["set", "unset", "seed", "state", "other", "why", "drag", "place", "camera", "measure", "region", "temporal", "record", "export", "screenshot", "restore"];
const own_rate_hz = 5;   // where the camera has none

function contents(): Contents {
  const text = document.getElementById("tofray-export")?.textContent;
  if (text == null) throw new Error("this file has no frames in it: tofray view SCENE --export FILE makes one that has");
  const of = JSON.parse(text) as Contents;
  if (of.format !== 1) throw new Error(`this file's frames are of form ${of.format}, and its page reads form 1`);
  return of;
}

async function bytes_of(block: Element | null | undefined, encoding: string): Promise<ArrayBuffer> {
  const text = atob(block?.textContent?.trim() ?? "");
  const bytes = Uint8Array.from(text, (one) => one.charCodeAt(0));
  if (encoding === "base64") return bytes.buffer;
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

export class FileLine {
  private readonly of = contents();
  private readonly blocks = [...document.querySelectorAll("script.tofray-frame")];
  private readonly messages: (Promise<ArrayBuffer> | undefined)[] = [];
  private at = 0;
  private playing = false;
  private hidden = false;
  private wanted = false;
  private rate: "own" | "max" | number = "own";
  private has_static = false;   // the page has the scene's arrays
  private timer: number | undefined;

  /** @throws Error where the file has nothing that can be read */
  constructor(private readonly to: Receiver) {
    if (this.of.frames.length === 0 || this.of.frames.length !== this.blocks.length) throw new Error(`this file names ${this.of.frames.length} frames, and ${this.blocks.length} are in it`);
  }

  begin(): void {
    const { hello, live, saved, controls, view3d, frames } = this.of;
    const why = `This page is a file. To change and measure, run ${live}`;
    const missing = [...live_only, ...(saved == null ? ["save"] : []), ...(controls == null ? ["controls"] : []), ...(view3d === undefined ? ["view3d"] : [])];
    this.say({ ...hello, playing: false, frame: frames[0]!, other: null, frames: frames.length, first: frames[0]!, live, cannot: Object.fromEntries(missing.map((type) => [type, why])) });
  }

  send(message: ClientMessage): void {
    const { hello, controls, saved } = this.of;
    switch (message.type) {
      case "want":
        this.rate = message.rate;
        if (!this.wanted) this.show();
        this.wanted = true;
        return this.go_on();
      case "visible":
        this.hidden = !message.visible;
        return this.go_on();
      case "ack":
      case "record_stop": return;
      case "play":
      case "pause":
        this.playing = message.type === "play";
        this.say_state();
        return this.go_on();
      case "seek": return this.seek(message.frame);
      case "fit": return this.fit(message.array);
      case "pixel": return void this.pixel(message.id, message.u, message.v);
      case "view3d": return void this.view3d(message.id);
      case "controls":
        if (controls != null) return this.say({ ...controls, id: message.id, generation: hello.generation });
        break;
      case "save":
        if (saved != null) return this.say({ ...saved, id: message.id });
    }
    this.say({ type: "fault", id: "id" in message ? message.id : null, text: "This page is a file: nothing computes behind it.", more: `Live: ${this.of.live}` });
  }

  /** As from a server: not before the caller has gone on. */
  private say(message: ServerMessage): void {
    setTimeout(() => this.to.text(message));
  }

  private say_state(): void {
    const { generation, seed, overrides, scene } = this.of.hello;
    const frame = this.of.frames[this.at]!;
    const command = `${this.of.hello.command.replace(/ --first-frame \d+$/, "")}${frame === 0 ? "" : ` --first-frame ${frame}`}`;
    this.say({ type: "state", generation, playing: this.playing, frame, seed, command, overrides, scene, other: null });
  }

  private message(at: number): Promise<ArrayBuffer> {
    return (this.messages[at] ??= bytes_of(this.blocks[at], this.of.encoding));
  }

  private show(): void {
    const at = this.at;
    void this.message(at).then((bytes) => {
      if (at === this.at) this.to.binary(bytes);
    }, (error: unknown) => this.say({ type: "fault", id: null, text: `Frame ${this.of.frames[at]} of this file cannot be read.`, more: String(error) }));
  }

  /** The frame of that number, or the nearest one that there is. */
  private seek(frame: number): void {
    const off = this.of.frames.map((one) => Math.abs(one - frame));
    this.at = off.indexOf(Math.min(...off));
    this.say_state();
    this.show();
  }

  private go_on(): void {
    clearTimeout(this.timer);
    if (!this.playing || this.hidden || !this.wanted || this.of.frames.length < 2) return;
    const own = this.of.hello.frame_rate_hz > 0 ? this.of.hello.frame_rate_hz : own_rate_hz;
    const hz = this.rate === "own" ? own : this.rate === "max" ? 60 : this.rate;
    this.timer = setTimeout(() => {
      this.at = (this.at + 1) % this.of.frames.length;
      this.show();
      this.go_on();
    }, 1000 / hz);
  }

  private fit(array: string): void {
    const scale = this.of.scales?.[this.at]?.find((one) => one.array === array);
    if (scale !== undefined) this.say({ type: "scale", ...scale });
    else this.say({ type: "fault", id: null, text: `This file has no other range of colours for ${array}.`, more: `Live: ${this.of.live}` });
  }

  /** What the frame's arrays have of it. */
  private async pixel(id: number, u: number, v: number): Promise<void> {
    const { hello } = this.of;
    const frame = read_frame(await this.message(this.at));
    const values: NamedValue[] = [];
    let why = "";
    for (const [number, { dims, values: numbers }] of frame.arrays) {
      const of = hello.arrays[number];
      if (of === undefined || dims.length !== 2 || dims[0] !== frame.height || dims[1] !== frame.width) continue;
      const value = numbers[v * frame.width + u] ?? NaN;
      values.push({ name: of.name, unit: of.unit, value: Number.isFinite(value) ? value : null });
      if (of.name === "flags" && value !== 0) why = hello.invalid.find((one) => ((value >>> one.bit) & 1) !== 0)?.name ?? "";
    }
    const answer: Pixel = { type: "pixel", id, side: "a", u, v, generation: frame.generation, frame: frame.frame, report: {}, values, why };
    this.to.text(answer);
  }

  private async view3d(id: number): Promise<void> {
    const of = this.of.view3d?.[this.at] ?? this.of.view3d?.[0];
    const block = document.getElementById("tofray-static");
    if (of === undefined) return this.say({ type: "fault", id, text: "This file has no scene in 3D.", more: `Live: ${this.of.live}` });
    const { static: _, arrays: __, ...text } = of;
    const arrays = this.of.view3d?.find((one) => one.arrays !== undefined)?.arrays;   // they are the same for all frames
    if (block === null || arrays === undefined || this.has_static) return this.say({ ...text, id });
    const bytes = await bytes_of(block, this.of.encoding);
    this.to.text({ ...text, id, static: true, arrays });
    new DataView(bytes).setUint32(12, id, true);   // an answer's arrays have its id
    this.has_static = true;
    this.to.binary(bytes);
  }
}
