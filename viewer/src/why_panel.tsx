// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// An error split by what makes it, as bars to either side of nothing.

import { ChartFiles, csv_of, svg_of_rods } from "./chart_files";
import { minus } from "./numbers";
import type { Why } from "./protocol";
import { cannot, cursor, frame_of, region, region_from, state, other, why, why_fault } from "./store";
import { ask_pixel, close_why, drag_chooses, is_region, question, region_key, why_waiting } from "./why";

/** What a cause is, for who has not met it. */
const causes: Readonly<Record<string, { said: string; means: string }>> = {
  noise: { said: "Noise", means: "chance in light and electronics: another frame has another one" },
  multipath: { said: "Multipath", means: "light that came by way of other surfaces, which is longer" },
  wiggling: { said: "Wiggling", means: "the light is no pure sine, so phase and distance are not quite in proportion" },
  wrong_cycle: { said: "Wrong cycle", means: "the phase repeats with distance, and another repetition was chosen: see Unwrapping" },
  mixed_pixel: { said: "Mixed pixel", means: "it sees several distances at once, as at an edge" },
  motion: { said: "Motion", means: "something moved while the raw frames were taken" },
  scatter: { said: "Scatter", means: "the lens spreads light of bright places over others" },
  crosstalk: { said: "Crosstalk", means: "charge or light of neighbouring pixels" },
  interference: { said: "Interference", means: "light of another camera" },
  drift: { said: "Drift", means: "what temperature does to phase and distance" },
  filter: { said: "Filter", means: "smoothing mixes neighbours in" },
};

function word(cause: string): string {
  return causes[cause]?.said ?? cause.replaceAll("_", " ");
}

/** "+1.23 mm": with its sign, and no more digits than are read. */
export function mm_text(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "unknown";
  const size = Math.abs(value);
  const digits = size >= 100 ? 0 : size >= 10 ? 1 : 2;
  const text = size.toFixed(digits);
  return `${Number(text) === 0 ? "" : value > 0 ? "+" : minus}${text}\u00a0mm`;
}

interface Bar {
  key: string;
  said: string;
  means: string;
  mm: number | null;
}

function Bars({ bars, sigma_mm }: { bars: readonly Bar[]; sigma_mm: number | null }) {
  const most = Math.max(1e-9, sigma_mm ?? 0, ...bars.map((one) => Math.abs(one.mm ?? 0)));
  const place = (mm: number): number => 50 + (48 * mm) / most;
  return (
    <table class="causes">
      <caption>Left: too near. Right: too far.{sigma_mm !== null && " The grey band: one σ̂ to either side."}</caption>
      <tbody>
        {bars.map(({ key, said, means, mm }) => {
          const [from, to] = [Math.min(50, place(mm ?? 0)), Math.max(50, place(mm ?? 0))];
          return (
            <tr key={key} data-cause={key} class={key === "error" ? "sum" : ""}>
              <th scope="row"><strong>{said}</strong><span class="means">{means}</span></th>
              <td class="bar-cell">
                <span class="bar-of" aria-hidden="true">
                  {sigma_mm !== null && <span class="band" style={{ left: `${place(-sigma_mm)}%`, width: `${place(sigma_mm) - place(-sigma_mm)}%` }} />}
                  <span class="zero" />
                  <span class="fill" style={{ left: `${from}%`, width: `${Math.max(0.6, to - from)}%` }} />
                </span>
                <span class="mm" data-mm={mm ?? ""}>{mm_text(mm)}</span>
              </td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function Answer({ of }: { of: Why }) {
  if (of.error_m === null) return <p>{of.pixels === 0 ? "No pixel here has a depth, so there is no error to split." : "There is no depth here, or no truth to compare it with: no error to split."}</p>;
  const error_mm = 1000 * of.error_m;
  const sigma_mm = of.sigma_m === null ? null : 1000 * of.sigma_m;
  const sorted = [...of.causes].sort((a, b) => Math.abs(b.mm ?? 0) - Math.abs(a.mm ?? 0));
  const many = of.region !== undefined;
  const bars: Bar[] = [
    { key: "error", said: many ? "Mean error" : "Error", means: many ? "measured less true depth, on average" : "measured less true depth", mm: error_mm },
    ...sorted.map(({ cause, mm }) => ({ key: cause, said: word(cause), means: causes[cause]?.means ?? "", mm })),
    { key: "rest", said: "Rest", means: "what no switch explains alone, and what causes do to each other", mm: of.rest_mm },
  ];
  const first = sorted[0];
  return (
    <>
      <p class="why-sum">
        <strong data-why="error">{mm_text(error_mm)}</strong> {error_mm < 0 ? "too near" : "too far"}
        {sigma_mm !== null && <>; predicted σ̂ <span data-why="sigma">{mm_text(sigma_mm).replace("+", "")}</span></>}.
        {first !== undefined && first.mm !== null && Math.abs(first.mm) > 0 && <> The largest cause: {word(first.cause).toLowerCase()}, {mm_text(first.mm)}.</>}
      </p>
      <Bars bars={bars} sigma_mm={sigma_mm} />
      <ChartFiles name="Error by cause" csv={() => csv_of(["cause", "mm"], [...bars.map(({ key, mm }) => [key, mm]), ["sigma_predicted", sigma_mm]])}
        svg={() => svg_of_rods(`${many ? "Mean error" : "Error"} by cause`, bars.map(({ said, mm }) => ({ name: said, value: mm, text: mm_text(mm) })), { band: sigma_mm ?? 0, note: sigma_mm === null ? "left: too near, right: too far" : "left: too near, right: too far; band: one σ̂ to either side" })} />
      <p class="what">A bar is the error with its cause less the error without it: the frame was computed again with that one switched off. What makes no difference here is left out.</p>
    </>
  );
}

export function WhyButtons() {
  const at = cursor.value;
  return (
    <>
      <button type="button" disabled={at === undefined || cannot("why") !== undefined} onClick={ask_pixel} title={cannot("why") ?? "its error, split by cause (w)"}>Why wrong?</button>
      <button type="button" aria-pressed={drag_chooses.value || region_from.value !== undefined} disabled={cannot("why") !== undefined} title="the same of a region: drag over a picture, with Alt without this button; by keys: e at both corners"
        onClick={() => (region_from.value !== undefined ? region_key() : (drag_chooses.value = !drag_chooses.value))}>{region_from.value !== undefined ? "Region: ends here" : "Region"}</button>
    </>
  );
}

export function WhyPanel() {
  const asked = question.value;
  const answer = why.value;
  if (asked === undefined) {
    if (drag_chooses.value) return <p class="hint" role="status">Drag over a picture: the region's error is split then.</p>;
    const of = region.value;
    return region_from.value !== undefined && of !== undefined ? <p class="hint" role="status">The region's other corner: move the cursor, then e again. Escape drops it.</p> : null;
  }
  const { of, side } = asked;
  const where = is_region(of) ? `pixels ${of.u0} … ${of.u1}, ${of.v0} … ${of.v1}` : `pixel ${of.u}, ${of.v}`;
  const now = frame_of(side);
  const generation = (side === "a" ? state.value : other.value)?.generation;
  const late = answer !== undefined && (why_waiting.value || (answer.generation !== undefined && answer.generation !== generation));
  const frame = answer?.frame ?? now?.frame;
  return (
    <section class="why-panel" aria-label="Why is it wrong?" aria-busy={why_waiting.value}>
      <div class="why-head">
        <h3>Why is it wrong?</h3>
        <button type="button" class="quiet" onClick={close_why} aria-label="Close: why is it wrong?" title="closes this">✕</button>
      </div>
      <p class="faint of-frame">
        {other.value !== undefined && `${side.toUpperCase()}, `}{where}{frame === undefined ? "" : `, frame ${frame}`}
        {answer?.pixels !== undefined && answer.count !== undefined && answer.count > 1 && <>: <span data-why="pixels">{answer.pixels}</span> of {answer.count} pixels have a depth</>}
      </p>
      <div role="status">
        {answer === undefined && why_waiting.value && <p class="faint">Frames are computed with one cause off after the other …</p>}
        {why_fault.value !== undefined && <p class="wrong"><strong>{why_fault.value.text}</strong> {why_fault.value.more ?? ""}</p>}
      </div>
      {answer !== undefined && <div class={late ? "late" : ""} data-why-of={answer.id}><Answer of={answer} /></div>}
    </section>
  );
}
