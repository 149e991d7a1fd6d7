// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The 3D pane by the processor, where there is no WebGL: points as small squares, lines, the nearest one in front.

import { dot, minus_of, plus, turned, type Eye } from "./orbit";
import type { Numbers, Rgb, Triple, View3d } from "./protocol";
import { in_eye, lines_of, object_color, truth_color, wire_opacity, type Drawn3d, type Line3d, type Stage3d, type Static3d } from "./stage3d";

const most_points = 300_000;   // above, every n-th
const most_edges = 60_000;     // of the scene, the same

export class Splatter implements Stage3d {
  private image = new ImageData(1, 1);
  private colors = new Uint32Array(1);
  private depth = new Float32Array(1);

  constructor(private readonly canvas: HTMLCanvasElement) {}

  resize(width: number, height: number): void {
    const [w, h] = [Math.max(1, width), Math.max(1, height)];
    this.canvas.width = w;
    this.canvas.height = h;
    this.image = new ImageData(w, h);
    this.colors = new Uint32Array(this.image.data.buffer);
    this.depth = new Float32Array(w * h);
  }

  draw(of: Drawn3d): void {
    this.paint(of);
    this.canvas.getContext("2d")?.putImageData(this.image, 0, 0);
  }

  pixels(of: Drawn3d): { width: number; height: number; pixels: Uint8ClampedArray } {
    this.draw(of);
    return { width: this.image.width, height: this.image.height, pixels: this.image.data.slice() };
  }

  holds_pointer(): boolean {
    return false;
  }

  dispose(): void {
    this.resize(1, 1);
  }

  private paint(of: Drawn3d): void {
    const { fixed, view, cloud, options, eye } = of;
    this.colors.fill(packed(options.light ? [248, 248, 246] : [13, 15, 18]));
    this.depth.fill(Infinity);
    if (fixed !== undefined && view !== undefined) {
      if (cloud !== undefined && fixed.width === cloud.width && fixed.height === cloud.height) {
        this.splat(fixed, view, eye, cloud.z, cloud.colors, 1);
        if (cloud.truth !== undefined) this.splat(fixed, view, eye, cloud.truth, truth_color, 0.4);
      }
      if (options.scene !== "off") this.edges(fixed, view, eye);
    }
    for (const one of lines_of(of).lines) this.line(eye, one, 1);
  }

  private splat(fixed: Static3d, view: View3d, eye: Eye, z: Numbers, colors: Uint8ClampedArray | Rgb, share: number): void {
    const { width, height } = this.image;
    const to = in_eye(view, eye) as [number, number, number, number, number, number, number, number, number, number, number, number];
    const [across, down] = [width / (eye.right_edge - eye.left_edge), height / (eye.bottom_edge - eye.top_edge)];
    const middle = Math.floor(fixed.height / 2) * fixed.width + Math.floor(fixed.width / 2);
    const pitch = fixed.width < 2 ? 0.01 : Math.abs(fixed.rays[2 * middle]! - fixed.rays[2 * middle - 2]!);
    const stride = Math.max(1, Math.ceil(z.length / most_points));
    const one_color = colors instanceof Uint8ClampedArray ? undefined : packed(colors);
    const of_pixels = colors instanceof Uint8ClampedArray ? new Uint32Array(colors.buffer, colors.byteOffset, colors.length / 4) : undefined;
    for (let i = 0; i < z.length; i += stride) {
      const far = z[i]!;
      if (!(far > 0) || far === Infinity) continue;
      const x = far * fixed.rays[2 * i]!;
      const y = far * fixed.rays[2 * i + 1]!;
      const depth = to[8] * x + to[9] * y + to[10] * far + to[11];
      if (depth < eye.near) continue;
      const px = across * ((to[0] * x + to[1] * y + to[2] * far + to[3]) / depth - eye.left_edge);
      const py = down * ((to[4] * x + to[5] * y + to[6] * far + to[7]) / depth - eye.top_edge);
      const size = Math.min(16, Math.max(1, Math.ceil((1.25 * share * far * pitch * stride * down) / depth)));
      const [left, top] = [Math.round(px - size / 2), Math.round(py - size / 2)];
      if (left + size <= 0 || top + size <= 0 || left >= width || top >= height) continue;
      const color = one_color ?? of_pixels![i]!;
      for (let row = Math.max(0, top); row < Math.min(height, top + size); ++row) {
        for (let column = Math.max(0, left); column < Math.min(width, left + size); ++column) {
          const at = row * width + column;
          if (depth >= this.depth[at]!) continue;
          this.depth[at] = depth;
          this.colors[at] = color;
        }
      }
    }
  }

  private edges({ triangles, triangle_objects: ids }: Static3d, view: View3d, eye: Eye): void {
    const stride = Math.max(1, Math.ceil((3 * ids.length) / most_edges));
    let own: View3d["objects"][number] | undefined;
    let opacity = 1;
    for (let i = 0; i < ids.length; i += stride) {
      if (own?.id !== ids[i]) {
        own = view.objects.find((one) => one.id === ids[i]);
        let count = 0;
        while (ids[i + count] === ids[i]) ++count;
        opacity = wire_opacity(count);
      }
      if (own === undefined) continue;
      const { position, rotation } = own;
      const corners = [0, 3, 6].map((k) => plus(position, turned(rotation, [triangles[9 * i + k]!, triangles[9 * i + k + 1]!, triangles[9 * i + k + 2]!])));
      corners.forEach((a, k) => this.line(eye, { a, b: corners[(k + 1) % 3]!, color: object_color(ids[i]!) }, opacity));
    }
  }

  private line(eye: Eye, { a, b, color }: Line3d, opacity: number): void {
    const { width, height } = this.image;
    const seen = (of: Triple): Triple => {
      const from = minus_of(of, eye.position);
      return [dot(from, eye.right), dot(from, eye.down), dot(from, eye.forward)];
    };
    let [p, q] = [seen(a), seen(b)];
    if (p[2] < eye.near && q[2] < eye.near) return;
    if (p[2] < eye.near) p = cut(p, q, eye.near);
    if (q[2] < eye.near) q = cut(q, p, eye.near);
    const place = (of: Triple): [number, number, number] => [
      (width * (of[0] / of[2] - eye.left_edge)) / (eye.right_edge - eye.left_edge), (height * (of[1] / of[2] - eye.top_edge)) / (eye.bottom_edge - eye.top_edge), 1 / of[2]];
    const span = clipped(place(p), place(q), width, height);
    if (span === undefined) return;
    const [from, to] = span;
    const steps = Math.max(1, Math.ceil(Math.max(Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1]))));
    const ink = packed(color);
    for (let i = 0; i <= steps; ++i) {
      const t = i / steps;
      const [x, y] = [Math.floor(from[0] + t * (to[0] - from[0])), Math.floor(from[1] + t * (to[1] - from[1]))];
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      const at = y * width + x;
      const depth = 1 / (from[2] + t * (to[2] - from[2]));
      if (depth > this.depth[at]! * 1.002) continue;
      this.colors[at] = opacity === 1 ? ink : mixed(this.colors[at]!, ink, opacity);
      if (opacity === 1) this.depth[at] = Math.min(depth, this.depth[at]!);
    }
  }
}

/** RGBA in memory. */
function packed(of: Rgb): number {
  return ((255 << 24) | (of[2] << 16) | (of[1] << 8) | of[0]) >>> 0;
}

function mixed(under: number, over: number, share: number): number {
  let out = 255 << 24;
  for (const shift of [0, 8, 16]) out |= Math.round(((under >>> shift) & 255) * (1 - share) + ((over >>> shift) & 255) * share) << shift;
  return out >>> 0;
}

/** On the way from a, which is before the near plane, to b, which is not. */
function cut(a: Triple, b: Triple, near: number): Triple {
  const t = (near - a[2]) / (b[2] - a[2]);
  return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), near];
}

/** The part within the picture (Liang, Barsky). */
function clipped(a: [number, number, number], b: [number, number, number], width: number, height: number): [typeof a, typeof b] | undefined {
  let [first, last] = [0, 1];
  const way = [b[0] - a[0], b[1] - a[1]] as const;
  for (const [p, q] of [[-way[0], a[0]], [way[0], width - a[0]], [-way[1], a[1]], [way[1], height - a[1]]] as const) {
    if (p === 0 && q < 0) return undefined;
    if (p < 0) first = Math.max(first, q / p);
    if (p > 0) last = Math.min(last, q / p);
  }
  if (first > last) return undefined;
  const at = (t: number): [number, number, number] => [a[0] + t * way[0], a[1] + t * way[1], a[2] + t * (b[2] - a[2])];
  return [at(first), at(last)];
}
