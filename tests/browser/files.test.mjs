// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Frames that were made before: played as they are, decoded anew where there are raw frames, and what they lack is said.

import assert from "node:assert/strict";
import { mkdtempSync } from "node:fs";
import { join } from "node:path";
import { expected, scale_of } from "./colors.mjs";
import { read_npz } from "./npz.mjs";
import { arrived, axe_source, beside, bytes_of, drawn, find, folder, pane, point_at, rendered, same, set, settled, shown, stand_at, test, told, view } from "./viewer.mjs";

const width = 224;
const words = ["demo", "--seed", "5"];

/** Three frames, with these arrays. */
function recorded(arrays) {
  const out = mkdtempSync(join(folder, "files-"));
  told(["render", ...words, "--frames", "3", "--emit", "npz", ...(arrays === undefined ? [] : ["--arrays", arrays]), "--quiet", "-o", out]);
  return { out, files: [0, 1, 2].map((i) => read_npz(join(out, `frame_000${i}.npz`))) };
}

/** As a camera records: no depth, and no truth. */
const raw_only = "raw,modulation_frequency_hz,reference_phase_rad,integration_time_s,lit";

test("a folder of frames is played in order, each with the colours of its own arrays; time has an end, and can be dragged", async () => {
  const { out, files } = recorded("z_m,amplitude_e,flags");
  const tab = await shown((await view([out])).url);
  const { page } = tab;
  for (const i of [2, 0, 1]) {
    await stand_at(tab, i);
    same((await pane(tab, 0)).pixels, expected(tab.hello(), scale_of(tab.hello(), "z_m"), [...files[i].z_m.values], files[i].flags.values), `frame ${i}`);
    for (const name of ["z_m", "amplitude_e", "flags"]) assert.ok(arrived(tab)[name].equals(bytes_of(files[i][name])), `${name} of frame ${i}`);
  }
  const slider = page.getByRole("slider", { name: "Frame" });
  assert.deepEqual(await slider.evaluate((one) => [one.min, one.max, one.value, one.ariaValueText]), ["0", "2", "1", "frame 1, 2 of 3"]);
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => window.tofray.last.frame === 2);
  await page.locator("#frame").fill("77");
  await page.locator("#frame").press("Enter");
  await settled(tab);
  assert.equal(await page.evaluate(() => window.tofray.last.frame), 2, "there is no further one");
  await page.getByRole("button", { name: "Play" }).click();
  await page.getByRole("status").getByText("playing").waitFor();
  // What is not there is said, and cannot be chosen.
  await page.locator("[data-note=files]").getByText("Frames that were made before.").waitFor();
  await page.locator("[data-note=files] summary").click();
  const absent = tab.hello().absent;
  for (const array of ["gt_z_m", "z_error_m", "noise_m"]) {
    const { why } = absent.find((one) => one.array === array);
    assert.ok(why.length > 10);
    assert.ok((await page.locator(`[data-absent~=${array}]`).textContent()).endsWith(why), array);
    assert.deepEqual(await page.locator(`.pane select.shows option[value=${array}]`).first().evaluate((one) => one.disabled), true, array);
  }
  await page.locator("[data-fixed]").getByText(tab.hello().cannot.set).waitFor();
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Take along …" }).click();
  assert.equal(await page.locator("#record .what").textContent(), tab.hello().cannot.record);
  assert.deepEqual(tab.troubles, []);
});

test("raw frames without depth and truth are decoded as process does it, also with another key of decoding", async () => {
  const { out } = recorded(raw_only);
  const tab = await shown((await view([out, "--camera", "pico-flexx"])).url);
  const { page } = tab;
  await stand_at(tab, 1);
  const processed = (...more) => {
    const to = mkdtempSync(join(folder, "processed-"));
    told(["process", join(out, "frame_0001.npz"), "--camera", "pico-flexx", ...more, "--emit", "npz", "--quiet", "-o", to]);
    return read_npz(join(to, "frame.npz"));
  };
  const before = processed();
  assert.ok(arrived(tab).z_m.equals(bytes_of(before.z_m)));
  assert.ok(arrived(tab).flags.equals(bytes_of(before.flags)));
  await page.locator("[data-note=files]").getByText("Their raw frames are decoded here").waitFor();
  const keys = tab.texts.findLast((one) => one.type === "controls").controls.filter((row) => row.settable !== false).map((row) => row.key);
  assert.ok(keys.length > 3);
  assert.deepEqual(keys.filter((key) => !key.startsWith("camera.")), [], "keys of a scene");
  await (await find(tab, "camera.decoding.filter.kind")).getByRole("combobox").selectOption("median");
  await page.locator('[data-changed="camera.decoding.filter.kind"] .now').getByText("median", { exact: true }).waitFor();
  await settled(tab);
  const after = processed("--set", "camera.decoding.filter.kind=median");
  assert.ok(!bytes_of(after.z_m).equals(bytes_of(before.z_m)));
  assert.ok(arrived(tab).z_m.equals(bytes_of(after.z_m)));
  await page.getByRole("button", { name: "Undo" }).first().click();
  await page.locator("[data-changed]").waitFor({ state: "detached" });
  await settled(tab);
  assert.ok(arrived(tab).z_m.equals(bytes_of(before.z_m)));
  // A pixel's chain is there, its truth is not.
  await beside(tab, "Pixel");
  await point_at(tab, 112, 86);
  await page.locator('.answer[data-pixel="112,86"] [data-phasor]').first().waitFor();
  assert.equal(await page.locator(".answer .object").count(), 0);
  assert.equal(await page.locator("[data-value=z_m]").textContent(), `${before.z_m.values[86 * width + 112].toPrecision(6)}\u00a0m`);
  assert.equal(await page.getByRole("button", { name: "Why wrong?" }).isDisabled(), true);
  // A | B: another decoding of the same raw frames.
  await page.getByRole("button", { name: "A | B", exact: true }).click();
  await drawn(tab, "a");
  await settled(tab);
  assert.ok(arrived(tab, "b").z_m.equals(bytes_of(before.z_m)));
  // And the recording beside a simulation, which has keys of its own.
  await beside(tab, "A | B");
  await page.locator("#other-scene").fill("demo");
  await page.locator("#other-scene").press("Enter");
  await page.waitForFunction(() => document.querySelector(".differences")?.textContent.includes("demo"));
  await settled(tab);
  const simulated = (...more) => bytes_of(rendered(["demo", ...more], 1).z_m);
  assert.ok(arrived(tab, "b").z_m.equals(simulated()));
  assert.ok(arrived(tab).z_m.equals(bytes_of(before.z_m)));
  await beside(tab, "Controls");
  await set(tab, "camera.lens.f_number", "2.8");
  assert.ok(arrived(tab, "b").z_m.equals(simulated("--set", "camera.lens.f_number=2.8")));
  assert.ok(arrived(tab).z_m.equals(bytes_of(before.z_m)));
  assert.deepEqual(tab.troubles, []);
});

test("axe-core finds nothing with files, dark and light; at 320 CSS pixels nothing has to be scrolled sideways", async () => {
  const { out } = recorded("z_m,amplitude_e");
  const tab = await shown((await view([out])).url, { viewport: { width: 320, height: 640 }, reducedMotion: "reduce" });
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator("[data-note=files] summary").click();
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320);
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.evaluate(axe_source);
  for (const colorScheme of ["dark", "light"]) {
    await page.emulateMedia({ colorScheme });
    assert.deepEqual(await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ["violations"] })).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.html)}`)), [], colorScheme);
  }
});
