// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Distances, statistics of a rectangle, and noise over time: what the page shows is what this file makes of the arrays that the command writes.

import assert from "node:assert/strict";
import { mkdtempSync } from "node:fs";
import { join } from "node:path";
import { read_npz } from "./npz.mjs";
import { expected, scale_of } from "./colors.mjs";
import { answered_arrays, beside, folder, inspected, pane, point_at, rendered, same, set, settled, shown, stand_at, test, told, until, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const width = 224, height = 172, pixels = width * height;

async function ready(options) {
  const { url } = await view(words);
  const tab = await shown(url, options);
  await stand_at(tab, 0);
  await tab.page.locator(".stage").first().focus();
  return tab;
}

const number = (text) => Number(text.replace("\u2212", "-").replace(/[\u00a0 ].*$/, ""));
const of_measure = ({ page }, name) => page.locator(`[data-measure-of="${name}"]`).textContent();

function places({ points_m, gt_position_m }, u, v) {
  const i = 3 * (v * width + u);
  return { measured: [...points_m.values.slice(i, i + 3)], true: [...gt_position_m.values.slice(i, i + 3)] };
}

const minus = (a, b) => a.map((one, k) => one - b[k]);

/** σ of a distance between two points whose ranges have noise, along their rays. */
function sigma({ noise_m }, [ua, va], [ub, vb], a, b) {
  const way = minus(b, a);
  const far = Math.hypot(...way);
  const along = (p) => p.reduce((sum, one, k) => sum + (one * way[k]) / far, 0) / Math.hypot(...p);
  return Math.hypot(along(a) * noise_m.values[va * width + ua], along(b) * noise_m.values[vb * width + ub]);
}

test("m at two pixels: the distance between the points that the command writes, the true one, and σ of both ends' noise", async () => {
  const tab = await ready();
  const { page } = tab;
  const [p, q] = [[112, 120], [200, 60]];
  await point_at(tab, ...p);
  await page.keyboard.press("m");
  await page.getByText("From pixel 112, 120: the other end?").waitFor();
  await point_at(tab, ...q);
  await page.keyboard.press("m");
  await page.locator("[data-measure]").waitFor();
  const check = async (frame, what) => {
    const [a, b] = [places(frame, ...p), places(frame, ...q)];
    const wanted = Math.hypot(...minus(b.measured, a.measured));
    const truth = Math.hypot(...minus(b.true, a.true));
    const s = sigma(frame, p, q, a.measured, b.measured);
    assert.ok(Math.abs(number(await of_measure(tab, "measured")) - wanted) < 0.6e-3, `${what}: ${await of_measure(tab, "measured")}, expected ${wanted}`);
    assert.ok(Math.abs(number(await of_measure(tab, "true")) - truth) < 0.6e-3, `${what}: ${await of_measure(tab, "true")}, expected ${truth}`);
    assert.ok(Math.abs(number(await of_measure(tab, "sigma")) / (1000 * s) - 1) < 2e-3, `${what}: ${await of_measure(tab, "sigma")}, expected ${1000 * s}`);
    assert.ok(Math.abs(number(await of_measure(tab, "error")) - 1000 * (wanted - truth)) < 0.01, `${what}: ${await of_measure(tab, "error")}`);
    const shown_place = (await page.locator('[data-measured="A"]').textContent()).split(", ").map(number);
    shown_place.forEach((one, k) => assert.ok(Math.abs(one - a.measured[k]) < 1e-4, `${what}: A is ${shown_place}`));
  };
  await check(rendered(words), "frame 0");
  const { path } = rendered(words);
  assert.deepEqual(await page.locator("[data-measure] bdi").allTextContents(), [p, q].map(([u, v]) => inspected(path, u, v).truth.object));
  // It stays, of each frame that comes and of a changed camera.
  await page.keyboard.press(".");
  await page.getByText("Distance, frame 1;").waitFor();
  await check(rendered(words, 1), "frame 1");
  const asked = () => tab.asked.filter((one) => one.type === "measure").length;
  const before = asked();
  await page.waitForTimeout(500);
  assert.equal(asked(), before, "asked again of what is known");
  await beside(tab, "Controls");
  await set(tab, "camera.lens.f_number", "2.8");
  await beside(tab, "Measure");
  await until(() => asked() > before, "the changed camera's");
  await until(() => tab.texts.findLast((one) => one.type === "measure").generation === 2, "its answer");
  await page.waitForTimeout(200);
  await check(rendered([...words, "--set", "camera.lens.f_number=2.8"], 1), "the changed camera");
});

test("the line is drawn on every pane with its ends; a click with the tool, Escape and ✕ do what they say", async () => {
  const tab = await ready();
  const { page } = tab;
  await page.getByRole("group", { name: "Tools" }).getByRole("button", { name: "Measure" }).click();
  for (const [u, v] of [[40, 60], [160, 60]]) {
    await point_at(tab, u, v);
    await page.mouse.down();
    await page.mouse.up();
  }
  await page.locator("[data-measure]").waitFor();
  await point_at(tab, 100, 150);
  await page.evaluate(() => new Promise((then) => requestAnimationFrame(() => requestAnimationFrame(then))));
  const white = (i) => page.evaluate((at) => {
    const { left, top, scale } = window.tofray.placement(at);
    const { data } = document.querySelectorAll(".pane")[at].querySelector("canvas.over").getContext("2d").getImageData(left + 50 * scale, top + 60.5 * scale - 1, 100 * scale, 2);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) if (data[k] > 200 && data[k + 3] > 200) ++count;
    return count / (data.length / 4);
  }, i);
  for (const i of [0, 1]) assert.ok((await white(i)) > 0.4, `pane ${i}: ${await white(i)}`);
  await page.getByRole("button", { name: "Drop what is measured" }).click();
  await page.locator("[data-measure]").waitFor({ state: "detached" });
  await page.evaluate(() => new Promise((then) => requestAnimationFrame(() => requestAnimationFrame(then))));
  assert.ok((await white(0)) < 0.1);
  // By keys: half done, and dropped.
  await page.locator(".stage").first().focus();
  await page.keyboard.press("m");
  await page.getByText("the other end?").waitFor();
  await page.keyboard.press("Escape");
  await page.getByText("the other end?").waitFor({ state: "detached" });
});

test("a rectangle by Shift and a drag, by g at two corners, and by the button: its numbers are those of `tofray quality`, and it stays over frames", async () => {
  const tab = await ready();
  const { page } = tab;
  const regions = () => tab.asked.filter((one) => one.type === "region").map((one) => one.region.join());
  await page.keyboard.down("Shift");
  await point_at(tab, 215, 60);
  await page.mouse.down();
  await point_at(tab, 180, 30);
  await point_at(tab, 150, 10);
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await page.locator('[data-row="fill_rate_percent"]').waitFor();
  assert.deepEqual([...new Set(regions())], ["150,10,215,60"]);
  const check = async (frame, what) => {
    const one = rendered(words, frame);
    const told_by = JSON.parse(told(["quality", one.path, "--region", "150,10,66,51", "--json"]));
    const metrics = numbers_in(told_by);
    const rows = await page.locator("[data-row]").evaluateAll((all) => all.map((row) => [row.dataset.row, row.querySelector("td").dataset.number]));
    let compared = 0;
    for (const [name, value] of rows) {
      if (!(name in metrics) || metrics[name] === null) continue;
      ++compared;
      assert.ok(Math.abs(Number(value) - metrics[name]) <= 1e-6 * Math.abs(metrics[name]) + 1e-12, `${what}: ${name} is ${value}, expected ${metrics[name]}`);
    }
    assert.ok(compared >= 5, `${what}: ${compared} numbers have their like`);
    // And by hand: fill rate, and the median of the noise estimated.
    const inside = [];
    for (let v = 10; v <= 60; ++v) for (let u = 150; u <= 215; ++u) inside.push(v * width + u);
    const valid = inside.filter((i) => Number.isFinite(one.z_m.values[i]));
    const of = Object.fromEntries(rows);
    assert.ok(Math.abs(of.fill_rate_percent - (100 * valid.length) / inside.length) < 1e-6, `${what}: fill rate ${of.fill_rate_percent}`);
    const noise = valid.map((i) => one.noise_m.values[i]).sort((a, b) => a - b);
    const median = (noise[(noise.length - 1) >> 1] + noise[noise.length >> 1]) / 2;
    assert.ok(Math.abs(of.noise_median_m / median - 1) < 1e-5, `${what}: ${of.noise_median_m}, expected ${median}`);
  };
  await check(0, "frame 0");
  await page.locator(".stage").first().focus();
  await page.keyboard.press(".");
  await page.locator("caption", { hasText: "frame 1" }).waitFor();
  await check(1, "frame 1");

  await point_at(tab, 20, 100);
  await page.keyboard.press("g");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Shift+ArrowUp");
  await page.keyboard.press("g");
  await until(() => regions().at(-1) === "20,90,50,100", "the rectangle of two corners");
  await page.getByRole("button", { name: "Drag one" }).click();
  await point_at(tab, 5, 5);
  await page.mouse.down();
  await point_at(tab, 60, 100);
  await point_at(tab, 120, 160);
  await page.mouse.up();
  await until(() => regions().at(-1) === "5,5,120,160", "a large one");
  await page.getByRole("button", { name: "Drop the rectangle" }).click();
  await page.locator("[data-region]").waitFor({ state: "detached" });
});

/** All numbers of a report, by name, wherever they stand in it. */
function numbers_in(of, out = {}) {
  if (of === null || typeof of !== "object") return out;
  for (const [name, value] of Object.entries(of)) {
    if (typeof value === "number" || value === null) out[name] ??= value;
    else if (typeof value === "object") {
      if (typeof value?.name === "string" && "value" in value) out[value.name] ??= value.value;
      numbers_in(value, out);
    }
  }
  return out;
}

test("200 frames now: σ over time of each pixel is that of 200 frames rendered, beside σ̂, as numbers and as two panes of one scale", async () => {
  const tab = await ready();
  const { page } = tab;
  await page.keyboard.press("n");
  await page.locator("[data-temporal]").waitFor();
  const answer = tab.texts.findLast((one) => one.type === "temporal" && one.static === true);
  assert.deepEqual([answer.frames, answer.done, answer.frame], [200, 200, 0]);
  const of = answered_arrays(tab, answer);
  // (Nothing moves in this scene: 200 frames that stand still are 200 frames.)
  const out = mkdtempSync(join(folder, "frames-"));
  told(["render", ...words, "--frames", "200", "--arrays", "z_m", "--emit", "npz", "--quiet", "-o", out]);
  const [n, mean, squares] = [new Float64Array(pixels), new Float64Array(pixels), new Float64Array(pixels)];
  for (let k = 0; k < 200; ++k) {
    const z = read_npz(join(out, `frame_${String(k).padStart(4, "0")}.npz`)).z_m.values;
    for (let i = 0; i < pixels; ++i) {
      if (!Number.isFinite(z[i])) continue;
      const off = z[i] - mean[i];
      mean[i] += off / ++n[i];
      squares[i] += off * (z[i] - mean[i]);
    }
  }
  const all = [];
  for (let i = 0; i < pixels; ++i) {
    assert.equal(of.temporal_count.values[i], n[i], `pixel ${i}: n`);
    if (n[i] < 2) {
      assert.ok(Number.isNaN(of.temporal_sigma_m.values[i]), `pixel ${i}`);
      continue;
    }
    const sigma_of = Math.sqrt(squares[i] / (n[i] - 1));
    all.push(sigma_of);
    assert.ok(Math.abs(of.temporal_sigma_m.values[i] - sigma_of) <= 2e-6 * sigma_of + 1e-9, `pixel ${i}: σ is ${of.temporal_sigma_m.values[i]}, expected ${sigma_of}`);
    assert.ok(Math.abs(of.temporal_mean_m.values[i] - mean[i]) <= 1e-6, `pixel ${i}: mean`);
  }
  const shown_number = async (name) => number(await page.locator(`[data-temporal-of="${name}"]`).textContent());
  all.sort((a, b) => a - b);
  const median = (all[(all.length - 1) >> 1] + all[all.length >> 1]) / 2;
  assert.ok(Math.abs((await shown_number("sigma")) / (1000 * median) - 1) < 2e-3, `${await shown_number("sigma")} mm, expected ${1000 * median}`);
  assert.ok(Math.abs((await shown_number("fill")) - (100 * n.reduce((a, b) => a + b, 0)) / (200 * pixels)) < 0.01);
  assert.ok(Math.abs((await shown_number("chi2")) - answer.chi2) < 1e-3);
  assert.ok(Math.abs((await shown_number("predicted")) / (1000 * answer.predicted_median_m) - 1) < 2e-3);

  await page.getByRole("button", { name: "Show σ and σ̂" }).click();
  await page.waitForFunction(() => window.tofray.pane(0)?.array === "temporal_sigma_m" && window.tofray.pane(1)?.array === "temporal_predicted_m");
  const { flags } = rendered(words);
  const scale = scale_of(tab.hello(), "noise_m");
  for (const [i, name] of [[0, "temporal_sigma_m"], [1, "temporal_predicted_m"]]) same((await pane(tab, i)).pixels, expected(tab.hello(), scale, [...of[name].values], flags.values), name);
  await page.getByRole("button", { name: "Histogram", exact: true }).first().click();
  await page.locator("canvas.histogram").waitFor();

  // While they are shown, a changed camera's come by themselves.
  await beside(tab, "Controls");
  await set(tab, "camera.lens.f_number", "2.8");
  await until(() => tab.texts.some((one) => one.type === "temporal" && one.static === true && one.generation === 2), "the changed camera's noise");
  await settled(tab);
  assert.ok(tab.texts.findLast((one) => one.type === "temporal" && one.static === true).sigma_median_m > 1.2 * answer.sigma_median_m);
  assert.equal(await page.getByRole("alert").count(), 0);
});

test("of two states the numbers are those of the one that controls change", async () => {
  const tab = await ready();
  const { page } = tab;
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await page.locator(".compare-bar").waitFor();
  await set(tab, "camera.lens.f_number", "2.8");
  await page.locator(".stage").first().focus();
  await point_at(tab, 112, 120);
  await page.keyboard.press("m");
  await point_at(tab, 200, 60);
  await page.keyboard.press("m");
  await page.locator("[data-measure]").waitFor();
  await page.getByRole("heading", { name: "Two points of B" }).waitFor();
  assert.equal(tab.asked.findLast((one) => one.type === "measure").side, "b");
  const b = rendered([...words, "--set", "camera.lens.f_number=2.8"]);
  const wanted = Math.hypot(...minus(places(b, 200, 60).measured, places(b, 112, 120).measured));
  assert.ok(Math.abs(number(await of_measure(tab, "measured")) - wanted) < 0.6e-3, `${await of_measure(tab, "measured")}, expected ${wanted}`);
});
