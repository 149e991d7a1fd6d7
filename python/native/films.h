// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include "tofray/mcap.h"

namespace tofray::python {

/// What messages say, out of words: driver, stamp, name, topics, …; compression. Words that are None are left as they are.
void take_film_words(const pybind11::dict& words, MessageOptions& messages, std::optional<McapCompression>& compression);

/// McapWriter and mcap_contents for Python.
void bind_films(pybind11::module_& module);

}  // namespace tofray::python
