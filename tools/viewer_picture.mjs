// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The pictures of docs/viewer.md, from the viewer itself, viewer.png, viewer_ab.png, viewer_why.png, viewer_3d.png,
// viewer_measure.png, viewer_along.png, viewer_files.png and viewer_file.png, and those of docs/bent-corner.md, bent_….png, by its own steps:
//   TOFRAY=build/release/apps/tofray/tofray TOFRAY_PAGE_PACKAGES=build/release/viewer node tools/viewer_picture.mjs docs/images
// (One of them alone: node --test-name-pattern=tutorial tools/viewer_picture.mjs docs/images)

import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { follow } from "../tests/browser/tutorial.mjs";
import { beside, drawn, find, open, point_at, set, settled, shown, stand_at, test, told, view } from "../tests/browser/viewer.mjs";

const [out] = process.argv.slice(2);
if (out === undefined) throw new Error("node tools/viewer_picture.mjs FOLDER");

async function start(colorScheme, words = ["demo"], webgl = false) {
  const { url } = await view([...words, "--seed", "1"]);
  const tab = await shown(url, { viewport: { width: 1280, height: 760 }, colorScheme, reducedMotion: "reduce", webgl });
  await stand_at(tab, 0);
  return tab;
}

async function take({ page }, name) {
  await page.evaluate(() => document.activeElement.blur());
  await page.waitForTimeout(500);   // scroll bars and outlines have gone
  await page.screenshot({ path: join(out, name) });
}

test("controls, a histogram and a pixel's values", async () => {
  const tab = await start("dark");
  await set(tab, "camera.lens.f_number", "2.4");
  await tab.page.getByRole("searchbox").fill("lens f");
  await tab.page.getByRole("button", { name: "Histogram", exact: true }).first().click();
  await point_at(tab, 176, 133);
  await take(tab, "viewer.png");
});

test("two apertures, by a wipe", async () => {
  const tab = await start("light");
  await tab.page.getByRole("button", { name: "A | B", exact: true }).click();
  await settled(tab);
  await set(tab, "camera.lens.f_number", "3.2");
  await tab.page.locator(".compare-bar").getByRole("button", { name: "Wipe" }).click();
  await drawn(tab, "wipe");
  await beside(tab, "A | B");
  await point_at(tab, 60, 40);
  await take(tab, "viewer_ab.png");
});

test("a region's error by cause, beside depth and all raw frames", async () => {
  const tab = await start("dark", ["corner", "--bounces", "3"]);
  const { page } = tab;
  await page.locator(".pane select.shows").nth(1).selectOption("raw frames");
  await page.waitForFunction(() => window.tofray.pane(1, "a", 8) !== undefined);
  await page.locator(".stage").first().focus();
  await point_at(tab, 60, 150);
  await page.keyboard.press("p");
  await point_at(tab, 150, 40);
  await page.keyboard.press("p");
  await point_at(tab, 96, 70);
  await page.keyboard.press("e");
  await point_at(tab, 127, 101);
  await page.keyboard.press("e");
  await page.locator("[data-why-of]").waitFor();
  await take(tab, "viewer_why.png");
});

test("points in space", async () => {
  const tab = await start("dark", ["demo"], true);
  const { page } = tab;
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("x");
  await page.locator('.stage.space[data-drawing="WebGL"]').waitFor();
  await page.locator(".pane select.cloud-color").selectOption("z_m");
  await page.getByRole("button", { name: "Truth" }).click();
  await page.locator(".object-choice option").nth(3).waitFor({ state: "attached" });
  await page.locator(".object-choice").selectOption({ label: "chest" });
  await page.getByRole("button", { name: "Move it" }).click();
  await page.locator(".stage.space").focus();
  for (const key of ["+", "+", "ArrowUp", "Shift+ArrowLeft"]) await page.keyboard.press(key);
  await page.waitForTimeout(500);
  await point_at(tab, 112, 60);
  await take(tab, "viewer_3d.png");
});

test("what is taken along", async () => {
  const tab = await start("dark", ["demo", "-o", mkdtempSync(join(tmpdir(), "tofray-picture-"))]);
  const { page } = tab;
  await page.locator(".stage").first().focus();
  await page.keyboard.press("r");
  await page.locator("#record-count").fill("2");
  await page.getByRole("button", { name: "Record", exact: true }).click();
  await page.locator("[data-recorded]").waitFor();
  // The folder of this picture is nobody's.
  await page.locator("[data-recorded] p code").evaluate((one) => (one.textContent = "recording_0001"));
  await take(tab, "viewer_along.png");
});

test("raw frames that were made before", async () => {
  const out = join(mkdtempSync(join(tmpdir(), "tofray-picture-")), "recording");
  told(["render", "demo", "--seed", "1", "--frames", "20", "--quiet", "--arrays", "raw,modulation_frequency_hz,reference_phase_rad,integration_time_s,lit", "-o", out]);
  const { url } = await view(["recording", "--camera", "pico-flexx"], 0, { cwd: join(out, "..") });
  const tab = await shown(url, { viewport: { width: 1280, height: 760 }, colorScheme: "dark", reducedMotion: "reduce" });
  const { page } = tab;
  await stand_at(tab, 7);
  await (await find(tab, "camera.decoding.filter.kind")).getByRole("combobox").selectOption("median");
  await page.locator('[data-changed="camera.decoding.filter.kind"]').waitFor();
  await settled(tab);
  await page.getByRole("searchbox").fill("filter");
  await page.locator("[data-note=files] summary").click();
  await take(tab, "viewer_files.png");
});

test("a page as one file", async () => {
  const file = join(mkdtempSync(join(tmpdir(), "tofray-picture-")), "demo.html");
  told(["view", "demo", "--seed", "1", "--frames", "3", "--export", file]);
  const { page } = await open(`file://${file}`, { viewport: { width: 1280, height: 760 }, colorScheme: "light", reducedMotion: "reduce" });
  await page.waitForFunction(() => [...document.querySelectorAll(".stage canvas.front")].length === 2);
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("x");
  await page.locator('.stage.space[data-drawing="processor"]').waitFor();
  await page.locator(".pane select.cloud-color").selectOption("z_m");
  await page.locator(".stage").first().hover({ position: { x: 235, y: 150 } });
  await page.getByRole("button", { name: "Histogram", exact: true }).first().click();
  await take({ page }, "viewer_file.png");
});

test("a distance and a rectangle", async () => {
  const tab = await start("light");
  const { page } = tab;
  await page.locator(".stage").first().focus();
  await point_at(tab, 112, 80);
  await page.keyboard.press("m");
  await point_at(tab, 176, 133);
  await page.keyboard.press("m");
  await point_at(tab, 150, 14);   // the wall alone
  await page.keyboard.press("g");
  await point_at(tab, 206, 48);
  await page.keyboard.press("g");
  await page.locator("[data-region]").waitFor();
  await point_at(tab, 60, 160);
  await take(tab, "viewer_measure.png");
});

test("the tutorial on a corner that bends", async () => {
  const page = join(dirname(fileURLToPath(import.meta.url)), "../docs/bent-corner.md");
  await follow(page, { picture: take, viewport: { width: 1280, height: 760 }, colorScheme: "light", reducedMotion: "reduce" });
});
