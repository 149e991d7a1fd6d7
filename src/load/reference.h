// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tofray::load {

/// All keys of camera profiles and scenes as a page of Markdown, from the tables: docs/reference/keys.md, and `tofray list keys`.
std::string reference_page();

}  // namespace tofray::load
