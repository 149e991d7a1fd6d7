// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A page in Chromium that nobody listens to: Playwright is sent a copy of every message of a page's WebSocket, which takes longer than to draw
// it. For what is measured, and for what runs for hours.

import { spawn } from "node:child_process";
import { mkdtempSync } from "node:fs";
import { join } from "node:path";
import { chromium, folder, until } from "./viewer.mjs";

const without_gpu = ["--disable-gpu", "--disable-software-rasterizer"];

/** Chromium, spoken to through a pipe (its DevTools protocol).
 *  @return {pid, page, close} */
export async function bare_browser(args = without_gpu) {
  const child = spawn(chromium, [
    "--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", "--force-device-scale-factor=1", "--window-size=1280,900",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions",
    `--user-data-dir=${mkdtempSync(join(folder, "profile-"))}`, ...args, "about:blank",
  ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const gone = new Promise((resolve) => child.on("exit", resolve));
  const answers = new Map();
  const listeners = new Map();   // by session
  let last = 0;
  let rest = "";
  child.stdio[4].setEncoding("utf8").on("data", (bytes) => {
    const parts = (rest + bytes).split("\0");
    rest = parts.pop();
    for (const message of parts.map((part) => JSON.parse(part))) {
      if (message.id === undefined) listeners.get(message.sessionId)?.(message);
      else if (message.error === undefined) answers.get(message.id)?.resolve(message.result);
      else answers.get(message.id)?.reject(new Error(message.error.message));
      answers.delete(message.id);
    }
  });
  const send = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
    answers.set(++last, { resolve, reject });
    child.stdio[3].write(`${JSON.stringify({ id: last, method, params, sessionId })}\0`);
  });

  /** A tab. @param before  runs in the page before its own scripts */
  const page = async (url, before = () => undefined) => {
    const { targetId } = await send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
    const troubles = [];
    listeners.set(sessionId, ({ method, params }) => {
      if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type)) troubles.push(params.args.map((one) => one.value ?? one.description).join(" "));
      if (method === "Runtime.exceptionThrown") troubles.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
      if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level)) troubles.push(params.entry.text);
    });
    const of = (method, params) => send(method, params, sessionId);
    for (const domain of ["Page", "Runtime", "Log"]) await of(`${domain}.enable`);
    await of("Page.addScriptToEvaluateOnNewDocument", { source: `(${before})()` });
    /** What a function of the page's returns, once it is there. */
    const evaluate = async (run, ...words) => {
      const { result, exceptionDetails } = await of("Runtime.evaluate", { expression: `(${run})(...${JSON.stringify(words)})`, awaitPromise: true, returnByValue: true });
      if (exceptionDetails !== undefined) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
      return result.value;
    };
    /** Until it holds in the page. */
    const wait = async (holds, ...words) => {
      for (const end = performance.now() + 60_000; !(await evaluate(holds, ...words));) {
        if (performance.now() > end) throw new Error(`waited 60 s for ${holds}`);
        await new Promise((again) => setTimeout(again, 50));
      }
    };
    await of("Page.navigate", { url });
    await wait(() => window.tofray?.counters.drawn > 0);
    return { troubles, evaluate, wait, send: of, close: () => send("Target.closeTarget", { targetId }) };
  };

  const close = async () => {
    child.kill("SIGKILL");
    await gone;
  };
  await until(() => child.pid !== undefined, "a browser");
  return { pid: child.pid, page, close };
}
