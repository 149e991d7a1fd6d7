// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/frozen_camera.h"

#include "camera/light/emitters.h"
#include "tofray/error.h"

namespace tofray::camera {

namespace {

const Camera& checked(const Camera& profile) {
  if (profile.mode.sequence.size() > flow::max_raw_frames) throw Error(ErrorKind::limit, "error: more than 64 raw frames in one sequence");
  return profile;
}

}  // namespace

FrozenCamera::FrozenCamera(const Camera& profile, bool noise, std::uint64_t seed, int subpixel, int threads)
    : camera_(with_emitters(ImageCamera(checked(profile)))),
      modulations_(modulations_of(camera_.mode)),
      scatter_(camera_.lens.scatter, camera_.sensor, camera_.pixel),
      lenses_(camera_, subpixel, threads),
      lights_(camera_),
      power_(power_view(camera_)),
      phasors_(camera_, modulations_),
      sensor_(profile, camera_, modulations_, phasors_.view().orders, seed, noise),
      decoder_(camera_, lights_.views(), modulations_, sensor_.view(), noise) {
  // One light, gates that stay at quarter turns, and no pixel that is late: then a path's sums say all.
  const SensorView& s = sensor_.view();
  phasors_.take_sums_alone(sensor_.at_quarter_turns() && lights_.views().size() == 1 && camera_.spread_spectrum.width == 0 &&
                           s.drifts == 0 && s.delay == nullptr);
}

void FrozenCamera::set_integration_times(const std::vector<double>& seconds) {
  for (std::size_t k = 0; k < seconds.size(); ++k) camera_.mode.sequence[k].integration_time_s = seconds[k];
  sensor_.take_integration_times();
  decoder_.take_integration_times();
}

}  // namespace tofray::camera
