// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The sheet of all raw frames: every pixel has the colour that this file computes of the arrays which the command writes.

import assert from "node:assert/strict";
import { color } from "./colors.mjs";
import { canvas_pixels, drawn, pane, point_at, rendered, same, set, shown, stand_at, test, view, written } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const width = 224, height = 172, pixels = width * height;

const kinds = { raw: "code", tap_a: "tap A", tap_b: "tap B", tap_difference: "A − B" };

/** The stack of a kind, as the command writes it. */
function stack(frame, kind) {
  if (kind !== "tap_difference") return [...frame[kind].values];
  return Array.from(frame.tap_a.values, (a, i) => Math.fround(a - frame.tap_b.values[i]));
}

/** The bar's range, which is one for all of them. */
async function bar({ page }, i) {
  const of = page.locator(".pane").nth(i).locator(".scale");
  return { low: Number(await of.getAttribute("data-low")), high: Number(await of.getAttribute("data-high")) };
}

function scale_of(kind, { low, high }) {
  return { low, high, curve: "linear", palette: kind === "tap_difference" ? "error" : "grey" };
}

async function sheet(tab, kind) {
  const { page } = tab;
  await page.locator(".pane").nth(1).locator("select.raw-kind").selectOption(kind);
  await page.waitForFunction(([name]) => window.tofray.pane(1, "a", 8)?.array === `${name}[8]`, [kind]);
}

function colors(hello, scale, values) {
  return values.flatMap((value) => [...color(hello, scale, value), 255]);
}

test("the sheet shows every raw frame of every kind, pixel for pixel, with one scale that holds what nearly all lit ones have", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  const frame = rendered(words);
  const phases = frame.raw.shape[0];
  assert.equal(phases, 9);
  await page.locator(".pane").nth(1).locator("select.shows").selectOption("raw frames");
  for (const [kind, said] of Object.entries(kinds)) {
    await sheet(tab, kind);
    assert.equal(await page.locator(".pane").nth(1).locator("select.raw-kind option:checked").textContent(), said);
    const values = stack(frame, kind);
    const range = await bar(tab, 1);
    const scale = scale_of(kind, range);
    for (let k = 0; k < phases; ++k) {
      const of = await pane(tab, 1, "a", k);
      assert.deepEqual([of.array, of.width, of.height], [`${kind}[${k}]`, width, height]);
      same(of.pixels, colors(tab.hello(), scale, values.slice(k * pixels, (k + 1) * pixels)), `${kind}, raw frame ${k}`);
    }
    const lit = values.filter((_, i) => frame.lit.values[Math.floor(i / pixels)] !== 0).sort((a, b) => a - b);
    const inside = lit.filter((one) => one >= range.low && one <= range.high).length / lit.length;
    assert.ok(inside > 0.985, `${kind}: ${inside} of the values are on the bar`);
    // No wider than it need be, but for round ends.
    const nearly_all = lit[Math.floor(0.995 * lit.length)] - lit[Math.floor(0.005 * lit.length)];
    assert.ok(range.high - range.low < (kind === "tap_difference" ? 3 : 2) * nearly_all, `${kind}: from ${range.low} to ${range.high} for ${nearly_all}`);
    if (kind === "tap_difference") assert.equal(range.low, -range.high);
  }
  // (At this size a tile is smaller than its image: what its canvas shows is checked where it is enlarged.)
});

test("each has its number, frequency and phase step, a row for each frequency, and the value under a cursor that is that of all", async () => {
  const { url } = await view(words);
  const tab = await shown(url, { viewport: { width: 1400, height: 900 } });
  const { page } = tab;
  await stand_at(tab, 0);
  const frame = rendered(words);
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("t");
  await page.locator('.tile[data-raw="8"]').waitFor();
  await page.waitForFunction(() => window.tofray.pane(1, "a", 8) !== undefined);
  await point_at(tab, 60, 40);
  const texts = await page.locator(".tile figcaption").allTextContents();
  const wanted = Array.from({ length: 9 }, (_, k) => {
    const [f, phase] = [frame.modulation_frequency_hz.values[k], frame.reference_phase_rad.values[k]];
    const said = frame.lit.values[k] === 0 ? "unlit" : `${Number((f / 1e6).toFixed(3))} MHz · ${Number(((phase * 180) / Math.PI).toFixed(1))}°`;
    return `${k} ${said} ${frame.raw.values[k * pixels + 40 * width + 60]}\u00a0DN`;
  });
  assert.deepEqual(texts, wanted);
  const tops = await page.locator(".tile").evaluateAll((all) => all.map((one) => one.getBoundingClientRect().top));
  const rows = tops.map((top) => [...new Set(tops)].indexOf(top));
  assert.deepEqual(rows, [0, 1, 1, 1, 1, 2, 2, 2, 2]);
  // The cursor of a tile is the other panes' too.
  const tile = await page.locator('.tile[data-raw="3"] .stage').boundingBox();
  await page.mouse.move(tile.x + tile.width / 2, tile.y + tile.height / 2);
  const at = await page.locator(".read-out dd").first().textContent();
  const [u, v] = at.split(", ").map(Number);
  assert.ok(Math.abs(u - 112) <= 2 && Math.abs(v - 86) <= 2, at);
  assert.equal(await page.locator('.tile[data-raw="3"] .tile-value').textContent(), `${frame.raw.values[3 * pixels + v * width + u]}\u00a0DN`);
  assert.equal(await page.locator('.reading[data-array="z_m"]').textContent(), `${frame.z_m.values[v * width + u].toPrecision(6)}\u00a0m`);
});

test("a click or Enter enlarges one, t goes back to all and then to what was there; the scale stays, also in another frame", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("t");
  await page.waitForFunction(() => window.tofray.pane(1, "a", 8) !== undefined);
  const range = await bar(tab, 1);
  const scale = scale_of("raw", range);
  const check = async (frame, k) => {
    const values = stack(rendered(words, frame), "raw").slice(k * pixels, (k + 1) * pixels);
    const wanted = colors(tab.hello(), scale, values);
    same((await pane(tab, 1)).pixels, wanted, `raw frame ${k} of frame ${frame}`);
    same(await canvas_pixels(tab, 1), wanted, `raw frame ${k} of frame ${frame} on the screen`);
  };
  await page.locator('.tile[data-raw="2"] .stage').click();
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "raw[2]");
  await check(0, 2);
  assert.equal(await page.locator(".pane").nth(1).locator("select.raw-number option:checked").textContent(), "2: 80.32 MHz · 90°");
  await page.keyboard.press("t");
  await page.locator('.tile[data-raw="5"] .stage').focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "raw[5]");
  assert.equal(await page.evaluate(() => document.activeElement === document.querySelectorAll(".pane")[1].querySelector(".stage")), true, "the focus is lost");
  await stand_at(tab, 3);
  await check(3, 5);
  assert.deepEqual(await bar(tab, 1), range);
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("t");
  await page.locator(".sheet").waitFor();
  await page.keyboard.press("t");
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "amplitude_e");
  assert.equal(await page.locator(".sheet").count(), 0);
});

test("pixels that are saturated are struck through in every raw frame, large enough to be seen, and counted in words", async () => {
  const scene = written("bright.yaml", [
    "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", "objects:",
    "  - box: {name: near, min: [-0.03, -0.02, 0.1], max: [-0.01, 0.01, 0.12], reflectivity: 0.9}",
    "  - plane: {name: wall, point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.3}", "",
  ].join("\n"));
  const all = [scene, "--seed", "5"];
  const { url } = await view(all);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  const { flags } = rendered(all);
  const saturated = tab.hello().invalid.find((one) => one.name === "saturated");
  const full = [...flags.values].map((bits) => ((bits >> saturated.bit) & 1) === 1);
  const count = full.filter((one) => one).length;
  assert.ok(count > 100 && count < pixels / 2, String(count));
  await page.locator(".pane select.shows").nth(1).selectOption("raw frames");
  await page.waitForFunction(() => window.tofray.pane(1, "a", 8) !== undefined);
  assert.equal(await page.locator("[data-saturated]").getAttribute("data-saturated"), String(count));
  assert.match(await page.locator("[data-saturated]").textContent(), new RegExp(`^S ${count} pixels are saturated`));
  /** Whether a picture's pixel has a mark of the reason's colour on it. */
  const marked = (canvas, of, at) => page.evaluate(([selector, which, i, across, rgb]) => {
    const over = document.querySelectorAll(".pane")[1].querySelectorAll(selector)[0];
    const { scale, left, top } = which ?? { scale: over.width / across, left: 0, top: 0 };
    const [x, y] = [left + ((i % across) + 0.5) * scale, top + (Math.floor(i / across) + 0.5) * scale];
    const half = Math.max(1, scale / 2);
    const { data } = over.getContext("2d").getImageData(Math.round(x - half), Math.round(y - half), Math.max(1, Math.round(2 * half)), Math.max(1, Math.round(2 * half)));
    for (let k = 0; k < data.length; k += 4) if (data[k + 3] > 100 && rgb.every((one, c) => Math.abs(one - data[k + c]) < 40)) return true;
    return false;
  }, [canvas, of, at, width, saturated.color]);
  const inside = (i) => [-1, 0, 1].every((dv) => [-1, 0, 1].every((du) => full[i + dv * width + du] === full[i]));
  const [some, none] = [true, false].map((is) => full.map((one, i) => (one === is && i > 3 * width && i < pixels - 3 * width && inside(i) ? i : -1)).filter((i) => i >= 0));
  const pick = (list) => Array.from({ length: 8 }, (_, k) => list[Math.floor(((k + 0.5) * list.length) / 8)]);
  for (const i of pick(some)) assert.ok(await marked('.tile[data-raw="3"] canvas.over', undefined, i), `pixel ${i} is not marked`);
  for (const i of pick(none)) assert.ok(!(await marked('.tile[data-raw="3"] canvas.over', undefined, i)), `pixel ${i} is marked`);
  // One of them, enlarged; the colours below are as ever.
  await page.locator('.tile[data-raw="2"] .stage').click();
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "raw[2]");
  const of = await page.evaluate(() => window.tofray.placement(1));
  for (const i of pick(some)) assert.ok(await marked("canvas.over", of, i), `pixel ${i} is not marked`);
  for (const i of pick(none)) assert.ok(!(await marked("canvas.over", of, i)), `pixel ${i} is marked`);
  // Depth is not struck through: there the reason has its own colour.
  for (const i of pick(some)) {
    const clear = await page.evaluate(([at, across]) => {
      const { left, top, scale } = window.tofray.placement(0);
      const over = document.querySelectorAll(".pane")[0].querySelector("canvas.over");
      return over.getContext("2d").getImageData(left + ((at % across) + 0.5) * scale, top + (Math.floor(at / across) + 0.5) * scale, 1, 1).data[3] === 0;
    }, [i, width]);
    assert.ok(clear, `pixel ${i} of depth`);
  }
});

test("nobody looks at raw frames, none are sent", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const wants = () => tab.asked.filter((one) => one.type === "want").at(-1).arrays;
  assert.ok(!wants().includes("raw"));
  await tab.page.locator(".pane").nth(1).locator("select.shows").selectOption("raw frames");
  await tab.page.waitForFunction(() => window.tofray.pane(1, "a", 0) !== undefined);
  assert.ok(wants().includes("raw") && !wants().includes("tap_a") && !wants().includes("tap_b"), wants().join());
  await tab.page.locator(".pane").nth(1).locator("select.shows").selectOption("z_m");
  await tab.page.waitForFunction(() => window.tofray.pane(1)?.array === "z_m");
  assert.ok(!wants().includes("raw"), wants().join());
});

test("two states have a sheet each, with one scale, and their difference is B − A of every raw frame", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".pane").nth(1).locator("select.shows").selectOption("raw frames");
  await sheet(tab, "tap_a");
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await drawn(tab, "a");
  await set(tab, "camera.lens.f_number", "2");
  const [a, b] = [rendered(words), rendered([...words, "--set", "camera.lens.f_number=2"])];
  const part = (frame, k) => stack(frame, "tap_a").slice(k * pixels, (k + 1) * pixels);
  const scale = scale_of("tap_a", await bar(tab, 1));
  await page.waitForFunction(() => window.tofray.pane(1, "b", 8) !== undefined);
  for (const k of [0, 4]) {
    same((await pane(tab, 1, "a", k)).pixels, colors(tab.hello(), scale, part(a, k)), `A, raw frame ${k}`);
    same((await pane(tab, 1, "b", k)).pixels, colors(tab.hello(), scale, part(b, k)), `B, raw frame ${k}`);
  }
  await page.locator(".compare-bar").getByRole("button", { name: "Difference" }).click();
  await page.waitForFunction(() => window.tofray.pane(1, "a", 8)?.shows === "difference");
  const of_difference = scale_of("tap_difference", await bar(tab, 1));
  for (const k of [0, 4]) same((await pane(tab, 1, "a", k)).pixels, colors(tab.hello(), of_difference, part(a, k).map((one, i) => part_b(b, k)[i] - one)), `B − A, raw frame ${k}`);

  function part_b(frame, k) {
    part_b.kept ??= new Map();
    if (!part_b.kept.has(k)) part_b.kept.set(k, part(frame, k));
    return part_b.kept.get(k);
  }
});
