// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Two states of the camera: each has the pictures of its own command, and their difference is the difference of these arrays.

import assert from "node:assert/strict";
import { beside, canvas_pixels, choose, drawn, pane, point_at, rendered, same, set, settled, shown, stand_at, test, view } from "./viewer.mjs";
import { expected, mixed, reason, scale_of } from "./colors.mjs";

const words = ["demo", "--seed", "5"];
const wider = ["--set", "camera.lens.f_number=3"];

/** A | B, both drawn, at a frame. */
async function both(frame = 0) {
  const { url } = await view(words);
  const tab = await shown(url);
  await stand_at(tab, frame);
  await tab.page.getByRole("button", { name: "A | B", exact: true }).click();
  await tab.page.waitForFunction((at) => window.tofray.last_b?.frame === at, frame);
  return tab;
}

const way = (tab, name) => tab.page.locator(".compare-bar").getByRole("button", { name, exact: true }).click();

test("B begins as A: both pictures are the same, and their difference is 0 in each pixel that has a value", async () => {
  const tab = await both();
  const { z_m, flags } = rendered(words);
  const hello = tab.hello();
  const wanted = expected(hello, scale_of(hello, "z_m"), z_m.values, flags.values);
  same((await pane(tab, 0)).pixels, wanted, "A");
  same((await pane(tab, 0, "b")).pixels, wanted, "B");
  await way(tab, "Difference");
  await drawn(tab, "difference");
  const none = [];
  z_m.values.forEach((z, i) => none.push(...(Number.isFinite(z) ? mixed(hello.palettes.error_far, 0) : reason(hello, flags.values[i]).color), 255));
  same((await pane(tab, 0)).pixels, none, "difference");
  await beside(tab, "A | B");
  assert.match(await tab.page.locator(".same").textContent(), /^A and B are the same\./);
});

test("another aperture in B: A stays as it is, B has the picture of its command, the difference that of the arrays", async () => {
  const tab = await both(2);
  const { page } = tab;
  const hello = tab.hello();
  const [a, b] = [rendered(words, 2), rendered([...words, ...wider], 2)];
  await set(tab, "camera.lens.f_number", "3");
  assert.deepEqual(await page.evaluate(() => [window.tofray.overrides, window.tofray.overrides_b]), [[], [{ key: "camera.lens.f_number", text: "3" }]]);
  const colored = ({ z_m, flags }) => expected(hello, scale_of(hello, "z_m"), z_m.values, flags.values);
  same((await pane(tab, 0)).pixels, colored(a), "A");
  same((await pane(tab, 0, "b")).pixels, colored(b), "B");
  same(await canvas_pixels(tab, 0, "b"), colored(b), "B on the screen");

  // A pixel's values, of both.
  await beside(tab, "Pixel");
  await point_at(tab, 112, 86);
  await page.locator('.answer[data-pixel="112,86"]').waitFor();
  for (const [attribute, { z_m }] of [["data-value", a], ["data-value-b", b]]) {
    const wanted = String(Number(z_m.values[86 * 224 + 112].toPrecision(6)));
    await page.locator(`td[${attribute}="z_m"]`).getByText(new RegExp(`^${wanted.replace(".", "\\.")}0*\u00a0m$`)).waitFor();
  }

  await way(tab, "Difference");
  await drawn(tab, "difference");
  const { low, high } = await page.locator(".scale").first().evaluate((one) => ({ low: Number(one.dataset.low), high: Number(one.dataset.high) }));
  assert.ok(high > 0 && low === -high, `${low}, ${high}`);
  const wanted = [];
  let unlike = 0;
  a.z_m.values.forEach((z, i) => {
    const d = b.z_m.values[i] - z;
    unlike += d !== 0 && Number.isFinite(d) ? 1 : 0;
    const bits = (Number.isFinite(z) ? b : a).flags.values[i];
    wanted.push(...(!Number.isFinite(d) ? reason(hello, bits).color : d < 0 ? mixed(hello.palettes.error_near, -d / high) : mixed(hello.palettes.error_far, d / high)), 255);
  });
  assert.ok(unlike > 10_000);
  same((await pane(tab, 0)).pixels, wanted, "difference");

  // Bits: those that only one of them has.
  await choose(tab, 1, "flags");
  const bits = [];
  a.flags.values.forEach((one, i) => bits.push(...(reason(hello, one ^ b.flags.values[i])?.color ?? [244, 244, 241]), 255));
  await page.waitForFunction(() => window.tofray.pane(1).array === "flags");
  same((await pane(tab, 1)).pixels, bits, "flags");

  await beside(tab, "A | B");
  const rows = await page.locator("tr[data-differs]").evaluateAll((all) => all.map((row) => [...row.children].map((one) => one.textContent)));
  assert.equal(rows.length, 1);
  assert.equal(rows[0][0], "camera.lens.f_number");
  assert.equal(rows[0][2], "3");
  assert.notEqual(rows[0][1], "3");
});

test("wipe shows A to its line and B behind it, flip and the key b show B in A's place; cursor and zoom are of both", async () => {
  const tab = await both();
  const { page } = tab;
  await set(tab, "camera.lens.f_number", "3");
  const [a, b] = [(await pane(tab, 0)).pixels, (await pane(tab, 0, "b")).pixels];
  assert.notDeepEqual(a, b);
  await page.keyboard.press("Escape");

  // The cursor, and what it reads.
  await point_at(tab, 112, 86);
  const arrays = [rendered(words), rendered([...words, ...wider])];
  const texts = await page.locator('.pane').first().locator(".reading [data-array], .reading [data-array-b]").allTextContents();
  texts.forEach((text, i) => assert.equal(Number.parseFloat(text), Number(arrays[i].z_m.values[86 * 224 + 112].toPrecision(6))));
  await page.locator(".stage").first().focus();
  await page.keyboard.press("+");
  await page.waitForFunction(() => window.tofray.placement(0).scale > 2);
  assert.deepEqual(await page.evaluate(() => window.tofray.placement(0, "b")), await page.evaluate(() => window.tofray.placement(0)));
  await page.keyboard.press("0");

  await way(tab, "Wipe");
  const line = page.getByRole("slider", { name: "Line between A and B" }).first();
  const mixed_of = (wanted) => page.waitForFunction((at) => document.querySelector(".wipe[role=slider]").getAttribute("aria-valuenow") === String(at), wanted);
  await mixed_of(50);
  await drawn(tab, "wipe");
  const halves = async () => {
    const canvas = await canvas_pixels(tab, 0);
    const { left, scale } = await page.evaluate(() => window.tofray.placement(0));
    const box = await page.locator(".stage").first().boundingBox();
    const at = Number(await line.getAttribute("aria-valuenow")) / 100;
    const wanted = [];
    for (let i = 0; i < a.length; i += 4) {
      const x = Math.floor(left + ((i / 4) % 224 + 0.5) * scale);
      wanted.push(...(x < Math.round(at * box.width) ? a : b).slice(i, i + 4));
    }
    same(canvas, wanted, `wiped at ${at}`);
  };
  await halves();
  await line.focus();
  for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
  await mixed_of(60);
  await drawn(tab, "wipe");
  await halves();

  await way(tab, "Flip");
  await drawn(tab, "a");
  same(await canvas_pixels(tab, 0), a, "A");
  await page.getByRole("button", { name: "A is shown" }).click();
  await drawn(tab, "b");
  same(await canvas_pixels(tab, 0), b, "B");
  await page.getByRole("button", { name: "B is shown" }).click();
  await page.locator(".stage").first().focus();
  await page.keyboard.down("b");
  await drawn(tab, "b");
  same(await canvas_pixels(tab, 0), b, "B while b is held down");
  await page.keyboard.up("b");
  await drawn(tab, "a");
  same(await canvas_pixels(tab, 0), a, "A again");
});

test("swapped, closed and undone: each side has its own list, and undo opens B again", async () => {
  const tab = await both();
  const { page } = tab;
  await set(tab, "camera.lens.f_number", "3");
  const lists = () => page.evaluate(() => [window.tofray.overrides, window.tofray.overrides_b]);
  const three = [{ key: "camera.lens.f_number", text: "3" }];
  await beside(tab, "A | B");
  await page.getByRole("button", { name: "Swap A and B" }).click();
  await page.waitForFunction(() => window.tofray.overrides.length === 1 && window.tofray.overrides_b.length === 0);
  await settled(tab);
  same((await pane(tab, 0)).pixels, (await (async () => {
    const { z_m, flags } = rendered([...words, ...wider]);
    return expected(tab.hello(), scale_of(tab.hello(), "z_m"), z_m.values, flags.values);
  })()), "A after the swap");
  await page.getByRole("tabpanel").getByRole("button", { name: "Close B" }).click();
  await page.waitForFunction(() => window.tofray.overrides_b === undefined);
  assert.equal(await page.locator(".badge").count(), 0);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("Control+z");
  await page.waitForFunction(() => window.tofray.overrides_b !== undefined);
  assert.deepEqual(await lists(), [three, []]);
  while (await page.evaluate(() => window.tofray.steps.past) > 0) {
    await page.keyboard.press("Control+z");
    await settled(tab);
  }
  assert.deepEqual(await lists(), [[], undefined]);
});

test("another camera opens as B, and a name that is none is refused", async () => {
  const tab = await both();
  const { page } = tab;
  await beside(tab, "A | B");
  await page.getByLabel("B: another scene or camera").fill("no-such-camera");
  await page.getByRole("button", { name: "Open", exact: true }).click();
  await page.getByRole("alert").waitFor();
  assert.equal((await page.evaluate(() => window.tofray.overrides_b)).length, 0);
  await page.getByRole("alert").getByRole("button", { name: "Dismiss" }).click();
  await page.getByLabel("B: another scene or camera").fill("pico-monstar");
  await page.getByRole("button", { name: "Open", exact: true }).click();
  await page.waitForFunction(() => window.tofray.pane(0, "b")?.width === 352);
  await way(tab, "Difference");
  await page.getByText("A and B have other pixels: no difference of them.").waitFor();
});
