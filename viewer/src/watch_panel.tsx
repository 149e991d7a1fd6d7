// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The pinned pixels with their statistics over the frames that came since.

import { ChartFiles, svg_of_rods } from "./chart_files";
import { number_text, with_unit } from "./numbers";
import type { Side } from "./protocol";
import { cursor, frame, hello, other, point_at, scale_of, spoken, title_of } from "./store";
import {
  all_watched, copy_csv, counted, csv, csv_copied, is_outside, moments_of, most_pins, pin_at, pins, predicted_of, second, sigma_of, statistics_anew, toggle_pin, unpin, unpin_all,
  watch_also, watched_arrays, watched_sides, type Moments, type Pin,
} from "./watch";

/** Lengths of noise are read in millimetres. */
function fine(array: string): { unit: string; factor: number } {
  const { unit = "", factor = 1 } = scale_of(array) ?? {};
  return unit === "m" ? { unit: "mm", factor: 1000 } : { unit, factor };
}

function text(value: number, { factor, unit }: { factor: number; unit: string }): string {
  return Number.isFinite(value) ? with_unit(number_text(Number((value * factor).toPrecision(6))), unit) : "–";
}

export function PinButton() {
  const at = cursor.value;
  const pinned = at === undefined ? undefined : pin_at(at.u, at.v);
  return (
    <button type="button" aria-pressed={pinned !== undefined} disabled={at === undefined || (pinned === undefined && pins.value.length >= most_pins)} onClick={toggle_pin}
      title="to the watch list, or off it (p)">{pinned === undefined ? "Pin" : `Pin ${pinned.number}`}</button>
  );
}

interface Line {
  stat: string;
  said: string;
  about?: string;
  text(of: Moments, array: string): string;
}

/** What numbers are read in. */
function coarse(array: string): { unit: string; factor: number } {
  const { unit = "", factor = 1 } = scale_of(array) ?? {};
  return { unit, factor };
}

const lines: readonly Line[] = [
  { stat: "mean", said: "mean", text: (of, array) => text(of.n === 0 ? NaN : of.mean, coarse(array)) },
  { stat: "sigma", said: "σ", about: "standard deviation from frame to frame", text: (of, array) => text(sigma_of(of), fine(array)) },
  { stat: "predicted", said: "σ̂", about: "σ that the camera predicts", text: (of, array) => text(predicted_of(of), fine(array)) },
  { stat: "min", said: "min", text: (of, array) => text(of.low, coarse(array)) },
  { stat: "max", said: "max", text: (of, array) => text(of.high, coarse(array)) },
  { stat: "n", said: "n", about: "frames with a value", text: (of) => (of.n === of.frames ? String(of.n) : `${of.n} of ${of.frames}`) },
];

function Statistics({ pin, side }: { pin: Pin; side: Side }) {
  void counted.value;
  const arrays = watched_arrays();
  const first = moments_of(pin, "z_m", side);
  return (
    <table class="statistics" data-state={side}>
      <caption>
        {other.value !== undefined && <strong>{side.toUpperCase()} </strong>}
        {first === undefined ? "Waits for a frame." : `Since frame ${first.since}: ${first.frames} ${first.frames === 1 ? "frame" : "frames"}`}
      </caption>
      <thead><tr><td />{arrays.map((array) => <th key={array} scope="col">{title_of(array)}</th>)}</tr></thead>
      <tbody>
        {lines.map((line) => (
          <tr key={line.stat}>
            <th scope="row" title={line.about ?? ""}>{line.said}</th>
            {arrays.map((array) => {
              const of = moments_of(pin, array, side);
              return <td key={array} data-stat={`${line.stat} ${array}`}>{of === undefined ? "–" : line.text(of, array)}</td>;
            })}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Pinned({ pin }: { pin: Pin }) {
  return (
    <section class="pinned" aria-label={`Pin ${pin.number}`} data-pinned={pin.number}>
      <div class="pinned-head">
        <h3><span class="pin" aria-hidden="true">{pin.number}</span><span class="unseen">Pin {pin.number}: </span>pixel {pin.u}, {pin.v}</h3>
        <button type="button" class="quiet" disabled={is_outside(pin)} onClick={() => point_at(pin.u, pin.v, true)} aria-label={`Go to pin ${pin.number}`} title="the cursor goes there">Go to</button>
        <button type="button" class="quiet" onClick={() => unpin(pin)} aria-label={`Remove pin ${pin.number}`} title="off the list">✕</button>
      </div>
      {is_outside(pin) ? <p class="faint">Outside the picture, which is smaller now.</p> : watched_sides().map((side) => <Statistics key={side} pin={pin} side={side} />)}
    </section>
  );
}

/** Mean and σ of each pin's depth. */
function watch_svg(): string {
  const { factor, unit } = coarse("z_m");
  const rods = all_watched().filter((one) => one.array === "z_m").map(({ pin, side, of }) => ({
    name: `${pin.number}: pixel ${pin.u}, ${pin.v}${other.value === undefined ? "" : ` of ${side.toUpperCase()}`}`,
    value: of.n === 0 ? null : factor * of.mean, spread: of.n < 2 ? 0 : factor * sigma_of(of),
    text: of.n === 0 ? "no depth" : `${text(of.mean, coarse("z_m"))} ± ${text(sigma_of(of), fine("z_m"))}`,
  }));
  return svg_of_rods("Depth of pinned pixels: mean and σ", rods, { points: true, note: `${unit}; over the frames that came since each was pinned` });
}

export function WatchPanel() {
  const offered = (hello.value?.panes ?? []).filter((one) => one.scale != null && one.array !== "z_m");
  const none = pins.value.length === 0;
  const anew = (): void => {
    statistics_anew();
    spoken.value = "The statistics begin anew";
  };
  return (
    <div class="watch">
      <p class="what about">Pinned pixels, over the frames that come. σ is how much a value changes from frame to frame, σ̂ what the camera predicts of it. A changed camera or scene begins anew.</p>
      <div class="watch-actions">
        <PinButton />
        <button type="button" onClick={anew} disabled={none}>Begin anew</button>
        <button type="button" onClick={() => void copy_csv()} disabled={none}>{csv_copied.value ? "Copied" : "Copy CSV"}</button>
        <button type="button" onClick={unpin_all} disabled={none}>Remove all</button>
        <span class="unseen" role="status">{csv_copied.value ? "The statistics are copied." : ""}</span>
      </div>
      <label class="watch-second">beside depth{" "}
        <select value={second.value} onChange={(event) => watch_also(event.currentTarget.value)}>
          {offered.map((one) => <option key={one.array} value={one.array}>{one.title}</option>)}
        </select>
      </label>
      {none && <p class="faint">{frame.value === undefined ? "No frame yet." : "Nothing is pinned: point at a pixel and press p, or Pin above."}</p>}
      {!none && <ChartFiles name="Watch list" csv={csv} svg={watch_svg} />}
      {pins.value.map((pin) => <Pinned key={pin.number} pin={pin} />)}
    </div>
  );
}
