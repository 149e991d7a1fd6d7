// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The window for what is taken along.

import { useSignal, type Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect } from "preact/hooks";
import { Dialog } from "./dialog";
import { copy } from "./download";
import { save } from "./edit";
import { film_fault, film_result, filming, make_film, no_film, stop_film } from "./film";
import { checksums, exporting, frame_now, keep_open, kept_side, record, recording, restore_from, take_screenshot, write_page, type Job } from "./keep";
import type { Exported, Fault, Recorded } from "./protocol";
import { cannot, hello, link, other } from "./store";

const most_frames = 10_000;   // as the server has it
const most_hz = 60;
const usual_count = 5;

/** A whole number that is typed; undefined: it is none. */
function whole(text: string, least: number): number | undefined {
  return /^\d{1,15}$/.test(text.trim()) && Number(text) >= least ? Number(text) : undefined;
}

/** Which frames. */
function Frames({ id, first, count, off }: { id: string; first: Signal<string>; count: Signal<string>; off: boolean }) {
  const [of_first, of_count] = [whole(first.value, 0), whole(count.value, 1)];
  return (
    <>
      <label for={`${id}-first`}>from frame</label>
      <input id={`${id}-first`} type="text" inputMode="numeric" autoComplete="off" value={first.value} disabled={off} aria-invalid={of_first === undefined} onInput={(event) => (first.value = event.currentTarget.value)} />
      <label for={`${id}-count`}>frames</label>
      <input id={`${id}-count`} type="text" inputMode="numeric" autoComplete="off" value={count.value} disabled={off} aria-invalid={of_count === undefined || of_count > most_frames} onInput={(event) => (count.value = event.currentTarget.value)} />
    </>
  );
}

function chosen(first: Signal<string>, count: Signal<string>): { first: number; frames: number } | undefined {
  const [of_first, of_count] = [whole(first.value, 0), whole(count.value, 1)];
  if (of_first === undefined || of_count === undefined || of_count > most_frames) return undefined;
  const { first: least = 0, frames: there = Infinity } = hello.value ?? {};
  return of_first < least || of_first + of_count > least + there ? undefined : { first: of_first, frames: of_count };
}

function Progress({ of, stop }: { of: { done: number; frames: number }; stop: () => void }) {
  return (
    <div class="keep-progress">
      <label class="progress">frame {of.done} of {of.frames} <progress max={of.frames} value={of.done} /></label>
      <button type="button" onClick={stop}>Stop</button>
    </div>
  );
}

function Wrong({ of }: { of: Fault | undefined }) {
  return of === undefined ? null : <p class="wrong" role="alert"><strong>{of.text}</strong> {of.more ?? ""}</p>;
}

function Part({ title, id, why, children }: { title: string; id: string; why: string | undefined; children: ComponentChildren }) {
  return (
    <section aria-labelledby={`${id}-title`} class="keep" id={id}>
      <h3 id={`${id}-title`}>{title}</h3>
      {why !== undefined ? <p class="what">{why}</p> : children}
    </section>
  );
}

function CopyButton({ text, children }: { text: string; children: ComponentChildren }) {
  const copied = useSignal(false);
  const put = (): void => void copy(text).then((done) => {
    copied.value = done;
    setTimeout(() => (copied.value = false), 2000);
  });
  return <button type="button" class="quiet" onClick={put}>{copied.value ? "Copied" : children}<span class="unseen" role="status">{copied.value ? "It is copied." : ""}</span></button>;
}

function size_text(bytes: number): string {
  return bytes < 1e5 ? `${(bytes / 1e3).toFixed(1)}\u00a0kB` : `${(bytes / 1e6).toFixed(1)}\u00a0MB`;
}

function RecordedFiles({ of }: { of: Recorded }) {
  return (
    <div data-recorded={of.folder}>
      <p>In <code>{of.folder}</code>:</p>
      <div class="wide" tabIndex={0} role="region" aria-label="Files that were recorded">
        <table class="files">
          <thead><tr><th scope="col">file</th><th scope="col">size</th><th scope="col">SHA-256</th></tr></thead>
          <tbody>
            {(of.files ?? []).map(({ name, bytes, sha256 }) => <tr key={name} data-file={name}><th scope="row">{name}</th><td>{size_text(bytes)}</td><td><code>{sha256}</code></td></tr>)}
          </tbody>
        </table>
      </div>
      {of.left_out !== undefined && of.left_out > 0 && <p class="what">{of.left_out} more are in the folder; manifest.json lists all of them.</p>}
      {of.command !== undefined && <><p class="what">The same bytes by the command line:</p><code class="command-of" tabIndex={0} role="region" aria-label="Command of these files">{of.command}</code></>}
      <div class="keep-buttons">
        {of.command !== undefined && <CopyButton text={of.command}>Copy command</CopyButton>}
        <CopyButton text={checksums(of)}>Copy SHA-256 list</CopyButton>
      </div>
    </div>
  );
}

function busy<A extends Recorded | Exported>(of: Job<A>): boolean {
  return of.progress.value !== undefined;
}

function Record({ first, count }: { first: Signal<string>; count: Signal<string> }) {
  const frames = chosen(first, count);
  const [progress, result] = [recording.progress.value, recording.result.value];
  const off = link.value !== "open" || busy(recording) || busy(exporting);
  return (
    <Part title="Record frames" id="record" why={cannot("record")}>
      <p class="what">Frames{other.value === undefined ? "" : ` of ${kept_side().toUpperCase()}`} as <code>render</code> writes them, with the same bytes, in a new folder where <code>tofray view</code> was started (or its <code>-o</code>).</p>
      <form class="keep-form" onSubmit={(event) => (event.preventDefault(), frames !== undefined && !off && record(frames.first, frames.frames))}>
        <Frames id="record" first={first} count={count} off={busy(recording)} />
        <button type="submit" disabled={off || frames === undefined}>Record</button>
      </form>
      {progress !== undefined && <Progress of={progress} stop={() => recording.stop()} />}
      <Wrong of={recording.fault.value} />
      <div role="status">{result !== undefined && <RecordedFiles of={result} />}</div>
    </Part>
  );
}

function Page({ first, count }: { first: Signal<string>; count: Signal<string> }) {
  const frames = chosen(first, count);
  const [progress, result] = [exporting.progress.value, exporting.result.value];
  const off = link.value !== "open" || busy(recording) || busy(exporting);
  return (
    <Part title="A page as one file" id="export" why={cannot("export")}>
      <p class="what">This viewer with frames in it, for who has no tofray: opened from a disk, without a network. Everything can be looked at there, nothing changed.</p>
      <form class="keep-form" onSubmit={(event) => (event.preventDefault(), frames !== undefined && !off && write_page(frames.first, frames.frames))}>
        <Frames id="export" first={first} count={count} off={busy(exporting)} />
        <button type="submit" disabled={off || frames === undefined}>Write page</button>
      </form>
      {progress !== undefined && <Progress of={progress} stop={() => exporting.stop()} />}
      <Wrong of={exporting.fault.value} />
      <div role="status">
        {result !== undefined && (
          <div data-exported={result.file}>
            <p><code>{result.file}</code>, {size_text(result.bytes ?? 0)}</p>
            {result.command !== undefined && <><code class="command-of" tabIndex={0} role="region" aria-label="Command of this page">{result.command}</code><div class="keep-buttons"><CopyButton text={result.command}>Copy command</CopyButton></div></>}
          </div>
        )}
      </div>
    </Part>
  );
}

function Picture() {
  const off = link.value !== "open";
  return (
    <Part title="Screenshot" id="screenshot" why={cannot("screenshot")}>
      <p class="what">This frame as <code>preview.png</code>, with the state in it: dropped on this page, it brings scene keys, seed and frame back.</p>
      <div class="keep-buttons">
        <button type="button" onClick={take_screenshot} disabled={off} title="without this window: i">Take one</button>
        <label class="file-button">
          <span>Bring one back …</span>
          <input type="file" accept="image/png" disabled={off || cannot("restore") !== undefined} onChange={(event) => {
            const file = event.currentTarget.files?.[0];
            if (file !== undefined) void restore_from(file);
            event.currentTarget.value = "";
          }} />
        </label>
      </div>
    </Part>
  );
}

function Film({ first, count }: { first: Signal<string>; count: Signal<string> }) {
  const own = hello.value?.frame_rate_hz ?? 0;
  const rate = useSignal(String(own > 0 ? Number(own.toPrecision(3)) : 10));
  const frames = chosen(first, count);
  const hz = Number(rate.value);
  const fits = rate.value.trim() !== "" && hz > 0 && hz <= most_hz;
  const progress = filming.value;
  return (
    <Part title="Film" id="film" why={no_film()}>
      <p class="what">The panes as they are seen, for slides; frame after frame, none left out. Numbers are in the files above.</p>
      <form class="keep-form" onSubmit={(event) => (event.preventDefault(), frames !== undefined && fits && void make_film(frames.first, frames.frames, hz))}>
        <Frames id="film" first={first} count={count} off={progress !== undefined} />
        <label for="film-rate">a second</label>
        <input id="film-rate" type="text" inputMode="decimal" autoComplete="off" value={rate.value} disabled={progress !== undefined} aria-invalid={!fits} onInput={(event) => (rate.value = event.currentTarget.value)} />
        <button type="submit" disabled={link.value !== "open" || frames === undefined || !fits || progress !== undefined}>Make film</button>
      </form>
      {progress !== undefined && <Progress of={progress} stop={stop_film} />}
      {film_fault.value !== undefined && <p class="wrong" role="alert">{film_fault.value}</p>}
      <div role="status">{film_result.value !== undefined && <p><code>{film_result.value}</code> is saved.</p>}</div>
    </Part>
  );
}

export function KeepDialog() {
  const first = useSignal("0");
  const count = useSignal(String(usual_count));
  const open = keep_open.value;
  useEffect(() => {
    if (!open) return;
    const { first: least = 0, frames: there = Infinity } = hello.value ?? {};
    first.value = String(frame_now());
    count.value = String(Math.max(1, Math.min(usual_count, least + there - frame_now())));
    requestAnimationFrame(() => document.querySelector<HTMLInputElement>("#record-first, #export-first, #film-first")?.select());
  }, [open]);
  return (
    <Dialog open={keep_open} title="Take along" id="keep">
      {open && (
        <>
          <Record first={first} count={count} />
          <Part title="The scene as YAML" id="yaml" why={cannot("save")}>
            <p class="what">Scene and camera with all changes, as a file that <code>check</code> and <code>render</code> take: the same bytes.</p>
            <div class="keep-buttons"><button type="button" disabled={link.value !== "open"} onClick={() => save(kept_side())} title="without this window: s">Save YAML</button></div>
          </Part>
          <Picture />
          <Page first={first} count={count} />
          <Film first={first} count={count} />
          <p class="what">Charts have CSV and SVG below each of them.</p>
        </>
      )}
    </Dialog>
  );
}
