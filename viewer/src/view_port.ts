// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Which part of the image the panes show: one for all of them, so that they stay linked.

/** Zoom 1: the whole image. (x, y): the image's point in the middle of the pane, in shares of its width and height. */
export interface ViewPort {
  zoom: number;
  x: number;
  y: number;
}

/** An image [pixels] and the canvas it is drawn on [device px]. */
export interface Extent {
  width: number;
  height: number;
  canvas_width: number;
  canvas_height: number;
}

/** How an image lies on a canvas: its upper left corner and the size of one of its pixels [device px]. */
export interface Placement {
  left: number;
  top: number;
  scale: number;
}

export const whole: ViewPort = { zoom: 1, x: 0.5, y: 0.5 };
export const most_zoom = 200;

/** How large an image's pixels are where all of it fits in: a whole number, so that each is as wide as its neighbour, or less than one. */
export function fitting_scale(of: Extent): number {
  const fit = Math.min(of.canvas_width / of.width, of.canvas_height / of.height);
  return fit >= 1 ? Math.floor(fit) : fit;
}

function scale_of(zoom: number, of: Extent): number {
  const wanted = fitting_scale(of) * zoom;
  return wanted >= 1 ? Math.round(wanted) : wanted;
}

export function placement(view: ViewPort, of: Extent): Placement {
  const scale = scale_of(view.zoom, of);
  return {
    left: Math.round(of.canvas_width / 2 - view.x * of.width * scale),
    top: Math.round(of.canvas_height / 2 - view.y * of.height * scale),
    scale,
  };
}

/** Without ground beside the image: where it is smaller than the canvas it stands in the middle. */
export function held(view: ViewPort, of: Extent): ViewPort {
  const zoom = Math.min(most_zoom, Math.max(1, view.zoom));
  const scale = scale_of(zoom, of);
  const inside = (at: number, size: number, canvas: number): number => {
    const half = Math.min(0.5, canvas / (2 * size * scale));
    return Math.min(1 - half, Math.max(half, at));
  };
  return { zoom, x: inside(view.x, of.width, of.canvas_width), y: inside(view.y, of.height, of.canvas_height) };
}

/** Zooms while one point of the image [pixels] stays where it is. */
export function zoomed(view: ViewPort, factor: number, u: number, v: number, of: Extent): ViewPort {
  const zoom = Math.min(most_zoom, Math.max(1, view.zoom * factor));
  const share = scale_of(view.zoom, of) / scale_of(zoom, of);
  const x = u / of.width;
  const y = v / of.height;
  return held({ zoom, x: x + (view.x - x) * share, y: y + (view.y - y) * share }, of);
}

/** Moved no further than it takes to have the pixel in view, with a neighbour. */
export function showing(view: ViewPort, u: number, v: number, of: Extent): ViewPort {
  const scale = scale_of(view.zoom, of);
  const near = (at: number, pixel: number, size: number, canvas: number): number => {
    const half = canvas / (2 * size * scale);
    const least = (pixel + 2) / size - half;
    const most = (pixel - 1) / size + half;
    return least > most ? (pixel + 0.5) / size : Math.min(most, Math.max(least, at));
  };
  return held({ zoom: view.zoom, x: near(view.x, u, of.width, of.canvas_width), y: near(view.y, v, of.height, of.canvas_height) }, of);
}
