// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Nothing is lost, cut or to be scrolled sideways, however narrow the window is.

import assert from "node:assert/strict";
import { before, measure_all, open_all } from "./full_pages.mjs";
import { beside, drawn, find, set, shown, test, type, view } from "./viewer.mjs";

// (At 200 % a window of 1280 × 900 has 640 × 450 CSS pixels.)
const windows = [["320 CSS pixels wide", { width: 320, height: 640 }], ["zoomed to 200 %", { width: 640, height: 450 }], ["in a usual window", { width: 1280, height: 760 }]];

for (const [what, viewport] of windows) {
  test(`${what}, points in space and all that is measured are not cut, and nothing has to be scrolled sideways`, async () => {
    const { url } = await view(["demo", "--seed", "5"]);
    const tab = await shown(url, { viewport, webgl: true });   // which has more buttons
    const { page } = tab;
    await measure_all(tab);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width);
    const outside = await page.evaluate(() => [...document.querySelectorAll("button, select, input, .stage, table, th, td, progress, .figure")]
      .filter((one) => one.checkVisibility() && one.closest(".wide, .unseen, dialog") === null)
      .filter((one) => {
        const [box, within] = [one, one.closest(".panel, .pane, header, footer, .compare-bar")].map((of) => of.getBoundingClientRect());
        return box.width > 0 && (box.right > within.right + 0.5 || box.left < within.left - 0.5);
      }).map((one) => one.outerHTML.slice(0, 200)));
    assert.deepEqual(outside, []);
    const folded = await page.evaluate(() => [...document.querySelectorAll(".panel td, .panel button, .pane button, .tool-bar button")].filter((one) => one.checkVisibility() && one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 0)
      .map((one) => one.outerHTML.slice(0, 200)));
    assert.deepEqual(folded, [], "wider than its place");
  });
}

for (const [what, viewport] of windows) {
  test(`${what}, no control is lost, and nothing has to be scrolled sideways, neither with controls nor with two states`, async () => {
    const { url } = await view(["demo", "--seed", "5"]);
    const tab = await shown(url, { viewport });
    const { page } = tab;
    const check = async (state) => {
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width, state);
      const outside = await page.evaluate((width) => [...document.querySelectorAll("button, select, input, .stage, summary")]
        .filter((one) => one.checkVisibility())
        .filter((one) => one.getBoundingClientRect().right > width || one.getBoundingClientRect().left < 0).map((one) => one.outerHTML), viewport.width);
      assert.deepEqual(outside, [], state);
      const cut = await page.evaluate(() => [...document.querySelectorAll(".panel table, .panel p, .panel li")]
        .filter((one) => one.checkVisibility() && one.closest(".wide, .unseen") === null)
        .filter((one) => one.getBoundingClientRect().right > one.closest(".panel").getBoundingClientRect().right + 0.5).map((one) => one.outerHTML.slice(0, 200)));
      assert.deepEqual(cut, [], state);
    };
    await check("at first");
    for (const i of [0, 2]) await page.locator(".group > summary").nth(i).click();
    await set(tab, "camera.lens.f_number", "2.8");
    await type(tab, "camera.lens.f_number", "banana");
    await (await find(tab, "camera.lens.f_number")).getByRole("alert").waitFor();
    await check("controls");
    await page.getByRole("button", { name: "A | B", exact: true }).click();
    await page.locator(".compare-bar").waitFor();
    await set(tab, "camera.lens.f_number", "4");
    await beside(tab, "A | B");
    await page.locator("tr[data-differs]").waitFor();
    await check("two states");
    await beside(tab, "Pixel");
    await page.locator(".stage").first().focus();
    await page.keyboard.press("ArrowRight");
    await page.locator("td[data-value-b=z_m]").waitFor();
    await check("a pixel of both");
    await page.locator(".compare-bar").getByRole("button", { name: "Wipe" }).click();
    await drawn(tab, "wipe");
    await check("wipe");
    await page.getByRole("button", { name: "Take along …" }).click();
    const dialog = page.getByRole("dialog", { name: "Take along" });
    await dialog.waitFor();
    assert.equal(await dialog.evaluate((one) => one.scrollWidth > one.clientWidth), false, "the window is scrolled sideways");
    const beyond = await dialog.evaluate((one) => [...one.querySelectorAll("button, input, p, h3, .file-button span")].filter((part) => part.getBoundingClientRect().right > one.getBoundingClientRect().right || part.getBoundingClientRect().left < one.getBoundingClientRect().left).map((part) => part.outerHTML.slice(0, 200)));
    assert.deepEqual(beyond, [], "the window for what is taken along");
  });
}

for (const [what, viewport] of windows) {
  test(`${what}, raw frames, charts, bars and the watch list are not cut, and nothing has to be scrolled sideways`, async () => {
    const { url } = await view(["demo", "--seed", "5"]);
    const tab = await shown(url, { viewport, before });
    const { page } = tab;
    const check = async (state) => {
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width, state);
      const outside = await page.evaluate(() => [...document.querySelectorAll("button, select, input, .stage, summary, svg, figcaption, table, th, td, .mm, .bar-of")]
        .filter((one) => one.checkVisibility() && one.closest(".wide, .unseen, dialog") === null)
        .filter((one) => {
          const [box, within] = [one, one.closest(".panel, .pane, header, footer, .compare-bar")].map((of) => of.getBoundingClientRect());
          return box.width > 0 && (box.right > within.right + 0.5 || box.left < within.left - 0.5);
        }).map((one) => one.outerHTML.slice(0, 200)));
      assert.deepEqual(outside, [], state);
      const folded = await page.evaluate(() => [...document.querySelectorAll(".panel td, .panel button, .mm")].filter((one) => one.checkVisibility() && one.closest(".wide, .unseen") === null && one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 0)
        .map((one) => one.outerHTML.slice(0, 200)));
      assert.deepEqual(folded, [], `${state}: wider than its place`);
    };
    await open_all(tab);
    await check("a pixel");
    await beside(tab, "Watch");
    await page.locator("[data-pinned]").nth(1).waitFor();
    await check("the watch list");
    await page.locator('.tile[data-raw="3"] .stage').focus();
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => window.tofray.pane(1)?.array === "raw[3]");
    await check("one raw frame");
  });
}
