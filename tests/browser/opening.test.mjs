// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The page opens by its address alone, keeps the key to itself, and shows names of others as text. All of these tests run with --disable-gpu.

import assert from "node:assert/strict";
import { beside, open, point_at, proxy, shown, stand_at, test, view, written } from "./viewer.mjs";

test("the address that the command prints opens the page with its first picture, and nothing is reported", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const { page, troubles } = await shown(url);
  assert.deepEqual(troubles, []);
  assert.deepEqual(await page.evaluate(() => window.violations), []);
  assert.equal(await page.title(), "demo – tofray view");
  assert.equal(await page.getByRole("heading", { level: 1 }).textContent(), "tofray view: demo");
  assert.equal(await page.evaluate(() => new Set(window.tofray.pane(0).pixels).size > 50), true, "the picture is of few colours");
});

test("the key leaves the address and stands in no line of a request, nor in a referrer", async () => {
  const line = await proxy();
  const { url, port } = await view(["demo", "--seed", "5", "--allow-host", `127.0.0.1:${line.port}`]);
  line.lead_to(port);
  const key = new URL(url).hash.slice(3);
  assert.match(key, /^[0-9a-f]{64}$/);
  const tab = await shown(`http://127.0.0.1:${line.port}/#t=${key}`);
  assert.equal(tab.page.url(), `http://127.0.0.1:${line.port}/`);
  await tab.page.reload();
  await tab.page.waitForFunction(() => window.tofray?.counters.drawn > 0);   // the tab has it

  const lines = line.sent.join("\r\n").split("\r\n");
  const requests = lines.filter((one) => / HTTP\/1\.1$/.test(one));
  assert.ok(requests.filter((one) => one === "GET /ws HTTP/1.1").length >= 2, requests.join("\n"));
  const with_key = lines.filter((one) => one.includes(key));
  assert.ok(with_key.length >= 2);
  for (const one of with_key) assert.match(one, /^Sec-WebSocket-Protocol: /);
});

test("a tab without the key is told what it lacks, and opens no socket", async () => {
  const { url } = await view(["demo", "--seed", "5"]);
  const tab = await open(url.split("#")[0]);
  await tab.page.getByRole("alert").getByText("The address has no key.").waitFor();
  assert.equal(tab.sockets, 0);
});

/** What the server says, with other words in its greetings and states. */
const greeting = (words) => (page) => page.routeWebSocket(/\/ws$/, (near) => {
  const far = near.connectToServer();
  far.onMessage((message) => {
    const has_names = typeof message === "string" && /^\{"type":"(hello|state)"/.test(message);
    near.send(has_names ? JSON.stringify({ ...JSON.parse(message), ...words }) : message);
  });
});

const markup = '<img src=x onerror=document.title="taken">';
const backward = "\u202Ecod.exe\u2066";
const long = "n".repeat(1000);
const with_nul = "before\u0000after <b>bold</b>";

test("names of a scene and of objects are shown as text, whatever is in them", async () => {
  const plane = (name, x) =>
    `  - box: {name: ${JSON.stringify(name)}, min: [${x}, -2, 1], max: [${x + 0.2}, 2, 1.1], reflectivity: 0.5}`;
  const scene = written(`${markup}.yaml`, [
    "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", "objects:",
    plane(markup, -0.4), plane(backward, -0.2), plane(long, 0), plane(with_nul, 0.2), "",
  ].join("\n"));
  const { url } = await view([scene, "--seed", "5"]);
  const tab = await shown(url, { before: greeting({ scene: markup, camera: backward + markup, mode: markup }) });   // (the server has cleaned these)
  await stand_at(tab, 0);
  await beside(tab, "Pixel");
  assert.equal(await tab.page.locator("h1 bdi").textContent(), markup);
  assert.deepEqual(await tab.page.locator(".camera bdi").allTextContents(), [backward + markup, markup]);
  assert.equal(await tab.page.title(), `${markup} – tofray view`);
  assert.ok((await tab.page.locator(".command code").textContent()).includes(markup));
  for (const [u, name] of [[50, markup], [90, backward], [132, long], [175, with_nul]]) {
    await point_at(tab, u, 86);
    await tab.page.locator(`.answer[data-pixel="${u},86"] .object bdi`).waitFor();
    assert.equal(await tab.page.locator(".object bdi").textContent(), name);
  }
  assert.equal(await tab.page.locator("img").count(), 1, "the page's own icon is its only picture");
  assert.equal(await tab.page.locator("b").count(), 0);
  assert.deepEqual(tab.requests.filter((one) => new URL(one).pathname === "/x"), []);
  assert.deepEqual(tab.troubles, []);
  assert.equal(await tab.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true, "a long name widens the page");
});
