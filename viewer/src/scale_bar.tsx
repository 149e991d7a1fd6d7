// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { color_of, place_of } from "./colors";
import { difference_at, type Shows } from "./compare";
import type { Scale, Tick } from "./protocol";
import { cursor, hello, value_at } from "./store";

const steps = 512;

/** The value that stands at a place of the bar, 0 … 1. */
export function value_of(place: number, scale: Scale): number {
  const share = scale.curve === "sqrt" ? place * place : place;
  return scale.low + share * (scale.high - scale.low);
}

function draw(canvas: HTMLCanvasElement, scale: Scale): void {
  const greeting = hello.value;
  const context = canvas.getContext("2d");
  if (greeting === undefined || context === null) return;
  const color = color_of(greeting, scale);
  const line = new ImageData(steps, 1);
  for (let i = 0; i < steps; ++i) line.data.set([...color(value_of((i + 0.5) / steps, scale)), 255], 4 * i);
  context.putImageData(line, 0, 0);
}

/** Ticks whose labels have room: on a curved bar they crowd at its low end. */
function roomy(scale: Scale): Tick[] {
  const kept: Tick[] = [];
  let last = Infinity;
  for (const tick of [...scale.ticks].reverse()) {
    const place = place_of(tick.at, scale);
    if (last - place < 0.06 + 0.012 * tick.label.length) continue;
    last = place;
    kept.unshift(tick);
  }
  return kept;
}

/** @param marked    whether the value under the cursor stands on it
 *  @param children  what stands above it, as wide as the bar */
export function ScaleBar({ scale, array, shows, marked = true, children }: { scale: Scale; array: string; shows: Shows; marked?: boolean; children?: ComponentChildren }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    if (canvas.current !== null) draw(canvas.current, scale);
  }, [scale, hello.value]);
  const value = shows === "difference" ? difference_at(array, cursor.value) : value_at(array, cursor.value, shows === "b" ? "b" : "a");
  const left = (place: number) => ({ left: `${100 * place}%` });
  const unit = scale.unit === "1" ? "" : scale.unit;
  return (
    <div class="scale" data-low={scale.low} data-high={scale.high}>
      {children}
      <div class="ramp">
        <canvas ref={canvas} width={steps} height={1} role="img"
          aria-label={`Colours from ${scale.ticks[0]?.label ?? scale.low} to ${scale.ticks[scale.ticks.length - 1]?.label ?? scale.high} ${unit}`} />
        {marked && value !== undefined && Number.isFinite(value) && <span class="marker" style={left(place_of(value, scale))} />}
      </div>
      <div class="ticks" aria-hidden="true">
        {roomy(scale).map((tick) => <span key={tick.at} style={left(place_of(tick.at, scale))}>{tick.label}</span>)}
      </div>
      <span class="unit" aria-hidden="true">{unit}</span>
    </div>
  );
}
