// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A slider's places and the values that stand there. Its ends are those of the row, which the server chose.

import type { Row } from "./protocol";

export const places = 1000;

export type Ends = readonly [number, number];

/** 0 … places */
export function place_of_value(value: number, [low, high]: Ends, log: boolean): number {
  const share = log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  return Math.round(places * Math.min(1, Math.max(0, share)));
}

/** As it is written into the field: no more digits than a step of the slider is worth. The ends are themselves. */
export function text_at(place: number, [low, high]: Ends, row: Row): string {
  const log = row.log === true;
  const share = place / places;
  const exact = place <= 0 ? low : place >= places ? high : log ? low * (high / low) ** share : low + share * (high - low);
  const step = log ? Math.abs(exact) * Math.log(high / low) / places : (high - low) / places;
  const digits = Math.max(0, Math.ceil(-Math.log10(step)));
  const inside = place > 0 && place < places;
  const value = row.kind === "integer" ? Math.round(exact) : inside ? Number(exact.toFixed(Math.min(20, digits))) : exact;
  return with_unit_of(row, String(value));
}

export function with_unit_of(row: Row, number: string): string {
  return row.unit === undefined || row.unit === "" || row.unit === "1" ? number : `${number} ${row.unit}`;
}

/** The number of a text in the row's own unit; undefined where it is of another, or none. */
export function number_in(text: string, row: Row): number | undefined {
  const parts = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*$/.exec(text);
  if (parts === null || (parts[2] !== "" && parts[2] !== row.unit)) return undefined;
  return Number(parts[1]);
}
