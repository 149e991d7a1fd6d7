// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the page says of a pixel is what `tofray inspect --pixel --json` says of the file that the same words write.

import assert from "node:assert/strict";
import { beside, inspected, point_at, rendered, shown, stand_at, test, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const width = 224, height = 172;

/** Twenty: the corners, the last row and column, some that are invalid for each reason, and others all over the image. */
function pixels_of({ flags, z_m }) {
  const out = [[0, 0], [width - 1, 0], [0, height - 1], [width - 1, height - 1], [100, height - 1], [width - 1, 60], [112, 86]];
  for (const bits of new Set(flags.values)) {
    if (bits === 0) continue;
    const at = flags.values.lastIndexOf(bits);
    out.push([at % width, Math.floor(at / width)]);
  }
  assert.ok(out.some(([u, v]) => Number.isNaN(z_m.values[v * width + u])));
  for (let i = 0; out.length < 20; ++i) out.push([(37 + 61 * i) % width, (11 + 47 * i) % height]);
  return out;
}

/** A number as the page writes it, read again. */
function number(text) {
  const [digits] = text.split("\u00a0");
  if (digits === "invalid" || digits === "–") return null;
  assert.match(digits, /^\u2212?[0-9.]+(e[+-][0-9]+)?$/, text);
  return Number(digits.replace("\u2212", "-"));
}

/** Six significant digits; whole numbers whole. */
const rounded = (value) => (value === null || Number.isInteger(value) ? value : Number(value.toPrecision(6)));

const members = {
  range_m: ["depth", "range_m"], z_m: ["depth", "z_m"], noise_m: ["depth", "noise_m"], amplitude_e: ["depth", "amplitude_e"],
  ambient_e: ["depth", "ambient_e"], confidence: ["depth", "confidence"], gt_object_id: ["truth", "object_id"],
  gt_reflectivity: ["truth", "reflectivity"], gt_range_m: ["truth", "range_m"], gt_z_m: ["truth", "z_m"],
  gt_irradiance_w_m2: ["truth", "irradiance_w_m2"], gt_radiance_w_m2_sr: ["truth", "radiance_w_m2_sr"], gt_power_w: ["truth", "power_w"],
};

async function compare_panel({ page, hello }, report) {
  const what = `pixel ${report.pixel}`;
  // All of it at once: it is of one moment, and a question for each cell takes its time.
  const said = await page.evaluate(() => {
    const texts = (selector) => [...document.querySelectorAll(selector)].map((one) => one.textContent);
    return {
      cells: [...document.querySelectorAll(".answer td[data-value]")].map((one) => [one.dataset.value, one.textContent]),
      objects: texts(".object bdi"),
      why: texts(".why strong"),
      readings: Object.fromEntries(['[data-reading="flags"]', ...["z_m", "amplitude_e"].flatMap((array) => [`.reading[data-array="${array}"]`, `[data-reading="${array}"]`])].map((one) => [one, texts(one)])),
      rows: [...document.querySelectorAll("table.raw tbody tr")].map((row) => [...row.cells].map((cell) => cell.textContent)),
    };
  });
  const reading = (place) => {
    assert.equal(said.readings[place].length, 1, `${what}: ${place}`);
    return said.readings[place][0];
  };
  const cells = Object.fromEntries(said.cells);
  for (const [array, [part, member]] of Object.entries(members)) assert.equal(number(cells[array]), rounded(report[part][member]), `${what}: ${array}`);
  assert.match(cells.gt_z_m, /\u00a0m$/);
  assert.match(cells.amplitude_e, /\u00a0e$/);
  assert.deepEqual(said.objects, [report.truth.object], what);

  const reason = hello().invalid.find(({ name }) => report.depth.flags.includes(name))?.name;
  assert.deepEqual(said.why, report.depth.z_m === null ? [`No depth: ${reason}.`] : [], what);
  const flags = reading('[data-reading="flags"]');
  assert.deepEqual(flags.split(", ").sort(), report.depth.flags.length === 0 ? ["none"] : [...report.depth.flags].sort(), what);
  for (const array of ["z_m", "amplitude_e"]) {
    for (const place of [`.reading[data-array="${array}"]`, `[data-reading="${array}"]`]) {
      const text = reading(place);
      const value = report.depth[members[array][1]];
      if (value === null) assert.equal(text, `invalid: ${reason}`, what);
      else assert.equal(number(text), rounded(value), `${what}: ${place}`);
    }
  }

  const { rows } = said;
  const scaled = (value, factor) => (value === null ? null : rounded(Number((value * factor).toPrecision(6))));
  const expected = report.raw_frames.map((one) => [
    one.lit ? scaled(one.modulation_frequency_hz, 1e-6) : "unlit", one.lit ? scaled(one.reference_phase_rad, 180 / Math.PI) : "",
    scaled(one.tap_a_e, 1), scaled(one.tap_b_e, 1), scaled(one.raw_dn, 1),
  ]);
  assert.deepEqual(rows.map((row) => row.map((text) => (text === "" || text === "unlit" ? text : number(text)))), expected, what);
}

test("the pointer over twenty pixels reads what inspect prints of them", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  await beside(tab, "Pixel");
  await stand_at(tab, 0);
  const frame = rendered(words);
  for (const [u, v] of pixels_of(frame)) {
    await point_at(tab, u, v);
    await tab.page.locator(`.answer[data-pixel="${u},${v}"][data-frame="0"]`).waitFor();
    assert.match(await tab.page.locator(".panel h2").textContent(), new RegExp(`^Pixel ${u}, ${v} `));
    await compare_panel(tab, inspected(frame.path, u, v));
  }
});

test("arrow keys go to the same pixels, and a live region says what inspect prints", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  await beside(tab, "Pixel");
  const { page } = tab;
  await stand_at(tab, 0);
  const frame = rendered(words);
  assert.deepEqual(await page.locator("#spoken").evaluate((one) => [one.getAttribute("aria-live"), one.getAttribute("role")]), ["polite", "log"]);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("ArrowRight");   // the first one only puts the cursor into the middle
  let [at_u, at_v] = [width / 2, height / 2];
  const go = async (by, forward, back) => {
    const key = by > 0 ? forward : back;
    for (let i = 0; i < Math.floor(Math.abs(by) / 10); ++i) await page.keyboard.press(`Shift+${key}`);
    for (let i = 0; i < Math.abs(by) % 10; ++i) await page.keyboard.press(key);
  };
  const left = pixels_of(frame).filter(([u, v]) => u !== at_u || v !== at_v);
  assert.ok(left.length >= 19);
  const presses = ([u, v]) => [u - at_u, v - at_v].reduce((sum, by) => sum + Math.floor(Math.abs(by) / 10) + (Math.abs(by) % 10), 0);
  while (left.length > 0) {
    left.sort((a, b) => presses(a) - presses(b));   // the nearest one is next
    const [u, v] = left.shift();
    await go(u - at_u, "ArrowRight", "ArrowLeft");
    await go(v - at_v, "ArrowDown", "ArrowUp");
    [at_u, at_v] = [u, v];
    await page.waitForFunction((start) => document.getElementById("spoken").textContent.startsWith(start), `Pixel ${u}, ${v}. `);
    await page.locator(`.answer[data-pixel="${u},${v}"][data-frame="0"]`).waitFor();
    const report = inspected(frame.path, u, v);
    await compare_panel(tab, report);
    const [, depth, amplitude] = /^Pixel \d+, \d+\. Depth (.*)\. Amplitude (.*)$/.exec(await page.locator("#spoken").textContent());
    if (report.depth.z_m === null) assert.equal(depth, await page.locator('.reading[data-array="z_m"]').textContent());
    else assert.equal(number(depth), rounded(report.depth.z_m));
    assert.equal(number(amplitude), rounded(report.depth.amplitude_e));
  }
  // At an edge it stays.
  await go(-300, "ArrowRight", "ArrowLeft");
  await go(-300, "ArrowDown", "ArrowUp");
  await page.waitForFunction(() => document.getElementById("spoken").textContent.startsWith("Pixel 0, 0. "));
});

test("while frames pass by, a pixel is asked for when the cursor moves, at most twice a second, and again when they stand still", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  await beside(tab, "Pixel");
  const { page } = tab;
  const questions = () => tab.asked.filter((one) => one.type === "pixel").length;
  const more_frames = async (count) => {
    const from = await page.evaluate(() => window.tofray.counters.drawn);
    await page.waitForFunction((to) => window.tofray.counters.drawn >= to, from + count);
  };
  await point_at(tab, 50, 50);
  await page.locator('.answer[data-pixel="50,50"]').waitFor();
  await more_frames(8);   // three times as long as from one question to the next
  assert.equal(questions(), 1);

  const start = performance.now();
  for (let i = 0; i < 40; ++i) {
    await point_at(tab, 60 + i, 50);
    await page.waitForTimeout(50);
  }
  await page.locator('.answer[data-pixel="99,50"]').waitFor();
  const moved = questions() - 1;
  assert.ok(moved >= 2 && moved <= 1 + (performance.now() - start) / 500, `${moved} questions`);

  await stand_at(tab, 3);
  await page.locator('.answer[data-pixel="99,50"][data-frame="3"]').waitFor();
  await compare_panel(tab, inspected(rendered(words, 3).path, 99, 50));
});
