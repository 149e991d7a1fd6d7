// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A long time of server and page, of which neither may grow: frames as fast as they are drawn, a key set ten times a second, side B opened and
// closed, a tab that comes and goes each few seconds. Not among the tests: it takes as long as it is told, an hour unless it is told.
//   TOFRAY=… TOFRAY_PAGE_PACKAGES=… node tests/browser/soak.mjs [SECONDS]

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { bare_browser } from "./bare.mjs";
import { test, view } from "./viewer.mjs";

const seconds = Number(process.argv[2] ?? 3600);
const samples = Math.min(1200, Math.max(60, Math.round(seconds)));

/** By how much a line through what was measured may grow from the end of the first quarter, in which caches fill, to the end. */
const most_growth = { "server, MB": 8, "page's heap, MB": 4, "page's process, MB": 64, "server's files": 2, "page's nodes": 200 };

const pause_ms = (ms) => new Promise((then) => setTimeout(then, ms));

/** The resident memory of a process, in MB. */
const resident_mb = (pid) => Number(/^VmRSS:\s+(\d+) kB$/m.exec(readFileSync(`/proc/${pid}/status`, "latin1"))[1]) / 1024;

/** The process in which a page of a browser lives: of its children the one of that type that has most memory. */
function renderer_of(pid) {
  const children = (of) => readFileSync(`/proc/${of}/task/${of}/children`, "latin1").split(" ").filter((one) => one !== "").map(Number);
  const all = [];
  for (const waiting = [pid]; waiting.length > 0;) {
    const one = waiting.pop();
    all.push(one);
    try { waiting.push(...children(one)); } catch { /* it has ended */ }
  }
  const is_renderer = (one) => { try { return readFileSync(`/proc/${one}/cmdline`, "latin1").includes("--type=renderer"); } catch { return false; } };
  return all.filter(is_renderer).sort((a, b) => resident_mb(b) - resident_mb(a))[0];
}

/** The slope of the line through points, by least squares. */
function slope_of(points) {
  const mean = (of) => points.reduce((sum, one) => sum + of(one), 0) / points.length;
  const [x, y] = [mean((one) => one[0]), mean((one) => one[1])];
  return points.reduce((sum, one) => sum + (one[0] - x) * (one[1] - y), 0) / points.reduce((sum, one) => sum + (one[0] - x) ** 2, 0);
}

/** Somebody at the page who never rests: runs in the page. */
function restless() {
  let i = 0;
  const click = (found) => found?.click();
  const button = (name) => [...document.querySelectorAll("button")].find((one) => one.textContent.trim() === name || one.ariaLabel === name);
  setInterval(() => {
    ++i;
    const slider = document.querySelector('.control[data-key="camera.lens.f_number"] input[type=range]');
    if (slider !== null) {
      slider.value = String(Math.round(Number(slider.max) * (0.3 + 0.4 * ((i * 0.618) % 1))));
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    }
    if (i % 100 === 50) click(button("A | B"));
    if (i % 70 === 35) click(button("Histogram"));
    const stage = document.querySelector(".stage")?.getBoundingClientRect();
    if (stage !== undefined) document.querySelector(".stage").dispatchEvent(new PointerEvent("pointermove", { bubbles: true, clientX: stage.left + stage.width * ((i * 0.37) % 1), clientY: stage.top + stage.height * ((i * 0.71) % 1) }));
  }, 100);
}

test(`${seconds} s: neither server nor page grow, frames come, and nobody complains`, async () => {
  const viewer = await view(["demo", "--rate", "max"]);
  const browser = await bare_browser();
  const page = await browser.page(viewer.url);
  await page.evaluate(() => {
    const put = (element, value, event) => ((element.value = value), element.dispatchEvent(new Event(event, { bubbles: true })));
    put(document.querySelector(".rate select"), "max", "change");
    put(document.querySelector("#search"), "camera.lens.f_number", "input");
  });
  await page.wait(() => document.querySelector('.control[data-key="camera.lens.f_number"] input[type=range]') !== null);
  await page.evaluate(restless);
  const renderer = renderer_of(browser.pid);

  let comes_and_goes = true;
  let visits = 0;
  const visitor = (async () => {
    while (comes_and_goes) {
      const tab = await browser.page(viewer.url);
      await pause_ms(1000);
      assert.deepEqual(tab.troubles, [], "a tab that comes and goes");
      await tab.close();
      ++visits;
      await pause_ms(1000);
    }
  })();

  const measured = Object.fromEntries(Object.keys(most_growth).map((name) => [name, []]));
  let drawn = 0;
  const from = performance.now();
  for (let i = 0; i < samples; ++i) {
    await pause_ms(from + 1000 * seconds * (i + 1) / samples - performance.now());
    await page.send("HeapProfiler.collectGarbage");
    const { usedSize } = await page.send("Runtime.getHeapUsage");
    const of = await page.evaluate(() => window.tofray.counters);
    const { nodes } = await page.send("Memory.getDOMCounters");
    const now = {
      "server, MB": resident_mb(viewer.pid), "page's heap, MB": usedSize / 2 ** 20, "page's process, MB": resident_mb(renderer),
      "server's files": readdirSync(`/proc/${viewer.pid}/fd`).length, "page's nodes": nodes,
    };
    for (const [name, value] of Object.entries(now)) measured[name].push([(performance.now() - from) / 1000, value]);
    if (i % 10 === 9) assert.ok(of.drawn > drawn, "no more frames are drawn");
    if (i % 10 === 9) drawn = of.drawn;
    assert.deepEqual(page.troubles, []);
  }
  comes_and_goes = false;
  await visitor;
  await browser.close();

  console.log(`${drawn} frames drawn, ${(drawn / seconds).toFixed(1)} a second; ${visits} tabs came and went`);
  const grown = [];
  for (const [name, points] of Object.entries(measured)) {
    const later = points.slice(Math.floor(samples / 4));
    const slope = slope_of(later);
    const growth = slope * (later.at(-1)[0] - later[0][0]);
    console.log(`${name}: ${later[0][1].toFixed(1)} to ${later.at(-1)[1].toFixed(1)}, slope ${(3600 * slope).toFixed(2)} an hour, ${growth.toFixed(2)} in all (${most_growth[name]} at most)`);
    if (growth > most_growth[name]) grown.push(name);
  }
  assert.deepEqual(grown, [], "these grow");
});
