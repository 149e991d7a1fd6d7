// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the server answers to a question: of a pixel, of a region, of the scene, of many frames.

import type { Override, Side } from "./protocol";

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
  /** How many objects and lights did not go into the message. */
  left_out?: number;
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

export interface RecordedFile {
  name: string;
  bytes: number;
  sha256: string;
}

/** Progress; with `files` it is the end. */
export interface Recorded {
  type: "record";
  id: number;
  side?: Side;
  first?: number;
  frames: number;
  done: number;
  folder?: string;
  files?: RecordedFile[];
  /** How many more there are. */
  left_out?: number;
  /** What makes the same files. */
  command?: string;
}

/** Progress; with `file` it is the end. */
export interface Exported {
  type: "export";
  id: number;
  frames: number;
  done: number;
  file?: string;
  bytes?: number;
  command?: string;
}

export interface Screenshot {
  type: "screenshot";
  id: number;
  side?: Side;
  generation?: number;
  frame?: number;
  name: string;
  /** `png`: its bytes. */
  arrays: string[];
}

/** The state that a screenshot has with it. */
export interface Restored {
  type: "restore";
  id: number;
  overrides: Override[];
  seed: number;
  frame: number;
  /** What is another since then. */
  note?: string;
}
