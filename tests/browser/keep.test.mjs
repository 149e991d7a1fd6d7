// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What is taken along: frames with the bytes of `render`, and a picture that brings its state back.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readdirSync, readFileSync } from "node:fs";
import { delimiter, dirname, join } from "node:path";
import { arrived, bytes_of, folder, rendered, set, settled, shown, stand_at, test, told, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const f_number = "camera.lens.f_number";
const empty = () => mkdtempSync(join(folder, "kept-"));
const sha256 = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");

/** By keys alone: the window is opened, and its first field has the focus. */
async function open_window({ page }) {
  await page.locator(".stage").first().focus();
  await page.keyboard.press("r");
  await page.getByRole("dialog", { name: "Take along" }).waitFor();
  await page.waitForFunction(() => document.activeElement.id === "record-first");
}

async function saved(page, act) {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  const path = join(empty(), download.suggestedFilename());
  await download.saveAs(path);
  return path;
}

test("five frames, recorded by keys, have the SHA-256 of what render --first-frame writes, and the list says each", async () => {
  const out = empty();
  const { url } = await view([...words, "-o", out]);
  const tab = await shown(url);
  const { page } = tab;
  await stand_at(tab, 3);
  await set(tab, f_number, "2.8");
  await open_window(tab);
  assert.equal(await page.locator("#record-first").inputValue(), "3", "it begins with the frame that is seen");
  await page.keyboard.type("7");
  await page.keyboard.press("Tab");
  await page.keyboard.type("5");
  await page.keyboard.press("Enter");
  const list = page.locator("[data-recorded]");
  await list.waitFor();
  const rows = await list.locator("[data-file]").evaluateAll((all) => all.map((one) => [one.dataset.file, one.querySelector("code").textContent]));
  const made = join(out, readdirSync(out)[0]);
  assert.deepEqual(readdirSync(out).length, 1);
  assert.equal(await list.locator("p code").first().textContent(), await list.getAttribute("data-recorded"));
  assert.deepEqual(rows.map(([name]) => name).sort(), readdirSync(made).sort(), "not all files are listed");
  for (const [name, hash] of rows) assert.equal(sha256(join(made, name)), hash, name);

  const again = empty();
  told(["render", ...words, "--set", `${f_number}=2.8`, "--first-frame", "7", "--frames", "5", "--quiet", "-o", again]);
  const frames = rows.filter(([name]) => name.endsWith(".npz"));
  assert.equal(frames.length, 5);
  assert.deepEqual(rows.map(([name]) => name).sort(), readdirSync(again).sort());
  for (const [name, hash] of rows) if (name !== "manifest.json") assert.equal(sha256(join(again, name)), hash, `${name} of render`);

  // The command that it shows is copied, and makes them, too; so is the list, as sha256sum reads it.
  await list.getByRole("button", { name: "Copy command" }).click();
  const command = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(command, await page.locator("[aria-label='Command of these files']").textContent());
  const by_shell = empty();
  execFileSync("sh", ["-c", `${command} --quiet -o .`], { cwd: by_shell, env: { ...process.env, PATH: [dirname(process.env.TOFRAY), process.env.PATH].join(delimiter) } });
  await list.getByRole("button", { name: "Copy SHA-256 list" }).click();
  const checks = (await page.evaluate(() => navigator.clipboard.readText())).split("\n").filter((line) => line.endsWith(".npz"));
  assert.equal(checks.length, 5);
  execFileSync("sha256sum", ["--check", "--quiet"], { cwd: by_shell, input: `${checks.join("\n")}\n` });
  assert.deepEqual(tab.troubles, []);
});

test("a recording is stopped, and nothing is left of it; a number of frames that cannot be is not sent", async () => {
  const out = empty();
  const { url } = await view([...words, "-o", out]);
  const tab = await shown(url);
  const { page } = tab;
  await open_window(tab);
  await page.locator("#record-count").fill("5000");
  await page.getByRole("button", { name: "Record", exact: true }).click();
  await page.locator("#record progress").waitFor();
  await page.getByRole("button", { name: "Stop" }).click();
  await page.locator("#record [role=alert]").waitFor();
  assert.equal(await page.locator("#record progress").count(), 0);
  assert.deepEqual(readdirSync(out), []);
  assert.ok(tab.texts.filter((one) => one.type === "record").every((one) => one.files === undefined));
  // Fields that say nothing that can be done switch the button off.
  for (const text of ["0", "x", "-1", "20000", ""]) {
    await page.locator("#record-count").fill(text);
    assert.equal(await page.getByRole("button", { name: "Record", exact: true }).isDisabled(), true, text);
  }
  await page.locator("#record-count").fill("1");
  await page.getByRole("button", { name: "Record", exact: true }).click();
  await page.locator("[data-recorded]").waitFor();
  assert.equal(await page.locator("#record [role=alert]").count(), 0);
});

/** A file, dropped on the page from outside. */
async function drop({ page }, name, bytes) {
  const transfer = await page.evaluateHandle(([as, text]) => {
    const out = new DataTransfer();
    out.items.add(new File([Uint8Array.from(atob(text), (one) => one.charCodeAt(0))], as, { type: "image/png" }));
    return out;
  }, [name, bytes.toString("base64")]);
  await page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
}

test("a screenshot that is dropped on the page brings keys, seed and frame back, as a step that can be undone", async () => {
  const first = await shown((await view(words)).url);
  await stand_at(first, 6);
  await set(first, f_number, "2.8");
  await set(first, "camera.illumination.0.power", "300 mW");
  await first.page.getByRole("searchbox").fill("");
  await first.page.locator("#seed").fill("11");
  await first.page.locator("#seed").press("Enter");
  await first.page.waitForFunction(() => document.querySelector(".command code").textContent.includes("--seed 11"));
  await settled(first);
  await first.page.locator(".stage").first().focus();
  const path = await saved(first.page, () => first.page.keyboard.press("i"));
  assert.match(path, /demo_0006\.png$/);
  const png = readFileSync(path);
  assert.equal(png.subarray(1, 4).toString(), "PNG");

  const tab = await shown((await view(words)).url);
  const { page } = tab;
  await drop(tab, "talk.png", png);
  await page.locator("[data-note=restored]").getByText("The state of talk.png: frame 6, 2 changed keys.").waitFor();
  await page.waitForFunction(() => window.tofray.last?.frame === 6 && window.tofray.overrides.length === 2);
  await settled(tab);
  assert.deepEqual(await page.evaluate(() => window.tofray.overrides.map(({ key, text }) => [key, text])), [[f_number, "2.8"], ["camera.illumination.0.power", "300 mW"]]);
  assert.equal(await page.evaluate(() => window.tofray.playing), false);
  const wanted = arrived(first);
  for (const [name, bytes] of Object.entries(arrived(tab))) assert.ok(bytes.equals(wanted[name]), name);
  const file = rendered(["demo", "--seed", "11", "--set", `${f_number}=2.8`, "--set", "camera.illumination.0.power=300 mW"], 6);
  assert.ok(arrived(tab).z_m.equals(bytes_of(file.z_m)));
  await page.getByRole("button", { name: "Undo" }).first().click();
  await page.waitForFunction(() => window.tofray.overrides.length === 0);
  assert.match(await page.locator(".command code").textContent(), /--seed 5/);

  // Without a pointer: by the window.
  await open_window(tab);
  await page.locator("#screenshot input[type=file]").setInputFiles(path);
  await page.waitForFunction(() => window.tofray.overrides.length === 2);
  await page.getByRole("dialog").waitFor({ state: "hidden" });
});

test("a picture that has no state in it, is cut, or is of another scene says so, and changes nothing", async () => {
  const room = await shown((await view(["room", "--seed", "5"])).url);
  await stand_at(room, 0);
  await room.page.locator(".stage").first().focus();
  const of_room = readFileSync(await saved(room.page, () => room.page.keyboard.press("i")));
  const out = empty();
  told([...["render", "demo", "--seed", "5", "--quiet", "-o", out]]);
  const tab = await shown((await view(words)).url);
  const { page } = tab;
  const alert = page.getByRole("alert");
  for (const [name, bytes, said] of [
    ["plain.png", readFileSync(join(out, "preview.png")), /plain\.png brings no state back\..*it has no state of tofray in it/],
    ["cut.png", of_room.subarray(0, of_room.indexOf("iTXt") + 40), /cut\.png brings no state back\..*it ends within a part/],
    ["letter.png", Buffer.from("Dear Sir"), /letter\.png brings no state back\..*it is no PNG/],
    ["room.png", of_room, /room[\s\S]*tofray view room/],
  ]) {
    await drop(tab, name, bytes);
    await alert.getByText(name === "room.png" ? /room/ : name).first().waitFor();
    assert.match(await alert.textContent(), said, name);
    await alert.getByRole("button", { name: "Dismiss" }).click();
  }
  assert.deepEqual(await page.evaluate(() => window.tofray.overrides), []);
  assert.equal(tab.asked.filter((one) => one.type === "state").length, 0);
});
