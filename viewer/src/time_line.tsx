// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { seek, stand_at, step, toggle_play } from "./ask";
import { zoom_at_cursor } from "./keys";
import { frame, hello, link, most_panes, rate, set_panes, shown, state, view } from "./store";
import { whole } from "./view_port";

const least_hz = 0.01, most_hz = 1000;   // as the server has them

const outlines = {
  back: "M11 3 5 8l6 5zM3.2 3h1.6v10H3.2z",
  on: "M5 3l6 5-6 5zM11.2 3h1.6v10h-1.6z",
  play: "M4 2.5 13 8l-9 5.5z",
  pause: "M3.5 2.5h3.2v11H3.5zM9.3 2.5h3.2v11H9.3z",
};

function Icon({ of }: { of: keyof typeof outlines }) {
  return <svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true"><path d={outlines[of]} fill="currentColor" /></svg>;
}

/** The number that is typed stays until it is sent; else the field shows the frame that is drawn. */
function FrameField() {
  const typed = useSignal<string | undefined>(undefined);
  const send = (): void => {
    if (typed.value !== undefined && /^\d{1,15}$/.test(typed.value)) seek(Number(typed.value));
    typed.value = undefined;
  };
  return (
    <form class="frame-field" onSubmit={(event) => (event.preventDefault(), send())}>
      <label for="frame">frame</label>
      <input id="frame" type="text" inputMode="numeric" pattern="[0-9]{1,15}" autoComplete="off" value={typed.value ?? String(frame.value?.frame ?? "")}
        onInput={(event) => (typed.value = event.currentTarget.value)} onBlur={() => (typed.value = undefined)}
        onFocus={(event) => event.currentTarget.select()} title="a number and Enter: seek any frame" />
    </form>
  );
}

/** How many frames pass by in a second: the camera's own number, all there can be, or one that is typed. */
function Rates() {
  const own = hello.value?.frame_rate_hz ?? 0;
  const is_number = typeof rate.value === "number";
  const choose = (to: string): void => void (rate.value = to === "own" || to === "max" ? to : 1);
  const type = (text: string): void => {
    const hz = Number(text);
    if (text.trim() !== "" && hz >= least_hz && hz <= most_hz) rate.value = hz;
  };
  return (
    <div class="rate">
      <label>
        <span class="unseen">Frames per second</span>
        <select value={is_number ? "number" : String(rate.value)} onChange={(event) => choose(event.currentTarget.value)}>
          <option value="own">camera's rate{own > 0 ? `, ${Number(own.toPrecision(3))}/s` : ""}</option>
          <option value="max">as fast as it goes</option>
          <option value="number">a number</option>
        </select>
      </label>
      {is_number && (
        <label>
          <input type="text" inputMode="decimal" autoComplete="off" value={String(rate.value)} aria-label="Frames per second, a number"
            onChange={(event) => (type(event.currentTarget.value), (event.currentTarget.value = String(rate.value)))} /> /s
        </label>
      )}
    </div>
  );
}

/** Where there is an end: a place between the first frame and the last one. */
function Range() {
  const of = hello.value;
  const count = of?.frames;
  if (of === undefined || count === undefined || count < 2) return null;
  const first = of.first ?? 0;
  const at = frame.value?.frame ?? first;
  return (
    <input type="range" class="time-range" min={first} max={first + count - 1} step={1} value={at} disabled={link.value !== "open"} aria-label="Frame" aria-valuetext={`frame ${at}, ${at - first + 1} of ${count}`}
      onInput={(event) => stand_at(event.currentTarget.valueAsNumber)} />
  );
}

export function TimeLine() {
  const playing = state.value?.playing === true;
  const off = link.value !== "open";
  const zoom = view.value.zoom;
  const times = `${zoom < 10 ? zoom.toFixed(1) : zoom.toFixed(0)} ×`;
  return (
    <div class="time-line" role="group" aria-label="Time and zoom">
      <div class="buttons">
        <button type="button" onClick={() => step(-1)} disabled={off} aria-label="One frame back" title="one frame back (,)"><Icon of="back" /></button>
        <button type="button" class="play" onClick={toggle_play} disabled={off} aria-label={playing ? "Pause" : "Play"} title={`${playing ? "pause" : "play"} (Space)`}>
          <Icon of={playing ? "pause" : "play"} />
        </button>
        <button type="button" onClick={() => step(1)} disabled={off} aria-label="One frame on" title="one frame on (.)"><Icon of="on" /></button>
      </div>
      <FrameField />
      <Range />
      <span class="faint time">{frame.value === undefined ? "" : `${frame.value.time_s.toFixed(3)} s`}</span>
      <Rates />
      <label class="panes zoom">
        <span class="unseen">Number of panes</span>
        <select value={shown.value.length} onChange={(event) => set_panes(Number(event.currentTarget.value))} title="how many panes ([ and ])">
          {Array.from({ length: most_panes }, (_, i) => <option key={i} value={i + 1}>{i + 1} {i === 0 ? "pane" : "panes"}</option>)}
        </select>
      </label>
      <div class="buttons">
        <button type="button" onClick={() => zoom_at_cursor(1 / 1.5)} disabled={zoom <= 1} aria-label="Zoom out" title="zoom out (−)">−</button>
        <button type="button" class="figure" onClick={() => (view.value = whole)} disabled={zoom <= 1} aria-label={`Zoom ${times}, to the whole picture`} title="the whole picture (0)">
          {times}
        </button>
        <button type="button" onClick={() => zoom_at_cursor(1.5)} aria-label="Zoom in" title="zoom in (+)">+</button>
      </div>
    </div>
  );
}
