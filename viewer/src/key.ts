// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The key that opens the server. It comes in the address's fragment, which no request carries, and stays in this tab.

const place = "tofray.key";

function of_address(): string | undefined {
  const key = /^#t=([A-Za-z0-9_-]+)$/.exec(location.hash)?.[1];
  if (location.hash !== "") history.replaceState(null, "", location.pathname + location.search);
  return key;
}

/** The key that is in the address, which it leaves, or else that of this tab. */
export function take_key(): string | undefined {
  const key = of_address();
  if (key !== undefined) sessionStorage.setItem(place, key);
  return key ?? sessionStorage.getItem(place) ?? undefined;
}
