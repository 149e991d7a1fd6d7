// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What build.mjs puts in.

/** Whether this is the page as one file, which has its frames in it and no server. */
declare const TOFRAY_IN_FILE: boolean;
/** The icon's address. */
declare const TOFRAY_ICON: string;
