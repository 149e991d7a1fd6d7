// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// From where the 3D pane looks: a point that is looked at, and an eye that goes around it. Axes are the camera's (x right, y down, z
// forward), the vertical stays vertical.

import type { Rotation, Triple } from "./protocol";

export interface Orbit {
  target: Triple;
  /** Distance of the eye from it [m]. */
  distance: number;
  /** Where the eye looks: 0, 0 along z; yaw to the right, pitch down [rad]. */
  yaw: number;
  pitch: number;
}

/** An eye, and what it sees: the edges of its picture at depth 1. */
export interface Eye {
  position: Triple;
  right: Triple;
  down: Triple;
  forward: Triple;
  left_edge: number;
  right_edge: number;
  top_edge: number;
  bottom_edge: number;
  near: number;
  far: number;
}

const half_height = Math.tan((22.5 * Math.PI) / 180);   // of the picture at depth 1
const steepest = 0.49 * Math.PI;

export function plus(a: Triple, b: Triple, by = 1): Triple {
  return [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]];
}

export function minus_of(a: Triple, b: Triple): Triple {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function dot(a: Triple, b: Triple): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Triple, b: Triple): Triple {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Triple): number {
  return Math.hypot(...a);
}

export function unit(a: Triple): Triple {
  const by = 1 / (length(a) || 1);
  return [a[0] * by, a[1] * by, a[2] * by];
}

/** A column of a rotation: where one of its own axes points in the world. */
export function axis(of: Rotation, i: 0 | 1 | 2): Triple {
  return [of[0][i], of[1][i], of[2][i]];
}

/** Of columns. */
export function rotation_of(x: Triple, y: Triple, z: Triple): Rotation {
  return [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
}

export function turned(of: Rotation, v: Triple): Triple {
  return [dot(of[0], v), dot(of[1], v), dot(of[2], v)];
}

/** By the inverse. */
export function turned_back(of: Rotation, v: Triple): Triple {
  return [dot(axis(of, 0), v), dot(axis(of, 1), v), dot(axis(of, 2), v)];
}

/** Rodrigues: a vector turned about a unit axis. */
export function about(v: Triple, around: Triple, angle: number): Triple {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return plus(plus(plus([0, 0, 0], v, c), cross(around, v), s), around, dot(around, v) * (1 - c));
}

function basis(of: Orbit): { right: Triple; down: Triple; forward: Triple } {
  const forward: Triple = [Math.sin(of.yaw) * Math.cos(of.pitch), Math.sin(of.pitch), Math.cos(of.yaw) * Math.cos(of.pitch)];
  const right: Triple = [Math.cos(of.yaw), 0, -Math.sin(of.yaw)];
  return { right, down: cross(forward, right), forward };
}

export function eye_of(of: Orbit, aspect: number): Eye {
  const axes = basis(of);
  return {
    ...axes, position: plus(of.target, axes.forward, -of.distance),
    left_edge: -aspect * half_height, right_edge: aspect * half_height, top_edge: -half_height, bottom_edge: half_height,
    near: 0.005 * of.distance, far: 200 * of.distance,
  };
}

/** Through a camera: all of its image, in the middle of the picture.
 *  @param corners  rays (x, y, 1) through the image's corners */
export function eye_through(position: Triple, rotation: Rotation, corners: readonly (readonly number[])[], aspect: number): Eye {
  const [xs, ys] = [0, 1].map((i) => corners.map((one) => one[i]! / (one[2] ?? 1))) as [number[], number[]];
  const edges = { left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) };
  const [width, height] = [edges.right - edges.left, edges.bottom - edges.top];
  const beside = Math.max(0, (aspect * height - width) / 2);
  const above = Math.max(0, (width / aspect - height) / 2);
  return {
    position, right: axis(rotation, 0), down: axis(rotation, 1), forward: axis(rotation, 2),
    left_edge: edges.left - beside, right_edge: edges.right + beside, top_edge: edges.top - above, bottom_edge: edges.bottom + above,
    near: 0.01, far: 1000,
  };
}

/** Obliquely from behind a camera, so that what it sees and itself are in the picture. @param depth  of what it looks at [m] */
export function beside_camera(position: Triple, rotation: Rotation, depth: number): Orbit {
  const forward = axis(rotation, 2);
  const level = Math.atan2(forward[0], forward[2]);
  const dip = Math.asin(Math.max(-1, Math.min(1, forward[1])));
  return { target: plus(position, forward, 0.55 * depth), distance: 1.55 * depth, yaw: level - 0.55, pitch: Math.min(1.3, Math.max(-1.3, dip + 0.4)) };
}

/** Pixels that the pointer moved: the scene turns with it. */
export function orbited(of: Orbit, dx: number, dy: number): Orbit {
  const per_pixel = 0.006;
  return { ...of, yaw: of.yaw + per_pixel * dx, pitch: Math.min(steepest, Math.max(-steepest, of.pitch + per_pixel * dy)) };
}

/** Pixels that the pointer moved, of a picture so high: what is looked at goes with it. */
export function panned(of: Orbit, dx: number, dy: number, height: number): Orbit {
  const metres = (2 * half_height * of.distance) / Math.max(1, height);
  const { right, down } = basis(of);
  return { ...of, target: plus(plus(of.target, right, -dx * metres), down, -dy * metres) };
}

export function nearer(of: Orbit, factor: number): Orbit {
  return { ...of, distance: Math.min(1e4, Math.max(0.01, of.distance / factor)) };
}

/** Where a point is in the picture of an eye: pixels from its upper left corner, and its depth. */
export function projected(eye: Eye, point: Triple, width: number, height: number): { x: number; y: number; depth: number } {
  const from = minus_of(point, eye.position);
  const depth = dot(from, eye.forward);
  return {
    x: (width * (dot(from, eye.right) / depth - eye.left_edge)) / (eye.right_edge - eye.left_edge),
    y: (height * (dot(from, eye.down) / depth - eye.top_edge)) / (eye.bottom_edge - eye.top_edge),
    depth,
  };
}

/** The direction in which a place of the picture is seen. */
export function direction_at(eye: Eye, x: number, y: number, width: number, height: number): Triple {
  const across = eye.left_edge + (x / width) * (eye.right_edge - eye.left_edge);
  const down = eye.top_edge + (y / height) * (eye.bottom_edge - eye.top_edge);
  return unit(plus(plus(eye.forward, eye.right, across), eye.down, down));
}
