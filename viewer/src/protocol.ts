// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the server says and what it is told, as JSON texts. What it answers to questions is in answers.ts, binary messages in wire.ts.

import type { Exported, Measured, Pixel, Recorded, RegionStatistics, Restored, Rotation, Screenshot, Sets, Temporal, Triple, View3d, Why } from "./answers";

export type * from "./answers";
export type { Frame, FrameArray, Numbers } from "./wire";

export type Rgb = readonly [number, number, number];

export interface Tick {
  at: number;
  label: string;
}

/** Which values have which colours. `low`, `high` and ticks are in the array's own unit; what people read is value · factor, in `unit`. */
export interface Scale {
  low: number;
  high: number;
  palette: "depth" | "grey" | "error";
  curve: "linear" | "sqrt";
  reverse?: boolean;
  factor?: number;
  unit: string;
  ticks: Tick[];
}

export interface ArrayInfo {
  name: string;
  unit: string;
  what: string;
  dtype: string;
  shape: string;
}

/** What a pane can show. Without a scale the array holds bits, each with its colour and letter in `Hello.invalid`. */
export interface PaneInfo {
  array: string;
  title: string;
  scale?: Scale | null;
}

export interface Reason {
  bit: number;
  name: string;
  letter: string;
  color: Rgb;
  advice: string;
}

export interface Palettes {
  depth: Rgb[];
  grey: Rgb[];
  error_near: Rgb[];
  error_far: Rgb[];
}

export type Side = "a" | "b";

/** One `--set KEY=TEXT`. */
export interface Override {
  key: string;
  text: string;
}

/** The second state, where one is open. */
export interface Other {
  generation: number;
  overrides: Override[];
  seed: number;
  command: string;
  scene?: string;
  camera?: string;
  mode?: string;
  width?: number;
  height?: number;
  phases?: number;
}

export interface Hello {
  type: "hello";
  protocol: number;
  version: string;
  build: string;
  scene: string;
  camera: string;
  mode: string;
  width: number;
  height: number;
  phases: number;
  frame_rate_hz: number;
  arrays: ArrayInfo[];
  panes: PaneInfo[];
  palettes: Palettes;
  invalid: Reason[];
  invalid_color: Rgb;
  command: string;
  generation: number;
  playing: boolean;
  frame: number;
  seed: number;
  overrides: Override[];
  other: Other | null;
  test_hooks?: boolean;
  /** Frames that were made before; else a scene, whose frames are computed. */
  source?: Source;
  /** How many frames there are; without it there is no end. */
  frames?: number;
  /** The first one's number. */
  first?: number;
  /** Arrays that the source has not, which a pane could show else. */
  absent?: Absent[];
  /** By type of message: why this source has no answer to it. */
  cannot?: Record<string, string>;
  /** In a page that is a file: the command that shows the same live. */
  live?: string;
}

export interface Source {
  kind: "files";
  name: string;
  /** Decoded here, by keys that can be changed. */
  raw?: boolean;
}

export interface Absent {
  array: string;
  title: string;
  why: string;
}

export interface State {
  type: "state";
  generation: number;
  playing: boolean;
  frame: number;
  seed: number;
  command: string;
  overrides: Override[];
  other: Other | null;
  scene?: string;
  camera?: string;
  mode?: string;
  width?: number;
  height?: number;
  phases?: number;
  frame_rate_hz?: number;
}

/** A key of scene or camera, its value in force, and how it can be changed. */
export interface Row {
  key: string;
  part: string;
  group: string;
  name: string;
  /** What the group is called: an object's name. */
  label?: string;
  kind: "number" | "integer" | "switch" | "choice" | "text" | "vector" | "list" | "part";
  unit?: string;
  units?: string[];
  low?: number;
  high?: number;
  choices?: string[];
  what?: string;
  /** As `--set` takes it; none where there is no value in force that can be typed. */
  text?: string;
  /** In the row's unit. */
  value?: number | number[];
  default?: string;
  /** The profile's own words of where the number is from. */
  source?: string;
  assumed?: boolean;
  log?: boolean;
  slider?: [number, number];
  /** false: what is in force excludes it. */
  settable?: boolean;
}

export interface Controls {
  type: "controls";
  id: number;
  generation: number;
  side?: Side;
  controls: Row[];
  left_out?: number;
}

/** A change was accepted. */
export interface Done {
  type: "done";
  id: number;
  generation: number;
}

export interface Saved {
  type: "saved";
  id: number;
  name: string;
  text: string;
}

export interface Fault {
  type: "fault";
  id: number | null;
  text: string;
  more?: string;
  key?: string;
}

export interface Stats {
  type: "stats";
  computed: number;
  sent: number;
  dropped: number;
  compute_ms: number;
  fps: number;
}

export interface ScaleMessage {
  type: "scale";
  array: string;
  scale: Scale;
}

export type ServerMessage = Hello | State | ScaleMessage | Pixel | Fault | Stats | Controls | Done | Saved | Why | View3d | Sets | Measured | RegionStatistics | Temporal | Recorded | Exported | Screenshot | Restored;

/** Frames a second: the camera's own, as many as there can be, or a number. */
export type Rate = "own" | "max" | number;

export type ClientMessage =
  | { type: "want"; arrays: string[]; rate: Rate }
  | { type: "visible"; visible: boolean }
  | { type: "ack"; sequence: number; channel?: 1 }
  | { type: "play" }
  | { type: "pause" }
  | { type: "seek"; frame: number }
  | { type: "pixel"; id: number; u: number; v: number; side?: Side }
  | { type: "why"; id: number; side?: Side; u: number; v: number }
  | { type: "why"; id: number; side?: Side; region: readonly [number, number, number, number] }
  | { type: "fit"; array: string }
  | { type: "view3d"; id: number; side?: Side }
  | { type: "drag"; id: number; side?: Side; object: number; from: readonly [number, number]; to: readonly [number, number]; how: "parallel" | "along" | "turn" | "scale"; base: number }
  | { type: "place"; id: number; side?: Side; object: number; position: Triple | null; rotation: Rotation | null; base: number }
  | { type: "camera"; id: number; side?: Side; position: Triple; rotation: Rotation; base: number }
  | { type: "measure"; id: number; side?: Side; a: readonly [number, number]; b: readonly [number, number] }
  | { type: "region"; id: number; side?: Side; region: readonly [number, number, number, number] }
  | { type: "temporal"; id: number; side?: Side; frames: number }
  | { type: "set"; id: number; side: Side; key: string; text: string }
  | { type: "unset"; id: number; side: Side; key: string }
  | { type: "seed"; id: number; side: Side; seed: number }
  | { type: "state"; id: number; side: Side; overrides: readonly Override[]; seed?: number }
  | { type: "other"; id: number; overrides: readonly Override[] | null; seed?: number; scene?: string }
  | { type: "controls"; id: number; side: Side }
  | { type: "save"; id: number; side: Side }
  | { type: "record"; id: number; side: Side; first: number; frames: number }
  | { type: "export"; id: number; first: number; frames: number }
  | { type: "record_stop"; id: number }
  | { type: "screenshot"; id: number; side: Side }
  | { type: "restore"; id: number; text: string };
