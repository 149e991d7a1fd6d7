// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the 3D panes show, one for all of them: where things are, from where it is looked at, and what of it is drawn.

import { computed, effect, signal } from "@preact/signals";
import { cloud_color } from "./cloud";
import { Following } from "./follow";
import { beside_camera, type Orbit } from "./orbit";
import type { Side, View3d } from "./protocol";
import type { Gizmo, SceneStyle, Static3d } from "./stage3d";
import { comparing, edited, flipped, other, scale_of, shown, temporal_titles } from "./store";

export const with_truth = signal(false);
export const scene_style = signal<SceneStyle>("wire");
export const with_camera = signal(true);
export const with_lights = signal(false);
export const with_axes = signal(true);
export const gizmo = signal<Gizmo>("off");
export const selected = signal<number | undefined>(undefined);   // an object's id
/** Through the camera; else as the orbit says. */
export const through = signal(false);
export const orbit = signal<Orbit | undefined>(undefined);       // undefined: as chosen from the camera

const space_shown = computed(() => shown.value.some((name) => cloud_color(name) !== undefined));

/** A 3D pane shows one state: that which controls change, or the one that flipping shows; B while its key is held down. */
export const space_side = computed<Side>(() => (other.value === undefined ? "a" : comparing.value === "flip" ? (flipped.value ? "b" : "a") : flipped.value ? "b" : edited.value));

export const fixed: Record<Side, Static3d | undefined> = { a: undefined, b: undefined };
export const fixed_count = signal(0);

const least_pause_ms = 60;

const following: Record<Side, Following<object, View3d>> = { a: follow("a"), b: follow("b") };

function follow(side: Side): Following<object, View3d> {
  const message = (_: object, of: Side) => ({ type: "view3d" as const, ...(of === "b" ? { side: of } : {}) });
  return new Following<object, View3d>(message, () => side, least_pause_ms, () => space_shown.value && space_side.value === side, (_, arrays) => {
    const [rays, triangles, ids] = ["rays", "triangles", "triangle_objects"].map((name) => arrays?.get(name));
    if (rays === undefined) return;
    fixed[side] = {
      height: rays.dims[0] ?? 0, width: rays.dims[1] ?? 0, rays: rays.values as Float32Array,
      triangles: (triangles?.values as Float32Array | undefined) ?? new Float32Array(0), triangle_objects: (ids?.values as Uint32Array | undefined) ?? new Uint32Array(0),
    };
    ++fixed_count.value;
  });
}

export function view3d_of(side: Side): View3d | undefined {
  return following[side].answer.value;
}

export function view3d_fault(side: Side) {
  return following[side].fault.value;
}

/** The arrays of the wire that a pane of points needs; undefined: it is another pane. */
export function arrays_for_space(name: string): readonly string[] | undefined {
  const color = cloud_color(name);
  if (color !== undefined) return ["z_m", color, ...(with_truth.value ? ["gt_z_m"] : [])];
  return name in temporal_titles ? [] : undefined;
}

/** How far the camera sees, for what is drawn of it [m]. */
export function reach(): number {
  const high = scale_of("z_m")?.high ?? 3;
  return high > 0 && Number.isFinite(high) ? high : 3;
}

/** The orbit, or where it begins. */
export function orbit_now(side: Side): Orbit {
  if (orbit.value !== undefined) return orbit.value;
  const camera = view3d_of(side)?.camera;
  return camera === undefined ? { target: [0, 0, 1], distance: 3, yaw: -0.6, pitch: 0.4 } : beside_camera(camera.position, camera.rotation, reach());
}

export function selected_object(side: Side) {
  return view3d_of(side)?.objects.find((one) => one.id === selected.value);
}

/** Another server, or another scene of B: what is known is of no use. */
export function forget_space(side: Side): void {
  following[side].forget();
  fixed[side] = undefined;
  if (side === "a") orbit.value = selected.value = undefined;
}

export function start_space(): void {
  for (const side of ["a", "b"] as const) {
    following[side].start();
    following[side].put({});
  }
  let scene: string | undefined;
  effect(() => {
    const now = other.value === undefined ? undefined : other.value.scene ?? "";
    if (now !== scene) forget_space("b");
    scene = now;
  });
}
