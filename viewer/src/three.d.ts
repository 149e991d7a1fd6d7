// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What view3d.ts uses of three, which comes without types.

declare module "three" {
  export class Vector3 {
    x: number;
    y: number;
    z: number;
    set(x: number, y: number, z: number): this;
  }
  export class Quaternion {
    setFromRotationMatrix(of: Matrix4): this;
  }
  export class Matrix4 {
    elements: number[];
    set(...rows: number[]): this;
    copy(of: Matrix4): this;
    invert(): this;
    makePerspective(left: number, right: number, top: number, bottom: number, near: number, far: number): this;
    makeRotationFromQuaternion(of: Quaternion): this;
  }
  export class Object3D {
    position: Vector3;
    quaternion: Quaternion;
    matrix: Matrix4;
    matrixWorld: Matrix4;
    matrixAutoUpdate: boolean;
    matrixWorldNeedsUpdate: boolean;
    frustumCulled: boolean;
    visible: boolean;
    renderOrder: number;
    add(...children: Object3D[]): this;
    remove(...children: Object3D[]): this;
    updateMatrixWorld(force?: boolean): void;
  }
  export class Scene extends Object3D {}
  export class Group extends Object3D {}
  export class PerspectiveCamera extends Object3D {
    constructor(fov?: number, aspect?: number, near?: number, far?: number);
    fov: number;
    near: number;
    far: number;
    projectionMatrix: Matrix4;
    projectionMatrixInverse: Matrix4;
    matrixWorldInverse: Matrix4;
  }
  export class BufferAttribute {
    constructor(array: Float32Array | Uint8Array | Uint8ClampedArray, size: number, normalized?: boolean);
    array: Float32Array | Uint8Array | Uint8ClampedArray;
    needsUpdate: boolean;
    setUsage(usage: number): this;
  }
  export const DynamicDrawUsage: number;
  export class Sphere {
    constructor(center: Vector3, radius: number);
  }
  export class BufferGeometry {
    boundingSphere: Sphere | null;
    setAttribute(name: string, attribute: BufferAttribute): this;
    getAttribute(name: string): BufferAttribute;
    setDrawRange(start: number, count: number): void;
    computeVertexNormals(): void;
    dispose(): void;
  }
  export class Material {
    dispose(): void;
  }
  export class ShaderMaterial extends Material {
    constructor(of: object);
    uniforms: Record<string, { value: unknown }>;
  }
  export class LineBasicMaterial extends Material {
    constructor(of: object);
  }
  export class MeshLambertMaterial extends Material {
    constructor(of: object);
  }
  export const DoubleSide: number;
  export class Points extends Object3D {
    constructor(geometry: BufferGeometry, material: Material);
    geometry: BufferGeometry;
    material: Material;
  }
  export class LineSegments extends Object3D {
    constructor(geometry: BufferGeometry, material: Material);
    geometry: BufferGeometry;
    material: Material;
  }
  export class Mesh extends Object3D {
    constructor(geometry: BufferGeometry, material: Material);
    geometry: BufferGeometry;
    material: Material;
  }
  export class HemisphereLight extends Object3D {
    constructor(sky: number, ground: number, intensity: number);
  }
  export class DirectionalLight extends Object3D {
    constructor(color: number, intensity: number);
  }
  export const LinearSRGBColorSpace: string;
  export const ColorManagement: { enabled: boolean };
  export class WebGLRenderer {
    constructor(of: object);
    outputColorSpace: string;
    setPixelRatio(ratio: number): void;
    setSize(width: number, height: number, style: boolean): void;
    setClearColor(color: number, alpha: number): void;
    render(scene: Scene, camera: PerspectiveCamera): void;
    dispose(): void;
  }
}

declare module "three/addons/controls/TransformControls.js" {
  import type { Object3D, PerspectiveCamera } from "three";
  export class TransformControls {
    constructor(camera: PerspectiveCamera, element: HTMLElement);
    object: Object3D | undefined;
    axis: string | null;
    dragging: boolean;
    mode: "translate" | "rotate" | "scale";
    space: "world" | "local";
    attach(object: Object3D): this;
    detach(): this;
    getHelper(): Object3D;
    addEventListener(type: string, listener: () => void): void;
    dispose(): void;
  }
}
