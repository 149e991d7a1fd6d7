// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "cli/options.h"

namespace tofray::app {

// What `tofray dataset` does with a set in files.
int run_dataset_plan(const Options& options);
int run_dataset_run(const Options& options);
int run_dataset_status(const Options& options);
int run_dataset_verify(const Options& options);
int run_dataset_merge(const Options& options);
int run_dataset_submit(const Options& options);

}  // namespace tofray::app
