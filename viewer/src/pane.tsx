// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { effect, useSignal, type Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { fit_pane } from "./ask";
import { difference_scale, shown_by } from "./compare";
import { Histogram } from "./histogram";
import { difference_reading, reading } from "./keys";
import { Legend } from "./legend";
import { draw_soon, pictures } from "./loop";
import { Picture } from "./picture";
import type { Side } from "./protocol";
import { ScaleBar } from "./scale_bar";
import {
  comparing, cursor, extent, focused, frame_of, hello, histograms, other, point_at, scale_of, show, shown, size, tab, title_of, toggle_histogram, view, wipe,
} from "./store";
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
      if (event.button !== 0 || (event.target instanceof Element && event.target.closest(".wipe") !== null)) return;
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
      const { width, height } = picture.image ?? size.value;
      const pixel = at.scale / devicePixelRatio;
      const to = { zoom: view.value.zoom, x: drag.from.x - dx / (pixel * width), y: drag.from.y - dy / (pixel * height) };
      view.value = held(to, extent.value);
    },
    pointerup: () => {
      if (drag?.moved === false) tab.value = "pixel";
      drag = undefined;
    },
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
const other_height = 300;     // what stands above and below it, for both to be seen without scrolling

/** As high as the image in it, at the largest scale that there is room for. */
function fit_stage(stage: HTMLElement): void {
  const { width, height } = size.peek();
  const ratio = devicePixelRatio;
  const room = Math.max(least_height, innerHeight - other_height);
  const scale = fitting_scale({ width, height, canvas_width: Math.max(1, stage.clientWidth) * ratio, canvas_height: room * ratio });
  stage.style.height = `${(scale * height) / ratio}px`;
}

/** Mounts a picture on two canvases that are as large as their stage, in device pixels. */
function mount(pane: number, side: Side, stage: HTMLElement, kept: Signal<Picture | undefined>): () => void {
  const [front, over] = stage.querySelectorAll("canvas");
  const picture = new Picture(pane, side, front!, over!);
  const place = `${pane}${side}`;
  pictures.set(place, picture);
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
    pictures.delete(place);
    kept.value = undefined;
  };
}

/** The line between A and B, which a pointer or the arrow keys move. */
function Wipe() {
  const move = (event: PointerEvent): void => {
    const line = event.currentTarget as HTMLElement;
    const box = line.parentElement?.getBoundingClientRect();
    if (box === undefined || !line.hasPointerCapture(event.pointerId)) return;
    wipe.value = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
  };
  const step: Readonly<Record<string, number>> = { ArrowLeft: -0.02, ArrowRight: 0.02, ArrowDown: -0.02, ArrowUp: 0.02, Home: -1, End: 1 };
  return (
    <div class="wipe" role="slider" tabIndex={0} aria-label="Line between A and B" aria-valuemin={0} aria-valuemax={100} aria-valuenow={Math.round(100 * wipe.value)}
      aria-valuetext={`${Math.round(100 * wipe.value)} % A`} style={{ left: `${100 * wipe.value}%` }}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)} onPointerMove={move}
      onKeyDown={(event) => {
        const by = step[event.key];
        if (by === undefined) return;
        event.preventDefault();
        wipe.value = Math.min(1, Math.max(0, wipe.value + by));
      }} />
  );
}

const badges = { a: "A", b: "B", wipe: "A", difference: "B − A" };

function Stage({ pane, side, title, kept }: { pane: number; side: Side; title: string; kept: Signal<Picture | undefined> }) {
  const stage = useRef<HTMLDivElement>(null);
  useEffect(() => (stage.current === null ? undefined : mount(pane, side, stage.current, kept)), []);
  const shows = shown_by(side);
  const which = other.value === undefined ? "" : ` of ${badges[shows]}${shows === "wipe" ? " and B" : ""}`;
  return (
    <div ref={stage} class="stage" tabIndex={0} role="application" aria-label={`${title}${which}: picture. Arrow keys move the pixel cursor.`}
      style={{ touchAction: view.value.zoom > 1 ? "none" : "pan-y pinch-zoom" }}>
      <canvas class="front" />
      <canvas class="over" />
      {other.value !== undefined && <span class={`badge ${shows}`} aria-hidden="true">{badges[shows]}</span>}
      {frame_of(shows === "b" ? "b" : "a")?.draft === true && <span class="badge draft">draft</span>}
      {shows === "wipe" && <span class="badge b" aria-hidden="true">B</span>}
      {shows === "wipe" && <Wipe />}
    </div>
  );
}

/** What this pane shows at the cursor, of A and B where both are there. */
function Reading({ array }: { array: string }) {
  if (cursor.value === undefined) return <span class="reading" data-array={array} />;
  if (other.value === undefined) return <span class="reading" data-array={array}>{reading(array)}</span>;
  const difference = difference_reading(array);
  return (
    <span class="reading both">
      <span><abbr title="the first state">A</abbr> <span data-array={array}>{reading(array)}</span></span>{" "}
      <span><abbr title="the second state">B</abbr> <span data-array-b={array}>{reading(array, "b")}</span></span>{" "}
      <span class="faint">{difference === "" ? "" : "B − A "}<span data-difference={array}>{difference}</span></span>
    </span>
  );
}

export function Pane({ pane }: { pane: number }) {
  const a = useSignal<Picture | undefined>(undefined);
  const b = useSignal<Picture | undefined>(undefined);
  const array = shown.value[pane] ?? "";
  const title = title_of(array);
  const beside = other.value !== undefined && comparing.value === "beside";
  const shows = shown_by("a");
  const own = scale_of(array);
  const scale = own !== undefined && shows === "difference" ? difference_scale(array) : own;
  const has_histogram = histograms.value.has(pane);
  return (
    <section class={`pane${focused.value === pane ? " focused" : ""}${beside ? " double" : ""}`} aria-label={`Pane ${pane + 1}: ${title}`}
      onFocusIn={() => (focused.value = pane)} onPointerDown={() => (focused.value = pane)}>
      <div class="pane-head">
        <label>
          <span class="unseen">Pane {pane + 1} shows</span>
          <select value={array} onChange={(event) => show(pane, event.currentTarget.value)}>
            {(hello.value?.panes ?? []).map((one) => <option key={one.array} value={one.array}>{one.title}</option>)}
          </select>
        </label>
        <Reading array={array} />
        <div class="buttons">
          <button type="button" class="quiet" aria-pressed={has_histogram} onClick={() => toggle_histogram(pane)} aria-label="Histogram" title="how many pixels have which value (h)">
            <svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true"><path d="M1 14h14v1.2H1zM2 9h2v4H2zM5 4h2v9H5zM8 1.5h2V13H8zM11 7h2v6h-2z" fill="currentColor" /></svg>
          </button>
          <button type="button" class="quiet" onClick={() => fit_pane(pane)} disabled={own === undefined}
            aria-label="Fit colours" title="the colours as this frame needs them, once (f); else they stay">Fit</button>
        </div>
      </div>
      <div class="stages">
        <Stage pane={pane} side="a" title={title} kept={a} />
        {beside && <Stage pane={pane} side="b" title={title} kept={b} />}
      </div>
      {scale !== undefined && <ScaleBar scale={scale} array={array} shows={shows}>{has_histogram && <Histogram array={array} scale={scale} shows={shows} />}</ScaleBar>}
      {scale === undefined && has_histogram && <Histogram array={array} scale={undefined} shows={shows} />}
      <div class="stages">
        <Legend shares={a.value?.shares ?? []} bits={own === undefined} shows={shows} name={beside ? "A" : ""} />
        {beside && <Legend shares={b.value?.shares ?? []} bits={own === undefined} shows="b" name="B" />}
      </div>
    </section>
  );
}
