// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A pixel's charts: each point where its number is, and each number as it was answered.

import assert from "node:assert/strict";
import { curve, phasors, with_chain } from "./answers.mjs";
import { beside, between, inspected, point_at, rendered, shown, stand_at, test, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const turn = 2 * Math.PI;

async function made_up(options = {}) {
  const { url } = await view(words);
  const tab = await shown(url, { before: between({ told: { pixel: with_chain } }), ...options });
  await stand_at(tab, 0);
  await beside(tab, "Pixel");
  await point_at(tab, 112, 86);
  await tab.page.locator('.answer[data-pixel="112,86"]').waitFor();
  return tab;
}

test("the correlation function goes through its 64 points, and each raw frame's point stands at its phase step and value", async () => {
  const { page } = await made_up();
  const charts = await page.locator("[data-curve]").evaluateAll((all) => all.map((one) => ({
    frequency: Number(one.dataset.curve),
    line: one.querySelector("polyline").getAttribute("points").split(" ").map((point) => point.split(",").map(Number)),
    samples: [...one.querySelectorAll("[data-sample]")].map((sample) => {
      const circle = sample.querySelector("circle");
      return [...sample.dataset.sample.split(" ").map(Number), Number(circle.getAttribute("cx")), Number(circle.getAttribute("cy"))];
    }),
    said: one.querySelector("svg").getAttribute("aria-label"),
  })));
  assert.deepEqual(charts.map((one) => one.frequency), [80e6, 60e6]);
  charts.forEach(({ line, samples, said }, k) => {
    assert.equal(line.length, 65);
    // Places are linear in phase and value: by two points all others are known.
    const { points } = curve[k];
    const [top, low] = [Math.max(...points), Math.min(...points)].map((value) => points.indexOf(value));
    const per_value = (line[low][1] - line[top][1]) / (points[top] - points[low]);
    assert.ok(per_value > 0);
    const y = (value) => line[top][1] + (points[top] - value) * per_value;
    const per_phase = (line[64][0] - line[0][0]) / turn;
    line.forEach(([at_x, at_y], i) => {
      assert.ok(Math.abs(at_x - line[0][0] - per_phase * ((turn * i) / 64)) < 0.02 && Math.abs(at_y - y(points[i % 64])) < 0.02, `curve ${k}, point ${i}`);
    });
    assert.deepEqual(samples.map(([phase, value]) => [phase, value]), curve[k].samples);
    for (const [phase, value, cx, cy] of samples) assert.ok(Math.abs(cx - line[0][0] - per_phase * phase) < 0.02 && Math.abs(cy - y(value)) < 0.02, `curve ${k}, sample at ${phase}`);
    assert.match(said, new RegExp(`^Correlation at ${k === 0 ? 80 : 60}\u00a0MHz .* measured: 0° .*, 90° .*, 180° .*, 270° `));
  });
});

test("a phasor points where I and Q are, Q up; its ellipse has two σ of the covariance, and the truth's cross stands at its place", async () => {
  const { page } = await made_up();
  const all = await page.locator("[data-phasor]").evaluateAll((figures) => figures.map((one) => ({
    frequency: Number(one.dataset.phasor),
    planes: [...one.querySelectorAll("svg")].map((svg) => {
      const numbers = (element, ...names) => names.map((name) => Number(element.getAttribute(name)));
      const line = svg.querySelector("line.line");
      const ellipse = svg.querySelector("ellipse");
      const cross = svg.querySelector(".truth path")?.getBBox();
      return {
        from: numbers(line, "x1", "y1"), to: numbers(line, "x2", "y2"), point: numbers(svg.querySelector("circle"), "cx", "cy"),
        axes: numbers(ellipse, "rx", "ry"), turn: Number(/rotate\(([-0-9.e]+) /.exec(ellipse.getAttribute("transform"))[1]),
        truth: cross && [cross.x + cross.width / 2, cross.y + cross.height / 2],
      };
    }),
    values: Object.fromEntries([...one.querySelectorAll("[data-phasor-value]")].map((cell) => [cell.dataset.phasorValue, [cell.textContent, Number(cell.dataset.number)]])),
  })));
  assert.deepEqual(all.map((one) => one.frequency), [80e6, 60e6]);
  all.forEach(({ planes, values }, k) => {
    const of = phasors[k];
    assert.equal(planes.length, 2);
    for (const [i, { from, to, point, axes, turn: turned, truth }] of planes.entries()) {
      const what = `phasor ${k}, plane ${i}`;
      const [dx, dy] = [to[0] - from[0], from[1] - to[1]];
      const scale = Math.hypot(dx, dy) / of.amplitude;
      assert.ok(Math.abs(Math.atan2(dy, dx) - of.phase_rad) < 1e-6, what);
      assert.ok(Math.hypot(point[0] - to[0], point[1] - to[1]) < 1e-6, what);
      // The ellipse: the covariance that its axes and its turn make, over four, is the answer's. (SVG turns to the right, Q points up.)
      const [a, b] = axes.map((one) => (one / scale) ** 2 / 4);
      const angle = (-turned * Math.PI) / 180;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const made = [a * c * c + b * s * s, a * s * s + b * c * c, (a - b) * s * c];
      const wanted = [of.sigma_i ** 2, of.sigma_q ** 2, of.covariance];
      made.forEach((one, j) => assert.ok(Math.abs(one - wanted[j]) < 1e-6 * of.sigma_i ** 2, `${what}: covariance ${made}, expected ${wanted}`));
      if (of.truth_i === null) assert.equal(truth, undefined, what);
      else assert.ok(Math.hypot(truth[0] - from[0] - of.truth_i * scale, from[1] - truth[1] - of.truth_q * scale) < 0.01, what);
    }
    // The second one is larger, so that ellipse and cross can be seen.
    const lengths = planes.map(({ from, to }) => Math.hypot(to[0] - from[0], to[1] - from[1]));
    assert.ok(lengths[1] > 4 * lengths[0]);
    for (const name of ["i", "q", "sigma_i", "sigma_q", "amplitude", "phase_rad"]) assert.equal(values[name][1], of[name], name);
    assert.equal(values.i[0], k === 0 ? "3000\u00a0e" : "\u22122000\u00a0e");
    assert.equal(values.phase_rad[0], k === 0 ? "53.1°" : "\u2212153.4°");
    assert.equal("truth_i" in values, k === 0);
  });
});

test("ways to unwrap stand by cost, the chosen one marked by a word, too, bars as long as half paths are apart, ranges where they are", async () => {
  const { page } = await made_up();
  const rows = await page.locator("[data-candidate]").evaluateAll((all) => all.map((one) => [...[...one.children].slice(0, 3).map((cell) => cell.textContent), Number(Number.parseFloat(one.querySelector(".bar span").style.width).toPrecision(4))]));
  assert.deepEqual(rows, [["0, 0 ✓ chosen", "0.623\u00a0m", "2.0\u00a0mm", 1], ["3, 2", "5.600\u00a0m", "12.6\u00a0mm", 6.325], ["1, 1", "2.800\u00a0m", "200\u00a0mm", 100]]);
  assert.match(await page.locator("[data-ratio]").textContent(), /cost is 40 times that/);
  const section = page.locator("details", { has: page.locator("[data-candidate]") });
  const places = await section.locator("svg circle").evaluateAll((all) => all.map((one) => [Number(one.getAttribute("cx")), one.classList.contains("sample")]));
  assert.deepEqual(places.map(([, chosen]) => chosen), [true, false, false]);
  const zero = Number(await section.locator("svg .grid").first().getAttribute("x1"));
  const ratio = (places[1][0] - zero) / (places[0][0] - zero);
  assert.ok(Math.abs(ratio - 5.6 / 0.6231) < 1e-3, String(ratio));
  assert.match(await section.locator("svg").getAttribute("aria-label"), /0\.6231 m, chosen; 5\.6 m; 2\.8 m; the true one is /);
});

test("the chain's stages stand in order, with the numbers as answered; a stage or a name that is not known is shown as it is, text as text", async () => {
  const { page } = await made_up();
  assert.deepEqual(await page.locator("[data-stage]").evaluateAll((all) => all.map((one) => [one.dataset.stage, one.querySelector("h3").textContent])),
    [["light", "Light"], ["taps", "Taps"], ["phase", "Phase"], ["sorcery", "sorcery"], ["z", "Depth"]]);
  const object = await page.locator(".object bdi").textContent();
  const cells = Object.fromEntries(await page.locator("[data-flow]").evaluateAll((all) => all.map((one) => [one.dataset.flow, [one.textContent, one.dataset.number]])));
  assert.deepEqual(cells, {
    "light.object": [object, "3"], "light.reflectivity": ["0.850000", "0.85"], "taps.tap_a": ["1.50000, 2.25000, 1234570, invalid\u00a0e", "[1.5,2.25,1234567.8,null]"],
    "phase.measured.0": ["0.250000\u00a0turns", "0.25"], "phase.measured.1": ["0.125000\u00a0turns", "0.125"], "sorcery.unheard_of": ["–", "null"], "sorcery.<i>word</i>": ["<i>text</i>", '"<i>text</i>"'], "z.z": ["0.623000\u00a0m", "0.623"],
  });
  assert.equal(await page.locator(".flow i").count(), 0);
  assert.deepEqual(await page.locator("[data-stage=phase] thead th").allTextContents(), ["80\u00a0MHz", "60\u00a0MHz"]);
});

test("of a real pixel the charts have the numbers of the answer, which are those of inspect", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await beside(tab, "Pixel");
  const frame = rendered(words);
  for (const [u, v] of [[112, 86], [10, 150], [60, 40]]) {
    await point_at(tab, u, v);
    await page.locator(`.answer[data-pixel="${u},${v}"][data-frame="0"]`).waitFor();
    const report = inspected(frame.path, u, v);
    const what = `pixel ${u}, ${v}`;
    const rows = await page.locator("[data-candidate]").evaluateAll((all) => all.map((one) => [one.dataset.candidate, Number(one.dataset.cost), one.dataset.chosen === "true"]));
    assert.ok(rows.length >= 2, what);
    assert.deepEqual(rows, report.unwrapping.candidates.map((one) => [one.cycles.join(","), one.cost, one.chosen === true]), what);
    assert.deepEqual(rows.map(([, cost]) => cost), rows.map(([, cost]) => cost).sort((a, b) => a - b), what);
    assert.equal(rows.find(([, , chosen]) => chosen)[0], report.phases.map((one) => one.cycles).join(","), what);
    const shown_numbers = Object.fromEntries(await page.locator("[data-flow]").evaluateAll((all) => all.map((one) => [one.dataset.flow, JSON.parse(one.dataset.number)])));
    assert.equal(await page.locator('[data-flow="light.object"]').textContent(), report.truth.object, what);
    assert.deepEqual(shown_numbers["taps.tap_a"], report.raw_frames.map((one) => one.tap_a_e), what);
    assert.deepEqual(shown_numbers["adc.code"], report.raw_frames.map((one) => one.raw_dn), what);
    report.phases.forEach((one, k) => {
      assert.equal(shown_numbers[`correlation.amplitude.${k}`], one.amplitude_e, what);
      assert.equal(shown_numbers[`unwrapping.half_path.${k}`], one.half_path_m, what);
    });
    assert.equal(shown_numbers["range.range"], report.depth.range_m, what);
    assert.equal(shown_numbers["z.z"], report.depth.z_m, what);
    const phasor = await page.locator("[data-phasor]").evaluateAll((all) => all.map((one) => Object.fromEntries([...one.querySelectorAll("[data-phasor-value]")].map((cell) => [cell.dataset.phasorValue, Number(cell.dataset.number)]))));
    assert.equal(phasor.length, report.phases.length, what);
    phasor.forEach((one, k) => {
      const { amplitude_e, measured_phase_rad } = report.phases[k];
      assert.ok(Math.abs(one.i - amplitude_e * Math.cos(measured_phase_rad)) < 1e-6 * amplitude_e && Math.abs(one.q - amplitude_e * Math.sin(measured_phase_rad)) < 1e-6 * amplitude_e, what);
    });
    const samples = await page.locator("[data-curve]").evaluateAll((all) => all.map((one) => [...one.querySelectorAll("[data-sample]")].map((sample) => sample.dataset.sample.split(" ").map(Number))));
    assert.deepEqual(samples, report.phases.map(({ modulation_frequency_hz }) => report.raw_frames.filter((one) => one.lit && one.modulation_frequency_hz === modulation_frequency_hz)
      .map((one) => [one.reference_phase_rad, one.difference_e])), what);
  }
});
