// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of what was chosen on a picture: two points, a rectangle, and the noise of many frames. All of them are the server's.

import { ChartFiles, csv_of, svg_of_bars } from "./chart_files";
import { minus, number_text, with_unit } from "./numbers";
import type { Measured, MeasuredPoint, RegionStatistics, Side, StatisticsRow, Temporal, Triple } from "./protocol";
import { cannot, edited, is_current, other, temporal } from "./store";
import {
  ask_temporal, choose_tool, drop_measure, drop_rectangle, measure_from, measuring, rectangle, rectangle_from, show_temporal, statistics, temporal_fault, temporal_frames,
  temporal_progress, tool,
} from "./tools";

/** A length with as many digits as a tenth of its σ, or of a millimetre, is worth. */
export function metres(value: number | null | undefined, sigma: number | null = null): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const digits = sigma !== null && sigma > 0 ? Math.min(6, Math.max(1, Math.ceil(-Math.log10(sigma)) + 1)) : 4;
  return with_unit(`${value < 0 ? minus : ""}${Math.abs(value).toFixed(digits)}`, "m");
}

function millimetres(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return with_unit(number_text(Number((1000 * value).toPrecision(4))).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, ""), "mm");
}

function place_text(of: Triple | null): string {
  return of === null ? "no depth" : of.map((one) => `${one < 0 ? minus : ""}${Math.abs(one).toFixed(4)}`).join(", ");
}

function End({ name, of }: { name: string; of: MeasuredPoint }) {
  return (
    <>
      <tr><th scope="row">{name}: pixel {of.u}, {of.v}</th><td>{of.name === undefined || of.name === "" ? "" : <bdi>{of.name}</bdi>}</td></tr>
      <tr class="inner"><th scope="row">measured</th><td data-measured={name}>{place_text(of.measured)}</td></tr>
      <tr class="inner"><th scope="row">true</th><td data-true={name}>{place_text(of.true)}</td></tr>
    </>
  );
}

function Distance({ of }: { of: Measured }) {
  const error = of.measured_m === null || of.true_m === null ? null : of.measured_m - of.true_m;
  return (
    <div data-measure={of.id}>
      <p class="figure"><strong data-measure-of="measured">{metres(of.measured_m, of.sigma_m)}</strong>{of.sigma_m !== null && <> ± <span data-measure-of="sigma">{millimetres(of.sigma_m)}</span></>}</p>
      <table>
        <caption>Distance, frame {of.frame}; ± is one σ, of the noise that the camera estimates of both ends. Places: x, y, z in metres, to the right, down and forward.</caption>
        <tbody>
          <tr><th scope="row">true</th><td data-measure-of="true">{metres(of.true_m, of.sigma_m)}</td></tr>
          <tr><th scope="row">measured − true</th><td data-measure-of="error">{error !== null && error > 0 ? "+" : ""}{millimetres(error)}</td></tr>
          <End name="A" of={of.a} />
          <End name="B" of={of.b} />
        </tbody>
      </table>
    </div>
  );
}

/** Names of `tofray quality`, for who reads them. */
function said(name: string): string {
  const flag = /^flag_(.*)_percent$/.exec(name)?.[1];
  return (flag ?? name.replace(/_(percent|m|rad)$/, "")).replaceAll("_", " ");
}

function value_of(row: StatisticsRow): string {
  if (row.value === null) return "–";
  if (row.unit === "m") return millimetres(row.value);
  if (row.unit === "rad") return `${number_text(Number(((row.value * 180) / Math.PI).toPrecision(4))).replace(/\.?0+$/, "")}°`;
  const text = number_text(Number(row.value.toPrecision(4)));
  return with_unit(text.includes(".") ? text.replace(/\.?0+$/, "") : text, row.unit);
}

function Rows({ of }: { of: RegionStatistics }) {
  const [u0, v0, u1, v1] = of.region;
  return (
    <div data-region={of.id}>
      <table class="quality">
        <caption>Pixels {u0} … {u1}, {v0} … {v1}, frame {of.frame}; as <code>tofray quality</code> defines them. Flags that no pixel has are left out.</caption>
        <tbody>
          {of.rows.filter((row) => !row.name.startsWith("flag_") || row.value !== 0).map((row) => (
            <tr key={row.name} data-row={row.name}>
              <th scope="row">
                <span>{row.name.startsWith("flag_") ? `flag: ${said(row.name)}` : said(row.name)}</span>
                {(row.needs ?? row.definition) !== undefined && <span class="means">{row.value === null && row.needs !== undefined ? `needs ${row.needs}` : row.definition}</span>}
              </th>
              <td data-number={row.value ?? ""}>{value_of(row)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** Of each pixel. */
function temporal_csv(side: Side): string {
  const arrays = temporal.value[side]?.arrays;
  const [sigma, mean, count, predicted] = ["temporal_sigma_m", "temporal_mean_m", "temporal_count", "temporal_predicted_m"].map((name) => arrays?.get(name));
  const width = sigma?.dims[1] ?? 1;
  const rows = Array.from(sigma?.values ?? [], (one, i) => [i % width, Math.floor(i / width), count?.values[i], mean?.values[i], one, predicted?.values[i]]);
  return csv_of(["u", "v", "frames", "mean [m]", "sigma [m]", "sigma_predicted [m]"], rows);
}

const bins = 100;

/** How many pixels have which σ, and which σ̂; to three times the larger median. */
function temporal_svg(of: Temporal): string {
  const arrays = temporal.value[of.side ?? "a"]?.arrays;
  const high = 3000 * Math.max(of.sigma_median_m ?? 0, of.predicted_median_m ?? 0) || 1;
  const counts = (name: string): Uint32Array => {
    const out = new Uint32Array(bins);
    for (const value of arrays?.get(name)?.values ?? []) {
      const at = Math.floor((1000 * value * bins) / high);
      if (at >= 0 && at < bins) out[at]! += 1;
    }
    return out;
  };
  const ticks = [0, 1, 2, 3].map((i) => ({ place: i / 3, label: String(Number(((high * i) / 3).toPrecision(3))) }));
  return svg_of_bars({ title: `Noise over ${of.frames} frames`, unit: "mm", low: 0, high, ticks, sets: [{ name: "σ over time", counts: counts("temporal_sigma_m") }, { name: "σ̂ predicted", counts: counts("temporal_predicted_m") }] });
}

function TemporalNumbers({ of, old }: { of: Temporal; old: boolean }) {
  const ratio = of.sigma_median_m != null && of.predicted_median_m != null && of.predicted_median_m > 0 ? of.sigma_median_m / of.predicted_median_m : undefined;
  const chi2 = of.chi2 ?? null;
  return (
    <div class={old ? "late" : ""} data-temporal={of.id}>
      {old && <p class="hint" role="status">Of an earlier state: 200 frames now makes them anew.</p>}
      <table>
        <caption>{of.frames} frames{of.frame === undefined ? "" : ` from frame ${of.frame} on`}, time standing still: only the noise is another</caption>
        <tbody>
          <tr><th scope="row"><span>σ over time</span><span class="means">median over the pixels</span></th><td data-temporal-of="sigma">{millimetres(of.sigma_median_m)}</td></tr>
          <tr><th scope="row"><span>σ̂ that the camera predicts</span><span class="means">median over the pixels</span></th><td data-temporal-of="predicted">{millimetres(of.predicted_median_m)}</td></tr>
          <tr><th scope="row"><span>σ / σ̂</span><span class="means">1: the noise is as predicted</span></th><td>{ratio === undefined ? "–" : ratio.toFixed(3)}</td></tr>
          <tr><th scope="row"><span>χ² per degree of freedom</span><span class="means">mean of (σ / σ̂)²: above 1 the camera is too sure</span></th><td data-temporal-of="chi2">{chi2 === null ? "–" : chi2.toFixed(3)}</td></tr>
          <tr><th scope="row"><span>fill rate</span><span class="means">how many of all values are there</span></th><td data-temporal-of="fill">{of.fill == null ? "–" : `${(100 * of.fill).toFixed(2)}\u00a0%`}</td></tr>
        </tbody>
      </table>
      <div class="watch-actions"><button type="button" disabled={old} onClick={show_temporal} title="σ in the first pane, σ̂ in the second one, with one scale of colours">Show σ and σ̂</button></div>
      <ChartFiles name="Noise over time" csv={() => temporal_csv(of.side ?? "a")} svg={() => temporal_svg(of)} />
    </div>
  );
}

export function MeasurePanel() {
  const side = other.value === undefined ? "a" : edited.value;
  const whose = other.value === undefined ? "" : ` of ${side.toUpperCase()}`;
  const progress = temporal_progress.value;
  const result = temporal.value[side]?.of;
  const distance = measuring.answer.value;
  const rows = statistics.answer.value;
  const fault = measuring.fault.value;
  const rows_fault = statistics.fault.value;
  const whys = [...new Set(["measure", "region", "temporal"].map((one) => cannot(one, side)).filter((one) => one !== undefined))];
  return (
    <div class="measures">
      {whys.map((one) => <p key={one} class="hint">{one}</p>)}
      <section aria-label="Two points">
        <div class="why-head">
          <h3>Two points{whose}</h3>
          <button type="button" aria-pressed={tool.value === "measure"} disabled={cannot("measure") !== undefined} onClick={() => choose_tool("measure")} title="clicks on a picture are its ends; by keys: m at both (m)">Measure</button>
          {measuring.question.value !== undefined && <button type="button" class="quiet" onClick={drop_measure} aria-label="Drop what is measured" title="drops it">✕</button>}
        </div>
        {measure_from.value !== undefined ? <p class="hint" role="status">From pixel {measure_from.value.u}, {measure_from.value.v}: the other end?</p>
          : measuring.question.value === undefined && <p class="what">{tool.value === "measure" ? "Click both ends on a picture." : "Distance between the surfaces that two pixels see, measured and true: m at one, m at the other."}</p>}
        {fault !== undefined && <p class="wrong"><strong>{fault.text}</strong> {fault.more ?? ""}</p>}
        {distance !== undefined && <Distance of={distance} />}
      </section>
      <section aria-label="Rectangle">
        <div class="why-head">
          <h3>Rectangle{whose}</h3>
          <button type="button" aria-pressed={tool.value === "rectangle"} disabled={cannot("region") !== undefined} onClick={() => choose_tool("rectangle")} title="drag on a picture; without this button with Shift; by keys: g at two corners (g)">Drag one</button>
          {rectangle.value !== undefined && <button type="button" class="quiet" onClick={drop_rectangle} aria-label="Drop the rectangle" title="drops it">✕</button>}
        </div>
        {rectangle_from.value !== undefined ? <p class="hint" role="status">The other corner: move the cursor, then g again. Escape drops it.</p>
          : rectangle.value === undefined && <p class="what">Fill rate, plane fit, bias and noise of a part of the picture: drag with Shift, or g at two corners.</p>}
        {rows_fault !== undefined && <p class="wrong"><strong>{rows_fault.text}</strong> {rows_fault.more ?? ""}</p>}
        {rows !== undefined && <Rows of={rows} />}
      </section>
      <section aria-label="Noise over time">
        <div class="why-head">
          <h3>Noise over time{whose}</h3>
          <button type="button" disabled={progress !== undefined || cannot("temporal") !== undefined} onClick={ask_temporal} title="what changes from frame to frame (n)">{temporal_frames} frames now</button>
        </div>
        {progress !== undefined && <label class="progress">frame {progress.done} of {progress.frames} <progress max={progress.frames} value={progress.done} /></label>}
        {progress === undefined && result === undefined && <p class="what">How much depth changes from frame to frame, beside σ̂, what the camera predicts of it.</p>}
        {temporal_fault.value !== undefined && <p class="wrong">{temporal_fault.value}</p>}
        {result !== undefined && <TemporalNumbers of={result} old={!is_current(side)} />}
      </section>
    </div>
  );
}
