// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How many pixels have which value: over the bar of colours and on its axis. Those without a value, and those beyond the bar's ends, are
// counted apart.

import { useEffect, useRef } from "preact/hooks";
import { ChartFiles, csv_of, svg_of_bars, svg_of_rods } from "./chart_files";
import { color_of, css, place_of, reason_of } from "./colors";
import { difference_of, image_of, type Shows, type Values } from "./compare";
import { percent } from "./legend";
import { number_text } from "./numbers";
import type { Hello, Scale } from "./protocol";
import { value_of } from "./scale_bar";
import { frame, frame_b, hello, other, title_of } from "./store";

const bins = 128;
const height = 72;

export interface Tally {
  counts: Uint32Array;
  below: number;
  above: number;
  invalid: number;
}

export function tally(of: Values, scale: Scale): Tally {
  const out: Tally = { counts: new Uint32Array(bins), below: 0, above: 0, invalid: 0 };
  for (const value of of.values) {
    if (!Number.isFinite(value)) ++out.invalid;
    else if (value < scale.low) ++out.below;
    else if (value > scale.high) ++out.above;
    else out.counts[Math.min(bins - 1, Math.floor(place_of(value, scale) * bins))]! += 1;
  }
  return out;
}

/** Bars in the colours of their values; another state's as a line. */
function draw(canvas: HTMLCanvasElement, greeting: Hello, scale: Scale, of: Tally, beside: Tally | undefined): void {
  const width = canvas.width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
  canvas.height = Math.round(height * devicePixelRatio);
  const context = canvas.getContext("2d");
  if (context === null) return;
  const color = color_of(greeting, scale);
  const most = Math.max(1, ...of.counts, ...(beside?.counts ?? []));
  const style = getComputedStyle(canvas);
  const edge = (i: number): number => Math.round((i * width) / bins);
  const top = (count: number): number => canvas.height - (count === 0 ? 0 : Math.max(devicePixelRatio, (count / most) * (canvas.height - devicePixelRatio)));
  const outline = (counts: Uint32Array, line: string, thick: number): void => {
    context.strokeStyle = line;
    context.lineWidth = thick * devicePixelRatio;
    context.beginPath();
    counts.forEach((count, i) => {
      context.lineTo(edge(i), top(count));
      context.lineTo(edge(i + 1), top(count));
    });
    context.stroke();
  };
  of.counts.forEach((count, i) => {
    context.fillStyle = css(color(value_of((i + 0.5) / bins, scale)));
    context.fillRect(edge(i), top(count), edge(i + 1) - edge(i), canvas.height - top(count));
  });
  outline(of.counts, style.getPropertyValue("--edge"), 1);
  if (beside !== undefined) outline(beside.counts, style.getPropertyValue("--ink"), 1.5);
}

interface Named {
  name: string;
  of: Tally;
}

/** A line for each bin, and what is counted apart; in the scale's unit. */
function histogram_csv(scale: Scale, all: readonly Named[]): string {
  const factor = scale.factor ?? 1;
  const edge = (i: number): number => factor * value_of(i / bins, scale);
  const heads = all.map(({ name }) => (name === "" ? "pixels" : `pixels_${name.replace("B − A", "difference")}`));
  const apart = (["below", "above", "invalid"] as const).map((word) => [word, "", ...all.map(({ of }) => of[word])]);
  const rows = Array.from({ length: bins }, (_, i) => {
    const ends = [edge(i), edge(i + 1)].sort((a, b) => a - b);
    return [...ends, ...all.map(({ of }) => of.counts[i])];
  });
  return csv_of([`from [${scale.unit}]`, `to [${scale.unit}]`, ...heads], [...rows, ...apart]);
}

function histogram_svg(greeting: Hello, scale: Scale, title: string, all: readonly Named[]): string {
  const color = color_of(greeting, scale);
  const colors = Array.from({ length: bins }, (_, i) => css(color(value_of((i + 0.5) / bins, scale))));
  const ticks = scale.ticks.map(({ at, label }) => ({ place: place_of(at, scale), label })).filter(({ place }) => place >= 0 && place <= 1);
  return svg_of_bars({ title, unit: scale.unit, low: scale.low, high: scale.high, ticks, sets: all.map(({ name, of }, i) => ({ name, counts: of.counts, ...(i === 0 ? { colors } : {}) })) });
}

function Line({ name, of }: { name: string; of: Tally }) {
  const shown = of.counts.reduce((sum, one) => sum + one, 0);
  const apart = [["shown", shown], ["below", of.below], ["above", of.above], ["invalid", of.invalid]] as const;
  return (
    <li data-of={name}>
      {name !== "" && <strong>{name} </strong>}
      {apart.filter(([word, count]) => count > 0 || word === "shown" || word === "invalid").map(([word, count], i) => <span key={word}>{i > 0 ? " · " : ""}<span data-apart={word}>{count}</span> {word}</span>)}
    </li>
  );
}

function Numbers({ array, scale, shows }: { array: string; scale: Scale; shows: Shows }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [a, b] = [frame.value, frame_b.value];
  const greeting = hello.value;
  const both = other.value !== undefined && shows !== "difference";
  const of = shows === "difference" ? difference_of(a, b, array) : image_of(a, array);
  const beside = both ? image_of(b, array) : undefined;
  const counted = of && tally(of, scale);
  const counted_b = beside && tally(beside, scale);
  useEffect(() => {
    if (canvas.current !== null && greeting !== undefined && counted !== undefined) draw(canvas.current, greeting, scale, counted, counted_b);
  });
  if (counted === undefined) return null;
  const peak = counted.counts.indexOf(Math.max(...counted.counts));
  const factor = scale.factor ?? 1;
  const [from, to] = [peak, peak + 1].map((i) => number_text(Number((factor * value_of(i / bins, scale)).toPrecision(3))));
  const named = [{ name: shows === "difference" ? "B − A" : both ? "A" : "", of: counted }, ...(counted_b === undefined ? [] : [{ name: "B", of: counted_b }])];
  const title = `Histogram of ${title_of(array).toLowerCase()}`;
  return (
    <>
      <canvas ref={canvas} class="histogram" role="img" aria-label={`Histogram: most pixels, ${counted.counts[peak]}, have ${from} to ${to} ${scale.unit}`} data-counts={counted.counts.join(" ")} />
      <ul class="apart">
        <Line name={shows === "difference" ? "B − A" : both ? "A" : ""} of={counted} />
        {counted_b !== undefined && <Line name="B" of={counted_b} />}
        <li class="files"><ChartFiles name={title} csv={() => histogram_csv(scale, named)} svg={() => greeting && histogram_svg(greeting, scale, title, named)} /></li>
      </ul>
    </>
  );
}

/** Of bits: how many pixels have which. */
function Bits({ array, shows }: { array: string; shows: Shows }) {
  const greeting = hello.value;
  const of = shows === "difference" ? difference_of(frame.value, frame_b.value, array) : image_of(shows === "b" ? frame_b.value : frame.value, array);
  if (greeting === undefined || of === undefined) return null;
  const count = of.values.length;
  const having = (is: (bits: number) => boolean): number => {
    let sum = 0;
    for (const bits of of.values) if (is(bits)) ++sum;
    return sum;
  };
  const counted = greeting.invalid.map((reason) => ({ reason, count: having((bits) => ((bits >>> reason.bit) & 1) !== 0) }));
  const none = having((bits) => reason_of(greeting, bits) === undefined);
  const rows = [...counted, { reason: undefined, count: none }].map((one) => ({ name: one.reason?.name ?? "none", count: one.count }));
  const title = `Histogram of ${title_of(array).toLowerCase()}`;
  return (
    <>
    <table class="bits">
      <caption>{count} pixels, some with several</caption>
      <tbody>
        {[...counted, { reason: undefined, count: none }].map((one) => (
          <tr key={one.reason?.bit ?? -1}>
            <th scope="row">{one.reason?.name ?? "none"}</th>
            <td class="bar"><span style={{ width: `${(100 * one.count) / count}%`, background: one.reason === undefined ? "var(--edge)" : css(one.reason.color) }} /></td>
            <td>{one.count}</td><td>{percent(one.count / count)}</td>
          </tr>
        ))}
      </tbody>
    </table>
    <ChartFiles name={title} csv={() => csv_of(["flag", "pixels", "share"], rows.map((one) => [one.name, one.count, one.count / count]))}
      svg={() => svg_of_rods(title, rows.map((one) => ({ name: one.name, value: one.count, text: `${one.count}, ${percent(one.count / count)}` })), { note: `of ${count} pixels` })} />
    </>
  );
}

export function Histogram({ array, scale, shows }: { array: string; scale: Scale | undefined; shows: Shows }) {
  return scale === undefined ? <Bits array={array} shows={shows} /> : <Numbers array={array} scale={scale} shows={shows} />;
}
