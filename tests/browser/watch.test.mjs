// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pinned pixels: their statistics are those of the frames that the command renders.

import assert from "node:assert/strict";
import { beside, point_at, rendered, set, shown, stand_at, test, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const width = 224;

/** Each step is a frame that is seen. */
async function play_to(tab, last) {
  const { page } = tab;
  for (let frame = (await page.evaluate(() => window.tofray.last.frame)) + 1; frame <= last; ++frame) {
    await page.keyboard.press(".");
    await page.waitForFunction((to) => window.tofray.last.frame === to, frame);
  }
}

async function csv({ page }) {
  await page.getByRole("button", { name: "Copy CSV" }).click();
  await page.getByText("The statistics are copied.").waitFor();
  const [head, ...rows] = (await page.evaluate(() => navigator.clipboard.readText())).trim().split("\n").map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(head.map((name, i) => [name, row[i]])));
}

/** Two passes over all values, in doubles. */
function statistics(frames, array, u, v) {
  const all = frames.map((frame) => frame[array].values[v * width + u]);
  const valid = all.filter(Number.isFinite);
  const mean = valid.reduce((sum, one) => sum + one, 0) / valid.length;
  const sigma = Math.sqrt(valid.reduce((sum, one) => sum + (one - mean) ** 2, 0) / (valid.length - 1));
  const predicted = frames.filter((frame) => Number.isFinite(frame.z_m.values[v * width + u]))
    .map((frame) => (frame.noise_m.values[v * width + u] * frame.z_m.values[v * width + u]) / frame.range_m.values[v * width + u]);
  const rms = Math.sqrt(predicted.reduce((sum, one) => sum + one ** 2, 0) / predicted.length);
  return { frames: all.length, n: valid.length, mean, sigma, rms, min: Math.min(...valid), max: Math.max(...valid) };
}

function near(text, value, what) {
  assert.ok(text !== "" && Math.abs(Number(text) - value) <= 1e-9 * Math.abs(value), `${what}: ${text}, expected ${value}`);
}

/** A pixel that has a depth in some of the frames alone. */
function flickering(frames) {
  for (let i = 0; i < frames[0].z_m.values.length; ++i) {
    const valid = frames.filter((frame) => Number.isFinite(frame.z_m.values[i])).length;
    if (valid > 2 && valid < frames.length && Number.isFinite(frames[0].z_m.values[i])) return [i % width, Math.floor(i / width)];
  }
  throw new Error("no pixel has a depth in some frames alone");
}

test("mean, σ, σ̂, least, greatest and n of pinned pixels are those of the frames rendered, each counted once, also when it comes again", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  const frames = Array.from({ length: 9 }, (_, i) => rendered(words, i));
  const places = [[112, 86], [10, 150], flickering(frames)];
  for (const [u, v] of places) {
    await point_at(tab, u, v);
    await page.keyboard.press("p");
  }
  await beside(tab, "Watch");
  await page.locator("[data-pinned]").nth(2).waitFor();
  await page.locator(".stage").first().focus();
  await play_to(tab, 8);
  await page.keyboard.press(",");   // seen already
  await page.waitForFunction(() => window.tofray.last.frame === 7);
  await page.waitForFunction(() => [...document.querySelectorAll(".statistics caption")].every((one) => one.textContent === "Since frame 0: 9 frames"));
  const rows = await csv(tab);
  assert.equal(rows.length, 6);
  places.forEach(([u, v], i) => {
    for (const array of ["z_m", "amplitude_e"]) {
      const row = rows.find((one) => one.pin === String(i + 1) && one.array === array);
      const of = statistics(frames, array, u, v);
      const what = `pin ${i + 1}, ${array}`;
      assert.deepEqual([row.u, row.v, row.unit, row.first_frame, row.frames, row.n].map(String), [u, v, array === "z_m" ? "m" : "e", 0, of.frames, of.n].map(String), what);
      near(row.mean, of.mean, `${what}: mean`);
      near(row.sigma, of.sigma, `${what}: sigma`);
      near(row.min, of.min, `${what}: min`);
      near(row.max, of.max, `${what}: max`);
      if (array === "z_m") near(row.sigma_predicted, of.rms, `${what}: predicted`);
      else assert.equal(row.sigma_predicted, "");
    }
  });
  const third = statistics(frames, "z_m", ...places[2]);
  assert.ok(third.n < third.frames);
  // What is read is the same.
  const cell = (pin, stat, array) => page.locator(`[data-pinned="${pin}"] [data-stat="${stat} ${array}"]`).textContent();
  const first = statistics(frames, "z_m", ...places[0]);
  const six = (value) => Number(value.toPrecision(6)).toPrecision(6);
  assert.equal(await cell(1, "sigma", "z_m"), `${six(1000 * first.sigma)}\u00a0mm`);
  assert.equal(await cell(1, "predicted", "z_m"), `${six(1000 * first.rms)}\u00a0mm`);
  assert.equal(await cell(1, "mean", "z_m"), `${six(first.mean)}\u00a0m`);
  assert.equal(await cell(1, "n", "z_m"), "9");
  assert.equal(await cell(3, "n", "z_m"), `${third.n} of 9`);
});

test("a changed state begins anew, so does the button, and so does another array beside depth", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  await point_at(tab, 112, 86);
  await page.keyboard.press("p");
  await page.locator(".stage").first().focus();
  await play_to(tab, 2);
  await set(tab, "camera.lens.f_number", "2.8");
  await beside(tab, "Watch");
  const caption = page.locator(".statistics caption");
  await caption.getByText("Since frame 2: 1 frame", { exact: true }).waitFor();
  await page.locator(".stage").first().focus();
  await play_to(tab, 4);
  await caption.getByText("Since frame 2: 3 frames", { exact: true }).waitFor();
  const changed = [2, 3, 4].map((i) => rendered([...words, "--set", "camera.lens.f_number=2.8"], i));
  near((await csv(tab))[0].sigma, statistics(changed, "z_m", 112, 86).sigma, "of the changed camera");
  await page.getByRole("combobox", { name: "beside depth" }).selectOption("confidence");
  await page.locator('[data-stat="n confidence"]').getByText("1", { exact: true }).waitFor();
  await caption.getByText("Since frame 2: 3 frames", { exact: true }).waitFor();
  await page.getByRole("button", { name: "Begin anew" }).click();
  await caption.getByText("Waits for a frame.").waitFor();
  await page.locator(".stage").first().focus();
  await play_to(tab, 5);
  await caption.getByText("Since frame 5: 1 frame", { exact: true }).waitFor();
});

test("of two states each has statistics of its own, those of the frames rendered", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  await point_at(tab, 112, 86);
  await page.keyboard.press("p");
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await page.locator(".compare-bar").waitFor();
  await set(tab, "camera.lens.f_number", "2.8");
  await beside(tab, "Watch");
  await page.getByRole("button", { name: "Begin anew" }).click();
  await page.locator(".stage").first().focus();
  for (let frame = 1; frame <= 4; ++frame) {
    await page.keyboard.press(".");
    await page.waitForFunction((to) => window.tofray.last.frame === to && window.tofray.last_b.frame === to, frame);
  }
  for (const state of ["a", "b"]) await page.locator(`.statistics[data-state=${state}] caption`).getByText("Since frame 1: 4 frames").waitFor();
  const rows = await csv(tab);
  assert.deepEqual(rows.map((one) => [one.state, one.array]), [["A", "z_m"], ["B", "z_m"], ["A", "amplitude_e"], ["B", "amplitude_e"]]);
  for (const [state, more] of [["A", []], ["B", ["--set", "camera.lens.f_number=2.8"]]]) {
    const frames = [1, 2, 3, 4].map((i) => rendered([...words, ...more], i));
    for (const array of ["z_m", "amplitude_e"]) {
      const row = rows.find((one) => one.state === state && one.array === array);
      const of = statistics(frames, array, 112, 86);
      near(row.mean, of.mean, `${state}, ${array}: mean`);
      near(row.sigma, of.sigma, `${state}, ${array}: sigma`);
      if (array === "z_m") near(row.sigma_predicted, of.rms, `${state}: predicted`);
    }
  }
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await page.locator(".statistics[data-state=b]").waitFor({ state: "detached" });
  await page.locator(".statistics[data-state=a] caption").getByText("Since frame 1: 4 frames").waitFor();
});

test("up to eight pins, each with the least number that is free, marked in every pane; p and the list take them away, and then nothing more is computed", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  const wants = () => tab.asked.filter((one) => one.type === "want").at(-1).arrays;
  assert.ok(!wants().includes("noise_m"));
  /** Pixels of the canvas above a picture that are a mark's white, about a pixel. */
  const marks = (u, v, i) => page.evaluate(([x, y, at]) => {
    const { left, top, scale } = window.tofray.placement(at);
    const canvas = document.querySelectorAll(".pane")[at].querySelector("canvas.over");
    const { data } = canvas.getContext("2d").getImageData(left + (x + 0.5) * scale - 12, top + (y + 0.5) * scale - 27, 24, 22);
    let white = 0;
    for (let k = 0; k < data.length; k += 4) if (data[k] > 240 && data[k + 1] > 240 && data[k + 2] > 240 && data[k + 3] > 240) ++white;
    return white;
  }, [u, v, i]);
  await point_at(tab, 40, 60);
  await page.keyboard.press("p");
  for (let i = 1; i < 10; ++i) {
    await point_at(tab, 40 + 15 * i, 60);
    await page.keyboard.press("p");
  }
  await point_at(tab, 20, 120);
  await beside(tab, "Watch");
  assert.deepEqual(await page.locator("[data-pinned]").evaluateAll((all) => all.map((one) => one.dataset.pinned)), ["1", "2", "3", "4", "5", "6", "7", "8"]);
  assert.equal(await page.getByRole("button", { name: "Pin", exact: true }).isDisabled(), true);
  for (const i of [0, 1]) {
    assert.ok((await marks(40, 60, i)) > 60, `pin 1 in pane ${i}`);
    assert.ok((await marks(145, 60, i)) > 60, `pin 8 in pane ${i}`);
    assert.ok((await marks(160, 60, i)) < 20, `none in pane ${i}`);
  }
  await page.getByRole("button", { name: "Remove pin 3" }).click();
  await point_at(tab, 175, 60);
  await page.keyboard.press("p");
  assert.equal(await page.locator('[data-pinned="3"] h3').textContent(), "3Pin 3: pixel 175, 60");
  await page.keyboard.press("p");
  await page.locator('[data-pinned="3"]').waitFor({ state: "detached" });
  await page.getByRole("button", { name: "Go to pin 8" }).click();
  assert.equal(await page.locator(".read-out dd").first().textContent(), "145, 60");
  assert.ok(wants().includes("noise_m") && wants().includes("range_m"));
  await page.getByRole("button", { name: "Remove all" }).click();
  await page.locator("[data-pinned]").first().waitFor({ state: "detached" });
  assert.ok(!wants().includes("noise_m"), wants().join());
});

test("a pixel that is pinned between a frame's coming and its drawing is counted in it", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await beside(tab, "Watch");
  await page.locator(".stage").first().focus();
  await page.keyboard.press("ArrowRight");
  const received = await page.evaluate(() => {
    window.held = [];
    window.draws = window.requestAnimationFrame;
    window.requestAnimationFrame = (draw) => window.held.push(draw);   // nothing is drawn until it is let go
    return window.tofray.counters.received;
  });
  await page.keyboard.press("p");
  await page.waitForFunction((before) => window.tofray.counters.received > before, received, { polling: 20 });
  const drawn = await page.evaluate(() => window.tofray.counters.drawn);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("p");
  assert.equal(await page.evaluate(() => window.tofray.counters.drawn), drawn);
  await page.evaluate(() => {
    window.requestAnimationFrame = window.draws;
    for (const draw of window.held) requestAnimationFrame(draw);
  });
  await page.locator("[data-pinned]").nth(1).getByText("1 frame").first().waitFor();
  assert.deepEqual((await csv(tab)).map((row) => row.frames), ["1", "1", "1", "1"]);
});
