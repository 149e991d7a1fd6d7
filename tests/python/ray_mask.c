// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// For Debian's Open3D 0.16.1, which leaves the mask of its rays at 0, and Debian's Embree 3.13, which looks at it: no ray hits anything.
// Preloaded, this sets the mask on the way from one to the other.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stddef.h>

struct ray { // RTCRay of Embree 3
  float origin[3], near, direction[3], time, far;
  unsigned mask, id, flags;
};

void rtcIntersect1M(void* scene, void* context, char* rays, unsigned count, size_t stride) {
  void (*embree)(void*, void*, void*, unsigned, size_t) =
      (void (*)(void*, void*, void*, unsigned, size_t))dlsym(RTLD_NEXT, "rtcIntersect1M");
  for (unsigned i = 0; i < count; ++i) ((struct ray*)(void*)(rays + i * stride))->mask = ~0u;
  embree(scene, context, rays, count, stride);
}
