// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/flags.h"
#include "tofray/frame.h"
#include "tofray/scene.h"

/// Whether scene, camera and frame make sense, out of the ground truth: what the camera sees of the scene, and why pixels have no depth.
namespace tofray {

/// What one object is to the camera, at one time. The camera looks along z of its frame.
struct ObjectInView {
  int object = 0;                    ///< index in Scene::objects
  std::string name;                  ///< as messages call it: "objects.2 (ball)"
  std::int64_t pixels = 0;           ///< pixels that see it
  std::optional<double> nearest_m;   ///< range of the nearest pixel that sees it; none where no pixel does
  std::optional<double> farthest_m;  ///< range of the farthest pixel that sees it; none where no pixel does
  bool endless = false;              ///< a plane
  Vec3 low{}, high{};                ///< its box in the world [m]; of a plane −inf and inf
  bool behind_camera = false;        ///< all of it has z < 0 in the camera's frame
  bool around_camera = false;        ///< the camera stands inside; of a mesh: its triangles surround the camera, by their solid angle
};

/// Where an object is at one time. Its own frame has the world's axes before it turns, and its zero is what it turns about: of a sphere its
/// centre, of a mesh the file's zero. What is at P there is at rotation·P + position in the world.
struct ObjectPlace {
  std::string name;                 ///< Object::name
  std::string class_name;           ///< Object::class_name
  Vec3 position{};                  ///< position in the world [m]
  Quaternion rotation{0, 0, 0, 1};  ///< rotation from its own frame's axes to the world's [1]
  bool endless = false;             ///< a plane
  Vec3 low{}, high{};               ///< its box in the world [m]; of a plane −inf and inf
};
/// Of each of Scene::objects.
/// @param time_s  of the scene, as Truth::time_s says it
std::vector<ObjectPlace> object_places(const Scene& scene, double time_s);

/// Something about a scene that is seldom meant.
struct SceneFinding {
  enum class Kind {
    no_objects,       ///< the scene has none
    nothing_in_view,  ///< no ray hits an object, or nothing but planes
    behind_camera,    ///< no ray hits an object, or nothing but planes, and all else is behind the camera
    millimetres,      ///< all is farther than 100 m: coordinates in millimetres?
    mesh_size,        ///< a mesh is very large or very small: a scale is missing, or one too many?
    around_camera,    ///< the camera stands inside an object
    floor_above,      ///< a floor is above the camera: is y up?
    same_place,       ///< an object is the same as another one, in the same place
    inside_another,   ///< an object is hidden inside another one
    beyond_reach,     ///< what is seen of an object is all beyond the ambiguity range
  };
  Kind kind = Kind::no_objects;
  bool warning = true;       ///< false: a note; it may well be meant
  std::vector<int> objects;  ///< indices in Scene::objects
  std::string where;         ///< file:line:col of the first of them; empty if built in code
  std::string what;          ///< one line, complete in itself
  std::string more;          ///< what it means and how to mend it, one line
};

/// What the camera sees of the scene at one time.
struct SceneReport {
  double time_s = 0;                  ///< time of the scene [s]
  std::int64_t pixels = 0;            ///< pixels of the image
  std::int64_t outside_lens = 0;      ///< pixels without a ray
  std::int64_t no_surface = 0;        ///< pixels whose ray hits nothing
  std::int64_t beyond_reach = 0;      ///< pixels that see what is farther than the ambiguity range
  double ambiguity_range_m = 0;       ///< ambiguity range of the camera's mode; 0 where no raw frame is lit
  std::optional<double> nearest_m;    ///< least range of all pixels; none where no ray hits anything
  std::optional<double> farthest_m;   ///< largest range of all pixels; none where no ray hits anything
  std::vector<ObjectInView> objects;  ///< one for each of Scene::objects
  std::vector<SceneFinding> findings;
};

/// Of the scene at frame 0: rays are traced once for each pixel, nothing else is simulated.
/// @throws Error as a Simulator's constructor does
SceneReport scene_report(const Scene& scene, const Camera& camera);
/// Of a frame that is there; of its truth `object_id` and `range_m` are needed.
/// @throws Error (bad_input) where they are not there or not of the same size, or name objects that the scene does not have
SceneReport scene_report(const Scene& scene, const Camera& camera, const Truth& truth);

/// Why a pixel has no depth: what truth tells of it, or else the reason that its flags say. With truth, low_signal and
/// no_return are no_surface, beyond_reach or dark.
enum class NoDepth {
  no_surface,    ///< its ray hits nothing
  beyond_reach,  ///< the surface is farther than the ambiguity range
  dark,          ///< it sees a surface within reach, and too little light comes back
  wrong_cycle,   ///< flying by flags, but most neighbours are off by multiples of a modulation frequency's ambiguity range
#define TOFRAY_REASON(name, ...) name,
  TOFRAY_REASONS(TOFRAY_REASON)  // saturated, …
#undef TOFRAY_REASON
};
#define TOFRAY_ONE(...) +1
/// How many reasons there are.
inline constexpr std::size_t no_depth_count = 1 + static_cast<std::size_t>(NoDepth::wrong_cycle) TOFRAY_REASONS(TOFRAY_ONE);
#undef TOFRAY_ONE
/// What messages call it: "no surface", "wrong cycle".
const char* no_depth_name(NoDepth reason);

/// How many pixels have no depth, and why: each counts once, under the member of its NoDepth. What has low signal or no return
/// is counted as such where there is no truth.
struct InvalidPixels {
  std::int64_t pixels = 0;                ///< pixels of the image
  std::int64_t valid = 0;                 ///< pixels that have a depth
  std::int64_t wrapped = 0;               ///< valid ones whose surface is beyond the ambiguity range: their depth is too small
  std::int64_t valid_on_wrong_cycle = 0;  ///< valid ones whose range is off by more than half a cycle of the highest modulation frequency
  std::int64_t no_surface = 0;            ///< the ray hits nothing
  std::int64_t beyond_reach = 0;          ///< the surface is farther than the ambiguity range
  std::int64_t dark = 0;                  ///< there is a surface within reach, and too little light comes back
  std::int64_t wrong_cycle = 0;           ///< most neighbours are off by whole cycles of a modulation frequency
#define TOFRAY_COUNT(name, ...) std::int64_t name = 0;
  TOFRAY_REASONS(TOFRAY_COUNT)  // std::int64_t saturated = 0; …
#undef TOFRAY_COUNT
  double ambiguity_range_m = 0;  ///< ambiguity range of the camera's mode; 0 where no raw frame is lit
  std::vector<double> ranges_m;  ///< ambiguity range of each modulation frequency alone

  /// Number of pixels of one reason.
  [[nodiscard]] std::int64_t count(NoDepth reason) const;
};

/// Needs `flags`; of the truth `object_id` and `range_m`; `raw` or both taps to know wrong cycles. What is missing is not told apart.
/// @param wrong_cycles  whether the frame is decoded once more to know them, where 1 % of the pixels are flying
/// @throws Error as process() does
InvalidPixels invalid_pixels(const Frame& frame, const Camera& camera, bool wrong_cycles = true);

/// Why pixels have no depth, in words, and what helps.
struct Validity {
  InvalidPixels pixels;
  std::string reasons;  ///< "12 dark, 3 no surface"; empty where all are valid
  /// Where fewer than half are valid, the reason of most, and what helps: "71 % dark: noise 0.11 m at the median; more light …"; also
  /// where many have a depth that is whole cycles off. Lines behind the first are indented.
  std::string advice;
  bool has_light = true;  ///< the camera's own has any power
  /// Whether fewer than half of the pixels have a depth.
  [[nodiscard]] bool few() const { return 2 * pixels.valid < pixels.pixels; }
};
/// @throws Error as invalid_pixels()
Validity validity(const Frame& frame, const Camera& camera, bool wrong_cycles = true);

}  // namespace tofray
