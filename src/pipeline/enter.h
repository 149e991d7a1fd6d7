// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/one_pixel.h"

/// Entering the pipeline at a later stage, with arrays from elsewhere in the place of what the earlier stages find.
namespace tofray::pipeline {

/// Into stage 2: what another renderer saw. [moment][height][width]; a null pointer where nothing is said of it.
struct SurfaceArrays {
  const float* z;                 ///< nothing is seen where it is not above 0, or beyond flow::max_distance
  const float* normal;            ///< [moment][height][width][3] of unit length, on either side
  const float *diffuse, *specular, *exponent;
  const std::int32_t* object;
  const std::uint8_t* shadow;     ///< [moment][light][height][width] not 0: the light does not reach it
  const std::uint8_t* sun_shadow;
  bool operator==(const SurfaceArrays&) const = default;
};

/// Into stage 3: what light each pixel receives.
struct LightArrays {
  const float *power, *path_length;   ///< [moment][light][height][width] [W], [m]
  const float* ambient_rate;          ///< [moment][height][width] [e⁻/s]
  bool operator==(const LightArrays&) const = default;
};

/// Into stage 4: ADC codes, or both taps where `raw` is null. [phase][height][width]
struct Recording {
  const std::uint16_t* raw;
  const float *tap_a, *tap_b;
  bool operator==(const Recording&) const = default;
};

struct Input {
  std::int32_t entry;      ///< the first stage that is computed: stage_power, stage_raw or stage_depth
  std::int32_t moments;    ///< 1, or one for each raw frame
  SurfaceArrays surface;
  LightArrays light;
  Recording recording;
  bool operator==(const Input&) const = default;
};

/// Of a moment's image number `image`, the pixels p; a null array is `otherwise` everywhere.
template <class F>
TOFRAY_FN F given(const float* array, const Setup& s, const Pixels& p, int image, float otherwise) {
  return array != nullptr ? num::load<F>(array + p.index + image * s.lens.width * s.lens.height, p.count) : F(otherwise);
}

template <class F>
TOFRAY_FN num::Mask<F> given_mask(const std::uint8_t* array, const Setup& s, const Pixels& p, int image) {
  std::int32_t marks[num::lanes<F>] = {};
  if (array != nullptr) {
    const std::uint8_t* from = array + p.index + image * s.lens.width * s.lens.height;
    for (int i = 0; i < p.count; ++i) marks[i] = from[i];
  }
  return num::load_int<F>(marks, p.count) > num::Int<F>(0);
}

/// The surface that was seen; its normal is turned to the camera.
template <class F>
TOFRAY_FN flow::Surface<F> given_surface(const Setup& s, const SurfaceArrays& in, const Pixels& p, int moment, const flow::Ray<F>& ray) {
  flow::Surface<F> out;
  const F z = given<F>(in.z, s, p, moment, 0.0f);
  out.found = (z > F(0.0f)) & (z <= F(flow::max_distance));
  const auto value = [&](F a) __attribute__((always_inline)) { return num::select(out.found, a, F(0.0f)); };
  trace::put_at(ray, num::select(out.found, z, F(1.0f)), out);
  const auto lane = num::lane_index<F>();
  const auto first = num::Int<F>(3 * (p.index + moment * s.lens.width * s.lens.height)) +
                     num::select(lane < num::Int<F>(p.count), lane, num::Int<F>(0)) * num::Int<F>(3);
  const F nx = value(num::gather(in.normal, first)), ny = value(num::gather(in.normal + 1, first)), nz = value(num::gather(in.normal + 2, first));
  trace::face_camera(nx, ny, nz, ray, out);
  out.diffuse = value(given<F>(in.diffuse, s, p, moment, 0.0f)), out.specular = value(given<F>(in.specular, s, p, moment, 0.0f));
  out.exponent = num::select(out.found, given<F>(in.exponent, s, p, moment, 1.0f), F(1.0f));
  out.object = num::Int<F>(0);
  if (in.object != nullptr) out.object = num::load_int<F>(in.object + p.index + moment * s.lens.width * s.lens.height, p.count);
  return out;
}

struct GivenShadows {
  const Setup& s;
  const SurfaceArrays& in;
  const Pixels& p;
  int moment;

  template <class F>
  TOFRAY_FN num::Mask<F> of_light(int l, const flow::Ray<F>&, const flow::Surface<F>&) const {
    return given_mask<F>(in.shadow, s, p, moment * s.scene.lights + l);
  }
  template <class F>
  TOFRAY_FN num::Mask<F> of_sun(const flow::Surface<F>&) const { return given_mask<F>(in.sun_shadow, s, p, moment); }
};

/// The light that each pixel receives; of the truth, only the power is known.
template <class F>
TOFRAY_FN void given_light(const Setup& s, const LightArrays& in, const Pixels& p, int moment, Lighting<F>& out) {
  out.radiometry = {nan<F>(), nan<F>(), F(0.0f)};
  out.light.total_rate = F(0.0f);
  for (int l = 0; l < s.scene.lights; ++l) {
    const F watts = given<F>(in.power, s, p, moment * s.scene.lights + l, 0.0f);
    out.light.signal_rate[l] = watts * F(s.lights[l].electrons_per_joule);
    out.light.path_length[l] = given<F>(in.path_length, s, p, moment * s.scene.lights + l, 0.0f);
    out.light.total_rate = out.light.total_rate + out.light.signal_rate[l];
    out.radiometry.power = out.radiometry.power + watts;
  }
  out.light.ambient_rate = given<F>(in.ambient_rate, s, p, moment, 0.0f);
}

/// Stages 2 to 4, or 3 and 4.
template <class F>
TOFRAY_FN void enter_before_raw(const Setup& s, const Job& job, const Input& in, const Pixels& p) {
  const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
  const F vignetting = camera::vignetting<F>(s.lens, p);
  raw::Exposure<F> exposure = raw::start<F>(s.sensor, p);
  F difference[flow::max_raw_frames];
  Lighting<F> lighting;
  flow::Surface<F> surface{};
  for (int k = 0; k < s.sensor.raw_frames; ++k) {
    const bool anew = k == 0 || in.moments > 1;
    if (anew) {
      lighting.radiometry = {F(0.0f), F(0.0f), F(0.0f)};
      surface.found = F(1.0f) < F(0.0f);
      if (in.entry == stage_power) {
        surface = given_surface(s, in.surface, p, k, ray);
        hide_outside_lens(vignetting, surface);
        if (s.last_stage >= stage_power) light_up(s, GivenShadows{s, in.surface, p, k}, ray, surface, vignetting, lighting);
      } else {
        given_light(s, in.light, p, k, lighting);
      }
    }
    if (k == (in.moments > 1 ? s.truth_slot : 0)) store_truth(job.out, p, surface, lighting.radiometry, [] { return num::Int<F>(-1); });
    if (s.last_stage >= stage_raw) difference[k] = collect(s, job, p, k, lighting.light, anew, exposure);
  }
  end_frame(s, job, p, ray, difference, exposure, vignetting);
}

/// Stage 4.
template <class F>
TOFRAY_FN void decode_pixels(const Setup& s, const Job& job, const Recording& in, const Pixels& p) {
  F difference[flow::max_raw_frames];
  num::Mask<F> clipped = F(1.0f) < F(0.0f);
  const camera::SensorView& sensor = s.sensor;
  const F offset = raw::pattern<F>(sensor.offset, p, 0.0f);
  for (int k = 0; k < sensor.raw_frames; ++k) {
    const std::int32_t at = p.index + k * s.lens.width * s.lens.height;
    num::Mask<F> over = F(1.0f) < F(0.0f);
    F level = F(sensor.max_code) + F(1.0f);   // of a code at an end of the ADC only the taps could tell that it was not held there
    if (in.tap_a != nullptr) {
      const F a = num::load<F>(in.tap_a + at, p.count), b = num::load<F>(in.tap_b + at, p.count);
      const auto charges = (num::abs(a) <= F(flow::max_charge)) & (num::abs(b) <= F(flow::max_charge));
      const raw::Means<F> charge{num::select(charges, a, F(0.0f)), num::select(charges, b, F(0.0f))};
      level = raw::read_out(sensor, charge, offset).level;
      difference[k] = raw::held_to_codes(sensor, charge.a - charge.b, offset);
      over = (!charges) | (a >= F(sensor.full_well)) | (b >= F(sensor.full_well));
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
  find_depth(s, job, p, camera::ray<F>(s.lens, p), difference, clipped, raw::pattern<F>(s.decoder.delay, p, 0.0f), camera::vignetting<F>(s.lens, p));
}

template <class F>
TOFRAY_FN void enter(const Setup& s, const Job& job, const Input& in, const Pixels& p) {
  if (in.entry == stage_depth) {
    decode_pixels<F>(s, job, in.recording, p);
  } else {
    enter_before_raw<F>(s, job, in, p);
  }
}

}  // namespace tofray::pipeline
