// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Who does not see the picture, or uses no pointer: axe-core's rules, and the way of the focus.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { before, measure_all, open_all } from "./full_pages.mjs";
import { axe_source, beside, choose, drawn, find, folder, point_at, set, shown, stand_at, test, type, view } from "./viewer.mjs";

/** Of the page as it is, on dark and on light ground. Only what is wrong comes out of the page: what is right is ten times as long. */
async function violations({ page }) {
  if (!await page.evaluate(() => window.axe !== undefined)) await page.evaluate(axe_source);
  const out = [];
  for (const colorScheme of ["dark", "light"]) {
    await page.emulateMedia({ colorScheme });
    const { found, passes } = await page.evaluate(async () => {
      const of = await window.axe.run(document, { resultTypes: ["violations"] });
      return { found: of.violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.html).join(" | ")}`), passes: of.passes.length };
    });
    assert.ok(passes >= 15, `only ${passes} rules had something to look at`);
    out.push(...found.map((one) => `${colorScheme}: ${one}`));
  }
  return out;
}

test("axe-core finds nothing in the page, dark and light: live, with a pixel, with the keys, without a server", async () => {
  const viewer = await view(["demo", "--seed", "5", "-o", mkdtempSync(join(folder, "along-"))]);
  const tab = await shown(viewer.url, { reducedMotion: "reduce" });
  const { page } = tab;
  assert.deepEqual(await violations(tab), []);
  await stand_at(tab, 0);
  await beside(tab, "Pixel");
  await point_at(tab, 112, 86);
  await page.locator('.answer[data-pixel="112,86"]').waitFor();
  await page.locator("summary", { hasText: "Raw frames" }).click();
  await choose(tab, 1, "flags");
  assert.deepEqual(await violations(tab), []);
  await page.keyboard.press("?");
  await page.getByRole("dialog").waitFor();
  assert.deepEqual(await violations(tab), []);
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "hidden" });
  await page.getByRole("button", { name: "Take along …" }).click();
  await page.getByRole("dialog", { name: "Take along" }).waitFor();
  await page.locator("#record-first").fill("x");
  assert.deepEqual(await violations(tab), [], "the window for what is taken along");
  await page.locator("#record-first").fill("0");
  await page.locator("#record-count").fill("2");
  await page.getByRole("button", { name: "Record", exact: true }).click();
  await page.locator("[data-recorded]").waitFor();
  assert.deepEqual(await violations(tab), [], "with what was recorded");
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "hidden" });
  await viewer.kill();
  await page.getByText("The server is gone.").waitFor();
  assert.deepEqual(await violations(tab), []);
});

test("axe-core finds nothing in the page, dark and light, with controls, a fault, histograms, and two states in each way to look at them", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await shown(url, { reducedMotion: "reduce" });
  const { page } = tab;
  await stand_at(tab, 0);
  await page.getByRole("combobox", { name: "Number of panes" }).selectOption("3");
  await page.waitForFunction(() => window.tofray.pane(2) !== undefined);
  await choose(tab, 2, "flags");
  for (let i = 0; i < 3; ++i) await page.getByRole("button", { name: "Histogram", exact: true }).nth(i).click();
  for (const i of [0, 2]) await page.locator(".group > summary").nth(i).click();
  await page.locator(".control").first().waitFor();
  assert.deepEqual(await violations(tab), []);
  await set(tab, "camera.lens.f_number", "2.8");
  await type(tab, "camera.lens.f_number", "banana");
  await (await find(tab, "camera.lens.f_number")).getByRole("alert").waitFor();
  assert.deepEqual(await violations(tab), []);
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await drawn(tab, "a");
  await set(tab, "camera.lens.f_number", "3");
  await beside(tab, "A | B");
  for (const [name, shows] of [["Side by side", "a"], ["Wipe", "wipe"], ["Flip", "a"], ["Difference", "difference"]]) {
    await page.locator(".compare-bar").getByRole("button", { name, exact: true }).click();
    await drawn(tab, shows);
    assert.deepEqual(await violations(tab), [], name);
  }
});

test("axe-core finds nothing in the page, dark and light, with raw frames, a pixel's charts, why it is wrong, and the watch list", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await shown(url, { reducedMotion: "reduce", before });
  const { page } = tab;
  await open_all(tab);
  assert.deepEqual(await violations(tab), []);
  await page.keyboard.press("e");
  await page.getByRole("button", { name: "Region: ends here" }).waitFor();
  assert.deepEqual(await violations(tab), [], "a region");
  await beside(tab, "Watch");
  await page.locator("[data-pinned]").nth(1).waitFor();
  await page.locator('.tile[data-raw="3"] .stage').focus();
  await page.keyboard.press("Enter");
  assert.deepEqual(await violations(tab), [], "the watch list, a raw frame enlarged");
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await drawn(tab, "a");
  await page.locator(".stage").first().focus();
  await page.locator(".pane select.raw-number").selectOption("all");
  await page.waitForFunction(() => window.tofray.pane(1, "b", 8) !== undefined);
  assert.deepEqual(await violations(tab), [], "two states' raw frames");
});

test("axe-core finds nothing in the page, dark and light, with points in space, a distance, a rectangle and the noise over time", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await shown(url, { reducedMotion: "reduce" });
  const { page } = tab;
  await measure_all(tab);
  assert.deepEqual(await violations(tab), []);
  await page.getByRole("button", { name: "Show σ and σ̂" }).click();
  await page.locator(".stage").first().focus();
  await page.keyboard.press("m");
  await page.getByText("the other end?").waitFor();
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await page.locator(".compare-bar").waitFor();
  assert.deepEqual(await violations(tab), [], "half measured, σ and σ̂, two states");
});

/** The rows of a table of docs/viewer.md, by the word over its first column. */
function table(word) {
  const text = readFileSync(new URL("../../docs/viewer.md", import.meta.url), "utf8");
  const [, rows] = new RegExp(`^\\| ${word} \\|.*\\n\\|[-|]+\\|\\n((?:\\|.*\\n)+)`, "m").exec(text);
  return rows.trim().split("\n").map((row) => row.slice(2, -2).split(" | ").map((cell) => cell.replaceAll("\\|", "|")));
}

test("a pane offers what docs/viewer.md lists, in that order", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const { page } = await shown(url);
  assert.deepEqual(await page.locator(".pane select.shows").first().locator("option").allTextContents(), table("pane").map(([title]) => title));
});

test("the help lists the keys as docs/viewer.md does, leaves the focus where it was, and keys do nothing in a field", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("?");
  await page.getByRole("dialog").waitFor();
  const said = await page.getByRole("dialog").locator("dl").first().locator("div").evaluateAll((rows) => rows.map((row) => [...row.children].map((one) => one.textContent)));
  assert.deepEqual(said, table("key"));
  assert.ok(said.length >= 10);
  const in_space = await page.getByRole("dialog").locator("dl.space-keys > div").evaluateAll((rows) => rows.map((row) => [...row.children].map((one) => one.textContent)));
  assert.deepEqual(in_space, table("key in 3D"));
  await page.keyboard.press(".");
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "hidden" });
  assert.equal(await page.evaluate(() => document.activeElement.className), "stage");
  await page.locator("#frame").focus();
  await page.keyboard.press(".");
  await page.locator(".stage").first().focus();
  await page.keyboard.press("2");   // the second array of the list
  await page.waitForFunction(() => window.tofray.pane(0).array === "amplitude_e");
  assert.equal(await page.evaluate(() => window.tofray.last.frame), 0);
  assert.deepEqual(tab.asked.filter((one) => one.type === "seek").map((one) => one.frame), [0]);
});

test("Tab goes through every control, each with a focus that is seen", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  const expected = await page.evaluate(() => [...document.querySelectorAll("button, select, input, a, summary, [tabindex]")].filter((one) => !one.disabled && one.tabIndex >= 0 && one.checkVisibility()).length);
  await page.evaluate(() => document.activeElement.blur());
  await page.locator("body").click({ position: { x: 2, y: 2 } });
  const seen = [];
  for (let i = 0; i < expected; ++i) {
    await page.keyboard.press("Tab");
    seen.push(await page.evaluate(() => {
      const one = document.activeElement;
      one.dataset.visited = "yes";
      const style = getComputedStyle(one);
      return { tag: one.tagName, outline: style.outlineStyle !== "none" && Number.parseFloat(style.outlineWidth) >= 2 };
    }));
  }
  assert.equal(await page.locator("[data-visited]").count(), expected, JSON.stringify(seen));
  for (const one of seen) assert.ok(one.outline, `${one.tag} shows no focus`);
});

test("all of it is done by keys: raw frames, one of them, pins, the watch list, why a pixel and a region are wrong", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await shown(url, { before });
  const { page } = tab;
  await stand_at(tab, 0);
  const keys = async (...all) => {
    for (const key of all) await page.keyboard.press(key);
  };
  await page.locator(".stage").first().focus();
  await keys("t");
  await page.locator(".sheet").waitFor();
  await page.waitForFunction(() => window.tofray.pane(0, "a", 8) !== undefined);
  await page.waitForFunction(() => document.activeElement.closest(".tile")?.dataset.raw === "0");
  await keys("Tab", "Enter");
  await page.waitForFunction(() => window.tofray.pane(0)?.array === "raw[1]");
  await keys("ArrowRight", "p");
  await keys("Shift+ArrowRight", "p", "w");
  await page.locator("[data-why-of]").waitFor();
  await keys("e", "Shift+ArrowRight", "Shift+ArrowDown", "e");
  await page.getByText(/^pixels \d+ … \d+, /).waitFor();
  for (let i = 0; i < 60 && !(await page.evaluate(() => document.activeElement.id === "tab-pixel")); ++i) await keys("Tab");
  await keys("ArrowRight");
  await page.locator("[data-pinned]").nth(1).waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.id), "tab-watch");
});

test("in forced colours it is still seen what is chosen", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await shown(url, { forcedColors: "active" });
  const { page } = tab;
  await page.getByRole("button", { name: "Histogram", exact: true }).first().click();
  const border = (locator) => locator.evaluate((one) => getComputedStyle(one).borderBottomColor);
  const histogram = page.getByRole("button", { name: "Histogram", exact: true });
  assert.notEqual(await border(histogram.first()), await border(histogram.nth(1)));
  assert.notEqual(await border(page.getByRole("tab", { selected: true })), await border(page.getByRole("tab", { selected: false }).first()));
  assert.notEqual(await border(page.locator(".pane").first()), await border(page.locator(".pane").nth(1)));
});
