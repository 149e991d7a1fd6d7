// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A 3D pane on the page: which of the two draws it, what a pointer and keys do to it, and names where things are.

import { effect, signal } from "@preact/signals";
import { paint } from "./colors";
import { image_of } from "./compare";
import { shown_array } from "./cloud";
import { begin_move, end_move, move } from "./hands";
import { accepted } from "./edit";
import { draw_soon, spaces } from "./loop";
import {
  about, axis, direction_at, eye_of, eye_through, nearer, orbited, panned, plus, projected, rotation_of, turned, type Eye,
} from "./orbit";
import type { Frame, Rotation, Side, Triple } from "./protocol";
import { fixed, fixed_count, gizmo, orbit, orbit_now, reach, scene_style, selected, space_side, through, view3d_of, with_axes, with_camera, with_lights, with_truth } from "./space";
import { Splatter } from "./splatter";
import { lines_of, object_along, pixel_near, point_of, type Cloud3d, type Drawn3d, type Stage3d } from "./stage3d";
import { array_of, cursor, frame_of, hello, letter_keys, of_b, point_at, scale_of, shown, spoken } from "./store";
import { measure_at, measure_ends, tool } from "./tools";

export type Drawing = "loading" | "WebGL" | "processor";

const still_px = 3;
const pick_px = 10;
const key_pause_ms = 500;   // key presses that follow each other are one gesture

const dark = matchMedia("(prefers-color-scheme: dark)");

interface Pose {
  position: Triple;
  rotation: Rotation;
}

/** What is moved by keys, or the camera by a drag: where it was asked to be last. Steps that follow each other are one gesture. */
let held: { what: "camera" | number; side: Side; pose: Pose; timer: number | undefined } | undefined;

function release(): void {
  if (held?.timer === undefined) return;
  clearTimeout(held.timer);
  held.timer = undefined;
  end_move();
}

/** The pose of the camera, or of an object, as far as it is known: where it was moved to, until the server has said so. */
function pose_now(side: Side, what: "camera" | number): Pose | undefined {
  const view = view3d_of(side);
  if (view === undefined) return undefined;
  if (held !== undefined && held.what === what && held.side === side && (held.timer !== undefined || view.generation < accepted[side])) return held.pose;
  return what === "camera" ? view.camera : view.objects.find((one) => one.id === what);
}

function move_held(side: Side, what: "camera" | number, pose: Pose): void {
  if (held?.timer === undefined || held.what !== what || held.side !== side) {
    release();
    begin_move(side);
  }
  clearTimeout(held?.timer);
  held = { what, side, pose, timer: setTimeout(release, key_pause_ms) };
  move(what === "camera" ? { type: "camera", position: pose.position, rotation: pose.rotation } : { type: "place", object: what, position: pose.position, rotation: null });
}

/** About the vertical to the right, and about its own right-hand axis downward. */
function turned_camera(of: Rotation, right: number, down: number): Rotation {
  const turn = (v: Triple): Triple => about(v, [0, 1, 0], right);
  const [x, y, z] = [axis(of, 0), axis(of, 1), axis(of, 2)].map(turn) as [Triple, Triple, Triple];
  return rotation_of(x, about(y, x, -down), about(z, x, -down));
}

export class SpaceView {
  readonly drawing = signal<Drawing>("loading");
  /** Why it is the processor that draws. */
  readonly sentence = signal("");
  private stage: Stage3d | undefined;
  private gone = false;
  private width = 1;
  private height = 1;
  private cloud: { of: readonly unknown[]; cloud: Cloud3d } | undefined;
  private last: Drawn3d | undefined;
  private readonly end: (() => void)[] = [];
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private drag: { moved: boolean; pans: boolean; x: number; y: number } | undefined;
  private camera_drag: { rotation: Rotation; position: Triple; dx: number; dy: number } | undefined;

  /** @param outer  has the focus and the pointers; `inner` in it is where the gizmo listens */
  constructor(private readonly pane: number, private readonly outer: HTMLElement, private readonly inner: HTMLElement, private readonly gpu: HTMLCanvasElement, private readonly flat: HTMLCanvasElement, private readonly labels: HTMLElement, private readonly marks: HTMLElement) {
    spaces.set(pane, this);
    this.listen();
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(outer);
    this.end.push(() => observer.disconnect());
    this.end.push(effect(() => {
      void [view3d_of("a"), view3d_of("b"), fixed_count.value, orbit.value, through.value, with_truth.value, scene_style.value, with_camera.value, with_lights.value, with_axes.value];
      void [gizmo.value, selected.value, space_side.value, cursor.value];
      draw_soon();
    }));
    dark.addEventListener("change", draw_soon);
    this.end.push(() => dark.removeEventListener("change", draw_soon));
    void this.begin();
  }

  private async begin(): Promise<void> {
    // Asked here, before anything is fetched: without WebGL none of it is of use.
    const context = this.gpu.getContext("webgl2", { alpha: false, antialias: true });
    if (context === null) return this.by_processor("no WebGL: drawn by the processor");
    this.gpu.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.by_processor("WebGL was lost: drawn by the processor");
    });
    this.gpu.addEventListener("webglcontextrestored", () => void this.by_gpu());
    await this.by_gpu();
  }

  private async by_gpu(): Promise<void> {
    const loaded = await import("./view3d").catch(() => undefined);
    if (this.gone) return;
    if (loaded === undefined) return this.by_processor("view3d.js could not be fetched: drawn by the processor");
    try {
      const { gpu_stage } = loaded;
      const fresh = gpu_stage(this.gpu, this.inner, draw_soon, {
        begin: () => begin_move(space_side.peek()),
        move: (position, rotation) => {
          const object = selected.peek();
          if (object !== undefined) move({ type: "place", object, position: position ?? null, rotation: rotation ?? null });
        },
        end: end_move,
      });
      this.use(fresh, "WebGL", "");
    } catch {
      this.by_processor("no WebGL: drawn by the processor");
    }
  }

  private by_processor(sentence: string): void {
    if (!this.gone) this.use(new Splatter(this.flat), "processor", sentence);
  }

  private use(stage: Stage3d, drawing: Drawing, sentence: string): void {
    this.stage?.dispose();
    this.stage = stage;
    this.drawing.value = drawing;
    this.sentence.value = sentence;
    this.gpu.hidden = drawing !== "WebGL";
    this.flat.hidden = drawing === "WebGL";
    stage.resize(this.width, this.height);
    draw_soon();
  }

  private resize(): void {
    if (this.outer.clientWidth === 0) return;
    this.width = Math.round(this.outer.clientWidth * devicePixelRatio);
    this.height = Math.round(this.outer.clientHeight * devicePixelRatio);
    this.stage?.resize(this.width, this.height);
    draw_soon();
  }

  private cloud_of(frame: Frame): Cloud3d | undefined {
    const greeting = hello.peek();
    const array = shown_array(shown.peek()[this.pane] ?? "z_m");
    const z = image_of(frame, "z_m");
    const colored = image_of(frame, array);
    if (greeting === undefined || z === undefined || colored === undefined || colored.values.length !== z.values.length) return this.cloud?.cloud;
    const scale = scale_of(array);
    const truth = with_truth.peek() ? array_of(frame, "gt_z_m")?.values : undefined;
    const of = [frame, array, scale, truth];
    if (this.cloud?.of.every((one, i) => one === of[i]) === true) return this.cloud.cloud;
    const colors = new Uint8ClampedArray(4 * z.values.length);
    paint(colors, greeting, colored.values, colored.flags, scale);
    const cloud = { width: z.width, height: z.height, z: z.values, colors, truth };
    this.cloud = { of, cloud };
    return cloud;
  }

  eye(side: Side): Eye {
    const aspect = this.width / Math.max(1, this.height);
    const view = view3d_of(side);
    const camera = pose_now(side, "camera");
    if (through.peek() && view?.frustum != null && camera !== undefined) return eye_through(camera.position, camera.rotation, view.frustum, aspect);
    return eye_of(orbit_now(side), aspect);
  }

  private drawn(): Drawn3d {
    const side = space_side.peek();
    const frame = frame_of(side);
    const at = cursor.peek();
    const there = (one: { u: number; v: number }) => (side === "b" ? of_b(one) : one);
    return {
      fixed: fixed[side], view: view3d_of(side), cloud: frame && this.cloud_of(frame), eye: this.eye(side), reach: reach(),
      options: {
        scene: scene_style.peek(), camera: with_camera.peek() && !through.peek(), lights: with_lights.peek(), axes: with_axes.peek() && !through.peek(), gizmo: gizmo.peek(),
        selected: selected.peek(), light: !dark.matches,
      },
      cursor: at && there(at), measure: measure_ends().map(there),
    };
  }

  draw(): void {
    if (this.stage === undefined) return;
    const of = this.drawn();
    this.last = of;
    this.stage.draw(of);
    this.write_labels(of);
    this.mark(of);
  }

  /** A ring about the cursor's point, and one about each end that is measured: above all else, so that nothing hides it. */
  private mark(of: Drawn3d): void {
    const rings = [...(of.cursor === undefined ? [] : [{ kind: "cursor", at: of.cursor }]), ...of.measure.map((at) => ({ kind: "end", at }))];
    while (this.marks.children.length > rings.length) this.marks.lastElementChild?.remove();
    rings.forEach(({ kind, at }, i) => {
      const ring = (this.marks.children[i] ?? this.marks.appendChild(document.createElement("i"))) as HTMLElement;
      const point = point_of(of, at.u, at.v);
      const place = point && projected(of.eye, point, this.width, this.height);
      ring.className = kind;
      ring.hidden = place === undefined || place.depth <= of.eye.near;
      if (place !== undefined) ring.style.transform = `translate(${(place.x / devicePixelRatio).toFixed(1)}px, ${(place.y / devicePixelRatio).toFixed(1)}px)`;
    });
  }

  private write_labels(of: Drawn3d): void {
    const ratio = devicePixelRatio;
    const all = lines_of(of).labels.map((one) => ({ ...projected(of.eye, one.at, this.width, this.height), text: one.text }))
      .filter((one) => one.depth > of.eye.near && one.x > 0 && one.y > 0 && one.x < this.width && one.y < this.height);
    while (this.labels.children.length > all.length) this.labels.lastElementChild?.remove();
    all.forEach((one, i) => {
      const label = (this.labels.children[i] ?? this.labels.appendChild(document.createElement("span"))) as HTMLElement;
      if (label.textContent !== one.text) label.textContent = one.text;
      label.style.transform = `translate(${(one.x / ratio).toFixed(1)}px, ${(one.y / ratio).toFixed(1)}px)`;
    });
  }

  /** For tests: what is on the screen, and from where it is seen. */
  readout(pixels: boolean): { drawing: Drawing; eye: Eye; width: number; height: number; pixels?: Uint8ClampedArray } | undefined {
    if (this.stage === undefined) return undefined;
    const of = this.drawn();
    return { drawing: this.drawing.peek(), eye: of.eye, width: this.width, height: this.height, ...(pixels ? this.stage.pixels(of) : {}) };
  }

  // --- Pointers ---

  private place_of(event: MouseEvent): { x: number; y: number } {
    const box = this.outer.getBoundingClientRect();
    return { x: (event.clientX - box.left) * devicePixelRatio, y: (event.clientY - box.top) * devicePixelRatio };
  }

  private pick(event: MouseEvent): { u: number; v: number } | undefined {
    const { x, y } = this.place_of(event);
    return this.last && pixel_near(this.last, x, y, this.width, this.height, pick_px * devicePixelRatio);
  }

  private listen(): void {
    const on = <K extends keyof HTMLElementEventMap>(name: K, listener: (event: HTMLElementEventMap[K]) => void, options?: AddEventListenerOptions): void => {
      this.outer.addEventListener(name, listener, options);
      this.end.push(() => this.outer.removeEventListener(name, listener, options));
    };
    on("pointerdown", (event) => this.pressed(event));
    on("pointermove", (event) => this.moved(event));
    on("pointerup", (event) => this.released(event));
    on("pointercancel", (event) => this.released(event, true));
    on("contextmenu", (event) => event.preventDefault());
    on("wheel", (event) => {
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / 100 : event.deltaY / 3;
      this.look(() => nearer(orbit_now(space_side.peek()), 1.15 ** -lines));
    }, { passive: false });
    on("keydown", (event) => this.key(event));
  }

  /** Another orbit; who looked through the camera looks from beside again. */
  private look(to: () => ReturnType<typeof orbit_now>): void {
    through.value = false;
    orbit.value = to();
  }

  private pressed(event: PointerEvent): void {
    if (event.button > 2 || this.stage?.holds_pointer() === true) return;
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.outer.setPointerCapture(event.pointerId);
    this.drag = { moved: this.pointers.size > 1, pans: event.button !== 0 || event.shiftKey, x: event.clientX, y: event.clientY };
    const pose = through.peek() ? pose_now(space_side.peek(), "camera") : undefined;
    this.camera_drag = pose && { ...pose, dx: 0, dy: 0 };
  }

  private moved(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (before === undefined || this.drag === undefined) {
      if (event.buttons === 0 && this.stage?.holds_pointer() !== true) {
        const at = this.pick(event);
        if (at !== undefined && space_side.peek() === "a") point_at(at.u, at.v, false);
      }
      return;
    }
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    this.drag.moved ||= Math.hypot(event.clientX - this.drag.x, event.clientY - this.drag.y) > still_px;
    if (!this.drag.moved) return;
    const others = [...this.pointers.entries()].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const side = space_side.peek();
    const [other_finger] = others;
    if (other_finger !== undefined) {
      const distance = (x: number, y: number): number => Math.max(1, Math.hypot(x - other_finger.x, y - other_finger.y));
      const factor = distance(event.clientX, event.clientY) / distance(before.x, before.y);
      this.look(() => panned(nearer(orbit_now(side), factor), dx / 2, dy / 2, this.outer.clientHeight));
    } else if (this.camera_drag !== undefined && !this.drag.pans) {
      const turning = this.camera_drag;
      turning.dx += dx;
      turning.dy += dy;
      const view = this.eye(side);
      const per_pixel = (view.bottom_edge - view.top_edge) / Math.max(1, this.outer.clientHeight);
      move_held(side, "camera", { position: turning.position, rotation: turned_camera(turning.rotation, -turning.dx * per_pixel, -turning.dy * per_pixel) });
    } else {
      this.look(() => (this.drag?.pans === true ? panned(orbit_now(side), dx, dy, this.outer.clientHeight) : orbited(orbit_now(side), dx, dy)));
    }
  }

  private released(event: PointerEvent, cancelled = false): void {
    const known = this.pointers.delete(event.pointerId);
    if (this.pointers.size > 0 || !known) return;
    const { drag } = this;
    this.drag = this.camera_drag = undefined;
    if (cancelled || drag === undefined || drag.moved || drag.pans) return;
    const at = this.pick(event);
    if (at !== undefined && space_side.peek() === "a") {
      point_at(at.u, at.v, true);
      if (tool.peek() === "measure") return measure_at(at);
    }
    this.select_at(event);
  }

  private select_at(event: MouseEvent): void {
    const of = this.last;
    if (of?.fixed === undefined || of.view === undefined) return;
    const { x, y } = this.place_of(event);
    select(object_along(of.fixed, of.view, of.eye.position, direction_at(of.eye, x, y, this.width, this.height)));
  }

  // --- Keys: while this pane has the focus ---

  private key(event: KeyboardEvent): void {
    if (event.altKey || event.metaKey || event.target !== this.outer) return;
    const letter = event.key.length === 1 && /[a-z]/i.test(event.key);
    if (letter && (event.ctrlKey || !letter_keys.peek())) return;
    if (this.act(event)) event.preventDefault();
  }

  private act(event: KeyboardEvent): boolean {
    const side = space_side.peek();
    const arrows: Readonly<Record<string, readonly [number, number]>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const arrow = arrows[event.key];
    if (arrow !== undefined) {
      if (event.ctrlKey) return this.nudge(side, arrow[0], arrow[1], 0);
      this.look(() => (event.shiftKey ? panned(orbit_now(side), -24 * arrow[0], -24 * arrow[1], this.outer.clientHeight) : orbited(orbit_now(side), 15 * arrow[0], 15 * arrow[1])));
      return true;
    }
    switch (event.key) {
      case "PageUp":
      case "PageDown":
        return event.ctrlKey && this.nudge(side, 0, 0, event.key === "PageUp" ? 1 : -1);
      case "+":
      case "=": return this.look(() => nearer(orbit_now(side), 1.15)), true;
      case "-": return this.look(() => nearer(orbit_now(side), 1 / 1.15)), true;
      case "0": return (through.value = false), (orbit.value = undefined), true;
      case "t": return toggle_through(), true;
      case "o": return next_object(side), true;
      case "Escape":
        if (selected.peek() === undefined && !through.peek()) return false;
        selected.value = undefined;
        through.value = false;
        return true;
      default: return this.fly(side, event);
    }
  }

  /** W A S D, R and F: the camera itself moves, along its own axes. */
  private fly(side: Side, { key, shiftKey }: KeyboardEvent): boolean {
    const ways: Readonly<Record<string, Triple>> = { w: [0, 0, 1], s: [0, 0, -1], a: [-1, 0, 0], d: [1, 0, 0], r: [0, -1, 0], f: [0, 1, 0] };
    const way = ways[key.toLowerCase()];
    const pose = pose_now(side, "camera");
    if (way === undefined) return false;
    if (pose === undefined) return true;
    move_held(side, "camera", { rotation: pose.rotation, position: plus(pose.position, turned(pose.rotation, way), shiftKey ? 0.2 : 0.02) });
    return true;
  }

  /** The chosen object, along the axes of the camera. */
  private nudge(side: Side, x: number, y: number, z: number): boolean {
    const view = view3d_of(side);
    const id = selected.peek();
    const pose = id === undefined ? undefined : pose_now(side, id);
    if (view === undefined || id === undefined || pose === undefined) return false;
    move_held(side, id, { rotation: pose.rotation, position: plus(pose.position, turned(view.camera.rotation, [x, y, z]), 0.02) });
    return true;
  }

  dispose(): void {
    this.gone = true;
    spaces.delete(this.pane);
    for (const one of this.end) one();
    this.stage?.dispose();
    this.stage = undefined;
  }
}

export function toggle_through(): void {
  through.value = !through.peek();
  spoken.value = through.peek() ? "Through the camera: a drag turns it" : "From beside the camera";
}

export function select(id: number | undefined): void {
  selected.value = id;
  const of = view3d_of(space_side.peek())?.objects.find((one) => one.id === id);
  spoken.value = of === undefined ? "No object is chosen" : `${of.name} is chosen${of.movable ? "" : `, which cannot be moved: ${of.why ?? ""}`}`;
}

function next_object(side: Side): void {
  const all = view3d_of(side)?.objects ?? [];
  const at = all.findIndex((one) => one.id === selected.peek());
  select(all[at + 1]?.id);
}
