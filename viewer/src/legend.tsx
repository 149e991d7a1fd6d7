// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { ink_on } from "./colors";
import type { Shows } from "./compare";
import { reason_color, type Share } from "./picture";
import { hello } from "./store";

export function percent(share: number): string {
  if (share === 0) return "0 %";
  return share < 0.001 ? "< 0.1 %" : `${(100 * share).toFixed(1)} %`;
}

/** Why pixels have no value: colour, letter, name and how many. The letter also stands in the pixels, where they are large enough. */
export function Legend({ shares, bits, shows, name = "" }: { shares: readonly Share[]; bits: boolean; shows: Shows; name?: string }) {
  const greeting = hello.value;
  if (greeting === undefined) return null;
  const none = shows === "difference" ? (bits ? "all flags are the same" : "every pixel has both values") : bits ? "no pixel is flagged" : "every pixel has a value";
  if (shares.length === 0) return <p class="legend faint">{name !== "" && <span class="of">{name}</span>}{none}</p>;
  return (
    <ul class="legend" aria-label={`${bits ? "Flags" : "Invalid pixels"}${name === "" ? "" : ` of ${name}`}`}>
      {name !== "" && <li class="of" aria-hidden="true">{name}</li>}
      {shares.map(({ reason, share }) => (
        <li key={reason?.bit ?? -1} title={reason?.advice ?? ""}>
          <span class="swatch" style={{ background: reason_color(greeting, reason), color: ink_on(reason?.color ?? greeting.invalid_color) }}>
            {reason?.letter ?? "?"}
          </span>
          {reason?.name ?? "invalid"} <span class="faint">{percent(share)}</span>
        </li>
      ))}
    </ul>
  );
}
