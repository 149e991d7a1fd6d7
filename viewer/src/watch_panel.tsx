// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The pinned pixels with their statistics over the frames that came since.

import { number_text, with_unit } from "./numbers";
import { cursor, frame, hello, point_at, scale_of, spoken, title_of } from "./store";
import {
  copy_csv, counted, csv_copied, is_outside, moments_of, most_pins, pin_at, pins, predicted_of, second, sigma_of, statistics_anew, toggle_pin, unpin, unpin_all,
  watch_also, watched_arrays, type Moments, type Pin,
} from "./watch";

/** Lengths of noise are read in millimetres. */
function small(array: string): { unit: string; factor: number } {
  const { unit = "", factor = 1 } = scale_of(array) ?? {};
  return unit === "m" ? { unit: "mm", factor: 1000 } : { unit, factor };
}

function text(value: number, factor: number, unit: string): string {
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

function Row({ pin, array, of }: { pin: Pin; array: string; of: Moments | undefined }) {
  const { unit = "", factor = 1 } = scale_of(array) ?? {};
  const fine = small(array);
  const cell = (name: string, said: string) => <td data-stat={name}>{said}</td>;
  return (
    <tr data-pin={pin.number} data-array={array}>
      <th scope="row">{title_of(array)}</th>
      {cell("mean", of === undefined || of.n === 0 ? "–" : text(of.mean, factor, unit))}
      {cell("sigma", of === undefined ? "–" : text(sigma_of(of), fine.factor, fine.unit))}
      {cell("predicted", of === undefined ? "–" : text(predicted_of(of), fine.factor, fine.unit))}
      {cell("min", of === undefined ? "–" : text(of.low, factor, unit))}
      {cell("max", of === undefined ? "–" : text(of.high, factor, unit))}
      {cell("n", of === undefined ? "0" : of.n === of.frames ? String(of.n) : `${of.n} of ${of.frames}`)}
    </tr>
  );
}

function Pinned({ pin }: { pin: Pin }) {
  void counted.value;
  const first = moments_of(pin, "z_m");
  return (
    <section class="pinned" aria-label={`Pin ${pin.number}`} data-pinned={pin.number}>
      <div class="pinned-head">
        <h3><span class="pin" aria-hidden="true">{pin.number}</span><span class="unseen">Pin {pin.number}: </span>pixel {pin.u}, {pin.v}</h3>
        <button type="button" class="quiet" disabled={is_outside(pin)} onClick={() => point_at(pin.u, pin.v, true)} aria-label={`Cursor to pin ${pin.number}`} title="the cursor goes there">Go to</button>
        <button type="button" class="quiet" onClick={() => unpin(pin)} aria-label={`Remove pin ${pin.number}`} title="off the list">✕</button>
      </div>
      {is_outside(pin) ? <p class="faint">Outside the picture, which is smaller now.</p> : (
        <div class="wide" tabIndex={0} role="region" aria-label={`Statistics of pin ${pin.number}`}>
          <table class="statistics">
            <caption>{first === undefined ? "Waits for a frame." : `Frames since ${first.since}: ${first.frames}`}</caption>
            <thead><tr><td /><th scope="col">mean</th><th scope="col">σ</th><th scope="col"><abbr title="σ that the camera predicts">σ̂</abbr></th><th scope="col">min</th><th scope="col">max</th><th scope="col">n</th></tr></thead>
            <tbody>{watched_arrays().map((array) => <Row key={array} pin={pin} array={array} of={moments_of(pin, array)} />)}</tbody>
          </table>
        </div>
      )}
    </section>
  );
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
      <p class="what">Pinned pixels, over the frames that come. σ is how much a value changes from frame to frame, σ̂ what the camera predicts of it. A changed camera or scene begins anew.</p>
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
      {pins.value.map((pin) => <Pinned key={pin.number} pin={pin} />)}
    </div>
  );
}
