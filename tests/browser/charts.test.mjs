// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Charts as files: the numbers that are shown as CSV, the drawing as an SVG that stands for itself; and the panes as a film.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { phasors, split, with_chain, curve, unwrapping } from "./answers.mjs";
import { answered_arrays, beside, between, folder, open, pane, shown, stand_at, test, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];

async function saved(page, act) {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  const path = join(mkdtempSync(join(folder, "chart-")), download.suggestedFilename());
  await download.saveAs(path);
  return path;
}

/** The rows behind the head. */
async function csv({ page }, name) {
  const path = await saved(page, () => page.getByRole("button", { name: `${name} as CSV` }).click());
  assert.match(path, /\/demo_\d{4}_[^/]*\.csv$/);
  const [head, ...rows] = readFileSync(path, "utf8").trimEnd().split("\n").map((line) => line.split(","));
  for (const row of rows) assert.equal(row.length, head.length, row.join());
  return { head, rows };
}

/** Is read as XML alone, has nothing of the page's styles to lean on, and paints more than its ground. @return its text */
async function svg({ page }, name) {
  const path = await saved(page, () => page.getByRole("button", { name: `${name} as SVG` }).click());
  assert.match(path, /\/demo_\d{4}_[^/]*\.svg$/);
  const text = readFileSync(path, "utf8");
  const { error, classes, painted } = await page.evaluate(async (of) => {
    const read = new DOMParser().parseFromString(of, "image/svg+xml");
    const image = new Image();
    const address = URL.createObjectURL(new Blob([of], { type: "image/svg+xml" }));
    image.src = address;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    const colors = new Map();
    for (let i = 0; i < data.length; i += 4) colors.set(`${data[i]} ${data[i + 1]} ${data[i + 2]}`, (colors.get(`${data[i]} ${data[i + 1]} ${data[i + 2]}`) ?? 0) + 1);
    return { error: read.querySelector("parsererror")?.textContent, classes: read.querySelectorAll("[class], style, script").length, painted: data.length / 4 - Math.max(...colors.values()) };
  }, text);
  assert.equal(error, undefined, name);
  assert.equal(classes, 0, name);
  assert.ok(painted > 500, `${name} paints ${painted} pixels`);
  return text;
}

test("a histogram's file has its counts, bin for bin, and those that are counted apart; of bits those of each", async () => {
  const tab = await shown((await view(words)).url);
  const { page } = tab;
  await stand_at(tab, 2);
  await page.getByRole("button", { name: "Histogram", exact: true }).first().click();
  const counts = (await page.locator("canvas.histogram").getAttribute("data-counts")).split(" ");
  const { head, rows } = await csv(tab, "Histogram of depth");
  assert.deepEqual(head, ["from [m]", "to [m]", "pixels"]);
  assert.deepEqual(rows.slice(0, counts.length).map((row) => row[2]), counts);
  for (const [i, [from, to]] of rows.slice(0, counts.length - 1).entries()) assert.ok(Math.abs(Number(to) - Number(rows[i + 1][0])) < 1e-9 && Number(from) < Number(to));
  const apart = Object.fromEntries(rows.slice(counts.length).map(([word, , count]) => [word, Number(count)]));
  assert.deepEqual(Object.keys(apart), ["below", "above", "invalid"]);
  assert.equal(rows.reduce((sum, row) => sum + Number(row[2]), 0), 224 * 172);
  assert.equal(apart.invalid, Number(await page.locator("[data-apart=invalid]").textContent()));
  const drawing = await svg(tab, "Histogram of depth");
  assert.equal(drawing.match(/<rect/g).length, 1 + counts.filter((one) => one !== "0").length, "a bar for each bin that has pixels");
  await page.locator(".pane select.shows").first().selectOption("flags");
  const flags = await csv(tab, "Histogram of flags");
  const shown_counts = await page.locator("table.bits tr").evaluateAll((all) => all.map((row) => [row.cells[0].textContent, row.cells[2].textContent]));
  assert.deepEqual(flags.rows.map(([name, count]) => [name, count]), shown_counts);
  await svg(tab, "Histogram of flags");
});

test("correlation functions, phasors, ways to unwrap and the error's split are saved with all digits", async () => {
  const before = between({ asked: { why: ({ id, u, v }) => ({ type: "why", id, u, v, pixels: 1, count: 1, ...split }) }, told: { pixel: with_chain } });
  const tab = await shown((await view(words)).url, { before });
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("ArrowRight");
  await beside(tab, "Pixel");
  await page.locator("[data-phasor]").first().waitFor();
  const at_80 = await csv(tab, "Correlation function at 80 MHz");
  assert.deepEqual(at_80.rows.filter(([of]) => of === "function").map((row) => Number(row[2])), curve[0].points);
  assert.deepEqual(at_80.rows.filter(([of]) => of === "measured").map(([, phase, value]) => [Number(phase), Number(value)]), curve[0].samples);
  const phasor = Object.fromEntries((await csv(tab, "Phasor at 60 MHz")).rows.map(([name, value]) => [name, value]));
  assert.deepEqual([Number(phasor.I), Number(phasor.Q), Number(phasor.sigma_Q), phasor.true_I], [phasors[1].i, phasors[1].q, phasors[1].sigma_q, ""]);
  const ways = await csv(tab, "Ways to unwrap");
  assert.deepEqual(ways.rows, unwrapping.candidates.map((one) => [one.cycles.join(" "), String(one.range_m), String(one.cost), String(one.chosen === true)]));
  for (const name of ["Correlation function at 80 MHz", "Phasor at 80 MHz", "Ways to unwrap"]) await svg(tab, name);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("w");
  await page.locator("[data-why-of]").waitFor();
  const why = Object.fromEntries((await csv(tab, "Error by cause")).rows);
  assert.deepEqual([Number(why.error), Number(why.wiggling), Number(why.rest), Number(why.sigma_predicted)], [1000 * split.error_m, -12, 0.39, 1000 * split.sigma_m]);
  const drawing = await svg(tab, "Error by cause");
  assert.equal(drawing.includes("<b>"), false, "a name is text");
});

test("the watch list and the noise over time are saved: pins by their numbers, noise pixel for pixel", async () => {
  const tab = await shown((await view(words)).url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  for (const key of ["ArrowRight", "p", "Shift+ArrowLeft", "p"]) await page.keyboard.press(key);
  await beside(tab, "Watch");
  await page.locator("[data-pinned]").nth(1).getByText("1 frame").first().waitFor();   // (it comes again with what is watched)
  await page.locator(".stage").first().focus();
  await page.keyboard.press(".");
  await page.waitForFunction(() => window.tofray.last?.frame === 1);
  await page.locator("[data-pinned]").nth(1).getByText("2 frames").first().waitFor();
  const watched = await csv(tab, "Watch list");
  assert.deepEqual(watched.rows.map((row) => [row[0], row[2], row[3], row[4], row[7]]), [["1", "112", "86", "z_m", "2"], ["1", "112", "86", "amplitude_e", "2"], ["2", "102", "86", "z_m", "2"], ["2", "102", "86", "amplitude_e", "2"]]);
  assert.equal((await svg(tab, "Watch list")).match(/<circle/g).length, 2);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("n");
  await beside(tab, "Measure");
  await page.locator("[data-temporal]").waitFor();
  const { temporal_sigma_m: sigma, temporal_count: count } = answered_arrays(tab, tab.texts.findLast((one) => one.type === "temporal" && one.static));
  const noise = await csv(tab, "Noise over time");
  assert.deepEqual(noise.head, ["u", "v", "frames", "mean [m]", "sigma [m]", "sigma_predicted [m]"]);
  assert.equal(noise.rows.length, 224 * 172);
  for (const i of [0, 223, 224, 20000, 38527]) {
    const [u, v, frames, , of_sigma] = noise.rows[i];
    assert.deepEqual([Number(v) * 224 + Number(u), Number(frames)], [i, count.values[i]]);
    assert.equal(of_sigma, Number.isNaN(sigma.values[i]) ? "" : String(sigma.values[i]));
  }
  await svg(tab, "Noise over time");
});

test("a film has all frames, drawn as the panes are, at the rate that was asked for; a browser that cannot says so", async () => {
  const tab = await shown((await view(words)).url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("r");
  await page.locator("#film-first").fill("4");
  await page.locator("#film-count").fill("6");
  await page.locator("#film-rate").fill("4");
  const path = await saved(page, () => page.getByRole("button", { name: "Make film" }).click());
  assert.match(path, /demo_0004_film_6_frames\.(mp4|webm)$/);
  const sought = tab.asked.filter((one) => one.type === "seek").map((one) => one.frame);
  assert.deepEqual(sought.slice(-6), [4, 5, 6, 7, 8, 9]);
  await page.locator("#film").getByText("is saved.").waitFor();
  const { pixels, width, height } = await pane(tab, 0);
  const placed = await page.evaluate(() => {
    const box = document.querySelector(".pane .stages").getBoundingClientRect();
    return { width: box.width, height: box.height };
  });

  const empty = await open("about:blank");
  const film = readFileSync(path);
  const seen = await empty.page.evaluate(async ([bytes, type]) => {
    const video = document.createElement("video");
    video.muted = true;
    video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(bytes), (one) => one.charCodeAt(0))], { type }));
    await new Promise((then, fail) => Object.assign(video, { onloadeddata: then, onerror: () => fail(new Error(video.error.message)) }));
    video.currentTime = 1e6;   // a film without a length has one then
    await new Promise((then) => (video.onseeked = then));
    const canvas = Object.assign(document.createElement("canvas"), { width: video.videoWidth, height: video.videoHeight });
    let data;
    for (const end = performance.now() + 30_000; data === undefined || (data.every((one, i) => i % 4 === 3 || one === 0) && performance.now() < end);) {
      await new Promise((again) => setTimeout(again, 20));   // the place is gone to before its picture is there to be drawn
      canvas.getContext("2d").drawImage(video, 0, 0);
      ({ data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height));
    }
    let text = "";
    for (let at = 0; at < data.length; at += 8192) text += String.fromCharCode(...data.subarray(at, at + 8192));
    return { length: video.duration, width: canvas.width, height: canvas.height, last: btoa(text) };
  }, [film.toString("base64"), path.endsWith("mp4") ? "video/mp4" : "video/webm"]);
  // (Each is shown for its quarter of a second at least; the last one's own time may be cut off.)
  assert.ok(seen.length >= 1.2 && seen.length < 4, `${seen.length} s`);
  assert.ok(seen.width >= 2 * placed.width && seen.width <= 2 * placed.width + 26, `${seen.width} px wide`);
  // The last picture is that of the pane, as near as a film has colours: coarse parts of it are compared.
  const last = Buffer.from(seen.last, "base64");
  const scale = placed.width / width;
  let off = 0, count = 0;
  for (let v = 8; v < height - 8; v += 4) {
    for (let u = 8; u < width - 8; u += 4) {
      const x = Math.round(8 + (u + 0.5) * scale), y = Math.round(8 + 30 + (v + 0.5) * scale);
      for (let c = 0; c < 3; ++c) off += Math.abs(last[4 * (y * seen.width + x) + c] - pixels[4 * (v * width + u) + c]);
      count += 3;
    }
  }
  assert.ok(off / count < 20, `mean difference ${off / count} of 255`);

  const without = await shown((await view(words)).url, { before: (one) => one.addInitScript(() => delete window.MediaRecorder) });
  await without.page.keyboard.press("r");
  await without.page.locator("#film").getByText("This browser has no MediaRecorder").waitFor();
  assert.equal(await without.page.getByRole("button", { name: "Make film" }).count(), 0);
});
