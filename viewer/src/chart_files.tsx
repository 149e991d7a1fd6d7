// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Charts as files: their numbers as CSV, all digits and units in the first line, and their drawing as SVG that stands for itself.

import { file_name, offer } from "./download";

export type Cell = string | number | boolean | null | undefined;

/** A field of a table (RFC 4180); a number that is not there is empty. */
function field(of: Cell): string {
  if (of === null || of === undefined) return "";
  if (typeof of === "number") return Number.isFinite(of) ? String(of) : "";
  const text = String(of);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function csv_of(head: readonly string[], rows: readonly (readonly Cell[])[]): string {
  return [head, ...rows].map((row) => row.map(field).join(",")).join("\n") + "\n";
}

export function escaped(text: string): string {
  return text.replace(/[&<>"]/g, (one) => `&#${one.charCodeAt(0)};`).replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, "\ufffd");
}

// --- What is drawn on the page by SVG: with the styles that it has there ---

const styles = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity", "font-family", "font-size", "font-weight", "text-anchor", "opacity"];

function with_styles(of: SVGSVGElement): SVGSVGElement {
  const copy = of.cloneNode(true) as SVGSVGElement;
  const [from, to] = [[...of.querySelectorAll("*")], [...copy.querySelectorAll("*")]];
  from.forEach((one, i) => {
    const style = getComputedStyle(one);
    for (const name of styles) {
      const value = style.getPropertyValue(name);
      if (value !== "") to[i]!.setAttribute(name, value);
    }
    for (const { name } of [...to[i]!.attributes]) if (name === "class" || name.startsWith("data-")) to[i]!.removeAttribute(name);
  });
  return copy;
}

/** The drawings beside each other, on the page's ground. */
export function svg_of_drawings(drawings: readonly SVGSVGElement[], title: string): string {
  const boxes = drawings.map((one) => one.viewBox.baseVal);
  const gap = 12;
  const width = boxes.reduce((sum, box) => sum + box.width, 0) + gap * (boxes.length + 1);
  const height = Math.max(...boxes.map((box) => box.height)) + 2 * gap + 16;
  const root = getComputedStyle(document.documentElement);
  let left = gap;
  const parts = drawings.map((one, i) => {
    const copy = with_styles(one);
    copy.setAttribute("x", String(left));
    copy.setAttribute("y", String(gap + 16));
    copy.setAttribute("width", String(boxes[i]!.width));
    copy.setAttribute("height", String(boxes[i]!.height));
    for (const name of ["class", "role"]) copy.removeAttribute(name);
    left += boxes[i]!.width + gap;
    return new XMLSerializer().serializeToString(copy);
  });
  return svg(width, height, title, root, `<text x="${gap}" y="${gap + 6}" font-size="12" font-weight="600" fill="${color(root, "--ink")}">${escaped(title)}</text>${parts.join("")}`);
}

// --- What is drawn otherwise ---

function color(style: CSSStyleDeclaration, name: string): string {
  return style.getPropertyValue(name).trim();
}

function svg(width: number, height: number, title: string, style: CSSStyleDeclaration, inner: string): string {
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="system-ui, 'DejaVu Sans', sans-serif">`
    + `<title>${escaped(title)}</title><rect width="${width}" height="${height}" fill="${color(style, "--surface")}"/>${inner}</svg>\n`;
}

export interface Bars {
  title: string;
  unit: string;
  low: number;
  high: number;
  ticks: readonly { place: number; label: string }[];
  /** Evenly from low to high. */
  sets: readonly { name: string; counts: ArrayLike<number>; colors?: readonly string[] }[];
}

/** How many have which value: the first set as bars, others as lines. */
export function svg_of_bars({ title, unit, ticks, sets }: Bars): string {
  const style = getComputedStyle(document.documentElement);
  const [width, height, left, top, bottom] = [520, 220, 12, 34, 40];
  const [across, up] = [width - 2 * left, height - top - bottom];
  const most = Math.max(1, ...sets.flatMap((one) => [...Array.from(one.counts)]));
  const [ink, faint, edge] = ["--ink", "--faint", "--edge"].map((name) => color(style, name));
  const x = (place: number): string => (left + place * across).toFixed(2);
  const y = (count: number): string => (top + (1 - count / most) * up).toFixed(2);
  const inner: string[] = [`<text x="${left}" y="18" font-size="13" font-weight="600" fill="${ink}">${escaped(title)}</text>`];
  sets.forEach(({ counts, colors, name }, i) => {
    const all = Array.from(counts);
    if (i === 0) all.forEach((count, k) => count > 0 && inner.push(`<rect x="${x(k / all.length)}" y="${y(count)}" width="${(across / all.length).toFixed(2)}" height="${(up * count / most).toFixed(2)}" fill="${colors?.[k] ?? faint}"/>`));
    const line = all.flatMap((count, k) => [`${x(k / all.length)},${y(count)}`, `${x((k + 1) / all.length)},${y(count)}`]).join(" ");
    inner.push(`<polyline points="${line}" fill="none" stroke="${i === 0 ? edge : ink}" stroke-width="${i === 0 ? 0.75 : 1.5}"/>`);
    if (name !== "") inner.push(`<text x="${width - left}" y="${18 + 13 * i}" text-anchor="end" font-size="11" fill="${i === 0 ? faint : ink}">${i === 0 ? "bars" : "line"}: ${escaped(name)}</text>`);
  });
  inner.push(`<line x1="${left}" x2="${width - left}" y1="${top + up}" y2="${top + up}" stroke="${edge}"/>`);
  for (const { place, label } of ticks) {
    inner.push(`<line x1="${x(place)}" x2="${x(place)}" y1="${top + up}" y2="${top + up + 4}" stroke="${edge}"/>`);
    inner.push(`<text x="${x(place)}" y="${top + up + 17}" text-anchor="${place < 0.03 ? "start" : place > 0.97 ? "end" : "middle"}" font-size="11" fill="${faint}">${escaped(label)}</text>`);
  }
  inner.push(`<text x="${left}" y="${height - 6}" font-size="11" fill="${faint}">${escaped(unit)}; highest: ${most} pixels</text>`);
  return svg(width, height, title, style, inner.join(""));
}

export interface Rod {
  name: string;
  value: number | null;
  text: string;
  /** To either side. */
  spread?: number;
}

/** A row for each: a bar from 0 on, or a point with its spread. `band`: to either side of 0. */
export function svg_of_rods(title: string, rods: readonly Rod[], { points = false, band = 0, note = "" }: { points?: boolean; band?: number; note?: string } = {}): string {
  const style = getComputedStyle(document.documentElement);
  const [row, top, name_width, across, text_width] = [22, 34, 170, 260, 190];
  const [width, height] = [name_width + across + text_width, top + row * rods.length + 26];
  const [ink, faint, edge, accent, raised] = ["--ink", "--faint", "--edge", "--accent", "--raised"].map((name) => color(style, name));
  const ends = rods.filter((one) => one.value !== null).flatMap(({ value, spread = 0 }) => [value! - spread, value! + spread]);
  let [low, high] = points ? [Math.min(...ends), Math.max(...ends)] : [Math.min(0, -band, ...ends), Math.max(0, band, ...ends)];
  if (!(high > low)) [low, high] = [low - 1, high + 1];
  const x = (value: number): number => name_width + 6 + ((value - low) / (high - low)) * (across - 12);
  const inner: string[] = [`<text x="12" y="18" font-size="13" font-weight="600" fill="${ink}">${escaped(title)}</text>`];
  if (band > 0) inner.push(`<rect x="${x(-band).toFixed(2)}" y="${top}" width="${(x(band) - x(-band)).toFixed(2)}" height="${row * rods.length}" fill="${raised}"/>`);
  if (!points) inner.push(`<line x1="${x(0).toFixed(2)}" x2="${x(0).toFixed(2)}" y1="${top}" y2="${top + row * rods.length}" stroke="${edge}"/>`);
  rods.forEach(({ name, value, text, spread = 0 }, i) => {
    const middle = top + row * (i + 0.5);
    inner.push(`<text x="12" y="${middle + 4}" font-size="12" fill="${ink}">${escaped(name)}</text><text x="${width - 12}" y="${middle + 4}" font-size="12" text-anchor="end" fill="${ink}">${escaped(text)}</text>`);
    if (value === null || !Number.isFinite(value)) return;
    if (points) inner.push(`<line x1="${x(value - spread).toFixed(2)}" x2="${x(value + spread).toFixed(2)}" y1="${middle}" y2="${middle}" stroke="${accent}" stroke-width="2"/><circle cx="${x(value).toFixed(2)}" cy="${middle}" r="4" fill="${accent}"/>`);
    else inner.push(`<rect x="${Math.min(x(0), x(value)).toFixed(2)}" y="${middle - 6}" width="${Math.max(0.6, Math.abs(x(value) - x(0))).toFixed(2)}" height="12" fill="${accent}"/>`);
  });
  inner.push(`<text x="12" y="${height - 8}" font-size="11" fill="${faint}">${escaped(note)}</text>`);
  return svg(width, height, title, style, inner.join(""));
}

/** The two buttons below a chart. `svg`: of the chart's own place on the page, where it is drawn there. */
export function ChartFiles({ name, csv, svg: drawing }: { name: string; csv: () => string; svg: (place: Element) => string | undefined }) {
  const what = name.toLowerCase();
  return (
    <div class="of-chart" data-chart={what}>
      <button type="button" class="quiet" aria-label={`${name} as CSV`} title="its numbers, as a table" onClick={() => offer(file_name(what, "csv"), csv(), "text/csv")}>CSV</button>
      <button type="button" class="quiet" aria-label={`${name} as SVG`} title="its drawing" onClick={(event) => {
        const text = drawing(event.currentTarget);
        if (text !== undefined) offer(file_name(what, "svg"), text, "image/svg+xml");
      }}>SVG</button>
    </div>
  );
}

/** Of the drawings that stand in the same place as the button. */
export function drawn_here(selector: string, title: string): (place: Element) => string | undefined {
  return (place) => {
    const drawings = [...(place.closest(selector)?.querySelectorAll<SVGSVGElement>("svg.chart") ?? [])];
    return drawings.length === 0 ? undefined : svg_of_drawings(drawings, title);
  };
}
