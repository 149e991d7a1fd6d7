// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The colours of values by the protocol's words (docs/reference/viewer-protocol.md), not by the page's code.

export function mixed(stops, t) {
  const at = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  return stops[i].map((x, channel) => Math.floor(x + (at - i) * (stops[i + 1][channel] - x) + 0.5));
}

export function color(hello, scale, value) {
  if (scale.palette === "error") {
    const s = value / scale.high;
    return s < 0 ? mixed(hello.palettes.error_near, -s) : mixed(hello.palettes.error_far, s);
  }
  let t = Math.min(1, Math.max(0, (value - scale.low) / (scale.high - scale.low)));
  if (scale.curve === "sqrt") t = Math.sqrt(t);
  return mixed(hello.palettes[scale.palette], scale.reverse ? 1 - t : t);
}

export const reason = (hello, flags) => hello.invalid.find(({ bit }) => (flags >> bit) & 1);

export function expected(hello, scale, values, flags) {
  const out = [];
  values.forEach((value, i) => out.push(...(Number.isFinite(value) ? color(hello, scale, value) : reason(hello, flags[i])?.color ?? hello.invalid_color), 255));
  return out;
}

export const scale_of = (hello, array) => hello.panes.find((one) => one.array === array).scale;
