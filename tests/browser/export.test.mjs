// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The page as one file: opened from a disk, without a network, it asks for nothing, and shows what the command writes.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync } from "node:fs";
import { delimiter, dirname, join } from "node:path";
import { inflateSync } from "node:zlib";
import { color, expected, scale_of } from "./colors.mjs";
import { axe_source, canvas_pixels, folder, open, pane, point_at, rendered, same, shown, test, told, view, written } from "./viewer.mjs";

const width = 224, height = 172;
const words = ["demo", "--seed", "5", "--set", "camera.lens.f_number=2.8"];
const first = 2, count = 3;

const made = join(mkdtempSync(join(folder, "page-")), "demo.html");
told(["view", ...words, "--first-frame", String(first), "--frames", String(count), "--export", made]);

const data = /(<script type="application\/json" id="tofray-export">)([\s\S]*?)(<\/script>)/;
const contents = (text) => JSON.parse(data.exec(text)[2]);

/** The page, with what tests read: data is told by no hash. */
function with_hooks(text) {
  const of = contents(text);
  return text.replace(data, (_, begin, __, end) => `${begin}${JSON.stringify({ ...of, hello: { ...of.hello, test_hooks: true } }).replaceAll("<", "\\u003c")}${end}`);
}

const text = readFileSync(made, "utf8");
const { hello, live } = contents(text);
const address = `file://${written("demo.html", with_hooks(text))}`;

async function opened(options) {
  const tab = await open(address, { offline: true, ...options });
  await tab.page.waitForFunction(() => window.tofray?.counters.drawn > 0);
  return tab;
}

const at_frame = ({ page }, frame) => page.waitForFunction((to) => window.tofray.last?.frame === to, frame);

test("from a disk and offline, panes have the colours of the arrays that the command writes, and nothing is asked for", async () => {
  const tab = await opened();
  const { page } = tab;
  assert.equal(await page.title(), "demo – tofray view");
  for (let frame = first; frame < first + count; ++frame) {
    const { arrays = undefined, ...file } = rendered(words, frame);
    await at_frame(tab, frame);
    const wanted = expected(hello, scale_of(hello, "z_m"), [...file.z_m.values], file.flags.values);
    same((await pane(tab, 0)).pixels, wanted, `depth of frame ${frame}`);
    same(await canvas_pixels(tab, 0), wanted, `depth of frame ${frame} on the screen`);
    same((await pane(tab, 1)).pixels, expected(hello, scale_of(hello, "amplitude_e"), [...file.amplitude_e.values], file.flags.values), `amplitude of frame ${frame}`);
    assert.match(await page.locator(".command code").textContent(), new RegExp(`--first-frame ${frame}$`));
    await page.locator(".stage").first().focus();
    await page.keyboard.press(".");
  }
  await at_frame(tab, first + count - 1);   // there is no further one
  await page.getByRole("slider", { name: "Frame" }).fill(String(first));
  await at_frame(tab, first);

  // Another pane, one raw frame, a histogram, points in space.
  const file = rendered(words, first);
  await page.locator(".pane select.shows").nth(1).selectOption("gt_reflectivity");
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "gt_reflectivity");
  same((await pane(tab, 1)).pixels, expected(hello, scale_of(hello, "gt_reflectivity"), [...file.gt_reflectivity.values], file.flags.values), "reflectivity");
  await page.getByRole("button", { name: "Histogram", exact: true }).first().click();
  const apart = await page.locator("[data-apart]").evaluateAll((all) => all.map((one) => Number(one.textContent)));
  assert.equal(apart.reduce((a, b) => a + b, 0), width * height);
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("t");
  await page.waitForFunction(() => window.tofray.pane(1, "a", 8) !== undefined);
  const bar = page.locator(".pane").nth(1).locator(".scale");
  const scale = { low: Number(await bar.getAttribute("data-low")), high: Number(await bar.getAttribute("data-high")), curve: "linear", palette: "grey" };
  same((await pane(tab, 1, "a", 3)).pixels, [...file.raw.values.slice(3 * width * height, 4 * width * height)].flatMap((one) => [...color(hello, scale, one), 255]), "raw frame 3");
  await page.keyboard.press("x");
  await page.waitForFunction(() => window.tofray.space(1, false)?.drawing === "processor");
  await page.waitForFunction(() => new Set(window.tofray.space(1).pixels).size > 40);   // points in the colours of depth

  assert.deepEqual(tab.requests, [address]);
  assert.equal(tab.sockets, 0);
  assert.deepEqual(tab.troubles.filter((one) => !/willReadFrequently/.test(one)), []);   // (this test reads canvases)
  assert.deepEqual(await page.evaluate(() => window.violations), []);
});

test("by WebGL, too, which comes out of the same file", async () => {
  const tab = await opened({ webgl: true });
  await tab.page.locator(".stage").nth(1).focus();
  await tab.page.keyboard.press("x");
  await tab.page.locator('.stage.space[data-drawing="WebGL"]').waitFor();
  await tab.page.locator(".object-choice option").nth(3).waitFor({ state: "attached" });
  assert.deepEqual(tab.requests, [address]);
  assert.deepEqual(tab.troubles.filter((one) => !/GPU stall|GL Driver Message/.test(one)), []);
});

test("a pixel has the values of the file that the command writes, in the bar and in the list; its frames pass by again and again", async () => {
  const tab = await opened();
  const { page } = tab;
  const file = rendered(words, first);
  await page.getByRole("tab", { name: "Pixel" }).click();
  for (const [u, v] of [[112, 86], [0, 0], [223, 171], [60, 150]]) {
    await point_at(tab, u, v);
    await page.locator(`.answer[data-pixel="${u},${v}"]`).waitFor();
    const i = v * width + u;
    for (const name of ["z_m", "amplitude_e", "noise_m", "gt_z_m", "gt_power_w"]) {
      const value = file[name].values[i];
      const cell = await page.locator(`[data-value=${name}]`).textContent();
      if (Number.isFinite(value)) assert.equal(Number(cell.split("\u00a0")[0].replace("\u2212", "-")), Number.isInteger(value) ? value : Number(value.toPrecision(6)), `${name} of ${u}, ${v}`);
      else assert.match(cell, /^invalid/);
    }
    const z = file.z_m.values[i];
    assert.match(await page.locator('[data-reading="z_m"]').textContent(), Number.isFinite(z) ? new RegExp(`^${z.toPrecision(6)}`) : /^invalid: /);
  }
  await page.locator("[data-no-chain]").getByText(live).waitFor();
  await page.getByRole("button", { name: "Play" }).click();
  const seen = new Set();
  for (const end = performance.now() + 20_000; seen.size < count && performance.now() < end;) seen.add(await page.evaluate(() => window.tofray.last.frame));
  await page.waitForFunction(() => window.tofray.counters.drawn > 6);   // more than there are
  assert.deepEqual([...seen].sort(), [2, 3, 4]);
  await page.getByRole("button", { name: "Pause" }).click();
  await page.waitForFunction(() => window.tofray.playing === false);
});

test("keys are shown and cannot be changed; what takes the program says so, with the command; the YAML is there", async () => {
  const tab = await opened();
  const { page } = tab;
  await page.locator("[data-note=file]").getByText("A file with 3 frames.").waitFor();
  assert.equal(await page.locator("[data-note=file] code").textContent(), live);
  assert.match(live, /^tofray view demo .*--set camera\.lens\.f_number=2\.8/);
  await page.locator("[data-fixed]").getByText(live).waitFor();
  await page.getByRole("searchbox").fill("camera.lens.f_number");
  const field = page.locator('.control[data-key="camera.lens.f_number"] input').first();
  assert.equal(await field.inputValue(), "2.8");
  assert.equal(await page.locator(".control input:enabled, .control select:enabled, .control button:enabled, .changes button.reset:enabled").count(), 0);
  for (const name of ["A | B", "Move", "Measure"]) assert.equal(await page.getByRole("group", { name: "Tools" }).or(page.locator("header")).getByRole("button", { name, exact: true }).first().isDisabled(), true, name);
  // By its key it is told, too.
  await page.locator(".stage").first().focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("a");
  await page.getByRole("alert").getByText("This page is a file").waitFor();
  assert.ok((await page.getByRole("alert").textContent()).includes(live));
  await page.getByRole("button", { name: "Dismiss" }).click();
  await page.keyboard.press("r");
  for (const part of ["record", "screenshot", "export"]) assert.ok((await page.locator(`#${part} .what`).textContent()).includes(live), part);
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("dialog").getByRole("button", { name: "Save YAML" }).click()]);
  const scene = join(mkdtempSync(join(folder, "yaml-")), download.suggestedFilename());
  await download.saveAs(scene);
  told(["check", scene]);
  const [saved, file] = [rendered([scene, "--seed", "5"], first), rendered(words, first)];
  assert.deepEqual(saved.z_m.values, file.z_m.values);
  await page.keyboard.press("Escape");
  // The licences of what is in it are in it.
  await page.getByRole("button", { name: "Help: keys" }).click();
  await page.locator("summary", { hasText: "Software of others" }).click();
  for (const one of ["three", "preact"]) await page.locator(".licences").getByText(one).first().waitFor();
  assert.deepEqual(tab.troubles, []);
});

test("axe-core finds nothing in it, dark and light, and at 320 CSS pixels nothing has to be scrolled sideways", async () => {
  const tab = await opened({ viewport: { width: 320, height: 640 }, reducedMotion: "reduce" });
  const { page } = tab;
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320);
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.evaluate(axe_source);
  await page.keyboard.press("Tab");
  for (const colorScheme of ["dark", "light"]) {
    await page.emulateMedia({ colorScheme });
    assert.deepEqual(await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ["violations"] })).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.html)}`)), [], colorScheme);
  }
});

test("the page that the window writes is that of the command it names", async () => {
  const out = mkdtempSync(join(folder, "export-"));
  const tab = await shown((await view([...words, "-o", out])).url);
  const { page } = tab;
  await page.getByRole("button", { name: "Take along …" }).click();
  await page.locator("#export-first").fill("1");
  await page.locator("#export-count").fill("2");
  await page.keyboard.press("Enter");
  await page.locator("[data-exported]").waitFor();
  const [name] = readdirSync(out);
  assert.equal(readdirSync(out).length, 1);
  assert.ok((await page.locator("[data-exported] code").first().textContent()).endsWith(name));
  const command = await page.locator("[aria-label='Command of this page']").textContent();
  const again = mkdtempSync(join(folder, "again-"));
  execFileSync("sh", ["-c", `${command} --quiet`], { cwd: again, env: { ...process.env, PATH: [dirname(process.env.TOFRAY), process.env.PATH].join(delimiter) } });
  const [file] = readdirSync(again);
  assert.ok(readFileSync(join(out, name)).equals(readFileSync(join(again, file))), `${name} is not ${file}`);
});

test("a page within a page that shuts it in works; one without frames, or with half of one, says what is wrong", async () => {
  const of = with_hooks(text);
  // As a notebook holds it: no origin, nothing kept.
  const holder = await open("about:blank", { offline: true });
  await holder.page.evaluate((html) => {
    const frame = document.createElement("iframe");
    frame.setAttribute("sandbox", "allow-scripts");
    frame.style = "width: 1200px; height: 800px";
    frame.srcdoc = html;
    document.body.append(frame);
  }, of);
  const inner = holder.page.frameLocator("iframe");
  await inner.getByText("A file with 3 frames.").waitFor();
  await inner.locator(".legend li").first().waitFor();
  await inner.getByRole("group", { name: "The same as a command" }).getByRole("button", { name: "Copy" }).click();
  await inner.getByText("This browser does not let the page copy.").waitFor();   // not to be copied, but to be read
  assert.deepEqual(holder.troubles, []);

  // Frames that were not packed.
  const unpacked = of.replace('"encoding":"deflate"', '"encoding":"base64"')
    .replace(/(<script type="application\/octet-stream"[^>]*>)([^<]*)(<\/script>)/g, (_, begin, block, end) => `${begin}${inflateSync(Buffer.from(block.trim(), "base64")).toString("base64")}${end}`);
  assert.notEqual(unpacked, of);
  const plain = await open(`file://${written("plain.html", unpacked)}`, { offline: true });
  await plain.page.waitForFunction(() => window.tofray?.counters.drawn > 0);
  same((await pane(plain, 0)).pixels, expected(hello, scale_of(hello, "z_m"), [...rendered(words, first).z_m.values], rendered(words, first).flags.values), "depth");

  const empty = await open(`file://${written("empty.html", of.replace(data, ""))}`, { offline: true });
  await empty.page.getByRole("alert").getByText("There is nothing to be seen in this file.").waitFor();
  const cut = of.replace(/(class="tofray-frame">[^<]{1000})[^<]*/, "$1");
  const half = await open(`file://${written("half.html", cut)}`, { offline: true });
  await half.page.getByRole("alert").getByText("Frame 2 of this file cannot be read.").waitFor();
});
