// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A picture in its place on the page: as large as there is room for, and what a pointer does to it.

import { effect, type Signal } from "@preact/signals";
import { draw_soon, pictures } from "./loop";
import { Picture } from "./picture";
import type { Side } from "./protocol";
import { extent, point_at, region, region_from, size, view, wipe, type Cursor } from "./store";
import { fitting_scale, held, zoomed } from "./view_port";
import { ask_rectangle, begin_drag, drag_to, end_drag, how_of, measure_at, rectangle, rectangle_between, rectangle_from, tool, wheel_scales } from "./tools";
import { ask_region, drag_chooses, region_between } from "./why";

const still_px = 3;   // a press that moves less is no drag

type Does = "pan" | "region" | "rectangle" | "object";

/** What a press does: with Alt it chooses a region to be explained, with Shift a rectangle of statistics, else it is the tool's. */
function does(event: PointerEvent): Does {
  if (event.altKey || drag_chooses.value) return "region";
  if (tool.value === "drag") return "object";
  return event.shiftKey || tool.value === "rectangle" ? "rectangle" : "pan";
}

/** Wheel zooms where the pointer is, a drag does what the tool says, else it moves what all panes show, and the cursor goes where the pointer is. */
function listen(stage: HTMLElement, picture: Picture, clicked: () => void): () => void {
  let drag: { x: number; y: number; from: { x: number; y: number }; moved: boolean; does: Does; corner: Cursor | undefined } | undefined;
  const pixel_at = (event: MouseEvent): Cursor | undefined => {
    const at = picture.point_at(event.clientX, event.clientY);
    return at && { u: Math.floor(at.u), v: Math.floor(at.v) };
  };
  const point = (event: MouseEvent): void => {
    const at = pixel_at(event);
    const { width, height } = size.value;
    if (at !== undefined && at.u >= 0 && at.v >= 0 && at.u < width && at.v < height) point_at(at.u, at.v, false);
  };
  /** The state whose picture is there. */
  const side_at = (event: MouseEvent): Side => {
    const shows = picture.shows.peek();
    const box = stage.getBoundingClientRect();
    return shows === "b" || (shows === "wipe" && event.clientX - box.left > wipe.value * box.width) ? "b" : "a";
  };
  const listeners: { [K in "pointerdown" | "pointermove" | "pointerup" | "pointercancel"]: (event: PointerEvent) => void } = {
    pointerdown: (event) => {
      if (event.button !== 0 || (event.target instanceof Element && event.target.closest(".wipe") !== null)) return;
      point(event);
      const corner = pixel_at(event);
      let how = does(event);
      if (how === "object" && (corner === undefined || picture.shows.peek() === "difference" || !begin_drag(corner, how_of(event), side_at(event)))) how = "pan";
      drag = { x: event.clientX, y: event.clientY, from: view.value, moved: false, does: how, corner };
      stage.setPointerCapture(event.pointerId);
    },
    pointermove: (event) => {
      const at = picture.where();
      if (drag === undefined || at === undefined) return point(event);
      const dx = event.clientX - drag.x;
      const dy = event.clientY - drag.y;
      drag.moved ||= Math.hypot(dx, dy) > still_px;
      if (!drag.moved) return;
      if (drag.does === "object") {
        const to = picture.point_at(event.clientX, event.clientY);
        point(event);
        if (to !== undefined) drag_to({ u: to.u - 0.5, v: to.v - 0.5 });   // a pixel's middle
        return;
      }
      if (drag.does !== "pan") {
        const to = pixel_at(event);
        if (to === undefined || drag.corner === undefined) return;
        if (drag.does === "region") {
          region_from.value = undefined;
          region.value = region_between(drag.corner, to);
        } else {
          rectangle_from.value = undefined;
          rectangle.value = rectangle_between(drag.corner, to);
        }
        return;
      }
      const { width, height } = picture.image ?? size.value;
      const pixel = at.scale / devicePixelRatio;
      const to = { zoom: view.value.zoom, x: drag.from.x - dx / (pixel * width), y: drag.from.y - dy / (pixel * height) };
      view.value = held(to, extent.value);
    },
    pointerup: () => {
      const ended = drag;
      drag = undefined;
      if (ended?.does === "object") end_drag();
      else if (ended?.moved === false && tool.value === "measure") measure_at(ended.corner);
      else if (ended?.moved === false) clicked();
      else if (ended?.does === "region" && region.value !== undefined) {
        drag_chooses.value = false;
        ask_region(region.value);
      } else if (ended?.does === "rectangle" && rectangle.value !== undefined) {
        ask_rectangle(rectangle.value);
      }
    },
    pointercancel: () => {
      if (drag?.does === "object") end_drag();
      drag = undefined;
    },
  };
  const wheel = (event: WheelEvent): void => {
    const at = picture.point_at(event.clientX, event.clientY);
    if (at === undefined) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / 100 : event.deltaY / 3;
    if (event.altKey && tool.value === "drag") return wheel_scales({ u: Math.floor(at.u), v: Math.floor(at.v) }, lines, side_at(event));
    view.value = zoomed(view.value, 1.25 ** -lines, at.u, at.v, extent.value);
    point(event);   // at the image's edges, which stay at the pane's, it is another one now
  };
  for (const [name, listener] of Object.entries(listeners)) stage.addEventListener(name, listener as EventListener);
  stage.addEventListener("wheel", wheel, { passive: false });
  return () => {
    for (const [name, listener] of Object.entries(listeners)) stage.removeEventListener(name, listener as EventListener);
    stage.removeEventListener("wheel", wheel);
  };
}

const least_height = 220;     // [CSS px] of a picture
const other_height = 300;     // what stands above and below it, for both to be seen without scrolling

/** As high as the image in it, at the largest scale that there is room for. */
function fit_stage(stage: HTMLElement, tile: boolean): void {
  const { width, height } = size.peek();
  const ratio = devicePixelRatio;
  const room = tile ? Infinity : Math.max(least_height, innerHeight - other_height);
  const scale = fitting_scale({ width, height, canvas_width: Math.max(1, stage.clientWidth) * ratio, canvas_height: room * ratio });
  stage.style.height = `${(scale * height) / ratio}px`;
}

interface Place {
  /** By which it is found among the pictures. */
  place: string;
  /** The array that it shows. */
  name: () => string | undefined;
  side: Side;
  stage: HTMLElement;
  kept?: Signal<Picture | undefined>;
  clicked: () => void;
  /** One of many. */
  tile?: boolean;
}

/** Mounts a picture on two canvases that are as large as their stage, in device pixels. */
export function mount({ place, name, side, stage, kept, clicked, tile = false }: Place): () => void {
  const [front, over] = stage.querySelectorAll("canvas");
  const picture = new Picture(name, side, front!, over!, tile);
  pictures.set(place, picture);
  if (kept !== undefined) kept.value = picture;
  const fit_in = (): void => fit_stage(stage, tile);
  const observer = new ResizeObserver(() => {
    if (stage.clientWidth === 0) return;   // it is being taken off the page
    fit_in();
    picture.resize(Math.round(stage.clientWidth * devicePixelRatio), Math.round(stage.clientHeight * devicePixelRatio));
    draw_soon();
  });
  observer.observe(stage);
  addEventListener("resize", fit_in);
  const silent = listen(stage, picture, clicked);
  const deaf = effect(() => {
    void size.value;
    fit_in();
  });
  return () => {
    observer.disconnect();
    removeEventListener("resize", fit_in);
    silent();
    deaf();
    pictures.delete(place);
    if (kept !== undefined) kept.value = undefined;
  };
}
