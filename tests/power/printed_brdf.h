// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "support/pi.h"
#include "tofray/scene.h"

/// Every BRDF, and how densely light is drawn from it, as they are printed: in double, with angles, of a surface whose normal is z.
namespace tofray::brdf_test {

using base::dot;
using base::operator+;
using base::operator-;
using test::pi;

/// Squared distance of two directions at this angle.
inline double apart(double angle) { return 4 * std::pow(std::sin(angle / 2), 2); }
inline double square_gap(const Vec3& a, const Vec3& b) { return dot(a - b, a - b); }

/// Phong's lobe without its factor: cosine of the angle to the mirror direction, to the n. From the distance, for large n.
inline double printed_shine(const Material& m, const Vec3& l, const Vec3& v) {
  const double gap = square_gap(l, {-v[0], -v[1], v[2]});
  return gap >= 2 ? 0 : std::exp(m.exponent * std::log1p(-gap / 2));
}
/// GGX's D: how densely slopes lie about tan²θ of the half vector.
inline double printed_slopes(const Material& m, const Vec3& l, const Vec3& v) {
  const Vec3 s = l + v;
  const double a2 = m.alpha * m.alpha, tan2 = (s[0] * s[0] + s[1] * s[1]) / (s[2] * s[2]), cos2 = 1 / (1 + tan2);
  return 1 / (pi * a2 * cos2 * cos2 * (1 + tan2 / a2) * (1 + tan2 / a2));
}
inline double printed_lambda(const Material& m, double mu) {
  return (std::sqrt(1 + m.alpha * m.alpha * (1 - mu * mu) / (mu * mu)) - 1) / 2;
}
inline double retro_width(const Material& m) { return apart(m.spread_rad) / (std::sqrt(2.0) - 1); }
inline double retro_fall(const Material& m, const Vec3& l, const Vec3& v) { return std::pow(1 + square_gap(l, v) / retro_width(m), 2); }
inline double ground_passes(double mu) { return 1 - std::pow(1 - mu / 2, 5); }

/// D, G2, F and the ground of Ashikhmin and Shirley.
inline double printed_ggx(const Material& m, const Vec3& l, const Vec3& v) {
  const double lh = base::length(l + v) / 2, f0 = m.specular;
  const double masking = 1 / (1 + printed_lambda(m, l[2]) + printed_lambda(m, v[2])), fresnel = f0 + (1 - f0) * std::pow(1 - lh, 5);
  const double ground = 28 * m.diffuse / (23 * pi) * (1 - f0) * ground_passes(l[2]) * ground_passes(v[2]);
  return printed_slopes(m, l, v) * masking * fresnel / (4 * l[2] * v[2]) + ground;
}
inline double printed_oren_nayar(const Material& m, const Vec3& l, const Vec3& v) {
  const double square = m.roughness_rad * m.roughness_rad, a = 1 - 0.5 * square / (square + 0.33), b = 0.45 * square / (square + 0.09);
  const double in = std::acos(std::min(l[2], 1.0)), out = std::acos(std::min(v[2], 1.0));
  const double turn = std::atan2(l[1], l[0]) - std::atan2(v[1], v[0]);
  return m.diffuse / pi * (a + b * std::max(0.0, std::cos(turn)) * std::sin(std::max(in, out)) * std::tan(std::min(in, out)));
}
/// Both directions above the surface.
inline double printed_f_r(const Material& m, const Vec3& l, const Vec3& v) {
  switch (m.brdf) {
    case Material::Brdf::lambert: return m.diffuse / pi;
    case Material::Brdf::phong: return m.diffuse / pi + m.specular * (m.exponent + 2) / (2 * pi) * printed_shine(m, l, v);
    case Material::Brdf::oren_nayar: return printed_oren_nayar(m, l, v);
    case Material::Brdf::ggx: return printed_ggx(m, l, v);
    case Material::Brdf::retro: break;
  }
  return m.diffuse / pi + m.retro / (pi * retro_width(m) * retro_fall(m, l, v) * std::max(l[2], v[2]));
}

/// With what probability light is drawn from the lobe.
inline double printed_share(const Material& m, double mu) {
  switch (m.brdf) {
    case Material::Brdf::phong: return m.specular / (m.diffuse + m.specular);
    case Material::Brdf::ggx: {
      const double ground = m.diffuse * (1 - m.specular) * ground_passes(mu);
      const double mirrors = std::max(m.specular + (1 - m.specular) * std::pow(1 - mu, 5), std::max(0.1 * ground, 1e-6));
      return mirrors / (mirrors + ground);
    }
    case Material::Brdf::retro: {
      const double back = m.retro / (1 + retro_width(m) / 4);
      return back / (m.diffuse + back);
    }
    default: return 0;
  }
}
/// Of the lobe's directions, some of them below the surface. GGX's are those of the normals that v sees, G1·D·(v·h)/(n·v), over 4·v·h.
inline double printed_lobe_pdf(const Material& m, const Vec3& l, const Vec3& v) {
  switch (m.brdf) {
    case Material::Brdf::phong: return (m.exponent + 1) / (2 * pi) * printed_shine(m, l, v);
    case Material::Brdf::ggx: return l[2] + v[2] <= 0 ? 0 : printed_slopes(m, l, v) / ((1 + printed_lambda(m, v[2])) * 4 * v[2]);
    case Material::Brdf::retro: return (1 + retro_width(m) / 4) / (pi * retro_width(m) * retro_fall(m, l, v));
    default: return 0;
  }
}
/// How densely light is drawn, per solid angle: 1 over the whole sphere.
inline double printed_pdf(const Material& m, const Vec3& l, const Vec3& v) {
  const double share = printed_share(m, v[2]), matt = (1 - share) * std::max(l[2], 0.0) / pi;
  return share > 0 ? matt + share * printed_lobe_pdf(m, l, v) : matt;
}

}  // namespace tofray::brdf_test
