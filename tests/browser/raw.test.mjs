// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The sheet of all raw frames: every pixel has the colour that this file computes of the arrays which the command writes.

import assert from "node:assert/strict";
import { test } from "node:test";
import { color } from "./colors.mjs";
import { canvas_pixels, drawn, pane, point_at, rendered, same, set, shown, stand_at, view } from "./viewer.mjs";

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
  await page.keyboard.press("r");
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

test("a click or Enter enlarges one, r goes back to all and then to what was there; the scale stays, also in another frame", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("r");
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
  await page.keyboard.press("r");
  await page.locator('.tile[data-raw="5"] .stage').focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "raw[5]");
  assert.equal(await page.evaluate(() => document.activeElement === document.querySelectorAll(".pane")[1].querySelector(".stage")), true, "the focus is lost");
  await stand_at(tab, 3);
  await check(3, 5);
  assert.deepEqual(await bar(tab, 1), range);
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("r");
  await page.locator(".sheet").waitFor();
  await page.keyboard.press("r");
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "amplitude_e");
  assert.equal(await page.locator(".sheet").count(), 0);
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
