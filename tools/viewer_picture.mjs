// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The picture of docs/viewer.md, from the viewer itself:
//   TOFRAY=build/release/apps/tofray/tofray TOFRAY_PAGE_PACKAGES=build/release/viewer node tools/viewer_picture.mjs docs/images/viewer.png

import { test } from "node:test";
import { point_at, shown, stand_at, view } from "../tests/browser/viewer.mjs";

const [out] = process.argv.slice(2);
if (out === undefined) throw new Error("node tools/viewer_picture.mjs FILE.png");

test(`writes ${out}`, async () => {
  const { url } = await view(["demo", "--seed", "1"]);
  const tab = await shown(url, { viewport: { width: 1280, height: 720 }, colorScheme: "dark", reducedMotion: "reduce" });
  await stand_at(tab, 0);
  await point_at(tab, 176, 133);
  await tab.page.locator('.answer[data-pixel="176,133"]').waitFor();
  await tab.page.evaluate(() => document.activeElement.blur());
  await tab.page.screenshot({ path: out });
});
