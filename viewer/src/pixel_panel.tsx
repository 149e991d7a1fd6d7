// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// All that the server knows of the pixel under the cursor: numbers of the library, the same as those of `tofray inspect --pixel`.

import { Curves, Flow, Phasors, UnwrappingTable } from "./chain";
import { number_text, value_text, with_unit } from "./numbers";
import type { ArrayInfo, NamedValue, Pixel, RawFrameReport } from "./protocol";
import { cursor, edited, frame, hello, other, pixel, pixel_b } from "./store";
import { PinButton } from "./watch_panel";
import { WhyButtons, WhyPanel } from "./why_panel";

function is_truth(value: NamedValue): boolean {
  return value.name.startsWith("gt_");
}

/** @param beside  B's values of the same names */
function Values({ title, values, beside }: { title: string; values: readonly NamedValue[]; beside: readonly NamedValue[] | undefined }) {
  if (values.length === 0) return null;
  const about = (name: string): ArrayInfo | undefined => hello.value?.arrays.find((array) => array.name === name);
  return (
    <table>
      <caption>{title}</caption>
      {beside !== undefined && <thead><tr><td /><th scope="col">A</th><th scope="col">B</th></tr></thead>}
      <tbody>
        {values.map(({ name, unit, value }) => (
          <tr key={name} title={about(name)?.what ?? ""}>
            <th scope="row">{name}</th>
            <td data-value={name}>{text_of({ name, unit, value })}</td>
            {beside !== undefined && <td data-value-b={name}>{text_of(beside.find((one) => one.name === name))}</td>}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function text_of(of: NamedValue | undefined): string {
  return of === undefined ? "" : with_unit(value_text(of.value), Array.isArray(of.value) ? "" : of.unit);
}

function RawFrames({ frames }: { frames: readonly RawFrameReport[] }) {
  const cell = (value: number | null, factor = 1): string => (value === null ? "–" : number_text(Number((value * factor).toPrecision(6))));
  if (frames.length === 0) return null;
  return (
    <details>
      <summary>Raw frames ({frames.length})</summary>
      <div class="wide" tabIndex={0} role="region" aria-label="Raw frames">
        <table class="raw">
          <thead>
            <tr><th scope="col">MHz</th><th scope="col">τ deg</th><th scope="col">A e</th><th scope="col">B e</th><th scope="col">code DN</th></tr>
          </thead>
          <tbody>
            {frames.map((one, i) => (
              <tr key={i}>
                <th scope="row">{one.lit ? cell(one.modulation_frequency_hz, 1e-6) : "unlit"}</th>
                <td>{one.lit ? cell(one.reference_phase_rad, 180 / Math.PI) : ""}</td>
                <td>{cell(one.tap_a_e)}</td>
                <td>{cell(one.tap_b_e)}</td>
                <td>{cell(one.raw_dn)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </details>
  );
}

function Answer({ of, beside }: { of: Pixel; beside: Pixel | undefined }) {
  const images = of.values.filter((one) => hello.value?.arrays.find((array) => array.name === one.name)?.shape !== "stack");
  const object = of.report.truth?.object ?? "";
  const chain = edited.value === "b" && beside !== undefined ? beside : of;   // of the state that controls change
  const reason = hello.value?.invalid.find((one) => one.name === of.why);
  return (
    <>
      {object !== "" && <p class="object"><span class="faint">sees</span> <bdi>{object}</bdi></p>}
      {of.why !== "" && <p class="why"><strong>No depth: {of.why}.</strong> {reason?.advice ?? ""}</p>}
      <Values title="Measured" values={images.filter((one) => !is_truth(one))} beside={beside?.values} />
      {beside !== undefined && <p class="what">What follows is {chain === beside ? "B" : "A"}, the state that controls change.</p>}
      <UnwrappingTable of={chain.report.unwrapping} truth_m={chain.report.truth?.range_m ?? undefined} />
      <Phasors of={chain.phasors ?? []} />
      <Curves of={chain.curve ?? []} />
      <Flow of={chain.flow ?? []} frequencies={(chain.phasors ?? []).map((one) => one.frequency_hz)} object={chain.report.truth?.object ?? ""} />
      <Values title="Ground truth" values={images.filter(is_truth)} beside={beside?.values} />
      <RawFrames frames={of.report.raw_frames ?? []} />
      {hello.value?.live !== undefined && <p class="what" data-no-chain>Its chain from light to depth takes the program: <code>{hello.value.live}</code></p>}
    </>
  );
}

export function PixelPanel() {
  const at = cursor.value;
  const answer = pixel.value;
  const late = answer !== undefined && (answer.u !== at?.u || answer.v !== at.v);
  return (
    <>
      <h2>
        {at === undefined ? "Pixel" : `Pixel ${at.u}, ${at.v}`}
        {answer !== undefined && <span class="faint of-frame"> frame {answer.frame}</span>}
      </h2>
      <div class="pixel-actions"><PinButton /><WhyButtons /></div>
      <WhyPanel />
      {at === undefined && <p class="faint">Point at a picture, or press Tab until one has the focus and use the arrow keys.</p>}
      {at !== undefined && answer !== undefined && (
        <div class={late ? "answer late" : "answer"} data-pixel={`${answer.u},${answer.v}`} data-frame={answer.frame}>
          <Answer of={answer} beside={other.value === undefined ? undefined : pixel_b.value} />
        </div>
      )}
      {at !== undefined && answer === undefined && frame.value !== undefined && <p class="faint">asked …</p>}
    </>
  );
}
