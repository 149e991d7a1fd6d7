// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/pass/pass.h"

namespace tofray::pipeline {

/// Forms and facets out of the scene's shapes, where the backend does that itself, before all else (scene/derive.h).
struct DeriveScene {
  static constexpr const char* name = "derive_scene";
  static constexpr const char* does = "forms and facets of what moves";
  static constexpr Over over = Over::scene;
  static constexpr int most_threads = heavy_block_threads;
};

}  // namespace tofray::pipeline
