// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Why is it wrong: what is asked, and that the page shows what was answered, to the bar.

import assert from "node:assert/strict";
import { split } from "./answers.mjs";
import { between, point_at, rendered, set, shown, stand_at, test, until, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];

/** A tab whose questions are answered here. @return  the questions, too */
async function asking(answer = () => ({}), options = {}) {
  const questions = [];
  const why = (of) => {
    questions.push(of);
    const { id, u, v, region } = of;
    const own = answer(of);
    return own === null ? [] : [own].flat().map((one) => ({ type: "why", id, u, v, region, pixels: 1, count: 1, ...split, ...one }));
  };
  const { url } = await view(words);
  const tab = await shown(url, { before: between({ asked: { why } }), ...options });
  await stand_at(tab, 0);
  await tab.page.locator(".stage").first().focus();
  return { ...tab, questions };
}

const row = ({ page }, cause) => page.locator(`[data-cause="${cause}"]`);
const answered = ({ page }) => page.locator("[data-why-of]").waitFor();

test("w asks for the pixel under the cursor, and every number of the answer is on the page, the largest cause first, the rest last", async () => {
  const tab = await asking();
  const { page, questions } = tab;
  await point_at(tab, 60, 40);
  await page.keyboard.press("w");
  await answered(tab);
  await page.waitForTimeout(500);   // once is enough
  assert.deepEqual(questions.map(({ u, v, region, side }) => [u, v, region, side]), [[60, 40, undefined, undefined]]);
  const rows = await page.locator(".causes tr").evaluateAll((all) => all.map((one) => [one.dataset.cause, one.querySelector("strong").textContent, one.querySelector(".mm").textContent]));
  assert.deepEqual(rows, [
    ["error", "Error", "\u22128.90\u00a0mm"], ["wiggling", "Wiggling", "\u221212.0\u00a0mm"], ["multipath", "Multipath", "+4.21\u00a0mm"], ["noise", "Noise", "\u22121.20\u00a0mm"],
    ["<b>gamma</b> rays", "<b>gamma</b> rays", "\u22120.50\u00a0mm"], ["mixed_pixel", "Mixed pixel", "+0.20\u00a0mm"], ["rest", "Rest", "+0.39\u00a0mm"],
  ]);
  assert.equal(await page.locator('[data-why="error"]').textContent(), "\u22128.90\u00a0mm");
  assert.equal(await page.locator('[data-why="sigma"]').textContent(), "1.80\u00a0mm");
  assert.match(await page.locator(".why-sum").textContent(), /too near.*largest cause: wiggling/);
  // Every known cause says what it is.
  const means = await page.locator(".causes tr").evaluateAll((all) => all.filter((one) => !one.dataset.cause.startsWith("<")).map((one) => one.querySelector(".means").textContent.length));
  for (const length of means) assert.ok(length > 15);
});

test("bars have one scale: as long as their millimetres, to the left where too near, the band one σ̂ to either side", async () => {
  const tab = await asking();
  const { page } = tab;
  await point_at(tab, 60, 40);
  await page.keyboard.press("w");
  await answered(tab);
  const bars = await page.locator(".causes tr").evaluateAll((all) => all.map((one) => {
    const [zero, fill, band] = [".zero", ".fill", ".band"].map((name) => one.querySelector(name).getBoundingClientRect());
    return { cause: one.dataset.cause, mm: Number(one.querySelector(".mm").dataset.mm), left: fill.left - zero.left, right: fill.right - zero.left, band: [band.left - zero.left, band.right - zero.left], box: one.querySelector(".bar-of").getBoundingClientRect().width };
  }));
  const unit = -bars.find((one) => one.cause === "wiggling").left / 12;   // px in a millimetre
  assert.ok(unit * 12 > 0.45 * bars[0].box && unit * 12 < 0.5 * bars[0].box, "the longest bar fills its half");
  for (const { cause, mm, left, right, band } of bars) {
    const [from, to] = [Math.min(0, mm * unit), Math.max(0, mm * unit)];
    assert.ok(Math.abs(left - from) <= 1 && Math.abs(right - to) <= 2, `${cause}: ${left} … ${right}, expected ${from} … ${to}`);
    assert.ok(Math.abs(band[0] + 1.8 * unit) <= 1 && Math.abs(band[1] - 1.8 * unit) <= 1, `${cause}: the band is ${band}`);
  }
});

test("a region: by Alt and a drag, by the button and a drag, and by e at two corners; at most 64 pixels across and down", async () => {
  const tab = await asking(() => ({ pixels: 300, count: 400 }));
  const { page, questions } = tab;
  const drag = async (from, to) => {
    await point_at(tab, ...from);
    await page.mouse.down();
    await point_at(tab, (from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
    await point_at(tab, ...to);
    await page.mouse.up();
  };
  const last = async (count) => {
    await until(() => questions.length === count, `question ${count}`);
    await answered(tab);
    return questions.at(-1).region;
  };
  await page.keyboard.down("Alt");
  await drag([50, 60], [40, 70]);
  await page.keyboard.up("Alt");
  assert.deepEqual(await last(1), [40, 60, 50, 70]);
  assert.equal(await page.locator('[data-why="pixels"]').textContent(), "300");
  assert.match(await page.locator(".why-panel .of-frame").first().textContent(), /pixels 40 … 50, 60 … 70.*300 of 400 pixels have a depth/);
  assert.equal(await row(tab, "error").locator("strong").textContent(), "Mean error");

  await page.getByRole("button", { name: "Region" }).click();
  await drag([100, 20], [220, 150]);
  assert.deepEqual(await last(2), [100, 20, 163, 83]);
  assert.match(await page.locator(".why-panel .of-frame").first().textContent(), /pixels 100 … 163, 20 … 83/);
  // Once: the next drag moves the picture, or nothing where all of it is seen.
  await drag([100, 20], [120, 40]);

  await page.locator(".stage").first().focus();
  await point_at(tab, 200, 150);
  await page.keyboard.press("e");
  for (let i = 0; i < 2; ++i) await page.keyboard.press("Shift+ArrowDown");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+ArrowLeft");
  await page.keyboard.press("e");
  assert.deepEqual(await last(3), [170, 150, 200, 170]);
  assert.equal(questions.length, 3);

  // Escape: nothing is asked by the next e but a new corner.
  await page.keyboard.press("e");
  await page.keyboard.press("Escape");
  await page.keyboard.press("e");
  assert.equal(questions.length, 3);
});

test("the region is drawn on every pane", async () => {
  const tab = await asking(() => ({ pixels: 300, count: 400 }));
  const { page } = tab;
  await point_at(tab, 40, 60);
  await page.keyboard.press("e");
  await point_at(tab, 60, 80);
  await page.keyboard.press("e");
  await answered(tab);
  await point_at(tab, 150, 20);
  await page.evaluate(() => new Promise((then) => requestAnimationFrame(() => requestAnimationFrame(then))));
  for (const i of [0, 1]) {
    const painted = await page.evaluate((at) => {
      const { left, top, scale } = window.tofray.placement(at);
      const context = document.querySelectorAll(".pane")[at].querySelector("canvas.over").getContext("2d");
      const opaque = (x, y, width, height) => {
        const { data } = context.getImageData(Math.round(x), Math.round(y), Math.max(1, Math.round(width)), Math.max(1, Math.round(height)));
        let count = 0;
        for (let k = 3; k < data.length; k += 4) if (data[k] > 128) ++count;
        return count / (data.length / 4);
      };
      const [x0, y0, x1, y1] = [left + 40 * scale, top + 60 * scale, left + 61 * scale, top + 81 * scale];
      return { edges: [opaque(x0, y0 - 1, x1 - x0, 1), opaque(x0, y1, x1 - x0, 1), opaque(x0 - 1, y0, 1, y1 - y0), opaque(x1, y0, 1, y1 - y0)], inside: opaque(x0 + 3, y0 + 3, x1 - x0 - 6, y1 - y0 - 6) };
    }, i);
    for (const share of painted.edges) assert.ok(share > 0.9, `pane ${i}: ${JSON.stringify(painted)}`);
    assert.equal(painted.inside, 0, `pane ${i}`);
  }
});

test("the question stays: it is asked anew when the state changes or another frame stands still, not while frames pass by", async () => {
  const tab = await asking();
  const { page, questions } = tab;
  await point_at(tab, 60, 40);
  await page.keyboard.press("w");
  await answered(tab);
  await page.keyboard.press(".");
  await until(() => questions.length === 2, "the next frame's question");
  await page.getByRole("button", { name: "Play" }).click();
  const from = await page.evaluate(() => window.tofray.counters.drawn);
  await page.waitForFunction((to) => window.tofray.counters.drawn > to, from + 8);
  assert.equal(questions.length, 2);
  await page.getByRole("button", { name: "Pause" }).click();
  await until(() => questions.length === 3, "the question of the frame that stands still");
  await page.getByRole("tab", { name: "Controls" }).click();
  await set(tab, "camera.lens.f_number", "2.8");
  await page.getByRole("tab", { name: "Pixel" }).click();
  await until(() => questions.length === 4, "the question of the changed state");
  await page.getByRole("button", { name: "Close: why is it wrong?" }).click();
  await page.locator(".stage").first().focus();
  await page.keyboard.press(".");
  await page.waitForTimeout(800);
  assert.equal(questions.length, 4);
});

test("an answer to an older question that comes late is not shown", async () => {
  let first;
  const tab = await asking((of) => {
    if (first === undefined) {
      first = of;
      return null;   // not answered yet
    }
    return [{ error_m: 0.002, causes: [], rest_mm: 2 }, { id: first.id, error_m: 0.007, causes: [], rest_mm: 7 }];
  });
  const { page, questions } = tab;
  await point_at(tab, 60, 40);
  await page.keyboard.press("w");
  await page.getByText("Frames are computed with one cause off").waitFor();
  await point_at(tab, 70, 40);
  await page.keyboard.press("w");
  await answered(tab);
  await page.waitForTimeout(200);
  assert.equal(questions.length, 2);
  assert.equal(await page.locator("[data-why-of]").getAttribute("data-why-of"), String(questions[1].id));
  assert.equal(await page.locator('[data-why="error"]').textContent(), "+2.00\u00a0mm");
});

test("no depth, no σ̂, and a fault are said in words", async () => {
  let answer = { error_m: null, sigma_m: null, causes: [], rest_mm: null, pixels: 0 };
  const tab = await asking((of) => (answer === "fault" ? { type: "fault", text: "no truth in a recording", more: "simulate it" } : answer));
  const { page } = tab;
  await point_at(tab, 60, 40);
  await page.keyboard.press("w");
  await page.getByText("No pixel here has a depth, so there is no error to split.").waitFor();
  answer = { sigma_m: null, causes: [{ cause: "noise", mm: null }], rest_mm: 0 };
  await page.keyboard.press("w");
  await row(tab, "noise").waitFor();
  assert.equal(await row(tab, "noise").locator(".mm").textContent(), "unknown");
  assert.equal(await row(tab, "rest").locator(".mm").textContent(), "0.00\u00a0mm");
  assert.equal(await page.locator('[data-why="sigma"], .band').count(), 0);
  answer = "fault";
  await page.keyboard.press("w");
  assert.equal(await page.locator(".why-panel .wrong").textContent(), "no truth in a recording simulate it");
  assert.equal(await page.getByRole("alert").count(), 0);
});

/** Of a real split: what the page shows of each cause, the error and the rest [mm]. */
async function shown_split({ page }) {
  await page.waitForFunction(() => document.querySelector(".why-panel")?.ariaBusy === "false" && document.querySelector("[data-why-of]") !== null);
  return Object.fromEntries(await page.locator(".causes tr").evaluateAll((all) => all.map((one) => [one.dataset.cause, Number(one.querySelector(".mm").dataset.mm)])));
}

test("a real error is that of the arrays rendered, its causes and the rest sum to it, and noise is what --noise off takes away", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  const frame = rendered(words);
  const quiet = rendered([...words, "--noise", "off"]);
  for (const [u, v] of [[112, 86], [60, 40], [150, 150]]) {
    await point_at(tab, u, v);
    await page.keyboard.press("w");
    const split = await shown_split(tab);
    const at = v * 224 + u;
    const error = 1000 * (frame.z_m.values[at] - frame.gt_z_m.values[at]);
    assert.ok(Math.abs(split.error - error) < 1e-3, `${u}, ${v}: ${split.error}, expected ${error}`);
    const sum = Object.entries(split).filter(([name]) => name !== "error").reduce((all, [, mm]) => all + mm, 0);
    assert.ok(Math.abs(sum - error) < 1e-3, `${u}, ${v}: ${JSON.stringify(split)}`);
    const noise = 1000 * (frame.z_m.values[at] - quiet.z_m.values[at]);
    assert.ok(Math.abs(split.noise - noise) < 1e-3, `${u}, ${v}: noise ${split.noise}, expected ${noise}`);
    await page.getByRole("button", { name: "Close: why is it wrong?" }).click();
  }
});

test("a region's real error is the mean over its pixels that have a depth", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  await point_at(tab, 0, 0);
  await page.keyboard.press("e");
  await point_at(tab, 30, 20);
  await page.keyboard.press("e");
  const split = await shown_split(tab);
  const frame = rendered(words);
  const errors = [];
  for (let v = 0; v <= 20; ++v)
    for (let u = 0; u <= 30; ++u) errors.push(1000 * (frame.z_m.values[v * 224 + u] - frame.gt_z_m.values[v * 224 + u]));
  const valid = errors.filter(Number.isFinite);
  assert.ok(valid.length < errors.length);
  const mean = valid.reduce((sum, one) => sum + one, 0) / valid.length;
  assert.ok(Math.abs(split.error - mean) < 1e-3, `${split.error}, expected ${mean}`);
  assert.equal(await page.locator('[data-why="pixels"]').textContent(), String(valid.length));
});
