// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Linked to every program of the woven copy. TOFRAY_MUTANT: the mutant that is on. TOFRAY_MUTANTS_SEEN: a file to which a program that ends
// adds the numbers of all mutants that it reached, with a minus for those that cannot be.
#include "switch.h"

#include <cstdio>
#include <cstdlib>

extern "C" {
int tofray_mutant = 0;
unsigned char tofray_mutant_seen[TOFRAY_MUTANTS + 1] = {};
}

namespace {

/// Before the constructors of all static objects, and after their destructors.
__attribute__((constructor(101))) void choose() {
  if (const char* number = std::getenv("TOFRAY_MUTANT")) tofray_mutant = std::atoi(number);
}

__attribute__((destructor(101))) void report() {
  const char* path = std::getenv("TOFRAY_MUTANTS_SEEN");
  std::FILE* file = path != nullptr ? std::fopen(path, "a") : nullptr;
  if (file == nullptr) return;
  for (int i = 1; i <= TOFRAY_MUTANTS; ++i) {
    if (tofray_mutant_seen[i] != 0) std::fprintf(file, "%d\n", (tofray_mutant_seen[i] & 1) != 0 ? i : -i);
  }
  std::fclose(file);
}

}  // namespace
