// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The 3D pane by the GPU: a file of its own, which is fetched when somebody looks at one. It knows nothing of the page but what it is told.

import {
  BufferAttribute, BufferGeometry, ColorManagement, DirectionalLight, DoubleSide, DynamicDrawUsage, Group, HemisphereLight, LinearSRGBColorSpace, LineBasicMaterial, LineSegments,
  Matrix4, Mesh, MeshLambertMaterial, Object3D, PerspectiveCamera, Points, Scene, ShaderMaterial, Sphere, Vector3, WebGLRenderer,
} from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Rotation, Triple } from "./protocol";
import { lines_of, object_color, truth_color, wire_opacity, type Cloud3d, type Drawn3d, type GizmoMoves, type Line3d, type Stage3d, type Static3d } from "./stage3d";

ColorManagement.enabled = false;   // colours are the page's, to the bit

// z · (x, y, 1) where there is a z; a pixel without one makes no point. As large as the pixel is from there, so that surfaces close.
const point_vertex = `
attribute float z;
attribute vec3 rgb;
uniform float focal;
uniform float pitch;
uniform float least;
varying vec3 shown;
void main() {
  shown = rgb;
  vec4 seen = modelViewMatrix * vec4(z * position.xy, z, 1.0);
  gl_Position = z > 0.0 ? projectionMatrix * seen : vec4(2.0, 2.0, 2.0, 1.0);   // outside the picture
  gl_PointSize = clamp(1.25 * z * pitch * focal / max(1e-6, -seen.z), least, 32.0);
}`;
const point_fragment = `
varying vec3 shown;
void main() {
  gl_FragColor = vec4(shown, 1.0);
}`;

interface PointCloud {
  points: Points;
  z: Float32Array;
  rgb: Uint8Array;
  of: { rays: Float32Array; z: unknown; colors: unknown };
}

function set_pose(to: Object3D, position: Triple, rotation: Rotation): void {
  const [a, b, c] = rotation;
  to.matrix.set(a[0], a[1], a[2], position[0], b[0], b[1], b[2], position[1], c[0], c[1], c[2], position[2], 0, 0, 0, 1);
  to.matrixWorldNeedsUpdate = true;
}

function cloud_of(rays: Float32Array, least: number): PointCloud {
  const count = rays.length / 2;
  const geometry = new BufferGeometry();
  const z = new Float32Array(count);
  const rgb = new Uint8Array(3 * count);
  geometry.setAttribute("position", new BufferAttribute(rays, 2));
  geometry.setAttribute("z", new BufferAttribute(z, 1).setUsage(DynamicDrawUsage));
  geometry.setAttribute("rgb", new BufferAttribute(rgb, 3, true).setUsage(DynamicDrawUsage));
  geometry.setDrawRange(0, count);
  geometry.boundingSphere = new Sphere(new Vector3(), Infinity);   // rays are no places
  const material = new ShaderMaterial({ vertexShader: point_vertex, fragmentShader: point_fragment, uniforms: { focal: { value: 1 }, pitch: { value: 0.01 }, least: { value: least } } });
  const points = new Points(geometry, material);
  points.frustumCulled = false;   // its box would be that of the rays
  points.matrixAutoUpdate = false;
  return { points, z, rgb, of: { rays, z: undefined, colors: undefined } };
}

/** How wide a pixel is at depth 1, in the image's middle. */
export function pitch_of({ width, height, rays }: Static3d): number {
  const i = Math.floor(height / 2) * width + Math.floor(width / 2);
  return width < 2 ? 0.01 : Math.abs(rays[2 * i]! - rays[2 * i - 2]!) || 0.01;
}

/** Lines that are made anew as they change. */
class Lines {
  readonly drawn: LineSegments;
  constructor() {
    this.drawn = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true }));
    this.drawn.frustumCulled = false;
  }
  set(all: readonly Line3d[]): void {
    const at = new Float32Array(all.flatMap(({ a, b }) => [...a, ...b]));
    const colors = new Uint8Array(all.flatMap(({ color }) => [...color, ...color]));
    this.drawn.geometry.dispose();
    this.drawn.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(at, 3)).setAttribute("color", new BufferAttribute(colors, 3, true));
    this.drawn.visible = all.length > 0;
  }
}

interface Shape {
  id: number;
  wire: LineSegments;
  solid: Mesh;
}

/** An object's triangles, in its own axes. */
function shape_of(id: number, triangles: Float32Array): Shape {
  const color = object_color(id).map((one) => one / 255);
  const count = triangles.length / 9;
  const edges = new Float32Array(18 * count);
  for (let i = 0; i < count; ++i)
    [0, 1, 1, 2, 2, 0].forEach((corner, k) => edges.set(triangles.subarray(9 * i + 3 * corner, 9 * i + 3 * corner + 3), 18 * i + 3 * k));
  const [r, g, b] = color as [number, number, number];
  const rgb = (r255: number): number => Math.round(255 * r255);
  const hex = (rgb(r) << 16) | (rgb(g) << 8) | rgb(b);
  const wire = new LineSegments(new BufferGeometry().setAttribute("position", new BufferAttribute(edges, 3)), new LineBasicMaterial({ color: hex, transparent: true, opacity: wire_opacity(count) }));
  const faces = new BufferGeometry().setAttribute("position", new BufferAttribute(triangles, 3));
  faces.computeVertexNormals();
  const solid = new Mesh(faces, new MeshLambertMaterial({ color: hex, side: DoubleSide, flatShading: true, transparent: true, opacity: 0.8, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }));
  for (const one of [wire, solid]) {
    one.matrixAutoUpdate = false;
    one.frustumCulled = false;
  }
  return { id, wire, solid };
}

class GpuStage implements Stage3d {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera();
  private readonly lines = new Lines();
  private readonly shapes = new Group();
  private readonly controls: TransformControls;
  private readonly held = new Object3D();   // what the gizmo is at
  private all: Shape[] = [];
  private shapes_of: unknown;
  private measured: PointCloud | undefined;
  private truth: PointCloud | undefined;
  private width = 1;
  private height = 1;

  /** @throws where there is no WebGL */
  constructor(private readonly canvas: HTMLCanvasElement, pointers: HTMLElement, private readonly redraw: () => void, moves: GizmoMoves) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setPixelRatio(1);
    this.camera.matrixAutoUpdate = false;
    const lamp = new DirectionalLight(0xffffff, 1.6);
    lamp.position.set(-0.4, -1, -0.6);
    this.scene.add(this.lines.drawn, this.shapes, this.held, new HemisphereLight(0xffffff, 0x667080, 1.4), lamp);
    this.controls = new TransformControls(this.camera, pointers);
    this.scene.add(this.controls.getHelper());
    this.controls.addEventListener("change", () => this.redraw());
    this.controls.addEventListener("mouseDown", () => moves.begin());
    this.controls.addEventListener("mouseUp", () => moves.end());
    this.controls.addEventListener("objectChange", () => {
      const { x, y, z } = this.held.position;
      const e = new Matrix4().makeRotationFromQuaternion(this.held.quaternion).elements as [number, number, number, number, number, number, number, number, number, number, number];
      const turns = this.controls.mode === "rotate";
      moves.move(turns ? undefined : [x, y, z], turns ? [[e[0], e[4], e[8]], [e[1], e[5], e[9]], [e[2], e[6], e[10]]] : undefined);
    });
    pointers.style.touchAction = "";   // the page's own rule holds
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.renderer.setSize(this.width, this.height, false);
  }

  draw(of: Drawn3d): void {
    const { options, view } = of;
    this.renderer.setClearColor(options.light ? 0xf8f8f6 : 0x0d0f12, 1);
    this.place_camera(of);
    this.place_cloud(of);
    this.place_shapes(of);
    this.place_gizmo(of);
    this.lines.set(lines_of(of).lines);
    this.shapes.visible = options.scene !== "off" && view !== undefined;
    this.renderer.render(this.scene, this.camera);
  }

  private place_camera({ eye }: Drawn3d): void {
    const { camera } = this;
    const { position: p, right: x, down: y, forward: z } = eye;
    camera.matrix.set(x[0], -y[0], -z[0], p[0], x[1], -y[1], -z[1], p[1], x[2], -y[2], -z[2], p[2], 0, 0, 0, 1);
    camera.matrixWorldNeedsUpdate = true;
    camera.near = eye.near;
    camera.far = eye.far;
    camera.fov = (2 * Math.atan((eye.bottom_edge - eye.top_edge) / 2) * 180) / Math.PI;   // the gizmo's size
    camera.projectionMatrix.makePerspective(eye.near * eye.left_edge, eye.near * eye.right_edge, -eye.near * eye.top_edge, -eye.near * eye.bottom_edge, eye.near, eye.far);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  }

  private place_cloud({ fixed, cloud, view, eye }: Drawn3d): void {
    const fits = fixed !== undefined && cloud !== undefined && view !== undefined && fixed.width === cloud.width && fixed.height === cloud.height;
    for (const [name, of] of [["measured", this.measured], ["truth", this.truth]] as const) {
      if (of === undefined || (fixed !== undefined && of.of.rays === fixed.rays)) continue;
      this.scene.remove(of.points);
      of.points.geometry.dispose();
      of.points.material.dispose();
      this[name] = undefined;
    }
    if (this.measured !== undefined) this.measured.points.visible = fits;
    if (this.truth !== undefined) this.truth.points.visible = fits && cloud.truth !== undefined;
    if (!fits) return;
    this.measured ??= this.added(cloud_of(fixed.rays, 1.5));
    this.fill(this.measured, cloud.z, cloud.colors);
    this.measured.points.visible = true;
    if (cloud.truth !== undefined) {
      this.truth ??= this.added(cloud_of(fixed.rays, 1));
      this.fill(this.truth, cloud.truth, truth_color);
      this.truth.points.visible = true;
    }
    const focal = this.height / (eye.bottom_edge - eye.top_edge);
    for (const [one, share] of [[this.measured, 1], [this.truth, 0.4]] as const) {
      if (one === undefined) continue;
      const material = one.points.material as ShaderMaterial;
      material.uniforms["focal"]!.value = focal;
      material.uniforms["pitch"]!.value = share * pitch_of(fixed);
      set_pose(one.points, view.camera.position, view.camera.rotation);
    }
  }

  private added(of: PointCloud): PointCloud {
    this.scene.add(of.points);
    return of;
  }

  /** A pixel without depth has z = 0. @param colors  RGBA of each, or one for all */
  private fill(to: PointCloud, z: Cloud3d["z"], colors: Uint8ClampedArray | readonly [number, number, number]): void {
    if (to.of.z !== z) {
      for (let i = 0; i < to.z.length; ++i) {
        const one = z[i]!;
        to.z[i] = one > 0 && Number.isFinite(one) ? one : 0;
      }
      to.points.geometry.getAttribute("z").needsUpdate = true;
    }
    if (to.of.colors !== colors || to.of.z !== z) {
      const whole = colors instanceof Uint8ClampedArray;
      for (let i = 0; i < to.z.length; ++i)
        for (let k = 0; k < 3; ++k) to.rgb[3 * i + k] = colors[whole ? 4 * i + k : k]!;
      to.points.geometry.getAttribute("rgb").needsUpdate = true;
    }
    to.of.z = z;
    to.of.colors = colors;
  }

  private place_shapes({ fixed, view, options }: Drawn3d): void {
    if (fixed !== undefined && this.shapes_of !== fixed) {
      this.forget_shapes();
      this.shapes_of = fixed;
      const { triangles, triangle_objects: ids } = fixed;
      for (let from = 0; from < ids.length;) {
        let end = from;
        while (end < ids.length && ids[end] === ids[from]) ++end;
        const shape = shape_of(ids[from]!, triangles.slice(9 * from, 9 * end));
        this.all.push(shape);
        this.shapes.add(shape.wire, shape.solid);
        from = end;
      }
    }
    for (const one of this.all) {
      const at = view?.objects.find((object) => object.id === one.id);
      one.wire.visible = at !== undefined;
      one.solid.visible = at !== undefined && options.scene === "solid" && at.bounds !== null;   // endless planes would hide what is before them
      if (at === undefined) continue;
      for (const drawn of [one.wire, one.solid]) set_pose(drawn, at.position, at.rotation);
    }
  }

  private forget_shapes(): void {
    for (const { wire, solid } of this.all) {
      this.shapes.remove(wire, solid);
      for (const one of [wire, solid]) {
        one.geometry.dispose();
        one.material.dispose();
      }
    }
    this.all = [];
  }

  private place_gizmo({ view, options }: Drawn3d): void {
    const chosen = options.gizmo === "off" ? undefined : view?.objects.find((one) => one.id === options.selected && one.movable);
    if (chosen === undefined) {
      if (this.controls.object !== undefined && !this.controls.dragging) this.controls.detach();
      return;
    }
    const mode = options.gizmo === "turn" ? "rotate" : "translate";
    if (this.controls.mode !== mode) this.controls.mode = mode;
    if (this.controls.dragging) return;   // what is dragged is where the pointer has it
    const [x, y, z] = chosen.position;
    const [a, b, c] = chosen.rotation;
    this.held.position.set(x, y, z);
    this.held.quaternion.setFromRotationMatrix(new Matrix4().set(a[0], a[1], a[2], 0, b[0], b[1], b[2], 0, c[0], c[1], c[2], 0, 0, 0, 0, 1));
    this.held.updateMatrixWorld();
    if (this.controls.object !== this.held) this.controls.attach(this.held);
  }

  pixels(of: Drawn3d): { width: number; height: number; pixels: Uint8ClampedArray } {
    this.draw(of);
    const { width, height } = this;
    const copy = document.createElement("canvas");
    copy.width = width;
    copy.height = height;
    const context = copy.getContext("2d");
    context?.drawImage(this.canvas, 0, 0);
    return { width, height, pixels: context?.getImageData(0, 0, width, height).data ?? new Uint8ClampedArray(0) };
  }

  holds_pointer(): boolean {
    return this.controls.object !== undefined && (this.controls.dragging || this.controls.axis !== null);
  }

  dispose(): void {
    this.controls.detach();
    this.controls.dispose();
    this.forget_shapes();
    for (const one of [this.measured, this.truth]) {
      one?.points.geometry.dispose();
      one?.points.material.dispose();
    }
    this.lines.drawn.geometry.dispose();
    this.lines.drawn.material.dispose();
    this.renderer.dispose();
  }
}

/** @param pointers  where the gizmo listens
 *  @throws where this browser gives no WebGL */
export function gpu_stage(canvas: HTMLCanvasElement, pointers: HTMLElement, redraw: () => void, moves: GizmoMoves): Stage3d {
  return new GpuStage(canvas, pointers, redraw, moves);
}
