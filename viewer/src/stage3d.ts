// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What draws in three dimensions, by the GPU (view3d.ts) or by the processor (splatter.ts), and what both are told. Points are z · (x, y, 1)
// of the camera's rays; nothing else is worked out here.

import { about, axis, cross, dot, minus_of, plus, turned, turned_back, unit, type Eye } from "./orbit";
import type { Numbers, Rgb, Rotation, Triple, View3d } from "./protocol";

/** What stays while neither scene nor lens change. */
export interface Static3d {
  width: number;
  height: number;
  rays: Float32Array;
  triangles: Float32Array;
  triangle_objects: Uint32Array;
}

export interface Cloud3d {
  width: number;
  height: number;
  z: Numbers;
  /** RGBA of each pixel. */
  colors: Uint8ClampedArray;
  truth: Numbers | undefined;
}

export type SceneStyle = "off" | "wire" | "solid";
export type Gizmo = "off" | "move" | "turn";

export interface Options3d {
  scene: SceneStyle;
  camera: boolean;
  lights: boolean;
  axes: boolean;
  gizmo: Gizmo;
  selected: number | undefined;
  light: boolean;     // a light page
}

export interface Drawn3d {
  fixed: Static3d | undefined;
  view: View3d | undefined;
  cloud: Cloud3d | undefined;
  eye: Eye;
  /** How far the camera sees [m]. */
  reach: number;
  options: Options3d;
  cursor: { u: number; v: number } | undefined;
  measure: readonly { u: number; v: number }[];
}

export interface GizmoMoves {
  begin(): void;
  move(position: Triple | undefined, rotation: Rotation | undefined): void;
  end(): void;
}

export interface Stage3d {
  /** In device pixels. */
  resize(width: number, height: number): void;
  draw(of: Drawn3d): void;
  /** RGBA as drawn, row by row from above. */
  pixels(of: Drawn3d): { width: number; height: number; pixels: Uint8ClampedArray };
  /** Whether the gizmo is where the pointer is. */
  holds_pointer(): boolean;
  dispose(): void;
}

/** A pixel's point of the world; undefined where it has no depth. */
export function point_of(of: Drawn3d, u: number, v: number): Triple | undefined {
  const { fixed, cloud, view } = of;
  if (fixed === undefined || cloud === undefined || view === undefined || fixed.width !== cloud.width || fixed.height !== cloud.height) return undefined;
  if (u < 0 || v < 0 || u >= cloud.width || v >= cloud.height) return undefined;
  const i = v * cloud.width + u;
  const z = cloud.z[i]!;
  if (!(z > 0) || !Number.isFinite(z)) return undefined;
  return plus(view.camera.position, turned(view.camera.rotation, [z * fixed.rays[2 * i]!, z * fixed.rays[2 * i + 1]!, z]));
}

const most_picked = 300_000;   // points that are looked through, where the pointer is

/** The pixel whose point is seen at a place of the picture, the nearest to the eye of those about it. */
export function pixel_near(of: Drawn3d, x: number, y: number, width: number, height: number, within: number): { u: number; v: number } | undefined {
  const { fixed, cloud, view, eye } = of;
  if (fixed === undefined || cloud === undefined || view === undefined || fixed.width !== cloud.width || fixed.height !== cloud.height) return undefined;
  let best: { i: number; cost: number } | undefined;
  const to = in_eye(view, eye);
  const stride = Math.max(1, Math.ceil(cloud.z.length / most_picked));
  for (let i = 0; i < cloud.z.length; i += stride) {
    const z = cloud.z[i]!;
    if (!(z > 0) || !Number.isFinite(z)) continue;
    const [a, b] = [z * fixed.rays[2 * i]!, z * fixed.rays[2 * i + 1]!];
    const depth = to[8]! * a + to[9]! * b + to[10]! * z + to[11]!;
    if (depth <= eye.near) continue;
    const px = (width * ((to[0]! * a + to[1]! * b + to[2]! * z + to[3]!) / depth - eye.left_edge)) / (eye.right_edge - eye.left_edge) - x;
    const py = (height * ((to[4]! * a + to[5]! * b + to[6]! * z + to[7]!) / depth - eye.top_edge)) / (eye.bottom_edge - eye.top_edge) - y;
    const off = Math.hypot(px, py);
    if (off > within) continue;
    const cost = depth * (1 + (0.05 * off) / within);
    if (best === undefined || cost < best.cost) best = { i, cost };
  }
  return best && { u: best.i % cloud.width, v: Math.floor(best.i / cloud.width) };
}

/** From the camera's axes to the eye's: three rows of four. */
export function in_eye(view: View3d, eye: Eye): number[] {
  const from = minus_of(view.camera.position, eye.position);
  return [eye.right, eye.down, eye.forward].flatMap((row) => [dot(row, axis(view.camera.rotation, 0)), dot(row, axis(view.camera.rotation, 1)), dot(row, axis(view.camera.rotation, 2)), dot(row, from)]);
}

/** The object that a ray from the eye meets first (Möller, Trumbore); an endless plane, such as a room's wall, only where it meets no other. Triangles are in their object's own axes, and so is the ray for each. */
export function object_along({ triangles: t, triangle_objects: objects }: Static3d, view: View3d, eye: Triple, way: Triple): number | undefined {
  const met = { bounded: { far: Infinity, id: undefined as number | undefined }, endless: { far: Infinity, id: undefined as number | undefined } };
  let own: { id: number; from: Triple; direction: Triple; kind: keyof typeof met } | undefined;
  const at = (k: number): Triple => [t[k]!, t[k + 1]!, t[k + 2]!];
  for (let i = 0; i < objects.length; ++i) {
    if (own?.id !== objects[i]) {
      const of = view.objects.find((one) => one.id === objects[i]);
      if (of === undefined) continue;
      own = { id: of.id, from: turned_back(of.rotation, minus_of(eye, of.position)), direction: turned_back(of.rotation, way), kind: of.bounds === null ? "endless" : "bounded" };
    }
    if (own === undefined) continue;
    const { from, direction, kind } = own;
    const a = at(9 * i);
    const [ab, ac] = [minus_of(at(9 * i + 3), a), minus_of(at(9 * i + 6), a)];
    const p = cross(direction, ac);
    const det = dot(ab, p);
    if (Math.abs(det) < 1e-12) continue;
    const s = minus_of(from, a);
    const u = dot(s, p) / det;
    if (u < 0 || u > 1) continue;
    const q = cross(s, ab);
    const v = dot(direction, q) / det;
    if (v < 0 || u + v > 1) continue;
    const far = dot(ac, q) / det;
    if (far > 1e-6 && far < met[kind].far) met[kind] = { far, id: own.id };
  }
  return met.bounded.id ?? met.endless.id;
}

// --- Lines: what both draw alike ---

/** Colours that are told apart also by who sees no red or green (Okabe and Ito). */
const object_colors: readonly Rgb[] = [[86, 180, 233], [230, 159, 0], [0, 158, 115], [240, 228, 66], [0, 114, 178], [213, 94, 0], [204, 121, 167]];

export function object_color(id: number): Rgb {
  return object_colors[id % object_colors.length]!;
}

/** Many wires close to each other are thin ones: what is measured is seen through them. */
export function wire_opacity(triangles: number): number {
  return triangles > 200 ? 0.16 : 0.5;
}

export const truth_color: Rgb = [64, 190, 170];
const axis_colors: readonly Rgb[] = [[240, 110, 100], [90, 190, 110], [110, 150, 255]];
const axis_names = ["x right", "y down", "z forward"] as const;

export interface Line3d {
  a: Triple;
  b: Triple;
  color: Rgb;
}

export interface Label3d {
  at: Triple;
  text: string;
}

function far_corners(view: View3d, reach: number): Triple[] {
  return (view.frustum ?? []).map(([x = 0, y = 0, z = 1]) => plus(view.camera.position, turned(view.camera.rotation, [(reach * x) / z, (reach * y) / z, reach])));
}

function box_lines(bounds: readonly number[], color: Rgb): Line3d[] {
  const corner = (i: number): Triple => [bounds[(i & 1) === 0 ? 0 : 3]!, bounds[(i & 2) === 0 ? 1 : 4]!, bounds[(i & 4) === 0 ? 2 : 5]!];
  return [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) => [1, 2, 4].filter((bit) => (i & bit) === 0).map((bit) => ({ a: corner(i), b: corner(i | bit), color })));
}

/** The edge of a cone of light, and four lines to it. */
function cone_lines(position: Triple, direction: Triple, half_angle: number, reach: number, color: Rgb): Line3d[] {
  const z = unit(direction);
  const x = unit(cross(Math.abs(z[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], z));
  const steps = 32;
  const angle = Math.min(half_angle, 1.4);
  const middle = plus(position, z, reach * Math.cos(angle));
  const rim = Array.from({ length: steps }, (_, i) => plus(middle, about(x, z, (2 * Math.PI * i) / steps), reach * Math.sin(angle)));
  return [
    ...rim.map((a, i) => ({ a, b: rim[(i + 1) % steps]!, color })),
    ...[0, 8, 16, 24].map((i) => ({ a: position, b: rim[i]!, color })),
  ];
}

/** Frustum, cones of light, axes, the chosen object's bounds, and what is measured. */
export function lines_of(of: Drawn3d): { lines: Line3d[]; labels: Label3d[] } {
  const { view, options, reach } = of;
  if (view === undefined) return { lines: [], labels: [] };
  const lines: Line3d[] = [];
  const labels: Label3d[] = [];
  const { position, rotation } = view.camera;
  const ink: Rgb = options.light ? [40, 44, 60] : [225, 228, 235];
  if (options.camera) {
    const corners = far_corners(view, reach);
    corners.forEach((a, i) => lines.push({ a: position, b: a, color: ink }, { a, b: corners[(i + 1) % corners.length]!, color: ink }));
  }
  if (options.lights) {
    for (const one of view.lights) {
      const color: Rgb = options.light ? [150, 95, 0] : [255, 200, 90];
      if (one.position === null) {   // parallel: an arrow to what the camera looks at
        const end = plus(position, axis(rotation, 2), 0.5 * reach);
        const from = plus(end, unit(one.direction), -0.5 * reach);
        lines.push({ a: from, b: end, color }, ...cone_lines(end, plus([0, 0, 0], unit(one.direction), -1), 0.3, 0.06 * reach, color));
        labels.push({ at: from, text: one.name });
        continue;
      }
      lines.push(...cone_lines(one.position, one.direction, one.half_angle_rad ?? 0.6, 0.35 * reach, color));
      labels.push({ at: one.position, text: one.name });
    }
  }
  if (options.axes) {
    for (const i of [0, 1, 2] as const) {
      const end = plus(position, axis(rotation, i), 0.18 * reach);
      lines.push({ a: position, b: end, color: axis_colors[i]! });
      labels.push({ at: end, text: axis_names[i]! });
    }
  }
  const chosen = view.objects.find((one) => one.id === options.selected);
  if (chosen !== undefined) {
    const bounds = chosen.bounds;
    if (bounds !== null) lines.push(...box_lines(bounds, options.light ? [58, 58, 168] : [255, 180, 84]));
    labels.push({ at: bounds === null ? chosen.position : [(bounds[0]! + bounds[3]!) / 2, bounds[1]!, (bounds[2]! + bounds[5]!) / 2], text: chosen.name });
  }
  const [a, b] = of.measure.map((one) => point_of(of, one.u, one.v));
  if (a !== undefined && b !== undefined) lines.push({ a, b, color: ink });
  return { lines, labels };
}
