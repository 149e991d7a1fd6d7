// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The line to the server: opened with the key, opened again when it breaks, and given up only where another server answers.

import type { ClientMessage, ServerMessage } from "./protocol";
import { FileLine } from "./file_line";
import { take_key } from "./key";
import { link } from "./store";

const first_wait_ms = 300;
const longest_wait_ms = 5000;

export interface Receiver {
  opened(): void;
  text(message: ServerMessage): void;
  binary(message: ArrayBuffer): void;
}

interface Line {
  begin(): void;
  send(message: ClientMessage): void;
}

let in_file: Line | undefined;   // in a page that is one file it answers in the server's place
let socket: WebSocket | undefined;
let receiver: Receiver | undefined;
let key: string | undefined;
let wait_ms = first_wait_ms;
let timer: number | undefined;
let last_id = 0;

/** How many keys there were so far: each is of another server. */
export let server_count = 0;

/** For a message that is answered. */
export function next_id(): number {
  return ++last_id;
}

export function send(message: ClientMessage): void {
  if (in_file !== undefined) in_file.send(message);
  else if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
}

/** @throws Error where the page is a file without frames */
export function connect(to: Receiver): void {
  receiver = to;
  if (TOFRAY_IN_FILE) {
    in_file = new FileLine(to);
    link.value = "open";
    return in_file.begin();
  }
  addEventListener("hashchange", () => {
    if (location.hash !== "") begin();
  });
  addEventListener("online", retry_now);
  begin();
}

/** With the key of the address, or that of this tab. */
function begin(): void {
  const before = key;
  key = take_key();
  if (key !== before) ++server_count;
  if (key === undefined) link.value = "keyless";
  else if (link.value !== "open") link.value = "connecting";
  retry_now();
}

export function retry_now(): void {
  wait_ms = first_wait_ms;
  open();
}

function open(): void {
  clearTimeout(timer);
  const old = socket;
  socket = undefined;
  old?.close();
  if (key === undefined) return;
  const address = new URL("ws", location.href);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  const fresh = new WebSocket(address, ["tofray.v1", `t.${key}`]);
  fresh.binaryType = "arraybuffer";
  socket = fresh;
  let was_open = false;
  fresh.onopen = () => {
    was_open = true;
    wait_ms = first_wait_ms;
    link.value = "open";
    receiver?.opened();
  };
  fresh.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
    if (socket !== fresh) return;
    if (typeof event.data === "string") receiver?.text(JSON.parse(event.data) as ServerMessage);
    else receiver?.binary(event.data);
  };
  fresh.onclose = () => {
    if (socket !== fresh) return;
    socket = undefined;
    void broken(was_open);
  };
}

/** A page is not told why its socket was refused. So it asks for itself: who answers that, but does not take the key, is another server. */
async function broken(was_open: boolean): Promise<void> {
  if (was_open) {
    link.value = "lost";
  } else {
    const answers = await fetch("./", { method: "HEAD", cache: "no-store" }).then(() => true, () => false);
    if (socket !== undefined) return;
    if (answers && link.value !== "open") {
      link.value = "other";
      return;
    }
    link.value = "gone";
  }
  clearTimeout(timer);
  timer = setTimeout(open, wait_ms);
  wait_ms = Math.min(longest_wait_ms, 2 * wait_ms);
}
