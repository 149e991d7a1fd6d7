// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { useSignal } from "@preact/signals";
import { seek, step, toggle_play } from "./ask";
import { zoom_at_cursor } from "./keys";
import { frame, hello, link, rate, state, view } from "./store";
import { whole } from "./view_port";

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

export function TimeLine() {
  const playing = state.value?.playing === true;
  const off = link.value !== "open";
  const own = hello.value?.frame_rate_hz ?? 0;
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
      <span class="faint time">{frame.value === undefined ? "" : `${frame.value.time_s.toFixed(3)} s`}</span>
      <label class="rate">
        <span class="unseen">Frames per second</span>
        <select value={rate.value} onChange={(event) => (rate.value = event.currentTarget.value === "max" ? "max" : "own")}>
          <option value="own">camera's rate{own > 0 ? `, ${Number(own.toPrecision(3))}/s` : ""}</option>
          <option value="max">as fast as it goes</option>
        </select>
      </label>
      <div class="buttons zoom">
        <button type="button" onClick={() => zoom_at_cursor(1 / 1.5)} disabled={zoom <= 1} aria-label="Zoom out" title="zoom out (−)">−</button>
        <button type="button" class="figure" onClick={() => (view.value = whole)} disabled={zoom <= 1} aria-label={`Zoom ${times}, to the whole picture`} title="the whole picture (0)">
          {times}
        </button>
        <button type="button" onClick={() => zoom_at_cursor(1.5)} aria-label="Zoom in" title="zoom in (+)">+</button>
      </div>
    </div>
  );
}
