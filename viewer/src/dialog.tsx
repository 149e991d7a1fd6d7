// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";

/** A window above all else, which Escape, its button and a press beside it close. */
export function Dialog({ open, title, id, children }: { open: Signal<boolean>; title: string; id: string; children: ComponentChildren }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const is_open = open.value;
  useEffect(() => {
    if (is_open && dialog.current?.open === false) dialog.current.showModal();
    if (!is_open) dialog.current?.close();
  }, [is_open]);
  return (
    <dialog ref={dialog} id={id} aria-labelledby={`${id}-title`} onClose={() => (open.value = false)}
      onClick={(event) => event.target === dialog.current && (open.value = false)}>
      <div class="help">
        <div class="help-head">
          <h2 id={`${id}-title`}>{title}</h2>
          <button type="button" onClick={() => (open.value = false)}>Close</button>
        </div>
        {children}
      </div>
    </dialog>
  );
}
