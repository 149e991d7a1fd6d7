// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pages with as much on them as there can be: for who looks for what is wrong with any of it.

import { split, with_chain } from "./answers.mjs";
import { between, stand_at } from "./viewer.mjs";

/** A page that has a pixel's charts, an error's split, the sheet of raw frames and two pins. */
export const before = between({ asked: { why: ({ id, u, v }) => ({ type: "why", id, u, v, pixels: 1, count: 1, ...split }) }, told: { pixel: with_chain } });

export async function open_all(tab) {
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".pane select.shows").nth(1).selectOption("raw frames");
  await page.waitForFunction(() => window.tofray.pane(1, "a", 8) !== undefined);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("p");
  await page.keyboard.press("Shift+ArrowDown");
  await page.keyboard.press("p");
  await page.keyboard.press("w");
  await page.locator("[data-why-of]").waitFor();
  await page.locator("[data-candidate]").first().waitFor();
}

/** Points in space, a distance, a rectangle's numbers, and 200 frames'. */
export async function measure_all(tab) {
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".pane select.shows").nth(1).selectOption("3D points");
  await page.locator(".stage.space:not([data-drawing=loading])").waitFor();
  await page.locator(".object-choice option").nth(3).waitFor({ state: "attached" });
  await page.locator(".object-choice").selectOption({ index: 3 });
  await page.getByRole("button", { name: "Lights", exact: true }).click();
  await page.locator(".stage").first().focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("m");
  await page.keyboard.press("Shift+ArrowDown");
  await page.keyboard.press("m");
  await page.keyboard.press("g");
  await page.keyboard.press("Shift+ArrowDown");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("g");
  await page.keyboard.press("n");
  await page.keyboard.press("d");
  for (const one of ["[data-measure]", "[data-region]", "[data-temporal]"]) await page.locator(one).waitFor();
}
