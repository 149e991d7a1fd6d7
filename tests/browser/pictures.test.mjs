// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Every pixel of a picture has the colour that this file computes of the arrays which the command writes, by the protocol's words
// (docs/reference/viewer-protocol.md).

import assert from "node:assert/strict";
import { expected, reason, scale_of } from "./colors.mjs";
import { canvas_pixels, choose, pane, rendered, same, shown, stand_at, test, until, view, written } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];

test("depth has the colours of the arrays that the command writes, each of its pixels, on the screen, too", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  await stand_at(tab, 0);
  const hello = tab.hello();
  const { z_m, flags } = rendered(words);
  const wanted = expected(hello, scale_of(hello, "z_m"), z_m.values, flags.values);
  const { array, width, height, pixels } = await pane(tab, 0);
  assert.deepEqual([array, width, height, pixels.length], ["z_m", 224, 172, 4 * 38528]);
  same(pixels, wanted, "depth");
  same(await canvas_pixels(tab, 0), wanted, "depth on the screen");
});

test("every pane of numbers has the colours of its own scale", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  await stand_at(tab, 0);
  const hello = tab.hello();
  const arrays = rendered(words);
  arrays.z_error_m = { values: arrays.z_m.values.map((z, i) => z - arrays.gt_z_m.values[i]) };
  const offered = hello.panes.map((one) => one.array).filter((one) => one !== "flags");
  assert.ok(offered.length >= 10, offered.join());
  for (const array of offered) {
    await choose(tab, 1, array);
    same((await pane(tab, 1)).pixels, expected(hello, scale_of(hello, array), [...arrays[array].values], arrays.flags.values), array);
    const [bar, unit] = await Promise.all([".ramp", ".unit"].map((part) => tab.page.locator(".pane").nth(1).locator(part).boundingBox()));
    assert.ok(bar.x + bar.width < unit.x && bar.width > 250, `${array}: the bar to ${bar.x + bar.width}, its unit from ${unit.x}`);
  }
});

test("invalid pixels have the colour of their reason, the legend its name, letter and share", async () => {
  // Saturated in front, dark behind, edges between, and nothing beyond the field of the lens.
  const scene = written("reasons.yaml", [
    "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", "objects:",
    "  - box: {name: near, min: [-0.2, -0.2, 0.1], max: [-0.02, 0.2, 0.12], reflectivity: 0.9}",
    "  - box: {name: far, min: [0, -0.5, 2], max: [0.5, 0.5, 2.1], reflectivity: 0.3}", "",
  ].join("\n"));
  const { url } = await view([scene, "--seed", "5"]);
  const tab = await shown(url);
  await stand_at(tab, 0);
  const hello = tab.hello();
  const { z_m, flags } = rendered([scene, "--seed", "5"]);
  const counts = new Map();
  const { pixels } = await pane(tab, 0);
  z_m.values.forEach((z, i) => {
    if (Number.isFinite(z)) return;
    const why = reason(hello, flags.values[i]);
    counts.set(why.name, (counts.get(why.name) ?? 0) + 1);
    assert.deepEqual(pixels.slice(4 * i, 4 * i + 3), why.color, `pixel ${i}, ${why.name}`);
  });
  assert.ok(counts.size >= 3, [...counts.keys()].join());
  const percent = (share) => (share < 0.001 ? "< 0.1 %" : `${(100 * share).toFixed(1)} %`);
  const legend = hello.invalid.filter(({ name }) => counts.has(name)).map(({ name, letter }) => `${letter}${name} ${percent(counts.get(name) / z_m.values.length)}`);
  assert.deepEqual(await tab.page.locator(".pane").first().locator(".legend li").allTextContents(), legend);
  const colors = hello.invalid.map((one) => String(one.color));
  assert.equal(new Set(colors).size, colors.length);
});

test("flags have the colour of the first reason whose bit is set, and one of their own where none is", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  await stand_at(tab, 0);
  await choose(tab, 1, "flags");
  const hello = tab.hello();
  const { flags } = rendered(words);
  const { pixels } = await pane(tab, 1);
  const none = [244, 244, 241];
  flags.values.forEach((bits, i) => assert.deepEqual(pixels.slice(4 * i, 4 * i + 3), reason(hello, bits)?.color ?? none, `pixel ${i}, bits ${bits}`));
});

test("a range of colours stays from frame to frame; f fits it to the frame shown, once", async () => {
  const scene = written("receding.yaml", [
    "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", "objects:",
    "  - plane: {name: card, point: [0, 0, 0.7], normal: [0, 0, -1], reflectivity: 0.8, velocity: [0, 0, 2 m/s]}", "",
  ].join("\n"));
  const all = [scene, "--seed", "5"];
  const { url } = await view(all);
  const tab = await shown(url);
  const { page } = tab;
  const scales = () => tab.texts.filter((one) => one.type === "scale");
  const check = async (frame, scale) => {
    await stand_at(tab, frame);
    const { z_m, flags } = rendered(all, frame);
    same((await pane(tab, 0)).pixels, expected(tab.hello(), scale, z_m.values, flags.values), `frame ${frame}`);
  };
  const first = scale_of(tab.hello(), "z_m");
  await check(0, first);
  await check(3, first);
  assert.equal(scales().length, 0);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("f");
  await page.waitForFunction((low) => document.querySelector(".scale").dataset.low !== low, String(first.low));
  const [{ array, scale: fitted }] = scales();
  assert.equal(array, "z_m");
  assert.ok(fitted.low > first.low, `${fitted.low}, ${first.low}`);
  await check(3, fitted);
  await check(1, fitted);
  await check(2, fitted);
  assert.equal(scales().length, 1);
});

test("a frame that was left has the same picture when it comes again", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const pictures = [];
  for (const frame of [1, 4, 1]) {
    await stand_at(tab, frame);
    pictures.push((await pane(tab, 0)).pixels);
  }
  same(pictures[2], pictures[0], "frame 1");
  assert.notDeepEqual(pictures[1], pictures[0]);
  // One by one, with the keys.
  await tab.page.locator(".stage").first().focus();
  for (const [key, frame] of [[".", 2], [".", 3], [",", 2], [",", 1]]) {
    await tab.page.keyboard.press(key);
    await tab.page.waitForFunction((to) => window.tofray.last.frame === to, frame);
  }
  same((await pane(tab, 0)).pixels, pictures[0], "frame 1 by keys");
});

test("a histogram counts each pixel once: where it stands on the bar, below it, above it, or without a value", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("h");
  await page.getByRole("button", { name: "Histogram", exact: true }).nth(1).click();
  const arrays = rendered(words);
  for (const [i, name] of [[0, "z_m"], [1, "amplitude_e"], [0, "noise_m"]]) {
    await choose(tab, i, name);
    const { low, high, curve } = scale_of(tab.hello(), name);
    const bins = new Array(128).fill(0);
    const apart = { shown: 0, below: 0, above: 0, invalid: 0 };
    for (const value of arrays[name].values) {
      if (!Number.isFinite(value)) ++apart.invalid;
      else if (value < low) ++apart.below;
      else if (value > high) ++apart.above;
      else {
        const t = (value - low) / (high - low);
        ++bins[Math.min(127, Math.floor((curve === "sqrt" ? Math.sqrt(t) : t) * 128))];
        ++apart.shown;
      }
    }
    const pane_of = page.locator(".pane").nth(i);
    await page.waitForFunction(([at, counts]) => document.querySelectorAll(".pane")[at].querySelector(".histogram")?.dataset.counts === counts, [i, bins.join(" ")]);
    for (const [word, count] of Object.entries(apart)) {
      const said = await pane_of.locator(`[data-apart=${word}]`).allTextContents();
      assert.deepEqual(said, count > 0 || word === "shown" || word === "invalid" ? [String(count)] : [], `${name}: ${word}`);
    }
    assert.ok(apart.shown > 10_000 && new Set(bins).size > 20, name);
    const [bar, histogram] = await Promise.all([".ramp", ".histogram"].map((part) => pane_of.locator(part).boundingBox()));
    assert.deepEqual([histogram.x, histogram.width], [bar.x, bar.width], `${name}: not over its bar`);
  }
  await choose(tab, 1, "flags");
  const rows = await page.locator(".bits tr").evaluateAll((all) => all.map((row) => [row.querySelector("th").textContent, Number(row.children[2].textContent)]));
  const wanted = tab.hello().invalid.map(({ name, bit }) => [name, arrays.flags.values.filter((bits) => (bits >> bit) & 1).length]);
  assert.deepEqual(rows.slice(0, -1), wanted);
  assert.ok(wanted.some(([, count]) => count > 0));
});

test("one to four panes, each with its picture; cursor and zoom are those of all", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  const arrays = rendered(words);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("]");
  await page.getByRole("combobox", { name: "Number of panes" }).selectOption("4");
  await page.waitForFunction(() => window.tofray.pane(3)?.array === "flags");
  const names = [0, 1, 2, 3].map((i) => page.evaluate((at) => window.tofray.pane(at).array, i));
  assert.deepEqual(await Promise.all(names), ["z_m", "amplitude_e", "z_error_m", "flags"]);
  const { z_m, amplitude_e, flags } = arrays;
  const hello = tab.hello();
  same((await pane(tab, 1)).pixels, expected(hello, scale_of(hello, "amplitude_e"), amplitude_e.values, flags.values), "amplitude");
  same((await pane(tab, 2)).pixels, expected(hello, scale_of(hello, "z_error_m"), z_m.values.map((z, i) => z - arrays.gt_z_m.values[i]), flags.values), "error");
  await page.locator(".stage").first().focus();
  await page.keyboard.press("+");
  await page.keyboard.press("+");
  await page.waitForFunction(() => window.tofray.placement(0).scale > 3);
  const placements = await page.evaluate(() => [0, 1, 2, 3].map((i) => window.tofray.placement(i)));
  for (const one of placements) assert.deepEqual(one, placements[0]);
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => [...document.querySelectorAll(".pane .reading")].every((one) => one.textContent !== ""));
  for (let i = 0; i < 5; ++i) await page.keyboard.press("[");
  await page.waitForFunction(() => document.querySelectorAll(".pane").length === 1);
  await page.waitForFunction(() => window.tofray.placement(0).scale > 3);
  assert.equal((await pane(tab, 0)).array, "z_m");
});

test("time passes by at the camera's rate, as fast as it goes, or at a number that is typed; another word leaves it", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  const rates = () => tab.asked.filter((one) => one.type === "want").map((one) => one.rate);
  assert.equal(rates().at(-1), "own");
  await page.getByRole("combobox", { name: "Frames per second" }).selectOption("number");
  const field = page.getByRole("textbox", { name: "Frames per second, a number" });
  for (const text of ["40", "banana", "0", "2.5"]) {
    await field.fill(text);
    await field.press("Enter");
  }
  assert.equal(await field.inputValue(), "2.5");
  await page.getByRole("combobox", { name: "Frames per second" }).selectOption("max");
  await page.getByRole("combobox", { name: "Frames per second" }).selectOption("own");
  await until(() => rates().at(-1) === "own", "the camera's rate");
  assert.deepEqual([...new Set(rates())].slice(-5), ["own", 1, 40, 2.5, "max"]);
  const drawn = await page.evaluate(() => window.tofray.counters.drawn);
  await page.waitForFunction((from) => window.tofray.counters.drawn > from + 2, drawn);
  assert.equal(await page.getByRole("alert").count(), 0);
});
