// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tofray::pictures {

/// Packages that carry their libraries along (packaging/carry.py) carry a font with them, beside fontconfig's library: letters are then that
/// font's, on every machine, also where there is no font and no configuration of any. Does nothing elsewhere, and where FONTCONFIG_FILE or
/// FONTCONFIG_PATH is set. To be called before cairo is asked for letters; the first call alone does something.
void use_carried_font();

}  // namespace tofray::pictures
