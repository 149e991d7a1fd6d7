// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Every pixel of a picture has the colour that this file computes of the arrays which the command writes, by the protocol's words
// (docs/reference/viewer-protocol.md).

import assert from "node:assert/strict";
import { test } from "node:test";
import { canvas_pixels, choose, pane, rendered, shown, stand_at, view, written } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];

function mixed(stops, t) {
  const at = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  return stops[i].map((x, channel) => Math.floor(x + (at - i) * (stops[i + 1][channel] - x) + 0.5));
}

function color(hello, scale, value) {
  if (scale.palette === "error") {
    const s = value / scale.high;
    return s < 0 ? mixed(hello.palettes.error_near, -s) : mixed(hello.palettes.error_far, s);
  }
  let t = Math.min(1, Math.max(0, (value - scale.low) / (scale.high - scale.low)));
  if (scale.curve === "sqrt") t = Math.sqrt(t);
  return mixed(hello.palettes[scale.palette], scale.reverse ? 1 - t : t);
}

const reason = (hello, flags) => hello.invalid.find(({ bit }) => (flags >> bit) & 1);

function expected(hello, scale, values, flags) {
  const out = [];
  values.forEach((value, i) => out.push(...(Number.isFinite(value) ? color(hello, scale, value) : reason(hello, flags[i])?.color ?? hello.invalid_color), 255));
  return out;
}

const scale_of = (hello, array) => hello.panes.find((one) => one.array === array).scale;

/** The first pixel of two pictures that differs: an assertion over 150,000 numbers says nothing that could be read. */
function same(got, wanted, what) {
  assert.equal(got.length, wanted.length, what);
  for (let at = 0; at < got.length; at += 4) {
    const [a, b] = [got.slice(at, at + 4), wanted.slice(at, at + 4)];
    if (String(a) !== String(b)) assert.fail(`${what}: pixel ${at / 4} is ${a}, expected ${b}`);
  }
}

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
