// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "mcap/reader.h"
#include "tofray/mcap.h"

namespace tofray::run {

/// As mcap_contents(), of bytes from anywhere. @param where  the file, for messages
McapContents contents_of(mcap::Source& source, const std::string& where);

}  // namespace tofray::run
