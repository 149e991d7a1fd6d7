// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A program without the viewer's page. (C arrays have at least one element; their count is what counts.)
extern "C" {
extern const char* const tofray_view_names[] = {nullptr};
extern const char* const tofray_view_begins[] = {nullptr};
extern const char* const tofray_view_ends[] = {nullptr};
extern const unsigned tofray_view_count = 0;
}
