// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The picture of docs/viewer.md, from the viewer itself:
//   TOFRAY=build/release/apps/tofray/tofray TOFRAY_PAGE_PACKAGES=build/release/viewer node tools/viewer_picture.mjs docs/images/viewer.png

import { test } from "node:test";
import { choose, point_at, shown, stand_at, view } from "../tests/browser/viewer.mjs";

const [out] = process.argv.slice(2);
if (out === undefined) throw new Error("node tools/viewer_picture.mjs FILE.png");

test(`writes ${out}`, async () => {
  const { url } = await view(["demo", "--seed", "1"]);
  const tab = await shown(url, { viewport: { width: 1280, height: 880 }, colorScheme: "dark", reducedMotion: "reduce" });
  await stand_at(tab, 0);
  await choose(tab, 1, "z_error_m");
  await point_at(tab, 150, 143);
  await tab.page.locator('.answer[data-pixel="150,143"]').waitFor();
  await tab.page.evaluate(() => document.activeElement.blur());
  await tab.page.screenshot({ path: out });
});
