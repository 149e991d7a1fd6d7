// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The viewer in a browser: the real program on a port that is free, its page in Chromium without a GPU, and without WebGL unless
// a test asks for it. Nothing here is of the page's own code.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { accessSync, constants, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { delimiter, join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { after, test as node_test } from "node:test";
import { read_npz } from "./npz.mjs";

/** Ends this program as a test that was left out. */
function skip(sentence) {
  console.log(`SKIPPED: ${sentence}`);
  process.exit(77);
}

function is_program(path) {
  try {
    accessSync(path, constants.X_OK);
    return true;
  } catch {
    return false;
  }
}

/** The tofray under test, and the folder whose node_modules came with its page. */
const { TOFRAY: tofray, TOFRAY_PAGE_PACKAGES: packages } = process.env;
if (tofray === undefined || packages === undefined) throw new Error("TOFRAY and TOFRAY_PAGE_PACKAGES say what is tested: ctest -L browser sets both");
export const chromium = (process.env.PATH ?? "").split(delimiter).flatMap((folder) => ["chromium", "chromium-browser"].map((name) => join(folder, name))).find(is_program);
if (chromium === undefined) skip("there is no chromium here, in which the viewer's page is looked at (Debian: chromium)");
const require = createRequire(resolve(packages, "package.json"));
export const axe_source = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

const folder = mkdtempSync(join(tmpdir(), "tofray-browser-"));
const running = new Set();
// What Playwright switches off, whose list this one replaces, and the pages that Chromium makes for its address bar beside each of ours.
const features_off = [
  "AvoidUnnecessaryBeforeUnloadCheckSync", "BoundaryEventDispatchTracksNodeRemoval", "DestroyProfileOnBrowserClose", "DialMediaRouteProvider", "GlobalMediaControls",
  "HttpsUpgrades", "LensOverlay", "MediaRouter", "PaintHolding", "ThirdPartyStoragePartitioning", "Translate", "AutoDeElevate", "RenderDocument", "OptimizationHints",
  "WebUIOmniboxPopup", "WebUIOmniboxAimPopup",
];
const launch = (args) => require("playwright-core").chromium.launch({
  executablePath: chromium,
  args: ["--no-sandbox", "--disable-dev-shm-usage", "--force-device-scale-factor=1", `--disable-features=${features_off}`, ...args],
});
const browsers = {};   // launched when they are needed first; with WebGL the processor draws
const browser = () => (browsers.without ??= launch(["--disable-gpu", "--disable-software-rasterizer"]));
const browser_with_webgl = () => (browsers.with ??= launch(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]));
after(async () => {
  for (const one of Object.values(browsers)) await (await one).close();
  for (const one of running) one.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
});

let of_test;   // what is to be done when the test that runs has ended

/** A test by node, after which its tabs and viewers are gone: they would go on playing beside the next ones. */
export function test(name, run) {
  return node_test(name, async (t) => {
    of_test = [];
    try {
      await run(t);
    } finally {
      await Promise.all(of_test.map((end) => end()));
      of_test = undefined;
    }
  });
}

/** A file for a test. @return its path */
export function written(name, text) {
  const path = join(folder, name);
  writeFileSync(path, text);
  return path;
}

/** What the command makes of the same words: the arrays of a frame, and the file that `inspect` reads. */
export function rendered(words, frame = 0) {
  const out = mkdtempSync(join(folder, "frame-"));
  execFileSync(tofray, ["render", ...words, "--first-frame", String(frame), "--emit", "npz", "--quiet", "-o", out]);
  const path = join(out, frame === 0 ? "frame.npz" : `frame_${String(frame).padStart(4, "0")}.npz`);
  return { path, ...read_npz(path) };
}

/** Runs the command itself. @return  what it writes to its output */
export function told(words, options = {}) {
  return execFileSync(tofray, words, { encoding: "utf8", ...options });
}

export { folder };

export function inspected(path, u, v) {
  return JSON.parse(execFileSync(tofray, ["inspect", path, "--pixel", `${u},${v}`, "--json"], { encoding: "utf8" }));
}

/** `tofray view`, until the tests end. @param port  0: any */
export async function view(words, port = 0, options = {}) {
  const child = spawn(tofray, ["view", ...words, "--port", String(port), "--json", "--test-hooks"], { ...options, stdio: ["ignore", "pipe", "inherit"] });
  running.add(child);
  const gone = new Promise((resolve) => child.on("exit", resolve));
  const kill = async () => {
    child.kill("SIGKILL");
    await gone;
    running.delete(child);
  };
  of_test?.push(kill);
  for await (const line of createInterface({ input: child.stdout })) {
    return { ...JSON.parse(line), kill };
  }
  throw new Error("tofray view said no address");
}

/** What goes through it is passed on, and kept: what the page's side has sent. @return {port, sent, cut} */
export async function proxy() {
  const lines = new Set();
  const sent = [];
  let target = 0;
  const server = createServer((near) => {
    const far = connect(target, "127.0.0.1");
    for (const one of [near, far]) {
      lines.add(one);
      one.on("error", () => undefined);
      one.on("close", () => (near.destroy(), far.destroy(), lines.delete(one)));
    }
    near.on("data", (bytes) => sent.push(bytes.toString("latin1")));
    near.pipe(far).pipe(near);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  server.unref();
  return {
    port: server.address().port,
    sent,
    lead_to: (port) => (target = port),
    cut: () => lines.forEach((one) => one.destroy()),
  };
}

/** Waits for something that this program has seen, as the page's own functions wait. */
export async function until(come, what) {
  for (const end = performance.now() + 30_000; !come();) {
    if (performance.now() > end) throw new Error(`waited 30 s for ${what}`);
    await new Promise((again) => setTimeout(again, 20));
  }
}

/** A tab of its own, without an earlier one's storage. @param before  what to do with the page first
 *  @param webgl   whether this browser has it
 *  @return  the page, and what has happened in it so far */
export async function open(url, { before, webgl = false, ...options } = {}) {
  const context = await (webgl ? await browser_with_webgl() : await browser()).newContext({ viewport: { width: 1280, height: 900 }, permissions: ["clipboard-read", "clipboard-write"], ...options });
  of_test?.push(() => context.close());
  const page = await context.newPage();
  await before?.(page);
  const seen = { page, texts: [], arrays: [], talk: [], frames: [], last: {}, generations: { a: [], b: [] }, asked: [], troubles: [], sockets: 0, requests: [], loads: 0 };
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && seen.troubles.push(message.text()));
  page.on("pageerror", (error) => seen.troubles.push(String(error)));
  page.on("request", (request) => seen.requests.push(request.url()));
  page.on("load", () => ++seen.loads);
  page.on("websocket", (socket) => {
    ++seen.sockets;
    socket.on("framereceived", ({ payload }) => {
      if (typeof payload === "string") {
        const text = JSON.parse(payload);
        seen.talk.push(`server ${text.type}`);
        return void seen.texts.push(text);
      }
      if (payload[6] >= 2) return void seen.arrays.push(payload);
      const side = payload[6] === 1 ? "b" : "a";
      seen.last[side] = payload;
      seen.generations[side].push(payload.readUInt32LE(8));
      if (side === "a") seen.frames.push(Number(payload.readBigUInt64LE(16)));
    });
    socket.on("framesent", ({ payload }) => {
      if (typeof payload !== "string") return;
      const text = JSON.parse(payload);
      seen.talk.push(`page ${text.type}`);
      seen.asked.push(text);
    });
  });
  await page.addInitScript(() => {
    window.violations = [];
    window.packed = (bytes) => {
      let text = "";
      for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
      return btoa(text);
    };
    window.alerts = [];   // their titles, in turn, however short they were to be seen
    new MutationObserver((changes) => changes.flatMap((one) => [...one.addedNodes])
      .forEach((one) => one.role === "alert" && window.alerts.push(one.querySelector("strong").textContent))).observe(document, { childList: true, subtree: true });
    document.addEventListener("securitypolicyviolation", (event) => window.violations.push(`${event.violatedDirective}: ${event.blockedURI}`));
  });
  await page.goto(url);
  seen.hello = () => seen.texts.findLast((one) => one.type === "hello");
  return seen;
}

/** For `before`: what comes between the page and its server. @param asked  by type: answers a question in the server's place; undefined: the
 *  server does. @param told  by type: changes what the server says */
export function between({ asked = {}, told: said = {} }) {
  return (page) => page.routeWebSocket(/./, (near) => {
    const far = near.connectToServer();
    near.onMessage((text) => {
      const message = JSON.parse(text);
      const answer = asked[message.type]?.(message);
      if (answer === undefined) return far.send(text);
      for (const one of [answer].flat()) near.send(JSON.stringify(one));
    });
    far.onMessage((text) => {
      if (typeof text !== "string") return near.send(text);
      const message = JSON.parse(text);
      near.send(said[message.type] === undefined ? text : JSON.stringify(said[message.type](message)));
    });
  });
}

/** A tab with a picture in it. */
export async function shown(url, options) {
  const tab = await open(url, options);
  await tab.page.waitForFunction(() => window.tofray?.counters.drawn > 0);
  return tab;
}

export async function pause({ page }) {
  if (await page.evaluate(() => window.tofray.playing)) await page.getByRole("button", { name: "Pause" }).click();
  await page.waitForFunction(() => window.tofray.playing === false);
}

/** Stands still at a frame, drawn. */
export async function stand_at(tab, frame) {
  await pause(tab);
  await tab.page.locator("#frame").fill(String(frame));
  await tab.page.locator("#frame").press("Enter");
  await tab.page.waitForFunction((to) => window.tofray.last?.frame === to, frame);
}

/** A pane as coloured: {array, width, height, pixels: RGBA}.
 *  @param side       b: the picture of B beside that of A
 *  @param raw_frame  of a sheet of raw frames the one of this number */
export async function pane({ page }, i, side = "a", raw_frame = undefined) {
  const { pixels, ...rest } = await page.evaluate(([at, of, number]) => {
    const one = window.tofray.pane(at, of, number);
    return { ...one, pixels: window.packed(one.pixels) };
  }, [i, side, raw_frame]);
  return { ...rest, pixels: unpacked(pixels) };
}

/** Numbers come out of the page as one text: a hundred times as quick as a list. */
const unpacked = (text) => Array.from(Buffer.from(text, "base64"));

/** The middle of each of a picture's pixels, read from the canvas on the screen: RGBA. */
export async function canvas_pixels({ page }, i, side = "a") {
  return unpacked(await page.evaluate(([at, of]) => {
    const { left, top, scale } = window.tofray.placement(at, of);
    const { width, height } = window.tofray.pane(at, of);
    const canvas = document.querySelectorAll(".pane")[at].querySelectorAll(".stage canvas.front")[of === "a" ? 0 : 1];
    const all = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const out = new Uint8Array(4 * width * height);
    for (let v = 0; v < height; ++v)
      for (let u = 0; u < width; ++u) {
        const place = 4 * (Math.floor(top + (v + 0.5) * scale) * canvas.width + Math.floor(left + (u + 0.5) * scale));
        out.set(all.data.subarray(place, place + 4), 4 * (v * width + u));
      }
    return window.packed(out);
  }, [i, side]));
}

/** The first pixel of two pictures that differs: an assertion over 150,000 numbers says nothing that could be read. */
export function same(got, wanted, what) {
  assert.equal(got.length, wanted.length, what);
  for (let i = 0; i < got.length; ++i) {
    const at = i - (i % 4);
    if (got[i] !== wanted[i]) assert.fail(`${what}: pixel ${at / 4} is ${got.slice(at, at + 4)}, expected ${wanted.slice(at, at + 4)}`);
  }
}

/** Puts the pointer into a pixel of the first pane. */
export async function point_at({ page }, u, v) {
  const { left, top, scale } = await page.evaluate(() => window.tofray.placement(0));
  const box = await page.locator(".stage").first().boundingBox();
  await page.mouse.move(box.x + left + (u + 0.5) * scale, box.y + top + (v + 0.5) * scale);
}

/** What stands beside the pictures: Controls, Pixel or A | B. */
export async function beside({ page }, name) {
  await page.getByRole("tab", { name, exact: true }).click();
  await page.locator(`[role=tab][aria-selected=true]`).getByText(name, { exact: true }).waitFor();
}

/** All changes are answered, and what is drawn is of the last one. */
export async function settled({ page }) {
  await page.waitForFunction(() => {
    const { unanswered, generation, generation_b, last, last_b } = window.tofray;
    return unanswered === 0 && last?.generation === generation && last_b?.generation === generation_b && !last.draft && last_b?.draft !== true;
  });
}

/** The bytes of the arrays of the frame that came last, by name. */
export function arrived({ last, hello }, side = "a") {
  const message = last[side];
  return Object.fromEntries(Array.from({ length: message.readUInt16LE(44) }, (_, i) => {
    const at = message.readUInt16LE(4) + 32 * i;
    const place = message.readUInt32LE(at + 4);
    return [hello().arrays[message.readUInt16LE(at)].name, message.subarray(place, place + message.readUInt32LE(at + 8))];
  }));
}

/** The arrays of an answer that says it has some, by name: {shape, values}. */
export function answered_arrays({ arrays }, { id, arrays: names }) {
  const message = arrays.findLast((one) => one.readUInt32LE(12) === id);
  const types = [undefined, Uint8Array, Uint16Array, Int16Array, Uint32Array, Float32Array, Int32Array, Float64Array];
  return Object.fromEntries(names.map((name, i) => {
    const at = message.readUInt16LE(4) + 32 * i;
    const [place, bytes] = [message.readUInt32LE(at + 4), message.readUInt32LE(at + 8)];
    const shape = [12, 16, 20].slice(0, message[at + 3]).map((k) => message.readUInt32LE(at + k));
    const copy = new Uint8Array(message.subarray(place, place + bytes));
    return [name, { shape, values: new types[message[at + 2]](copy.buffer) }];
  }));
}

/** Of arrays as a file has them. */
export function bytes_of({ values }) {
  return Buffer.from(values.buffer, values.byteOffset, values.byteLength);
}

/** What has changed on the page is drawn. @param shows  what the first picture is of: a, b, wipe or difference */
export async function drawn({ page }, shows) {
  await page.waitForFunction((of) => window.tofray.pane(0).shows === of, shows);
  await page.evaluate(() => new Promise((then) => requestAnimationFrame(() => requestAnimationFrame(then))));
}

/** The control of a key, by the search. */
export async function find({ page }, key) {
  await page.getByRole("searchbox", { name: "Search the controls" }).fill(key);
  const control = page.locator(`.control[data-key="${key}"]`);
  await control.waitFor();
  return control;
}

/** Types a value into a key's field. */
export async function type(tab, key, text) {
  const field = (await find(tab, key)).getByRole("textbox");
  await field.fill(text);
  await field.press("Enter");
  return field;
}

/** Types a value into a field, and waits until it is drawn. */
export async function set(tab, key, text) {
  await type(tab, key, text);
  await tab.page.locator(`[data-changed="${key}"] .now`).getByText(text, { exact: true }).waitFor();
  await settled(tab);
}

export async function choose(tab, i, array) {
  await tab.page.locator(".pane select.shows").nth(i).selectOption(array);
  await tab.page.waitForFunction(([at, name]) => window.tofray.pane(at)?.array === name, [i, array]);
}
