// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/setup.h"
#include "tofray/options.h"

namespace tofray::pipeline {
struct Input;
}

namespace tofray::backend {

/// Something that computes frames: the processor, or a GPU.
class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Takes what does not change from frame to frame.
  virtual void load(const pipeline::Setup& setup) = 0;
  /// All passes of a frame, with arrays in host memory. `input`: begin with this instead of the scene.
  virtual void run(const pipeline::Setup& setup, const pipeline::Job& job, const pipeline::Input* input = nullptr) = 0;
  /// Whether it derives forms and facets of the scene itself; if not, whoever calls has to.
  [[nodiscard]] virtual bool derives() const = 0;
  /// Says what it is in `out`.
  virtual void describe(RanOn& out) const = 0;
};

}  // namespace tofray::backend
