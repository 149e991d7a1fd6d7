// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "analysis/bodies.h"
#include "tofray/analysis.h"

/// What of a scene is seldom meant. The rules are such that no scene that makes sense gets a warning.
namespace tofray::analysis {

/// What the rules look at.
struct Seen {
  const Scene& scene;
  const std::vector<Body>& bodies;
  Pose pose;  ///< of the camera
  Vec eye{}, forward{};
};

/// Adds all findings to a report whose numbers are there.
void add_findings(const Seen& seen, SceneReport& report);

/// Objects in the same place, and inside one another.
void find_overlaps(const Seen& seen, SceneReport& report);

/// A finding about objects; those of one file's entry stand once in its sentences.
/// @param warning  else a note
void add(const Seen& seen, SceneReport& report, SceneFinding::Kind kind, bool warning, const std::vector<int>& objects,
         const std::string& what, const std::string& more);

/// "objects.2 (ball)"; of a file's parts one for all of them.
std::string name_of(const Scene& scene, int object);
/// "objects.2 (ball), objects.3 (box) and 4 more".
std::string names_of(const Scene& scene, const std::vector<int>& objects);

}  // namespace tofray::analysis
