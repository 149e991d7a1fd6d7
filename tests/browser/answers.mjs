// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Answers that are made up, so that what the page has to show of them is known: also numbers, words and gaps that a camera seldom has.

const turn = 2 * Math.PI;

/** Two correlation functions. */
const f = [(t) => 100 + 9000 * Math.cos(t + 1) + 500 * Math.cos(3 * t), (t) => 6000 * Math.cos(t - 2)];
export const phasors = [
  { frequency_hz: 80e6, unit: "e", i: 3000, q: 4000, sigma_i: 120, sigma_q: 90, covariance: 4000, amplitude: 5000, phase_rad: Math.atan2(4, 3), truth_i: 3300, truth_q: 3900 },
  { frequency_hz: 60e6, unit: "e", i: -2000, q: -1000, sigma_i: 50, sigma_q: 100, covariance: 0, amplitude: Math.hypot(2000, 1000), phase_rad: Math.atan2(-1, -2), truth_i: null, truth_q: null },
];
export const curve = f.map((of, k) => ({
  frequency_hz: phasors[k].frequency_hz, unit: "e", points: Array.from({ length: 64 }, (_, i) => of((turn * i) / 64)),
  samples: [0, 1, 2, 3].map((j) => [(turn * j) / 4, of((turn * j) / 4) + 100 * (j - 1.5)]),
}));
export const unwrapping = {
  candidates: [{ cycles: [0, 0], range_m: 0.6231, cost: 4e-6, chosen: true }, { cycles: [3, 2], range_m: 5.6, cost: 1.6e-4 }, { cycles: [1, 1], range_m: 2.8, cost: 0.04 }],
  runner_up_ratio: 40,
};
export const flow = [
  { stage: "light", values: [{ name: "object", value: 3, unit: "1" }, { name: "reflectivity", value: 0.85, unit: "1" }] },
  { stage: "taps", values: [{ name: "tap_a", value: [1.5, 2.25, 1234567.8, null], unit: "e" }] },
  { stage: "phase", values: [{ name: "measured", value: 0.25, unit: "turns", phase: 0 }, { name: "measured", value: 0.125, unit: "turns", phase: 1 }] },
  { stage: "sorcery", values: [{ name: "unheard_of", value: null, unit: "m" }, { name: "<i>word</i>", value: "<i>text</i>" }, { name: "nothing", value: [null, null], unit: "e" }] },
  { stage: "z", values: [{ name: "z", value: 0.623, unit: "m" }] },
];

/** What the server says of a pixel, with these numbers in it. */
export function with_chain(message) {
  return { ...message, report: { ...message.report, unwrapping }, phasors, curve, flow };
}

/** An error's split. */
export const split = {
  error_m: -0.0089, sigma_m: 0.0018, rest_mm: 0.39,
  causes: [{ cause: "noise", mm: -1.2 }, { cause: "multipath", mm: 4.21 }, { cause: "wiggling", mm: -12 }, { cause: "mixed_pixel", mm: 0.2 }, { cause: "<b>gamma</b> rays", mm: -0.5 }],
};
