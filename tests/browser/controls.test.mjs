// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Every key has its control; what is typed, dragged, chosen or switched is a `--set`, which can be undone, copied and saved. What the page
// then shows are the bytes that the command makes.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync } from "node:fs";
import { delimiter, dirname, join } from "node:path";
import { read_npz } from "./npz.mjs";
import { arrived, bytes_of, find, folder, pause, rendered, set, settled, shown, stand_at, test, told, type, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const f_number = "camera.lens.f_number";

const rows = JSON.parse(told(["list", "controls", "demo", "--json"])).controls;
const row_of = (key) => rows.find((row) => row.key === key);

const overrides = ({ page }) => page.evaluate(() => window.tofray.overrides.map(({ key, text }) => `${key}=${text}`));

async function start(options) {
  const { url } = await view(words);
  const tab = await shown(url, options);
  await stand_at(tab, 0);
  return tab;
}

/** What is drawn has the bytes that the command makes with these changes. */
function is_frame_of(tab, changes, frame = 0) {
  const file = rendered([...words, ...changes.flatMap((one) => ["--set", one])], frame);
  const got = arrived(tab);
  assert.ok(Object.keys(got).length >= 3);
  for (const [name, bytes] of Object.entries(got)) {
    if (file[name] !== undefined) assert.ok(bytes.equals(bytes_of(file[name])), `${changes}: ${name}`);
  }
}

test("every key of scene and camera has a control, which is made when its group is opened, and its sentence", async () => {
  const { page, troubles } = await start();
  assert.ok(rows.length > 100, `${rows.length} rows`);
  await page.locator(".group").first().waitFor();
  assert.equal(await page.locator(".control").count(), 0);
  await page.locator(".group > summary").evaluateAll((all) => all.forEach((one) => one.click()));
  await page.waitForFunction((count) => document.querySelectorAll(".control").length === count, rows.length);
  const said = await page.locator(".control").evaluateAll((all) => all.map((one) => ({
    key: one.dataset.key,
    controls: one.querySelectorAll("input:not([type=range]), select").length,
    slider: one.querySelector("input[type=range]") !== null,
    what: one.querySelector(".what").textContent,
    assumed: one.querySelector(".assumed") !== null,
  })));
  assert.deepEqual(said.map((one) => one.key).sort(), rows.map((one) => one.key).sort());
  for (const one of said) {
    const row = row_of(one.key);
    assert.equal(one.controls, 1, one.key);
    assert.equal(one.slider, row.slider !== undefined && row.value !== undefined && row.settable !== false, one.key);
    assert.ok(one.what.includes(row.what ?? ""), one.key);
    assert.equal(one.assumed, row.assumed === true, one.key);
  }
  assert.ok(said.some((one) => one.assumed), "nothing is marked as assumed");
  assert.deepEqual(troubles, []);
});

test("the search finds keys by the beginnings of their words, the nearest first, and by what is said of them", async () => {
  const { page } = await start();
  await page.locator(".stage").first().focus();
  await page.keyboard.press("/");
  await page.waitForFunction(() => document.activeElement?.id === "search");
  await page.keyboard.type("f num");
  const first = page.locator(".control").first();
  await first.waitFor();
  assert.equal(await first.getAttribute("data-key"), f_number);
  const search = page.getByRole("searchbox", { name: "Search the controls" });
  for (const [text, key] of [["ampl", "camera.decoding.amplitude_threshold"], ["left eye radius", "objects.5.sphere.radius"], ["lens.f_number", f_number], ["NUMBER f", f_number], ["sens width", "camera.sensor.width"]]) {
    await search.fill(text);
    await page.waitForFunction((wanted) => document.querySelector(".control")?.dataset.key === wanted, key);
  }
  await search.fill("qqq");
  await page.getByText("No key has “qqq”.").waitFor();
  assert.equal(await page.getByText("Did you mean").count(), 0);   // nothing is near
  for (const [typed, near, key] of [["ilumination power", "illumination power", "camera.illumination.0.power"], ["f_nubmer", "f number", f_number]]) {
    await search.fill(typed);
    await page.getByText("Did you mean").getByRole("button", { name: near, exact: true }).click();
    await page.waitForFunction((wanted) => document.querySelector(".control")?.dataset.key === wanted, key);
  }
  await search.press("Escape");
  await page.locator(".group").first().waitFor();
  assert.equal(await page.evaluate(() => document.activeElement?.id), "search");
  await search.press("Escape");   // nothing to take back: letters act again
  assert.ok(await page.evaluate(() => document.activeElement === document.body));
  await page.keyboard.press("?");
  await page.getByRole("dialog", { name: "Keys" }).waitFor();
  await page.keyboard.press("?");
});

test("a field takes a value with its unit; what it refuses is told beside it in the command's words, and the value in force stays", async () => {
  const tab = await start();
  const { page } = tab;
  const row = row_of("camera.integration_time");
  assert.equal(row.dimension, "time");
  await set(tab, row.key, "850 us");
  is_frame_of(tab, [`${row.key}=850 us`]);
  const control = await find(tab, row.key);
  const field = control.getByRole("textbox");
  for (const text of ["850", "850 banana", "banana"]) {
    await type(tab, row.key, text);
    const wrong = control.getByRole("alert");
    let fault = "";
    try {
      told(["render", ...words, "--set", `${row.key}=${text}`, "-o", join(folder, "none")], { stdio: ["ignore", "ignore", "pipe"] });
    } catch (error) {
      fault = error.stderr.toString();
    }
    const [first, ...more] = fault.trim().split("\n").map((line) => line.trim()).filter((line) => line !== "");
    await wrong.locator("strong").getByText(first, { exact: true }).waitFor();
    assert.equal((await wrong.locator("span").allTextContents()).join(" ").replace(/\s+/g, " ").trim(), more.join(" ").replace(/\s+/g, " ").trim());
    assert.equal(await field.getAttribute("aria-invalid"), "true");
    assert.deepEqual(await overrides(tab), [`${row.key}=850 us`]);
    assert.equal(await page.evaluate(() => window.tofray.steps.past), 1, "a refused change is a step");
  }
  await field.press("Escape");
  await page.waitForFunction((key) => document.querySelector(`.control[data-key="${key}"] [role=alert]`) === null, row.key);
  assert.equal(await field.inputValue(), "850 us");
  is_frame_of(tab, [`${row.key}=850 us`]);
});

test("a slider that is moved quickly ends at its last value; no frame comes before an older one; it is one step", async () => {
  const tab = await start();
  const { page } = tab;
  const slider = (await find(tab, f_number)).getByRole("slider");
  const box = await slider.boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + box.width / 2, y);
  await page.mouse.down();
  for (let i = 1; i <= 100; ++i) await page.mouse.move(box.x + box.width * (0.5 + 0.002 * i), y);
  const wanted = await (page.locator(`.control[data-key="${f_number}"]`).getByRole("textbox")).inputValue();
  await page.mouse.up();
  await page.waitForFunction((text) => window.tofray.overrides[0]?.text === text, wanted);
  await settled(tab);
  const sent = tab.asked.filter((one) => one.type === "set");
  assert.ok(sent.length >= 2 && sent.length <= 101, `${sent.length} changes were sent`);
  const last = `${f_number}=${sent.at(-1).text}`;
  assert.deepEqual(await overrides(tab), [last]);
  assert.equal(sent.at(-1).text, wanted);
  assert.ok(Number(wanted) > row_of(f_number).value);
  const { generations: { a: generations } } = tab;
  assert.deepEqual(generations, [...generations].sort((x, y) => x - y));
  assert.equal(generations.at(-1), tab.texts.filter((one) => one.type === "state").at(-1).generation);
  is_frame_of(tab, [last]);
  assert.equal(await page.evaluate(() => window.tofray.steps.past), 1);
  await page.getByRole("button", { name: "Undo" }).click();
  await page.waitForFunction(() => window.tofray.overrides.length === 0);
  await settled(tab);
  is_frame_of(tab, []);
});

/** Another value than the one in force, as one types it. */
function another(row) {
  if (row.kind === "switch") return row.text === "true" ? "false" : row.text === "false" ? "true" : undefined;
  if (row.kind === "choice") return row.choices.find((one) => one !== row.text);
  if (row.kind !== "number" && row.kind !== "integer") return undefined;
  const [low, high] = row.slider ?? [];
  if (low === undefined) return undefined;
  const value = row.kind === "integer" ? Math.round(row.value + 1) : Number((row.value === 0 ? low + 0.75 * (high - low) : row.value * 1.05).toPrecision(4));
  return value >= low && value <= high ? `${value}${(row.unit ?? "") === "" ? "" : ` ${row.unit}`}` : undefined;
}

test("twenty keys of all kinds: each control writes its --set, in order, and together they make the bytes of the command", async () => {
  const tab = await start();
  const { page } = tab;
  // What --set itself takes together with all before it; that the page says the same of the rest is the server's test.
  const chosen = [];
  const places = new Set();
  const takes = (one) => {
    try {
      told(["check", "demo", ...[...chosen, one].flatMap(({ row, text }) => ["--set", `${row.key}=${text}`])], { stdio: "ignore" });
      return true;
    } catch {
      return false;
    }
  };
  for (const row of rows) {
    const text = row.settable === false ? undefined : another(row);
    const place = `${row.group} ${row.kind}`;
    if (text === undefined || /width|height|profile|mode$/.test(row.key) || places.has(place) || chosen.length === 20) continue;
    if (!takes({ row, text })) continue;
    places.add(place);
    chosen.push({ row, text });
  }
  assert.equal(chosen.length, 20);
  for (const kind of ["number", "choice"]) assert.ok(chosen.some(({ row }) => row.kind === kind), kind);
  for (const { row, text } of chosen) {
    const control = await find(tab, row.key);
    if (row.kind === "choice") await control.getByRole("combobox").selectOption(text);
    else if (row.kind === "switch") await control.getByRole("checkbox").click();
    else await type(tab, row.key, text);
    await page.locator(`[data-changed="${row.key}"]`).waitFor();
  }
  await settled(tab);
  const changes = chosen.map(({ row, text }) => `${row.key}=${text}`);
  assert.deepEqual(await overrides(tab), changes);
  assert.equal(await page.locator(".changes h3").textContent(), "20 changed");
  is_frame_of(tab, changes);
  // One is taken back by its own button, then all of them.
  await page.locator(".changes").getByRole("button", { name: `Reset ${chosen[3].row.key}` }).click();
  await page.waitForFunction(() => window.tofray.overrides.length === 19);
  assert.deepEqual(await overrides(tab), changes.filter((_, i) => i !== 3));
  await page.getByRole("button", { name: "Reset all" }).click();
  await page.getByText("Nothing is changed.").waitFor();
  await settled(tab);
  is_frame_of(tab, []);
});

test("fifty steps back are the first bytes again, fifty forward the last", async () => {
  const tab = await start();
  const { page } = tab;
  const first = arrived(tab).z_m;
  const field = (await find(tab, f_number)).getByRole("textbox");
  for (let i = 1; i <= 50; ++i) {
    await field.fill(String(2 + i / 50));
    await field.press("Enter");
    await page.waitForFunction((count) => window.tofray.steps.past === count, i);
  }
  await settled(tab);
  const last = arrived(tab).z_m;
  assert.ok(!last.equals(first));
  const undo = page.getByRole("button", { name: "Undo" });
  await page.locator(".stage").first().focus();
  for (let i = 0; i < 49; ++i) await page.keyboard.press("Control+z");
  await undo.click();
  await page.waitForFunction(() => window.tofray.overrides.length === 0);
  await settled(tab);
  assert.equal(await undo.isDisabled(), true);
  assert.ok(arrived(tab).z_m.equals(first));
  await page.locator(".stage").first().focus();
  for (let i = 0; i < 25; ++i) await page.keyboard.press("Control+y");
  for (let i = 0; i < 25; ++i) await page.keyboard.press("Control+Shift+z");
  await page.waitForFunction(() => window.tofray.overrides[0]?.text === "3");
  await settled(tab);
  assert.ok(arrived(tab).z_m.equals(last));
  assert.deepEqual(await page.evaluate(() => window.tofray.steps), { past: 50, future: 0 });
  // In a field the keys are the field's own.
  await field.press("Control+z");
  assert.deepEqual(await overrides(tab), [`${f_number}=3`]);
});

test("the command that c copies, run by a shell, and the YAML that s saves both make the bytes shown", async () => {
  const tab = await start({ permissions: ["clipboard-read", "clipboard-write"] });
  const { page } = tab;
  await set(tab, f_number, "2.8");
  await page.getByRole("searchbox").fill("");
  await page.locator("#seed").fill("9");
  await page.locator("#seed").press("Enter");
  await page.waitForFunction(() => document.querySelector(".command code").textContent.includes("--seed 9"));
  await stand_at(tab, 4);
  await settled(tab);
  await page.locator(".stage").first().focus();
  await page.keyboard.press("c");
  await page.getByRole("button", { name: "Copied" }).waitFor();
  const command = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(command, await page.locator(".command code").textContent());
  const out = mkdtempSync(join(folder, "copied-"));
  const path = [dirname(process.env.TOFRAY), process.env.PATH].join(delimiter);
  execFileSync("sh", ["-c", `${command} --emit npz --quiet -o .`], { cwd: out, env: { ...process.env, PATH: path } });
  const same = (file, what) => {
    const got = arrived(tab);
    for (const name of ["z_m", "amplitude_e", "flags"]) assert.ok(got[name].equals(bytes_of(file[name])), `${what}: ${name}`);
  };
  same(read_npz(join(out, "frame_0004.npz")), command);

  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("s")]);
  assert.match(download.suggestedFilename(), /\.yaml$/);
  const scene = join(out, download.suggestedFilename());
  await download.saveAs(scene);
  assert.match(readFileSync(scene, "utf8"), /f_number/);
  told(["check", scene]);
  same(rendered([scene, "--seed", "9"], 4), scene);
});

test("a server that was started again by the same words gets the changes again, and undo takes them back", async () => {
  const first = await view(words);
  const tab = await shown(first.url);
  const { page } = tab;
  await stand_at(tab, 0);
  await set(tab, f_number, "2.8");
  await first.kill();
  await page.getByText("The server is gone.").waitFor();
  const second = await view(words, first.port);
  await page.goto(second.url);
  await page.getByText("the change of before was set again").waitFor();
  await page.waitForFunction(() => window.tofray.overrides.length === 1);
  assert.deepEqual(await overrides(tab), [`${f_number}=2.8`]);
  await page.locator(".notice").getByRole("button", { name: "Undo" }).click();
  await page.waitForFunction(() => window.tofray.overrides.length === 0);
  assert.equal(await page.locator(".notice").count(), 0);
});

test("what another page has changed is shown, and can be undone here", async () => {
  const { url } = await view(words);
  const [one, two] = [await shown(url), await shown(url)];
  await pause(one);
  await set(two, f_number, "2.8");
  await one.page.locator(`[data-changed="${f_number}"]`).waitFor();
  await one.page.getByRole("button", { name: "Undo" }).click();
  await two.page.getByText("Nothing is changed.").waitFor();
  assert.deepEqual(await overrides(two), []);
});

test("of a frame that takes long a draft comes first, marked as one; what stays has the bytes of the command", async () => {
  const slow = ["room", "--seed", "5", "--bounces", "7", "--subpixel", "5"];   // a second at least: the page draws the draft before it, however busy
  const { url } = await view(slow);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 0);
  await page.evaluate(() => {
    window.badges = new Set();
    new MutationObserver(() => document.querySelectorAll(".badge.draft").forEach((one) => window.badges.add(one.textContent))).observe(document.body, { childList: true, subtree: true });
  });
  await set(tab, f_number, "2.8");
  assert.deepEqual(await page.evaluate(() => [...window.badges]), ["draft"]);
  assert.equal(await page.locator(".badge.draft").count(), 0);
  const file = rendered([...slow, "--set", `${f_number}=2.8`]);
  for (const name of ["z_m", "amplitude_e"]) assert.ok(arrived(tab)[name].equals(bytes_of(file[name])), name);
});
