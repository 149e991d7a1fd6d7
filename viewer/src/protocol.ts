// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the server says and what it is told: JSON texts, and a binary message for each frame. All of it is little-endian, 8-byte aligned.

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

export type Value = number | string | boolean | null | Value[];

export interface NamedValue {
  name: string;
  unit: string;
  value: Value;
}

export interface RawFrameReport {
  lit: boolean;
  modulation_frequency_hz: number | null;
  reference_phase_rad: number | null;
  integration_time_s: number | null;
  tap_a_e: number | null;
  tap_b_e: number | null;
  difference_e: number | null;
  raw_dn: number | null;
}

/** A way to unwrap the phases: how many whole cycles of each frequency. */
export interface Candidate {
  cycles: number[];
  range_m: number;
  /** What the decoder minimises. */
  cost: number;
  chosen?: boolean;
}

export interface Unwrapping {
  candidates: Candidate[];
  runner_up_ratio?: number | null;
}

/** What `tofray inspect FILE --pixel u,v --json` prints, as far as the page reads it. */
export interface PixelReport {
  truth?: { object?: string | null; range_m?: number | null } | null;
  raw_frames?: RawFrameReport[];
  depth?: { z_m?: number | null; range_m?: number | null; noise_m?: number | null } | null;
  unwrapping?: Unwrapping | null;
}

/** A number of a stage; `phase`: of which modulation frequency. */
export interface FlowValue {
  name: string;
  value: Value;
  unit?: string;
  phase?: number;
}

/** A stage of the way from light to depth. */
export interface Stage {
  stage: string;
  values: FlowValue[];
}

/** What one modulation frequency measured, as a complex number, and what direct light alone would have been. */
export interface Phasor {
  frequency_hz: number;
  unit?: string;
  i: number | null;
  q: number | null;
  sigma_i?: number | null;
  sigma_q?: number | null;
  covariance?: number | null;
  amplitude?: number | null;
  phase_rad?: number | null;
  truth_i?: number | null;
  truth_q?: number | null;
}

/** The correlation function over a period, at evenly spaced phases from 0 on, and what the raw frames measured of it. */
export interface Curve {
  frequency_hz: number;
  unit?: string;
  points: (number | null)[];
  samples: [number, number | null][];
}

export interface Pixel {
  type: "pixel";
  id: number;
  side?: Side;
  u: number;
  v: number;
  generation: number;
  frame: number;
  report: PixelReport;
  values: NamedValue[];
  why: string;
  flow?: Stage[];
  phasors?: Phasor[];
  curve?: Curve[];
}

export interface Cause {
  cause: string;
  mm: number | null;
  changes?: boolean;
}

/** An error split by what makes it: each is the error with it less the error without it. */
export interface Why {
  type: "why";
  id: number;
  side?: Side;
  u?: number;
  v?: number;
  region?: [number, number, number, number];
  generation?: number;
  frame?: number;
  /** With a depth, and of all: what the means are of. */
  pixels?: number;
  count?: number;
  error_m: number | null;
  sigma_m: number | null;
  causes: Cause[];
  rest_mm: number | null;
}

/** Of three numbers; rotations are three rows, from the camera's or the object's axes to the world's. */
export type Triple = readonly [number, number, number];
export type Rotation = readonly [Triple, Triple, Triple];

export interface Light3d {
  name: string;
  /** null: from far away. */
  position: Triple | null;
  direction: Triple;
  half_angle_rad: number | null;
  /** One of the camera's own. */
  camera?: boolean;
}

export interface Object3d {
  id: number;
  name: string;
  key?: string;
  kind?: string;
  /** Of its origin, about which it turns, in the world. */
  position: Triple;
  rotation: Rotation;
  /** Least x, y, z and greatest x, y, z, in the world; null: endless. */
  bounds: readonly number[] | null;
  movable: boolean;
  /** Why not. */
  why?: string;
}

/** What stands where, at a frame's time. */
export interface View3d {
  type: "view3d";
  id: number;
  side?: Side;
  generation: number;
  frame: number;
  camera: { position: Triple; rotation: Rotation; movable?: boolean; why?: string };
  /** Rays (x, y, 1) through the image's corners, in order around it. */
  frustum: readonly (readonly number[])[] | null;
  lights: Light3d[];
  objects: Object3d[];
  /** A binary message with the same id follows; else the last one holds. */
  static?: boolean;
  arrays?: string[];
}

/** What a gesture writes: applied as any other change. */
export interface Sets {
  type: "drag" | "place" | "camera";
  id: number;
  unsets?: string[];
  sets: Override[];
  what?: string;
}

export interface MeasuredPoint {
  u: number;
  v: number;
  measured: Triple | null;
  true: Triple | null;
  object?: number | null;
  /** The object's. */
  name?: string;
}

export interface Measured {
  type: "measure";
  id: number;
  side?: Side;
  generation: number;
  frame: number;
  a: MeasuredPoint;
  b: MeasuredPoint;
  measured_m: number | null;
  true_m: number | null;
  sigma_m: number | null;
}

export interface StatisticsRow {
  name: string;
  value: number | null;
  unit: string;
  definition?: string;
  /** Where there is no value: what it takes. */
  needs?: string;
}

export interface RegionStatistics {
  type: "region";
  id: number;
  side?: Side;
  generation: number;
  frame: number;
  region: [number, number, number, number];
  rows: StatisticsRow[];
}

/** Progress; with `sigma_median_m` it is the end, and the arrays follow. */
export interface Temporal {
  type: "temporal";
  id: number;
  side?: Side;
  generation?: number;
  frame?: number;
  frames: number;
  done: number;
  fill?: number | null;
  sigma_median_m?: number | null;
  predicted_median_m?: number | null;
  chi2?: number | null;
  arrays?: string[];
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

export type ServerMessage = Hello | State | ScaleMessage | Pixel | Fault | Stats | Controls | Done | Saved | Why | View3d | Sets | Measured | RegionStatistics | Temporal;

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
  | { type: "state"; id: number; side: Side; overrides: readonly Override[]; seed: number }
  | { type: "other"; id: number; overrides: readonly Override[] | null; seed?: number; scene?: string }
  | { type: "controls"; id: number; side: Side }
  | { type: "save"; id: number; side: Side };

export type Numbers = Uint8Array | Uint16Array | Int16Array | Uint32Array | Int32Array | Float32Array | Float64Array;

export interface FrameArray {
  id: number;
  dims: number[];
  values: Numbers;
}

export interface Frame {
  side: Side;
  /** No frame, but the arrays of the answer whose id is in `sequence`. */
  answers: boolean;
  generation: number;
  sequence: number;
  frame: number;
  time_s: number;
  width: number;
  height: number;
  draft: boolean;
  compute_ms: number;
  arrays: Map<number, FrameArray>;
}

const types = [Uint8Array, Uint16Array, Int16Array, Uint32Array, Float32Array, Int32Array, Float64Array] as const;
const header_bytes = 64;
const entry_bytes = 32;

function need(condition: boolean, what: string): asserts condition {
  if (!condition) throw new RangeError(`a frame that cannot be read: ${what}`);
}

/** The arrays are views of the message: nothing is copied.
 *  @throws RangeError where the message is not a whole frame */
export function read_frame(message: ArrayBuffer): Frame {
  need(message.byteLength >= header_bytes, `${message.byteLength} bytes`);
  const view = new DataView(message);
  const u16 = (at: number): number => view.getUint16(at, true);
  const u32 = (at: number): number => view.getUint32(at, true);
  need(u32(0) === 0x31564654, "it does not begin with TFV1");
  const header = u16(4);
  const count = u16(44);
  const channel = view.getUint8(6);
  need(header >= header_bytes && header + count * entry_bytes <= message.byteLength, `${count} arrays do not fit in`);
  const arrays = new Map<number, FrameArray>();
  for (let i = 0; i < count; ++i) {
    const at = header + i * entry_bytes;
    const id = u16(at);
    const type = types[view.getUint8(at + 2) - 1];
    const rank = view.getUint8(at + 3);
    const place = u32(at + 4);
    const bytes = u32(at + 8);
    need(type !== undefined, `array ${id} is of an unknown type`);
    need(rank <= 3, `array ${id} has ${rank} dimensions`);
    need(place % 8 === 0 && place + bytes <= message.byteLength, `array ${id} ends behind it`);
    const dims = [u32(at + 12), u32(at + 16), u32(at + 20)].slice(0, rank);
    const elements = dims.reduce((product, dim) => product * dim, 1);
    need(elements * type.BYTES_PER_ELEMENT === bytes, `array ${id} has ${bytes} bytes, its shape is ${dims.join(" × ")}`);
    arrays.set(id, { id, dims, values: new type(message, place, elements) });
  }
  return {
    side: (channel & 1) === 1 ? "b" : "a",
    answers: channel >= 2,
    generation: u32(8),
    sequence: u32(12),
    frame: Number(view.getBigUint64(16, true)),
    time_s: view.getFloat64(24, true),
    width: u32(32),
    height: u32(36),
    draft: (view.getUint8(7) & 1) !== 0,
    compute_ms: view.getFloat32(48, true),
    arrays,
  };
}
