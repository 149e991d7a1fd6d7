// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A pixel's way from light to depth: its stages, the correlation function with what was measured of it, the phasors, and the ways to
// unwrap. All numbers are the server's; here they are only placed.

import type { ComponentChildren } from "preact";
import { ChartFiles, csv_of, drawn_here } from "./chart_files";
import { minus, number_text, value_text, with_unit } from "./numbers";
import type { Candidate, Curve, FlowValue, Phasor, Stage, Unwrapping, Value } from "./protocol";

const stages: Readonly<Record<string, { said: string; means: string }>> = {
  light: { said: "Light", means: "what the pixel looks at, and how much of the camera's light comes back" },
  electrons: { said: "Electrons", means: "what the light makes in the pixel, by raw frame" },
  taps: { said: "Taps", means: "the electrons sorted into two stores in time with the light" },
  adc: { said: "Digits", means: "A − B as a code" },
  correlation: { said: "Correlation", means: "of each modulation frequency's raw frames one complex number" },
  phase: { said: "Phase", means: "its angle: how late the light is" },
  unwrapping: { said: "Unwrapping", means: "how many whole cycles are to be added" },
  range: { said: "Range", means: "distance along the pixel's ray" },
  filter: { said: "Filter", means: "what neighbours, or frames before, do to it" },
  z: { said: "Depth", means: "along the camera's axis" },
};

const words: Readonly<Record<string, string>> = {
  object: "object", reflectivity: "reflectivity", true_range: "true range", incidence: "angle to the normal", irradiance: "light on the surface",
  radiance: "light toward the camera", power: "light on the pixel", signal: "signal", direct: "direct light", indirect: "indirect light",
  ambient: "ambient light", tap_a: "tap A", tap_b: "tap B", code: "code", difference: "A − B", i: "I", q: "Q", amplitude: "amplitude", measured: "measured",
  calibrated: "calibrated", half_wave: "unambiguous range", cycles: "whole cycles", half_path: "half path", range: "range", noise: "noise σ̂", z: "z", x: "x", y: "y",
  confidence: "confidence", flags: "flags", temporal_frames: "frames averaged", sigma: "sigma", radius: "radius",
};

export function mhz(hz: number): string {
  return `${Number((hz / 1e6).toFixed(3))}\u00a0MHz`;
}

function short(value: number): string {
  return String(Number(value.toPrecision(4))).replace("-", minus);
}

function said(value: Value, unit: string): string {
  if (Array.isArray(value)) return value.length === 0 ? "none" : with_unit(value.map((one) => (typeof one === "number" ? number_text(Number(one.toPrecision(6))) : value_text(one))).join(", "), unit);
  return value === null ? "–" : with_unit(value_text(value), unit);
}

/** The same number of several modulation frequencies stands in one row. */
function rows_of(values: readonly FlowValue[]): FlowValue[][] {
  const rows = new Map<string, FlowValue[]>();
  for (const one of values) rows.set(one.name, [...(rows.get(one.name) ?? []), one]);
  return [...rows.values()];
}

function StageNumbers({ of, frequencies, object }: { of: Stage; frequencies: readonly number[]; object: string }) {
  const rows = rows_of(of.values.filter(({ value }) => !(Array.isArray(value) && value.every((one) => one === null))));
  const several = rows.some((row) => row.length > 1);
  const columns = several ? Math.max(...rows.map((row) => row.length)) : 1;
  return (
    <table>
      {several && frequencies.length >= columns && (
        <thead><tr><td />{frequencies.slice(0, columns).map((hz, k) => <th key={k} scope="col">{mhz(hz)}</th>)}</tr></thead>
      )}
      <tbody>
        {rows.map((row) => {
          const { name, value } = row[0]!;
          const long = Array.isArray(value) && value.length > 3;
          return (
            <tr key={name} class={long ? "long" : ""}>
              <th scope="row">{words[name] ?? name.replaceAll("_", " ")}</th>
              {row.map((one, k) => (
                <td key={k} colSpan={row.length === 1 ? columns : 1} data-flow={`${of.stage}.${name}${one.phase === undefined ? "" : `.${one.phase}`}`} data-number={JSON.stringify(one.value)}>
                  {name === "object" && object !== "" ? <bdi>{object}</bdi> : said(one.value, one.unit ?? "")}
                </td>
              ))}
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

/** @param object  the name of what the pixel sees, whose number is in the chain */
export function Flow({ of, frequencies, object }: { of: readonly Stage[]; frequencies: readonly number[]; object: string }) {
  if (of.length === 0) return null;
  return (
    <details class="section" open>
      <summary>From light to depth</summary>
      <ol class="flow">
        {of.map((one) => (
          <li key={one.stage} data-stage={one.stage}>
            <h3>{stages[one.stage]?.said ?? one.stage}</h3>
            <p class="what">{stages[one.stage]?.means ?? ""}</p>
            <StageNumbers of={one} frequencies={frequencies} object={object} />
          </li>
        ))}
      </ol>
    </details>
  );
}

// --- Charts ---

interface Frame {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

function Chart({ frame, label, children }: { frame: Frame; label: string; children: ComponentChildren }) {
  return <svg class="chart" viewBox={`0 0 ${frame.width} ${frame.height}`} role="img" aria-label={label}>{children}</svg>;
}

function degrees(rad: number): string {
  return `${Number(((rad * 180) / Math.PI).toFixed(1)).toString().replace("-", minus)}°`;
}

const quarters = [0, 90, 180, 270, 360];

function Correlation({ of }: { of: Curve }) {
  const frame: Frame = { width: 300, height: 150, left: 46, right: 8, top: 10, bottom: 22 };
  const unit = of.unit ?? "e";
  const points = of.points.filter((one): one is number => one !== null && Number.isFinite(one));
  const samples = of.samples.filter((one): one is [number, number] => one[1] !== null && Number.isFinite(one[1]));
  if (points.length < 2 || points.length !== of.points.length) return null;
  const values = [...points, ...samples.map(([, value]) => value)];
  let [low, high] = [Math.min(...values), Math.max(...values)];
  if (!(high > low)) [low, high] = [low - 1, high + 1];
  const margin = 0.06 * (high - low);
  [low, high] = [low - margin, high + margin];
  const x = (rad: number): number => frame.left + (rad / (2 * Math.PI)) * (frame.width - frame.left - frame.right);
  const y = (value: number): number => frame.top + ((high - value) / (high - low)) * (frame.height - frame.top - frame.bottom);
  const turn = (rad: number): number => ((rad % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI);
  const line = [...points, points[0]!].map((value, i) => `${x((2 * Math.PI * i) / points.length).toFixed(2)},${y(value).toFixed(2)}`).join(" ");
  const axis = [Math.min(...points), 0, Math.max(...points)].filter((value, i) => i !== 1 || (value > low + 0.15 * (high - low) && value < high - 0.15 * (high - low)));
  const label = `Correlation at ${mhz(of.frequency_hz)} over the phase step, from ${short(Math.min(...points))} to ${short(Math.max(...points))} ${unit}; measured: ${samples.map(([phase, value]) => `${degrees(phase)} ${short(value)}`).join(", ")}`;
  return (
    <figure class="chart-of" data-curve={of.frequency_hz}>
      <figcaption>{mhz(of.frequency_hz)} <span class="faint">{unit}</span></figcaption>
      <Chart frame={frame} label={label}>
        {axis.map((value) => <g key={value}><line class="grid" x1={frame.left} x2={frame.width - frame.right} y1={y(value)} y2={y(value)} /><text x={frame.left - 4} y={y(value) + 3.5} text-anchor="end">{short(value)}</text></g>)}
        {quarters.map((at) => <text key={at} x={x((at * Math.PI) / 180)} y={frame.height - 6} text-anchor={at === 360 ? "end" : "middle"}>{at}°</text>)}
        <polyline class="line" points={line} />
        {samples.map(([phase, value], i) => (
          <g key={i} data-sample={`${phase} ${value}`}>
            <circle class="sample" cx={x(turn(phase))} cy={y(value)} r="4" />
            {Math.abs(turn(phase)) < 1e-9 && <circle class="sample again" cx={x(2 * Math.PI)} cy={y(value)} r="4" />}
          </g>
        ))}
      </Chart>
      <ChartFiles name={`Correlation function at ${mhz(of.frequency_hz)}`} csv={() => curve_csv(of)} svg={drawn_here("figure", `Correlation at ${mhz(of.frequency_hz)}: A − B [${unit}]`)} />
    </figure>
  );
}

/** The function at each phase, then what was measured of it. */
function curve_csv(of: Curve): string {
  const points = of.points.map((value, i) => ["function", (2 * Math.PI * i) / of.points.length, value]);
  return csv_of(["of", "phase [rad]", `A-B [${of.unit ?? "e"}]`], [...points, ...of.samples.map(([phase, value]) => ["measured", phase, value])]);
}

export function Curves({ of }: { of: readonly Curve[] }) {
  if (of.length === 0) return null;
  return (
    <details class="section" open>
      <summary>Correlation function</summary>
      <p class="what">Line: what this camera's raw frames have over their phase step, without noise. Points: what this pixel measured of it.</p>
      {of.map((one) => <Correlation key={one.frequency_hz} of={one} />)}
    </details>
  );
}

/** Half axes and direction of the ellipse of one σ of two numbers that vary together. */
export function ellipse_of(sigma_i: number, sigma_q: number, covariance: number): { a: number; b: number; turn: number } {
  const [p, r] = [sigma_i * sigma_i, sigma_q * sigma_q];
  const middle = (p + r) / 2;
  const off = Math.hypot((p - r) / 2, covariance);
  return { a: Math.sqrt(middle + off), b: Math.sqrt(Math.max(0, middle - off)), turn: Math.atan2(2 * covariance, p - r) / 2 };
}

interface Circle {
  i: number;
  q: number;
  scale: number;   // of the chart's px per unit
}

const side = 144;

/** Measured phasor, its ellipse of two σ, and the truth's, about a point; Q points up. */
function Plane({ of, about, label, whole }: { of: Phasor; about: Circle; label: string; whole: boolean }) {
  const x = (i: number): number => side / 2 + (i - about.i) * about.scale;
  const y = (q: number): number => side / 2 - (q - about.q) * about.scale;
  const [i, q] = [of.i ?? NaN, of.q ?? NaN];
  const noise = of.sigma_i != null && of.sigma_q != null ? ellipse_of(of.sigma_i, of.sigma_q, of.covariance ?? 0) : undefined;
  const truth = of.truth_i != null && of.truth_q != null;
  const cross = 4.5;
  return (
    <svg class="chart phasor" viewBox={`0 0 ${side} ${side}`} role="img" aria-label={label}>
      <rect class="ground" x="0.5" y="0.5" width={side - 1} height={side - 1} rx="4" />
      <line class="grid" x1={x(0)} x2={x(0)} y1="0" y2={side} />
      <line class="grid" x1="0" x2={side} y1={y(0)} y2={y(0)} />
      {whole && <><text x={side - 4} y={y(0) - 4} text-anchor="end">I</text><text x={x(0) + 4} y="12">Q</text></>}
      {noise !== undefined && (
        <ellipse class="noise" cx={x(i)} cy={y(q)} rx={2 * noise.a * about.scale} ry={2 * noise.b * about.scale} transform={`rotate(${(-noise.turn * 180) / Math.PI} ${x(i)} ${y(q)})`} />
      )}
      <line class="line" x1={x(0)} y1={y(0)} x2={x(i)} y2={y(q)} />
      <circle class="sample" cx={x(i)} cy={y(q)} r="3.5" />
      {truth && (
        <g class="truth">
          {whole && <line x1={x(0)} y1={y(0)} x2={x(of.truth_i!)} y2={y(of.truth_q!)} />}
          <path d={`M${x(of.truth_i!) - cross} ${y(of.truth_q!) - cross}l${2 * cross} ${2 * cross}m0 ${-2 * cross}l${-2 * cross} ${2 * cross}`} />
        </g>
      )}
    </svg>
  );
}

function Phasors1({ of }: { of: Phasor }) {
  if (of.i === null || of.q === null) return null;
  const unit = of.unit ?? "e";
  const truth = of.truth_i != null && of.truth_q != null ? { i: of.truth_i, q: of.truth_q } : undefined;
  const reach = Math.max(Math.hypot(of.i, of.q), truth === undefined ? 0 : Math.hypot(truth.i, truth.q), 1e-12);
  const whole: Circle = { i: 0, q: 0, scale: (0.86 * side) / 2 / reach };
  const sigma = Math.max(of.sigma_i ?? 0, of.sigma_q ?? 0);
  const away = truth === undefined ? 0 : Math.hypot(truth.i - of.i, truth.q - of.q);
  const near = Math.max(3 * sigma, 1.15 * away, 1e-3 * reach);
  const close: Circle = { i: of.i, q: of.q, scale: (0.9 * side) / 2 / near };
  const times = close.scale / whole.scale;
  const numbers: [string, string, number | null | undefined, string][] = [
    ["I", "i", of.i, unit], ["Q", "q", of.q, unit], ["σ of I", "sigma_i", of.sigma_i, unit], ["σ of Q", "sigma_q", of.sigma_q, unit],
    ["amplitude", "amplitude", of.amplitude, unit], ["true I", "truth_i", of.truth_i, unit], ["true Q", "truth_q", of.truth_q, unit],
  ];
  const angle = of.phase_rad ?? Math.atan2(of.q, of.i);
  return (
    <figure class="chart-of" data-phasor={of.frequency_hz}>
      <figcaption>{mhz(of.frequency_hz)}</figcaption>
      <div class="planes">
        <Plane of={of} about={whole} whole label={`Phasor at ${mhz(of.frequency_hz)}: ${short(reach)} ${unit} from the middle to the edge; it points to ${degrees(angle)}${truth === undefined ? "" : `, the truth's to ${degrees(Math.atan2(truth.q, truth.i))}`}`} />
        <div>
          <Plane of={of} about={close} whole={false} label={`Its end, ${short(times)} times as large: the ellipse of noise has half axes of two σ, ${short(2 * sigma)} ${unit} at most${truth === undefined ? "" : `; the truth's end is ${short(away)} ${unit} away`}`} />
          <p class="times">end, × {short(times)}</p>
        </div>
      </div>
      <table>
        <tbody>
          {numbers.filter(([, , value]) => value != null).map(([word, key, value, of_unit]) => (
            <tr key={key}><th scope="row">{word}</th><td data-phasor-value={key} data-number={value}>{with_unit(number_text(Number(value!.toPrecision(6))), of_unit)}</td></tr>
          ))}
          <tr><th scope="row">phase</th><td data-phasor-value="phase_rad" data-number={of.phase_rad ?? ""}>{degrees(angle)}</td></tr>
        </tbody>
      </table>
      <ChartFiles name={`Phasor at ${mhz(of.frequency_hz)}`} csv={() => phasor_csv(of)} svg={drawn_here("figure", `Phasor at ${mhz(of.frequency_hz)}, and its end enlarged [${unit}]`)} />
    </figure>
  );
}

function phasor_csv(of: Phasor): string {
  const unit = of.unit ?? "e";
  const rows = [
    ["frequency", of.frequency_hz, "Hz"], ["I", of.i, unit], ["Q", of.q, unit], ["sigma_I", of.sigma_i, unit], ["sigma_Q", of.sigma_q, unit], ["covariance", of.covariance, `${unit}^2`],
    ["amplitude", of.amplitude, unit], ["phase", of.phase_rad, "rad"], ["true_I", of.truth_i, unit], ["true_Q", of.truth_q, unit],
  ];
  return csv_of(["name", "value", "unit"], rows);
}

export function Phasors({ of }: { of: readonly Phasor[] }) {
  if (of.length === 0) return null;
  return (
    <details class="section" open>
      <summary>Phasors</summary>
      <p class="what"><span class="key-dot" aria-hidden="true" /> measured, with the ellipse of two σ of its noise; <span class="key-cross" aria-hidden="true">×</span> the truth: direct light alone, without noise.</p>
      {of.map((one) => <Phasors1 key={one.frequency_hz} of={one} />)}
    </details>
  );
}

// --- Unwrapping ---

function Ranges({ of, truth_m }: { of: readonly Candidate[]; truth_m: number | undefined }) {
  const frame: Frame = { width: 300, height: 54, left: 8, right: 8, top: 8, bottom: 20 };
  const all = [...of.map((one) => one.range_m), ...(truth_m === undefined ? [] : [truth_m])];
  const most = 1.05 * Math.max(...all, 1e-9);
  const x = (m: number): number => frame.left + (m / most) * (frame.width - frame.left - frame.right);
  const y = 24;
  const chosen = of.find((one) => one.chosen === true);
  const label = `Ranges that the phases allow: ${of.map((one) => `${short(one.range_m)} m${one.chosen === true ? ", chosen" : ""}`).join("; ")}${truth_m === undefined ? "" : `; the true one is ${short(truth_m)} m`}`;
  return (
    <Chart frame={frame} label={label}>
      <line class="grid" x1={frame.left} x2={frame.width - frame.right} y1={y} y2={y} />
      {(chosen === undefined || x(chosen.range_m) > 60) && <text x={frame.left} y={frame.height - 4}>0</text>}
      <text x={frame.width - frame.right} y={frame.height - 4} text-anchor="end">{short(most)} m</text>
      {of.map((one, i) => <circle key={i} class={one.chosen === true ? "sample" : "other"} cx={x(one.range_m)} cy={y} r={one.chosen === true ? 5 : 4} />)}
      {truth_m !== undefined && <g class="truth"><path d={`M${x(truth_m)} ${y - 14}v28`} /></g>}
      {chosen !== undefined && <text x={Math.min(frame.width - 80, Math.max(frame.left + 24, x(chosen.range_m)))} y={frame.height - 4} text-anchor="middle">{short(chosen.range_m)} m</text>}
    </Chart>
  );
}

/** @param cost  [m²] */
function apart_text(cost: number): string {
  const mm = 1000 * Math.sqrt(cost);
  return with_unit(mm < 1 ? short(Number(mm.toPrecision(2))) : mm < 100 ? mm.toFixed(1) : mm.toFixed(0), "mm");
}

export function UnwrappingTable({ of, truth_m }: { of: Unwrapping | null | undefined; truth_m: number | undefined }) {
  if (of == null || of.candidates.length === 0) return null;
  const most = Math.max(...of.candidates.map((one) => one.cost).filter(Number.isFinite), 1e-300);
  const ratio = of.runner_up_ratio;
  return (
    <details class="section" open>
      <summary>Unwrapping</summary>
      <p class="what">A phase repeats with distance. Each way to add whole cycles gives a range; the one on which the frequencies agree best is chosen. Cost: the sum of the squares of how far their half paths are apart; its root is shown.{truth_m === undefined ? "" : " The stroke is the true range."}</p>
      <Ranges of={of.candidates} truth_m={truth_m} />
      <table class="candidates">
        <thead><tr><th scope="col">cycles</th><th scope="col">range</th><th scope="col">apart</th><td /></tr></thead>
        <tbody>
          {of.candidates.map((one, i) => (
            <tr key={i} class={one.chosen === true ? "chosen" : ""} data-candidate={one.cycles.join(",")} data-cost={one.cost} data-chosen={one.chosen === true}>
              <th scope="row"><span class="cycles">{one.cycles.join(", ")}</span>{one.chosen === true && <span class="tick"> ✓ chosen</span>}</th>
              <td>{with_unit(one.range_m.toFixed(3), "m")}</td>
              <td>{apart_text(one.cost)}</td>
              <td class="bar"><span aria-hidden="true" style={{ width: `${Math.max(1, 100 * Math.sqrt(one.cost / most))}%` }} /></td>
            </tr>
          ))}
        </tbody>
      </table>
      <ChartFiles name="Ways to unwrap" csv={() => csv_of(["cycles", "range [m]", "cost [m^2]", "chosen"], of.candidates.map((one) => [one.cycles.join(" "), one.range_m, one.cost, one.chosen === true]))} svg={drawn_here("details", "Ranges that the phases allow [m]")} />
      {ratio != null && Number.isFinite(ratio) && <p class="what" data-ratio={ratio}>The runner-up's cost is {short(ratio)} times that of the one chosen.</p>}
    </details>
  );
}
