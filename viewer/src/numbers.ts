// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Numbers for people.

import type { Value } from "./protocol";

export const minus = "\u2212";

/** Six significant digits (a float has seven), whole numbers whole, a true minus sign. */
export function number_text(value: number): string {
  if (Number.isNaN(value)) return "invalid";
  if (!Number.isFinite(value)) return value > 0 ? "infinite" : `${minus}infinite`;
  const magnitude = Math.abs(value);
  const digits = Number.isInteger(value) && magnitude < 1e15 ? magnitude.toFixed(0) : magnitude.toPrecision(6);
  return value < 0 ? minus + digits : digits;
}

export function value_text(value: Value): string {
  if (value === null) return "invalid";
  if (typeof value === "number") return number_text(value);
  if (Array.isArray(value)) return value.map(value_text).join(", ");
  return String(value);
}

/** With its unit; the unit of pure numbers is 1 and not said. */
export function with_unit(text: string, unit: string): string {
  return text === "invalid" || unit === "1" || unit === "" ? text : `${text}\u00a0${unit}`;
}

/** How many digits after the point tell a thousandth of a range or less. */
export function digits_for(range: number): number {
  return Math.min(6, Math.max(0, 4 - Math.ceil(Math.log10(range))));
}

/** For a pixel's inside, where numbers stand in columns. */
export function fixed_text(value: number, digits: number): string {
  const text = Math.abs(value).toFixed(Number.isInteger(value) ? 0 : digits);
  return value < 0 && Number(text) !== 0 ? minus + text : text;
}
