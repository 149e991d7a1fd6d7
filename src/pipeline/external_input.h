// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/multipath.h"
#include "pipeline/run.h"

/// Entering the pipeline at a later stage, with arrays from elsewhere in the place of what the earlier stages find.
namespace tofray::pipeline {

/// Into stage 2: what another renderer saw. [moment][height][width]; a null pointer where nothing is said of it.
struct SurfaceArrays {
  const float* z;       ///< nothing is seen where it is not above 0, or beyond flow::max_distance
  const float* normal;  ///< [moment][height][width][3] of unit length, on either side
  const float *diffuse, *specular, *exponent;
  const std::int32_t* object;
  const std::uint8_t* shadow;  ///< [moment][light][height][width] not 0: the light does not reach it
  const std::uint8_t* sun_shadow;
  bool operator==(const SurfaceArrays&) const = default;
};

/// Into stage 3: what light each pixel receives, path by path, or summed already.
struct LightArrays {
  const float *power, *path_length;   ///< [moment][path][height][width] [W], [m]; of phasors: power [moment][light][height][width]
  const std::int32_t* light_of_path;  ///< [path]
  std::int32_t paths;
  const float* phasor;        ///< [moment][light][modulation][order][height][width][2] [W] in place of path_length, or null
  std::int32_t orders;        ///< of 1, 3, 5 …, those that `phasor` has
  const float* ambient_rate;  ///< [moment][height][width] [e⁻/s]
  std::int32_t lights;        ///< that phasors are of, the camera's first ones
  std::int32_t rates;         ///< 1: power and phasors are electrons per second
  bool operator==(const LightArrays&) const = default;
};

/// Into stage 4: ADC codes, or both taps where `raw` is null. [phase][height][width]
struct Recording {
  const std::uint16_t* raw;
  const float *tap_a, *tap_b;
  bool operator==(const Recording&) const = default;
};

struct Input {
  Stage entry;              ///< the first stage that is computed: power, raw or depth
  std::int32_t moments;     ///< 1, or one for each raw frame
  std::int32_t from_image;  ///< 1: the light of stage 3 is that of Job::light
  SurfaceArrays surface;
  LightArrays light;
  Recording recording;
  bool operator==(const Input&) const = default;
};

/// Where image number `image` of a stack begins.
TOFRAY_INLINE std::int64_t place_of(const Setup& s, int image) { return std::int64_t{image} * s.lens.width * s.lens.height; }

/// Of a moment's image number `image`, the pixels p; a null array is `otherwise` everywhere.
template <class F>
TOFRAY_INLINE F given(const float* array, const Setup& s, const Pixels& p, int image, float otherwise) {
  return array != nullptr ? num::load<F>(array + place_of(s, image) + p.index, p.count) : F(otherwise);
}

template <class F>
TOFRAY_INLINE num::Mask<F> given_mask(const std::uint8_t* array, const Setup& s, const Pixels& p, int image) {
  std::int32_t marks[num::lanes<F>] = {};
  if (array != nullptr) {
    const std::uint8_t* from = array + place_of(s, image) + p.index;
    for (int i = 0; i < p.count; ++i) marks[i] = from[i];
  }
  return num::load_int<F>(marks, p.count) > num::Int<F>(0);
}

/// The surface that was seen; its normal is turned to the camera.
template <class F>
TOFRAY_INLINE flow::Surface<F> given_surface(const Setup& s, const SurfaceArrays& in, const Pixels& p, int moment,
                                             const flow::Ray<F>& ray) {
  flow::Surface<F> out;
  const F z = given<F>(in.z, s, p, moment, 0.0f);
  out.found = (z > F(0.0f)) & (z <= F(flow::max_distance));
  const auto value = [&](F a) TOFRAY_LAMBDA { return num::select(out.found, a, F(0.0f)); };
  trace::put_at(ray, num::select(out.found, z, F(1.0f)), out);
  const auto lane = num::lane_index<F>();
  const auto at = num::select(lane < num::Int<F>(p.count), lane, num::Int<F>(0)) * num::Int<F>(3);
  const float* normal = in.normal + 3 * (place_of(s, moment) + p.index);
  const F nx = value(num::gather(normal, at)), ny = value(num::gather(normal + 1, at)), nz = value(num::gather(normal + 2, at));
  trace::face_camera(nx, ny, nz, ray, out);
  const F diffuse = value(given<F>(in.diffuse, s, p, moment, 0.0f)), specular = value(given<F>(in.specular, s, p, moment, 0.0f));
  out.finish = brdf::lambert_and_lobe(diffuse, specular, num::select(out.found, given<F>(in.exponent, s, p, moment, 1.0f), F(1.0f)));
  out.object = num::Int<F>(0);
  if (in.object != nullptr) out.object = num::load_int<F>(in.object + place_of(s, moment) + p.index, p.count);
  return out;
}

template <class F>
struct GivenShadows {
  const Setup& s;
  const SurfaceArrays& in;
  const Pixels& p;
  int moment;

  TOFRAY_INLINE const float* sun_direction() const { return s.power.sun_direction; }

  TOFRAY_INLINE num::Mask<F> of_light(int l) const { return given_mask<F>(in.shadow, s, p, moment * s.scene.lights + l); }
  TOFRAY_INLINE num::Mask<F> of_sun() const { return given_mask<F>(in.sun_shadow, s, p, moment); }
};

/// The light that each pixel receives over paths of their own lengths.
template <class F>
TOFRAY_INLINE void given_paths(const Setup& s, const LightArrays& in, const power::Wanted& wanted, const Pixels& p, int moment,
                               flow::Light<F>& light, F& power) {
  for (int i = 0; i < in.paths; ++i) {
    const int l = in.light_of_path[i];
    const F watts = given<F>(in.power, s, p, moment * in.paths + i, 0.0f);
    const flow::Path<F> path{watts * F(s.lights[l].electrons_per_joule), given<F>(in.path_length, s, p, moment * in.paths + i, 0.0f)};
    power::add_path(s.phasors, wanted, l, path, false, light);
    power = power + watts;
  }
}

/// Light of arrays that is summed already: of each light the power, and Σ power·e^{imφ}.
template <class F>
TOFRAY_INLINE void given_phasors(const Setup& s, const LightArrays& in, const power::Wanted& wanted, const Pixels& p, int moment,
                                 flow::Light<F>& light, F& power) {
  const auto lane = num::lane_index<F>();
  const auto at = num::select(lane < num::Int<F>(p.count), lane, num::Int<F>(0));
  for (int l = 0; l < in.lights; ++l) {
    const F watts = given<F>(in.power, s, p, moment * in.lights + l, 0.0f);
    const F electrons = F(in.rates != 0 ? 1.0f : s.lights[l].electrons_per_joule);
    light.signal_rate = num::fma(watts, electrons, light.signal_rate);
    power = in.rates != 0 ? nan<F>() : power + watts;
    for (int j = wanted.first; j < wanted.last; ++j) {
      for (int h = 0; h < in.orders && h < s.phasors.orders; ++h) {
        const int image = ((moment * in.lights + l) * s.phasors.modulations + j) * in.orders + h;
        F real, imaginary;
        num::gather_pair(in.phasor + 2 * (place_of(s, image) + p.index), at, real, imaginary);
        power::add_phasor(s.phasors, j, l, h, real * electrons, imaginary * electrons, light);
      }
    }
  }
}

/// Raw frames without noise of the light that has met one surface alone; ambient light is all that there is.
template <class F>
TOFRAY_NOINLINE void store_direct_levels(const Setup& s, float* to, const flow::LightImage& image, const Pixels& p,
                                         const effect::Exposure<F>& exposure) {
  flow::Light<F> light;
  const bool by_frame = image.times > 1;
  for (int k = 0; k < s.sensor.raw_frames; ++k) {
    const int time = by_frame ? k : 0;
    if (by_frame || k == 0) {
      const power::Wanted which = wanted(s, {k, by_frame ? k + 1 : s.sensor.raw_frames, time, 0, 1, false, !by_frame}, !by_frame);
      load_light(s, image.before, p, image.times, time, light);
      light.ambient_rate = num::load<F>(image.values + light_place(s, p, image.times, time, 1), p.count);
      if (s.sensor.delay != nullptr) power::delay_by(s.phasors, which, s.sensor, p, light);
    }
    store_levels<F>(s, to, p, k, k + 1, light, exposure);
  }
}

/// Pixels with arrays from elsewhere, for stages 2 to 4, or 3 and 4.
template <class F>
class ArraySource {
 public:
  TOFRAY_INLINE ArraySource(const Setup& s, const Job& job, const Input& in, const Pixels& p, const Pixels& next)
      : s_(s), job_(job), in_(in), pixels_(p), next_(next) {}

  TOFRAY_INLINE int moments() const { return in_.moments; }
  static constexpr bool once() { return false; }
  TOFRAY_INLINE int packs() const { return 1; }
  TOFRAY_INLINE Pixels pixels(int) const { return pixels_; }
  TOFRAY_INLINE Pixels ahead(int) const {
    camera::fetch_lens<F>(s_.lens, next_);
    return next_;
  }
  TOFRAY_INLINE PackState<F>& pack(int) { return pack_; }
  static constexpr bool blurs = false, inlined = true;
  TOFRAY_INLINE flow::Light<F>& mean(int) { return pack_.light; }
  TOFRAY_INLINE void go_to(const Moment&) const {}

  TOFRAY_INLINE bool find_light(const Moment& now, int, const Pixels& p, const flow::Ray<F>& ray, F vignetting, PackState<F>& pack) const {
    if (in_.from_image != 0) {
      if (s_.last_stage >= Stage::raw) load_light(s_, job_.light, p, now.index, pack.light);
      if (now.truth) {
        store_mixed<F>(s_, job_.out, job_.light, p);
        store_bounced<F>(s_, job_.out, job_.light, p, job_.light.times > 1 ? now.first : 0);
        if (job_.out.gt_raw_direct_dn != nullptr && job_.light.indirect != nullptr)
          store_direct_levels<F>(s_, job_.out.gt_raw_direct_dn, job_.light, p, pack.exposure);
      }
      return true;
    }
    const power::Wanted which = wanted(s_, now, false);
    flow::Radiometry<F> radiometry{F(0.0f), F(0.0f), F(0.0f)};
    flow::Surface<F> surface{};
    surface.found = F(1.0f) < F(0.0f);
    if (in_.entry == Stage::power) {
      surface = given_surface(s_, in_.surface, p, now.index, ray);
      hide_outside_lens(vignetting, surface);
      if (s_.last_stage >= Stage::power) {
        light_up(s_, which, GivenShadows<F>{s_, in_.surface, p, now.index}, ray, surface, vignetting, pack.light, radiometry);
      }
    } else {
      radiometry.irradiance = radiometry.radiance = nan<F>();
      power::clear(s_.phasors, which, pack.light);
      if (in_.light.phasor == nullptr) {
        given_paths(s_, in_.light, which, p, now.index, pack.light, radiometry.power);
      } else {
        given_phasors(s_, in_.light, which, p, now.index, pack.light, radiometry.power);
      }
      power::add_up(s_.phasors, which, pack.light);
      pack.light.ambient_rate = given<F>(in_.light.ambient_rate, s_, p, now.index, 0.0f);
    }
    if (now.truth) {
      store_truth(job_.out, p, surface, radiometry, []() TOFRAY_LAMBDA { return num::Int<F>(-1); });
      store_seen(job_.out, p, nothing_known<F>());
      store_no_phase_flow<F>(s_, job_.out.gt_phase_flow_px, p);
      if (s_.last_stage >= Stage::power) store(job_.out.gt_ambient_e_per_s, p, pack.light.ambient_rate);
    }
    return true;
  }

 private:
  const Setup& s_;
  const Job& job_;
  const Input& in_;
  Pixels pixels_, next_;
  PackState<F> pack_;
};

/// Stage 4.
template <class F>
TOFRAY_INLINE void decode_pixels(const Setup& s, const Job& job, const Recording& in, const Pixels& p) {
  F difference[flow::max_raw_frames];
  num::Mask<F> clipped = F(1.0f) < F(0.0f);
  const camera::SensorView& sensor = s.sensor;
  const F offset = raw::pattern<F>(sensor.offset, p, 0.0f);
  for (int k = 0; k < sensor.raw_frames; ++k) {
    const std::int32_t at = p.index + k * s.lens.width * s.lens.height;
    num::Mask<F> over = F(1.0f) < F(0.0f);
    F level = F(sensor.max_code) + F(1.0f);  // of a code at an end of the ADC only the taps could tell that it was not held there
    if (in.tap_a != nullptr) {
      const F a = num::load<F>(in.tap_a + at, p.count), b = num::load<F>(in.tap_b + at, p.count);
      const auto charges = (num::abs(a) <= F(flow::max_charge)) & (num::abs(b) <= F(flow::max_charge));
      const effect::TapPair<F> charge{num::select(charges, a, F(0.0f)), num::select(charges, b, F(0.0f))};
      level = effect::read_out(sensor, charge, offset).level;
      difference[k] = effect::held_to_codes(effect::reach_of_codes(sensor, offset), charge.a - charge.b);
      over = (!charges) | (num::max(charge.a, charge.b) >= F(sensor.full_read));
    }
    if (in.raw != nullptr) {
      std::int32_t codes[num::lanes<F>] = {};
      for (int i = 0; i < p.count; ++i) codes[i] = in.raw[at + i];
      const F code = num::to_float(num::load_int<F>(codes, p.count));
      difference[k] = (code - F(sensor.mid_code)) * F(sensor.step);
      level = num::select((code <= F(0.0f)) | (code >= F(sensor.max_code)), level, code);
    }
    over = over | (num::abs(level - F(sensor.valid_middle)) > F(sensor.valid_half));
    if (sensor.frame[k].lit != 0) clipped = clipped | over;
  }
  find_depth_noinline<F>(s, job, p, camera::ray<F>(s.lens, p), difference, clipped, camera::vignetting<F>(s.lens, p));
}

template <class F>
TOFRAY_INLINE void enter(const Setup& s, const Job& job, const Input& in, const Pixels& p, const Pixels& next) {
  if (in.entry == Stage::depth) {
    decode_pixels<F>(s, job, in.recording, p);
    return;
  }
  ArraySource<F> source(s, job, in, p, next);
  run_pipeline<F>(s, job, source);
}

}  // namespace tofray::pipeline
