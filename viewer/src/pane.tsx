// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { useSignal, type Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { fit_pane } from "./ask";
import { difference_scale, shown_by } from "./compare";
import { Histogram } from "./histogram";
import { difference_reading, reading } from "./keys";
import { cloud_color, shown_array } from "./cloud";
import { Legend } from "./legend";
import type { Picture } from "./picture";
import type { Side } from "./protocol";
import { exposure_text, raw_kinds, raw_name, raw_view, type RawKind, type RawView } from "./raw";
import { ScaleBar } from "./scale_bar";
import { Sheet } from "./sheet";
import { last_raw_kind, show_raw } from "./sheet_state";
import { space_side } from "./space";
import { SpaceStage } from "./space_pane";
import { show_space } from "./space_state";
import { mount } from "./stage";
import {
  cannot, comparing, cursor, exposures, focused, frame_of, hello, histograms, is_bits, is_current, other, scale_of, show, shown, tab, temporal_titles, title_of, toggle_histogram, view, wipe,
} from "./store";

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
  useEffect(() => {
    if (stage.current === null) return undefined;
    return mount({ place: `${pane}${side}`, name: () => shown.value[pane], side, stage: stage.current, kept, clicked: () => (tab.value = "pixel") });
  }, []);
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

/** Of which kind, and all of them or one. */
function RawChoice({ pane, of }: { pane: number; of: RawView }) {
  return (
    <>
      <label>
        <span class="unseen">Raw frames: what of them</span>
        <select class="raw-kind" value={of.kind} onChange={(event) => show_raw(pane, event.currentTarget.value as RawKind, of.number)}>
          {raw_kinds.map((one) => <option key={one.kind} value={one.kind}>{one.said}</option>)}
        </select>
      </label>
      <label>
        <span class="unseen">Raw frames: which of them</span>
        <select class="raw-number" value={of.number ?? "all"} title="all (t)"
          onChange={(event) => show_raw(pane, of.kind, event.currentTarget.value === "all" ? undefined : Number(event.currentTarget.value))}>
          <option value="all">all</option>
          {exposures("a").map((one) => <option key={one.number} value={one.number}>{one.number}: {exposure_text(one)}</option>)}
        </select>
      </label>
    </>
  );
}

// In the list of what a pane can show.
const raw_frames = "raw frames";
const space = "3D points";

/** What gives points their colours. */
function ColorChoice({ pane, color }: { pane: number; color: string }) {
  return (
    <label class="points-of">
      <span class="unseen">Points are coloured by</span>
      <select class="cloud-color" value={color} onChange={(event) => show_space(pane, event.currentTarget.value)} title="what gives points their colours">
        {(hello.value?.panes ?? []).map((one) => <option key={one.array} value={one.array}>by {one.title.toLowerCase()}</option>)}
      </select>
    </label>
  );
}

export function Pane({ pane }: { pane: number }) {
  const a = useSignal<Picture | undefined>(undefined);
  const b = useSignal<Picture | undefined>(undefined);
  const array = shown.value[pane] ?? "";
  const title = title_of(array);
  const beside = other.value !== undefined && comparing.value === "beside";
  const cloud = cloud_color(array);
  const shows = cloud === undefined ? shown_by("a") : space_side.value;
  const own = scale_of(array);
  const scale = own !== undefined && cloud === undefined && shows === "difference" ? difference_scale(array) : own;
  const raw = raw_view(array);
  const sheet = raw !== undefined && raw.number === undefined;
  const bits = is_bits(array);
  const has_histogram = histograms.value.has(pane) && !sheet;
  const choose = (to: string): void => (to === raw_frames ? show_raw(pane, last_raw_kind()) : to === space ? show_space(pane) : show(pane, to));
  const lasting = Object.entries(temporal_titles).filter(([name]) => name === array || is_current("a") || is_current("b"));
  const chosen = raw !== undefined ? raw_frames : cloud !== undefined ? space : array;
  return (
    <section class={`pane${focused.value === pane ? " focused" : ""}${beside ? " double" : ""}`} aria-label={`Pane ${pane + 1}: ${title}`}
      onFocusIn={() => (focused.value = pane)} onPointerDown={() => (focused.value = pane)}>
      <div class="pane-head">
        <label>
          <span class="unseen">Pane {pane + 1} shows</span>
          <select class={`shows${raw !== undefined ? " raw" : cloud !== undefined ? " points" : ""}`} value={chosen} onChange={(event) => choose(event.currentTarget.value)}>
            {(hello.value?.panes ?? []).map((one) => <option key={one.array} value={one.array}>{one.title}</option>)}
            <option value={raw_frames}>Raw frames</option>
            <option value={space} disabled={cannot("view3d") !== undefined}>3D points</option>
            {lasting.map(([name, title]) => <option key={name} value={name}>{title}</option>)}
            {(hello.value?.absent ?? []).map((one) => <option key={one.array} value={one.array} disabled title={one.why}>{one.title}: {one.why}</option>)}
          </select>
        </label>
        {raw !== undefined && <RawChoice pane={pane} of={raw} />}
        {cloud !== undefined && <ColorChoice pane={pane} color={cloud} />}
        {sheet ? <span class="reading faint" /> : <Reading array={shown_array(array)} />}
        <div class="buttons">
          <button type="button" class="quiet" aria-pressed={has_histogram} disabled={sheet} onClick={() => toggle_histogram(pane)} aria-label="Histogram" title="how many pixels have which value (h)">
            <svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true"><path d="M1 14h14v1.2H1zM2 9h2v4H2zM5 4h2v9H5zM8 1.5h2V13H8zM11 7h2v6h-2z" fill="currentColor" /></svg>
          </button>
          <button type="button" class="quiet" onClick={() => fit_pane(pane)} disabled={own === undefined}
            aria-label="Fit colours" title="the colours as this frame needs them, once (f); else they stay">Fit</button>
        </div>
      </div>
      <div class="stages">
        {cloud !== undefined ? <SpaceStage pane={pane} array={array} /> : sheet ? <Sheet pane={pane} side="a" kind={raw.kind} /> : <Stage pane={pane} side="a" title={title} kept={a} />}
        {beside && cloud === undefined && (sheet ? <Sheet pane={pane} side="b" kind={raw.kind} /> : <Stage pane={pane} side="b" title={title} kept={b} />)}
      </div>
      {scale !== undefined && <ScaleBar scale={scale} array={sheet ? raw_name(raw.kind, 0) : shown_array(array)} shows={shows} marked={!sheet}>{has_histogram && <Histogram array={shown_array(array)} scale={scale} shows={shows} />}</ScaleBar>}
      {bits && has_histogram && <Histogram array={shown_array(array)} scale={undefined} shows={shows} />}
      {!sheet && cloud === undefined && (
        <div class="stages">
          <Legend shares={a.value?.shares ?? []} bits={bits} shows={shows} name={beside ? "A" : ""} />
          {beside && <Legend shares={b.value?.shares ?? []} bits={bits} shows="b" name="B" />}
        </div>
      )}
    </section>
  );
}
