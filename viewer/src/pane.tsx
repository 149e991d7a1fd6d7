// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { effect, useSignal, type Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { fit } from "./ask";
import { reading } from "./keys";
import { Legend } from "./legend";
import { draw_soon, pictures } from "./loop";
import { Picture } from "./picture";
import { ScaleBar } from "./scale_bar";
import { cursor, extent, focused, hello, point_at, scale_of, show, shown, size, title_of, view } from "./store";
import { fitting_scale, held, zoomed } from "./view_port";

const still_px = 3;   // a press that moves less is no drag

/** Wheel zooms where the pointer is, a drag moves what all panes show, and the cursor goes where the pointer is. */
function listen(stage: HTMLElement, picture: Picture): () => void {
  let drag: { x: number; y: number; from: { x: number; y: number }; moved: boolean } | undefined;
  const point = (event: MouseEvent): void => {
    const at = picture.point_at(event.clientX, event.clientY);
    const { width, height } = size.value;
    if (at !== undefined && at.u >= 0 && at.v >= 0 && at.u < width && at.v < height) point_at(Math.floor(at.u), Math.floor(at.v), false);
  };
  const listeners: { [K in "pointerdown" | "pointermove" | "pointerup" | "pointercancel"]: (event: PointerEvent) => void } = {
    pointerdown: (event) => {
      if (event.button !== 0) return;
      drag = { x: event.clientX, y: event.clientY, from: view.value, moved: false };
      stage.setPointerCapture(event.pointerId);
      point(event);
    },
    pointermove: (event) => {
      const at = picture.where();
      if (drag === undefined || at === undefined) return point(event);
      const dx = event.clientX - drag.x;
      const dy = event.clientY - drag.y;
      drag.moved ||= Math.hypot(dx, dy) > still_px;
      if (!drag.moved) return;
      const { width, height } = size.value;
      const pixel = at.scale / devicePixelRatio;
      const to = { zoom: view.value.zoom, x: drag.from.x - dx / (pixel * width), y: drag.from.y - dy / (pixel * height) };
      view.value = held(to, extent.value);
    },
    pointerup: () => (drag = undefined),
    pointercancel: () => (drag = undefined),
  };
  const wheel = (event: WheelEvent): void => {
    const at = picture.point_at(event.clientX, event.clientY);
    if (at === undefined) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / 100 : event.deltaY / 3;
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
const other_height = 330;     // what stands above and below it, for both to be seen without scrolling

/** As high as the image in it, at the largest scale that there is room for. */
function fit_stage(stage: HTMLElement): void {
  const { width, height } = size.peek();
  const ratio = devicePixelRatio;
  const room = Math.max(least_height, innerHeight - other_height);
  const scale = fitting_scale({ width, height, canvas_width: Math.max(1, stage.clientWidth) * ratio, canvas_height: room * ratio });
  stage.style.height = `${(scale * height) / ratio}px`;
}

/** Mounts a picture on two canvases that are as large as their stage, in device pixels. */
function mount(pane: number, stage: HTMLElement, kept: Signal<Picture | undefined>): () => void {
  const [front, over] = stage.querySelectorAll("canvas");
  const picture = new Picture(pane, front!, over!);
  pictures.set(pane, picture);
  kept.value = picture;
  const fit_in = (): void => fit_stage(stage);
  const observer = new ResizeObserver(() => {
    fit_in();
    picture.resize(Math.round(stage.clientWidth * devicePixelRatio), Math.round(stage.clientHeight * devicePixelRatio));
    draw_soon();
  });
  observer.observe(stage);
  addEventListener("resize", fit_in);
  const silent = listen(stage, picture);
  const deaf = effect(() => {
    void size.value;
    fit_in();
  });
  return () => {
    observer.disconnect();
    removeEventListener("resize", fit_in);
    silent();
    deaf();
    pictures.delete(pane);
  };
}

export function Pane({ pane }: { pane: number }) {
  const stage = useRef<HTMLDivElement>(null);
  const picture = useSignal<Picture | undefined>(undefined);
  useEffect(() => (stage.current === null ? undefined : mount(pane, stage.current, picture)), []);
  const array = shown.value[pane] ?? "";
  const title = title_of(array);
  const scale = scale_of(array);
  const text = reading(array);
  return (
    <section class={`pane${focused.value === pane ? " focused" : ""}`} aria-label={`Pane ${pane + 1}: ${title}`} onFocusIn={() => (focused.value = pane)} onPointerDown={() => (focused.value = pane)}>
      <div class="pane-head">
        <label>
          <span class="unseen">Pane {pane + 1} shows</span>
          <select value={array} onChange={(event) => show(pane, event.currentTarget.value)}>
            {(hello.value?.panes ?? []).map((one) => <option key={one.array} value={one.array}>{one.title}</option>)}
          </select>
        </label>
        <span class="reading" data-array={array}>{cursor.value === undefined ? "" : text}</span>
        <button type="button" class="quiet" onClick={() => fit(array)} disabled={scale === undefined}
          aria-label="Fit colours" title="the colours as this frame needs them, once (f); else they stay">Fit</button>
      </div>
      <div ref={stage} class="stage" tabIndex={0} role="application" aria-label={`${title}: picture. Arrow keys move the pixel cursor.`}
        style={{ touchAction: view.value.zoom > 1 ? "none" : "pan-y pinch-zoom" }}>
        <canvas class="front" />
        <canvas class="over" />
      </div>
      {scale !== undefined && <ScaleBar scale={scale} array={array} />}
      <Legend shares={picture.value?.shares.value ?? []} bits={scale === undefined} />
    </section>
  );
}

