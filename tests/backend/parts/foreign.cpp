// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A library that has the name and nothing of tofray.
extern "C" int nothing_of_tofray();
extern "C" int nothing_of_tofray() { return 0; }
