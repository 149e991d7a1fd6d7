// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ways that light comes from: how densely each BRDF draws them, what they weigh, and what they add up to.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "brdf/sample.h"
#include "brdf_of.h"
#include "printed_brdf.h"
#include "support/random.h"
#include "support/sanitizers.h"
#include "support/statistics.h"

using namespace tofray;
using base::operator+;
using base::operator*;
using brdf_test::at_angle;
using tofray::base::dot;
using tofray::test::pi;
using tofray::test::Random;

namespace {

using Brdf = Material::Brdf;
using Way = flow::Direction<float>;

Material of_phong(double diffuse, double specular, double exponent) { return {"phong", Brdf::phong, diffuse, specular, exponent}; }
Material of_oren_nayar(double diffuse, double roughness) { return {"rough", Brdf::oren_nayar, diffuse, 0, 1, roughness}; }
Material of_ggx(double diffuse, double f0, double alpha) { return {"ggx", Brdf::ggx, diffuse, f0, 1, 0, alpha}; }
Material of_retro(double diffuse, double retro, double spread) { return {"sheet", Brdf::retro, diffuse, 0, 1, 0, 0.5, retro, spread}; }

Way single(const Vec3& a) { return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])}; }
Vec3 exact(const Way& a) { return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)}; }

/// A surface somewhere in space, and someone who looks at it: what the sampler is given, and the same in double about the normal.
struct Look {
  Way normal, view;
  Vec3 x, y, z;    ///< z is the normal, the view in the plane of x and z
  Vec3 from_view;  ///< the view in these axes

  /// @param rotation  its rows: what the axes are before rounding
  Look(const base::Mat3& rotation, double angle)
      : normal(single(rotation[2])), view(single(std::sin(angle) * rotation[0] + std::cos(angle) * rotation[2])) {
    z = base::normalized(exact(normal));
    const Vec3 v = base::normalized(exact(view)), aside = v + -dot(v, z) * z;
    // Seen from above, the plane is anyone's: any across the normal.
    x = base::normalized(base::length(aside) > 1e-6 ? aside : rotation[0] + -dot(rotation[0], z) * z);
    y = base::cross(z, x);
    from_view = local(view);
  }
  [[nodiscard]] Vec3 local(const Way& a) const {
    const Vec3 d = base::normalized(exact(a));
    return {dot(d, x), dot(d, y), dot(d, z)};
  }
  [[nodiscard]] brdf::Sampled<float> sample(const flow::Finish<float>& finish, float u, float v) const {
    return brdf::sample<float>(finish, normal, view, u, v);
  }
};
Look upright(double angle) { return {{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}, angle}; }

float single_uniform(Random& random) { return static_cast<float>(random.below(1 << 24)) * 0x1p-24f; }

/// The sphere in rows and columns about a lobe's axis. Rows are even in log(1 + |l − axis|²/w²): most of them where a lobe of the width w
/// is, and its tail. A lobe that is narrower along y than along x has its columns closer there.
struct Cells {
  static constexpr int rows = 60, columns = 24;
  Vec3 axis, x, y;
  double width, narrow, reach;

  Cells(const Vec3& about, double w, double y_over_x) : axis(about), width(w * w), narrow(y_over_x), reach(std::log1p(4 / width)) {
    x = base::normalized(base::cross({0, 1, 0}, axis)), y = base::cross(axis, x);
  }
  [[nodiscard]] std::size_t cell_of(const Vec3& l) const {
    const double t = std::log1p(brdf_test::square_gap(l, axis) / width) / reach;
    const double turn = std::atan2(dot(l, y) / narrow, dot(l, x)) / (2 * pi) + 0.5;
    const int row = std::min(static_cast<int>(t * rows), rows - 1), column = std::min(static_cast<int>(turn * columns), columns - 1);
    return static_cast<std::size_t>(row * columns + column);
  }
  /// ∫ of a function of direction over each cell: 48 × 16 midpoints in it.
  template <class Function>
  [[nodiscard]] std::vector<double> integral(const Function& of) const {
    constexpr int fine = 48, along_turn = 16;
    std::vector<double> sums(static_cast<std::size_t>(rows * columns));
    for (int i = 0; i < rows * fine; ++i) {
      const double low = width * std::expm1(reach * i / (rows * fine)), high = width * std::expm1(reach * (i + 1) / (rows * fine));
      const double square = 0.5 * (low + high), along = 1 - square / 2, across = std::sqrt(square * (1 - square / 4));
      for (int k = 0; k < columns * along_turn; ++k) {
        const double turn = ((k + 0.5) / (columns * along_turn) - 0.5) * 2 * pi, c = std::cos(turn), s = narrow * std::sin(turn);
        const double size = c * c + s * s, area = 0.5 * (high - low) * narrow / size * 2 * pi / (columns * along_turn);
        const Vec3 l = along * axis + across * c / std::sqrt(size) * x + across * s / std::sqrt(size) * y;
        sums[static_cast<std::size_t>(i / fine * columns + k / along_turn)] += area * of(l);
      }
    }
    return sums;
  }
};
double sum_of(const std::vector<double>& all) {
  double sum = 0;
  for (const double a : all) sum += a;
  return sum;
}

struct Drawn {
  const char* name;
  Material material;
  double lobe;  ///< about how wide; 0: none, or wide

  friend std::ostream& operator<<(std::ostream& out, const Drawn& one) { return out << one.name; }
};
const Drawn drawn_materials[] = {
    {"lambert", {"", Brdf::lambert, 0.8}, 0},
    {"oren_nayar", of_oren_nayar(0.9, 0.6), 0},
    {"phong_of_exponent_1", of_phong(0.3, 0.6, 1), 1},
    {"phong", of_phong(0.5, 0.2, 30), 0.25},
    {"phong_of_exponent_10000", of_phong(0.1, 0.8, 1e4), 0.014},
    {"plastic", of_ggx(0.6, 0.04, 0.1), 0.2},
    {"rough_metal", of_ggx(0, 0.9, 1), 0},
    {"rough_lacquer", of_ggx(0.8, 0.2, 0.5), 0},
    {"mirror", of_ggx(0, 0.95, 1e-3), 0.002},
    {"varnish", of_ggx(0.7, 0.04, 1e-3), 0.002},
    {"sign", of_retro(0.4, 0.3, 0.006), 0.01},
    {"narrow_sign", of_retro(0.05, 0.9, 1e-3), 1.6e-3},
    {"wide_sign", of_retro(0.3, 0.5, pi / 4), 1.2},
};
const double drawn_degrees[] = {0, 45, 80, 89};

class Sampling : public testing::TestWithParam<std::tuple<Drawn, double>> {
 protected:
  const Material& material = std::get<0>(GetParam()).material;
  const flow::Finish<float> finish = brdf_test::finish_of(material);
  const double angle = std::get<1>(GetParam()) * pi / 180;
  /// About the lobe, or where that is wide about the normal. At grazing incidence GGX's is narrower across than along the plane.
  [[nodiscard]] Cells cells(const Vec3& v) const {
    const double lobe = std::get<0>(GetParam()).lobe;
    if (lobe == 0) return {{0, 0, 1}, 1e4, 1};
    if (material.brdf == Brdf::retro) return {v, lobe, 1};
    const double narrow = material.brdf == Brdf::ggx ? v[2] : 1;
    return {{-v[0], -v[1], v[2]}, lobe * narrow, std::sqrt(narrow)};  // the root: the matt part is to be summed well, too
  }
};
std::string name_of(const testing::TestParamInfo<std::tuple<Drawn, double>>& info) {
  return std::get<0>(info.param).name + std::string("_at_") + std::to_string(static_cast<int>(std::get<1>(info.param)));
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(each, Sampling, testing::Combine(testing::ValuesIn(drawn_materials), testing::ValuesIn(drawn_degrees)), name_of);

// χ² over the cells, with what is drawn below the surface: the printed density is 1 over the whole sphere. A million samples in 5 runs
// of each of 13 × 4 cases: by Šidák z < 5.8 each is one false alarm in a million of all. (TOFRAY_LONG_RAYS: so many in each run; .ci/long: a
// million.)
TEST_P(Sampling, is_as_dense_as_printed) {
  const int samples = test::often_unless("TOFRAY_LONG_RAYS", 200'000);
  const Vec3 view = at_angle(angle, 0);
  const Cells grid = cells(view);
  std::vector<double> expected = grid.integral([&](const Vec3& l) { return brdf_test::printed_pdf(material, l, view); });
  ASSERT_NEAR(sum_of(expected), 1, 1e-3);
  for (double& e : expected) e *= samples;
  for (std::uint64_t run = 0; run < 5; ++run) {
    Random random(100 + run);
    const Look look(random.rotation(), angle);
    std::vector<double> seen(expected.size());
    for (int i = 0; i < samples; ++i) {
      const float u = single_uniform(random), v = single_uniform(random);
      ++seen[grid.cell_of(look.local(look.sample(finish, u, v).light))];
    }
    EXPECT_LT(test::chi_square_z(seen, expected), 5.8) << run;
  }
}

// What comes back: the mean weight of ways spread evenly is the integral of the printed f_r·cos. Their own error is far below 0.2 %.
TEST_P(Sampling, weighs_all_that_comes_back) {
  const Look look = upright(angle);
  const auto back = [&](const Vec3& l) { return l[2] > 0 ? brdf_test::printed_f_r(material, l, look.from_view) * l[2] : 0; };
  const double albedo = sum_of(cells(look.from_view).integral(back));
  const int samples = test::often(250'000);
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const double v = i * 0.61803398874989485;
    sum += static_cast<double>(look.sample(finish, static_cast<float>((i + 0.5) / samples), static_cast<float>(v - std::floor(v))).weight);
  }
  EXPECT_NEAR(sum / samples, albedo, 2e-3 * albedo);
}

// The numbers of the white furnaces (GGX's mirrors all perfect, Phong's lobe at 60°), from weights alone.
TEST(sampling, adds_up_to_the_white_furnaces) {
  const auto back = [](const Material& material, double angle) {
    const flow::Finish<float> finish = brdf_test::finish_of(material);
    const Look look = upright(angle);
    constexpr int side = 500;
    double sum = 0;
    for (int i = 0; i < side * side; ++i) {
      const auto u = static_cast<float>((i % side + 0.5) / side), v = static_cast<float>((i / side + 0.5) / side);
      sum += static_cast<double>(look.sample(finish, u, v).weight);
    }
    return sum / (side * side);
  };
  const double of_mirrors[][2] = {{0.2, 0.789929}, {0.5, 0.698251}, {0.9, 0.683961}, {1, 0.687849}};
  for (const auto& [cosine, known] : of_mirrors) EXPECT_NEAR(back(of_ggx(0, 1, 0.5), std::acos(cosine)), known, 2e-3 * known) << cosine;
  const double of_lobes[][2] = {{1, 0.608998}, {10, 0.504736}, {50, 0.500002}};
  for (const auto& [n, known] : of_lobes) EXPECT_NEAR(back(of_phong(0, 1, n), pi / 3), known, 2e-3 * known) << n;
}

namespace {

Material any_material(Random& random) {
  const double share = random.below(4) == 0 ? random.below(2) : random.uniform(), rest = (1 - share) * random.uniform();
  switch (random.below(5)) {
    case 0: return {"", Brdf::lambert, share};
    case 1: return of_phong(share, rest, random.scale(1, 1e4));
    case 2: return of_oren_nayar(0.95 * share, random.between(0, pi / 2));
    case 3: return of_ggx(share, random.below(4) == 0 ? random.below(2) : random.uniform(), random.scale(1e-3, 1));
    default: return of_retro(share, rest, random.scale(1e-3, pi / 4));
  }
}

/// f_r·cos/pdf as printed, both directions above the surface.
double printed_weight(const Material& m, const Vec3& l, const Vec3& v) {
  return brdf_test::printed_f_r(m, l, v) * l[2] / brdf_test::printed_pdf(m, l, v);
}

/// More than any way weighs, where nothing is rounded. GGX's is what a search found, 1.59, and a little.
double most_weight(const Material& m, double cos_view) {
  const double square = m.roughness_rad * m.roughness_rad;
  switch (m.brdf) {
    case Brdf::lambert: return m.diffuse;
    case Brdf::phong: return (m.diffuse + m.specular) * (m.exponent + 2) / (m.exponent + 1);
    case Brdf::oren_nayar: return m.diffuse * (1 + 0.45 * square / (square + 0.09) / cos_view);
    case Brdf::ggx: return 1.7;
    case Brdf::retro: break;
  }
  return m.diffuse + m.retro;
}

/// What rounding may change of it where lobes are steep: of each direction a digit of each part; of Phong's cosine to the mirror direction,
/// the difference of two products, a digit to the n, which is in both f_r and pdf.
double rounding_of(const Material& m, const Vec3& l, const Vec3& v) {
  const double weight = printed_weight(m, l, v);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 near_l = l, near_v = v;
    near_l[k] += 0x1p-23, near_v[k] += 0x1p-23;
    sum += std::abs(printed_weight(m, base::normalized(near_l), v) - weight) +
           std::abs(printed_weight(m, l, base::normalized(near_v)) - weight);
  }
  if (m.brdf != Brdf::phong) return sum;
  const double of_f_r = 1 - m.diffuse / pi / brdf_test::printed_f_r(m, l, v);
  const double of_pdf = brdf_test::printed_share(m, v[2]) * brdf_test::printed_lobe_pdf(m, l, v) / brdf_test::printed_pdf(m, l, v);
  return sum + weight * std::abs(of_f_r - of_pdf) * m.exponent * 0x1p-22;
}

}  // namespace

// To 1e-5 of what is printed, and rounding.
TEST(sampling, weighs_reflection_by_density) {
  Random random(7);
  int even = 0;
  for (int i = 0; i < test::often(200000); ++i) {
    const Material m = any_material(random);
    if (m.diffuse + m.specular + m.retro == 0) continue;
    const Look look(random.rotation(), random.between(0, random.below(2) == 0 ? 1.3 : 1.56));
    const auto got = look.sample(brdf_test::finish_of(m), single_uniform(random), single_uniform(random));
    const Vec3 l = look.local(got.light), v = look.from_view;
    if (l[2] < 1e-6) {
      EXPECT_LE(got.weight, l[2] < -1e-6 ? 0 : 1e-3) << i;
      continue;
    }
    const double weight = printed_weight(m, l, v);
    const double rounding = rounding_of(m, l, v);
    ASSERT_NEAR(static_cast<double>(got.weight), weight, 1e-5 * weight + rounding) << i << " " << m.name << " " << l[2] << " " << v[2];
    even += rounding < 1e-5 * weight;
  }
  EXPECT_GT(even, test::often(100000));
}

TEST(sampling, of_lambert_weighs_the_reflectivity) {
  Random random(9);
  for (int i = 0; i < 10000; ++i) {
    const float rho = single_uniform(random);
    const Look look(random.rotation(), random.between(0, 1.57));
    EXPECT_EQ(look.sample({rho, {}, 0}, single_uniform(random), single_uniform(random)).weight, rho);
  }
}

// Seen along the normal, each lobe's ways lie on rings whose sines are known. However narrow the lobe and however small u, they keep their digits.
TEST(sampling, keeps_the_digits_of_narrow_lobes) {
  const double width = brdf_test::retro_width(of_retro(0, 1, 1e-3));
  const Look look = upright(0);
  for (int k = 1; k <= 23; ++k) {
    const double u = std::pow(0.5, k);
    const auto sine = [&](const Material& material) {
      const Way way = look.sample(brdf_test::finish_of(material), static_cast<float>(u), 0.1f).light;
      return static_cast<double>(std::hypot(way.x, way.y));
    };
    const auto beside = [](double square) { return std::sqrt(square * (1 - square / 4)); };
    const double phong = beside(-2 * std::expm1(std::log1p(-u) / 10001)), retro = beside(u / ((1 - u) / width + 0.25));
    const double ggx = std::sin(2 * std::atan(1e-3 * std::sqrt(u / (1 - u))));  // tan²θ of the half vector is α²u/(1 − u)
    EXPECT_NEAR(sine(of_phong(0, 1, 1e4)), phong, 2e-6 * phong) << k;
    for (const double exponent : {1.0, 10.0, 100.0}) {
      const double wide = beside(-2 * std::expm1(std::log1p(-u) / (exponent + 1)));
      EXPECT_NEAR(sine(of_phong(0, 1, exponent)), wide, 4e-6 * wide) << exponent << " " << k;
    }
    EXPECT_NEAR(sine(of_ggx(0, 1, 1e-3)), ggx, 2e-6 * ggx) << k;
    EXPECT_NEAR(sine(of_retro(0, 1, 1e-3)), retro, 2e-6 * retro) << k;
  }
}

// Everything at its limits at once: directions are of unit length, weights are numbers, no more than the bound, and 0 below the surface.
TEST(sampling, is_good_at_the_limits_of_every_number) {
  const float shares[] = {0.0f, 0x1p-24f, 0.001f, 0.25f, 0.5f, 0.75f, 0.9f, 0.999f, 1 - 0x1p-23f, 1 - 0x1p-24f};
  const Vec3 normals[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0.6, 0.8, -1e-9}, {1e-4, 0, -1}, {0.36, -0.48, 0.8}};
  std::vector<Material> materials;
  for (const double diffuse : {0.0, 1e-6, 0.5, 1.0}) {
    materials.push_back({"lambert", Brdf::lambert, diffuse});
    for (const double roughness : {0.0, 1e-3, 0.5, pi / 2}) materials.push_back(of_oren_nayar(0.9 * diffuse, roughness));
    for (const double other : {0.0, 1e-6, 0.5, 1.0}) {
      for (const double alpha : {1e-3, 0.03, 1.0}) materials.push_back(of_ggx(diffuse, other, alpha));
      if (diffuse + other > 1) continue;
      for (const double exponent : {1.0, 100.0, 1e4}) materials.push_back(of_phong(diffuse, other, exponent));
      for (const double spread : {1e-3, 0.03, pi / 4}) materials.push_back(of_retro(diffuse, other, spread));
    }
  }
  for (const Material& material : materials) {
    const flow::Finish<float> finish = brdf_test::finish_of(material);
    for (const double cosine : {1.0, 0.9999999, 0.7, 0.02, 1e-3, 1e-4, 1e-7}) {
      for (const Vec3& normal : normals) {
        const Vec3 z = base::normalized(normal), x = base::normalized(base::cross({0.1, 0.2, 0.3}, z));
        const Look look({{x, base::cross(z, x), z}}, std::acos(cosine));
        const double most = most_weight(material, std::max(look.from_view[2], 1e-7));
        for (const float u : shares) {
          for (const float v : shares) {
            const auto got = look.sample(finish, u, v);
            const Vec3 l = exact(got.light);
            const auto where = [&] {
              return ::testing::Message() << material.name << " " << material.diffuse << " " << material.specular << " " << cosine << " "
                                          << u << " " << v << ": " << l[0] << " " << l[1] << " " << l[2];
            };
            ASSERT_NEAR(base::length(l), 1, 1e-6) << where();
            ASSERT_GE(got.weight, 0) << where();
            ASSERT_LE(static_cast<double>(got.weight), most * (1 + 1e-2) + 1e-6) << where();
            if (look.local(got.light)[2] < -3e-7) {
              ASSERT_EQ(got.weight, 0) << where();
            }
          }
        }
      }
    }
  }
}

// Light that goes from mirror to mirror: each way is the next one's view, and what rounding adds to its length does not add up.
TEST(sampling, keeps_directions_of_unit_length_from_bounce_to_bounce) {
  Random random(13);
  for (const Material& material : {of_ggx(0, 1, 0.1), of_phong(0, 1, 50), of_retro(0, 1, 0.3)}) {
    const flow::Finish<float> finish = brdf_test::finish_of(material);
    Way view{0, 0, 1};
    for (int i = 0; i < 10000; ++i) {
      Way normal = single(random.direction());
      if (normal.x * view.x + normal.y * view.y + normal.z * view.z < 0) normal = {-normal.x, -normal.y, -normal.z};
      view = brdf::sample<float>(finish, normal, view, single_uniform(random), single_uniform(random)).light;
      ASSERT_NEAR(base::length(exact(view)), 1, 1e-6) << material.name << " " << i;
    }
  }
}
