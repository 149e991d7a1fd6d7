// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <zip.h>

#include <bit>
#include <clocale>
#include <cstring>

#include "base/limits.h"
#include "files/data_limits.h"
#include "files/npy.h"
#include "files/npz.h"
#include "results/frame_file.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using namespace tofray::results;
using out_test::error_of;
using out_test::Python;
using out_test::TemporaryFolder;

namespace {

constexpr PoseMatrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// −0, subnormals, infinities, both extremes and NaNs with payload and sign.
template <class T, class Bits>
std::vector<T> special_values() {
  std::vector<T> values = {T(0),
                           T(-0.0),
                           std::numeric_limits<T>::denorm_min(),
                           -std::numeric_limits<T>::denorm_min(),
                           std::numeric_limits<T>::min() / 3,
                           std::numeric_limits<T>::max(),
                           std::numeric_limits<T>::lowest(),
                           std::numeric_limits<T>::infinity(),
                           T(0.1)};
  const auto quiet = std::bit_cast<Bits>(std::numeric_limits<T>::quiet_NaN());
  values.push_back(std::bit_cast<T>(static_cast<Bits>(quiet | 0x1234)));
  values.push_back(std::bit_cast<T>(static_cast<Bits>(quiet | (Bits{1} << (8 * sizeof(T) - 1)) | 7)));
  return values;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

TEST(npy, keeps_every_bit_of_special_values) {
  const auto f = special_values<float, std::uint32_t>();
  const auto d = special_values<double, std::uint64_t>();
  const std::string file = npz_bytes({npy_view("f", {f.size()}, f), npy_view("d", {1, d.size()}, d)});
  const auto back = parse_npz(file, "memory");
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].array.bytes, bytes_of(f));
  EXPECT_EQ(back[1].array.bytes, bytes_of(d));
  EXPECT_EQ(back[1].array.shape, (NpyShape{1, d.size()}));
}

TEST(npy, header_is_what_the_format_says) {
  const std::string header = npy_header(npy_type_of<float>(), {3, 172, 224});
  EXPECT_EQ(header.size() % 64, 0U);
  EXPECT_EQ(header.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(header.substr(10, 66), "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 172, 224), }");
  EXPECT_EQ(header.back(), '\n');
  EXPECT_EQ(npy_header({'b', 1}, {5}).substr(10, 59), "{'descr': '|b1', 'fortran_order': False, 'shape': (5,), }  ");
}

TEST(npy, fortran_order_and_big_endian_are_turned) {
  // a[i][j] = 10 i + j, 2 × 3, first index fastest, big endian
  std::string file("\x93NUMPY\x01\x00", 8);
  const std::string dictionary = "{\"shape\":(2,3),'fortran_order':True,'descr':'>u2'}\n";
  file += static_cast<char>(dictionary.size());
  file += '\0';
  file += dictionary;
  for (const int value : {0, 10, 1, 11, 2, 12}) file += std::string{'\0', static_cast<char>(value)};
  const NpyArray array = parse_npy(file, "memory");
  EXPECT_EQ(array.bytes, bytes_of(std::vector<std::uint16_t>{0, 1, 2, 10, 11, 12}));
  EXPECT_EQ(array.number(4), 11.0);
}

TEST(npy, text_goes_through_utf32) {
  const std::string text = "σ = 1 µm, 東京, \xF0\x9F\x93\xB7";
  const std::string bytes = utf32_of(text);
  const NpyArray array = parse_npy(npy_header({'U', static_cast<int>(bytes.size())}, {}) + bytes, "memory");
  EXPECT_EQ(array.text(), text);
  EXPECT_EQ((NpyArray{{'U', 8}, {}, utf32_of("\xFF\xC0")}.text()), "\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(npy, text_has_each_character_s_shortest_form) {
  // the first and the last of each length
  const std::vector<std::uint32_t> codes = {0x1, 0x7F, 0x80, 0x7FF, 0x800, 0xD7FF, 0xE000, 0xFFFF, 0x10000, 0x10FFFF};
  const std::string text = "\x01\x7F\xC2\x80\xDF\xBF\xE0\xA0\x80\xED\x9F\xBF\xEE\x80\x80\xEF\xBF\xBF\xF0\x90\x80\x80\xF4\x8F\xBF\xBF";
  EXPECT_EQ((NpyArray{{'U', static_cast<int>(4 * codes.size())}, {}, bytes_of(codes)}.text()), text);
  EXPECT_EQ(utf32_of(text), bytes_of(codes));
  for (const char* bad : {"\xF5\x80\x80\x80", "\xF8\x80\x80\x80", "\xC1\x80\x80\x80", "\xE0\x9F\x80\x80", "\xF0\x8F\x80\x80"})
    EXPECT_EQ(utf32_of(bad), bytes_of(std::vector<std::uint32_t>(4, 0xFFFD))) << "a byte at a time";
  // beyond the last, and halves of a pair of UTF-16
  EXPECT_EQ((NpyArray{{'U', 12}, {}, bytes_of(std::vector<std::uint32_t>{0x110000, 0xD800, 0xDFFF})}.text()),
            "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST(npy, refuses_what_it_cannot_hold) {
  const auto header_of = [](const std::string& dictionary) {
    std::string file("\x93NUMPY\x01\x00", 8);
    file += static_cast<char>(dictionary.size());
    file += '\0';
    return file + dictionary;
  };
  const auto message = [&](const std::string& file) { return std::string(error_of([&] { (void)parse_npy(file, "x.npy"); }).what()); };
  EXPECT_NE(message(header_of("{'descr': '|O', 'fortran_order': False, 'shape': (3,), }")).find("\"|O\" is not read"), std::string::npos);
  EXPECT_NE(message(header_of("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (3,), }")).find("records"), std::string::npos);
  EXPECT_NE(message(header_of("{'descr': '<c8', 'fortran_order': False, 'shape': (3,), }")).find("\"<c8\" is not read"), std::string::npos);
  EXPECT_NE(message(header_of("{'descr': '<f4', 'fortran_order': False, 'shape': (3,), }") + "123").find("cut short"), std::string::npos);
  EXPECT_NE(message(header_of("{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }") + "12345").find("not its own"),
            std::string::npos);
  for (const char* dictionary :
       {"'descr': '<f4', 'fortran_order': False, 'shape': (3,), }", "{'descr' '<f4', 'fortran_order': False, 'shape': (3,), }",
        "{'descr': '<f4' 'fortran_order': False, 'shape': (3,), }", "{'descr': '<f4', 'fortran_order': False, 'shape': 3,), }",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (3 4), }", "{'descr': '<f4', 'fortran_order': False, 'shape': (3,)"})
    EXPECT_NE(message(header_of(dictionary)).find("the array's header is malformed"), std::string::npos) << message(header_of(dictionary));
  EXPECT_NE(message("PK\x03\x04 and so on").find("not a .npy array"), std::string::npos);
  EXPECT_NE(message(std::string("\x93NUMPY\x09\x00 0 0 0 0", 16)).find("version 9"), std::string::npos);
  // declared sizes that overflow 64 bits, or only memory
  for (const char* shape :
       {"(4294967296, 4294967296, 4)", "(999999999999,)", "(100000000000000000,100000000000000000)", "(18446744073709551617,)"}) {
    const Error error = error_of(
        [&] { (void)parse_npy(header_of(std::string("{'descr': '<f4', 'fortran_order': False, 'shape': ") + shape + ", }"), "x.npy"); });
    EXPECT_EQ(error.kind(), ErrorKind::limit) << shape;
  }
  EXPECT_EQ(
      error_of([&] { (void)parse_npy(header_of("{'descr': '<f4', 'fortran_order': False, 'shape': (1,1,1,1,1,1,1,1,1), }"), "x"); }).kind(),
      ErrorKind::limit);
}

TEST(npz, with_an_array_of_no_values_is_whole) {
  const std::vector<float> none;
  for (const Packing packing : {Packing::stored, Packing::deflated}) {
    const std::vector<NamedArray> back =
        parse_npz(npz_bytes({npy_view("none", {0, 3}, none), npy_view("more", {0}, none)}, packing), "x.npz");
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[0].array.shape, (NpyShape{0, 3}));
    EXPECT_TRUE(back[0].array.bytes.empty());
  }
}

TEST(npz, with_two_arrays_of_one_name_is_refused) {
  const std::vector<std::uint8_t> data = {7};
  const std::string file = npz_bytes({npy_view("a", {1}, data), npy_view("b", {1}, data), npy_view("a", {1}, data)});
  EXPECT_EQ(error_of([&] { (void)parse_npz(file, "x.npz"); }).kind(), ErrorKind::bad_input);
}

TEST(npz, has_as_many_arrays_as_the_limit_and_no_more) {
  const std::vector<std::uint8_t> data = {7};
  std::vector<std::string> names;
  for (int i = 0; i < 4097; ++i) names.push_back("a" + std::to_string(i));
  const auto archive = [&](std::size_t count) {
    std::vector<NpyView> views;
    for (std::size_t i = 0; i < count; ++i) views.push_back(npy_view(names[i].c_str(), {1}, data));
    return npz_bytes(views);
  };
  EXPECT_EQ(parse_npz(archive(4096), "full.npz").size(), 4096U);
  const Error error = error_of([&] { (void)parse_npz(archive(4097), "over.npz"); });
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_NE(std::string(error.what()).find("the zip has 4097 entries, more than 4096"), std::string::npos);
}

TEST(npz, has_the_same_bytes_each_time_and_in_every_time_zone) {
  const std::vector<float> data = {1, 2, 3};
  const char* before = std::getenv("TZ");
  const std::string zone = before != nullptr ? before : "";
  std::vector<std::string> files;
  for (const char* tz : {"UTC", "Asia/Kolkata", "America/St_Johns", "Pacific/Kiritimati", "XYZ+11:30ABC,M3.2.0,M11.1.0"}) {
    setenv("TZ", tz, 1);
    tzset();
    files.push_back(npz_bytes({npy_view("a", {3}, data), npy_view("b", {3, 1}, data)}));
  }
  before != nullptr ? setenv("TZ", zone.c_str(), 1) : unsetenv("TZ");
  tzset();
  for (const std::string& file : files) EXPECT_EQ(file, files[0]);
}

TEST(npz, frame_is_read_by_numpy_with_every_name_type_and_shape) {
  const Python python;
  if (!python.there()) GTEST_SKIP() << "no /usr/bin/python3 with numpy";
  TemporaryFolder folder;
  write_frame_npz(folder.file("frame.npz"), out_test::sample_frame(24, 16), out_test::sample_camera(24, 16), identity,
                  R"({"seed": 7, "µ": "σ"})");
  EXPECT_EQ(python.run(R"py(
import sys, json, zipfile, numpy as np
path = sys.argv[1]
f = np.load(path)
p, h, w = 9, 16, 24
expected = dict(tap_a=('f4', (p,h,w)), tap_b=('f4', (p,h,w)), raw=('u2', (p,h,w)), modulation_frequency_hz=('f8', (p,)), reference_phase_rad=('f8', (p,)),
  integration_time_s=('f8', (p,)), start_time_s=('f8', (p,)), lit=('?', (p,)), z_m=('f4', (h,w)), range_m=('f4', (h,w)), points_m=('f4', (h,w,3)),
  amplitude_e=('f4', (h,w)), ambient_e=('f4', (h,w)), noise_m=('f4', (h,w)), confidence=('u1', (h,w)), amplitude_by_frequency_e=('f4', (1,h,w)), range_by_frequency_m=('f4', (1,h,w)), cycle_by_frequency=('i4', (1,h,w)), flags=('u2', (h,w)), gt_time_s=('f8', ()),
  gt_range_m=('f4', (h,w)), gt_z_m=('f4', (h,w)), gt_reflectivity=('f4', (h,w)), gt_position_m=('f4', (h,w,3)), gt_normal=('f4', (h,w,3)),
  gt_object_id=('i4', (h,w)), gt_material_id=('i4', (h,w)),
  gt_class_id=('i4', (h,w)), gt_triangle_id=('i4', (h,w)), gt_texcoord=('f4', (h,w,2)), gt_velocity_m_per_s=('f4', (h,w,3)), gt_flow_px=('f4', (h,w,2)), gt_mixed=('u1', (h,w)), gt_object_share=('f4', (h,w)), gt_irradiance_w_m2=('f4', (h,w)), gt_radiance_w_m2_sr=('f4', (h,w)), gt_power_w=('f4', (h,w)), gt_ambient_e_per_s=('f4', (h,w)), gt_signal_e=('f4', (p,h,w)), gt_direct_e=('f4', (p,h,w)), gt_indirect_e=('f4', (p,h,w)), gt_raw_dn=('f4', (p,h,w)), gt_raw_direct_dn=('f4', (p,h,w)), gt_phase_flow_px=('f4', (p,h,w,2)), gt_multipath_m=('f4', (p,h,w)), gt_path_noise_m=('f4', (p,h,w)), gt_path_count=('i4', (h,w)), transient_e_per_s=('f4', (2,h,w)), transient_lost_e_per_s=('f4', (h,w)),
  camera_matrix=('f8', (3,3)), distortion=('f8', (5,)), camera_pose=('f8', (4,4)))
assert set(f.files) == set(expected) | {'meta'}, set(f.files) ^ set(expected)
for name, (dtype, shape) in expected.items():
  assert f[name].dtype == np.dtype(dtype) and f[name].shape == shape, (name, f[name].dtype, f[name].shape)
assert f['meta'].dtype.kind == 'U' and f['meta'].shape == () and json.loads(str(f['meta'])) == {'seed': 7, 'µ': 'σ'}
assert f['lit'].tolist() == [False] + [True] * 8 and f['modulation_frequency_hz'][5] == 60.24e6
assert f['camera_matrix'].tolist() == [[0.95*24, 0, 11.5], [0, 0.95*24, 7.5], [0, 0, 1]] and f['distortion'].tolist() == [-0.3, 0, 0, 0, 0]
assert np.isnan(f['z_m'][0, 0]) and f['gt_object_id'][0, 0] == -1 and np.array_equal(f['camera_pose'], np.eye(4))
assert np.array_equal(f['points_m'][..., 2], f['z_m'], equal_nan=True)
for entry in zipfile.ZipFile(path).infolist():
  assert entry.compress_type == 0 and entry.date_time == (1980, 1, 1, 0, 0, 0), entry
assert zipfile.ZipFile(path).testzip() is None
)py",
                       folder.file("frame.npz")),
            0);
}

TEST(npz, special_values_arrive_in_numpy_bit_by_bit) {
  const Python python;
  if (!python.there()) GTEST_SKIP() << "no /usr/bin/python3 with numpy";
  TemporaryFolder folder;
  const auto f = special_values<float, std::uint32_t>();
  const auto d = special_values<double, std::uint64_t>();
  std::vector<std::uint32_t> f_bits(f.size());
  std::memcpy(f_bits.data(), f.data(), 4 * f.size());
  std::vector<std::uint64_t> d_bits(d.size());
  std::memcpy(d_bits.data(), d.data(), 8 * d.size());
  out_test::write_file(folder.file("x.npz"), npz_bytes({npy_view("f", {f.size()}, f), npy_view("fb", {f.size()}, f_bits),
                                                        npy_view("d", {d.size()}, d), npy_view("db", {d.size()}, d_bits)}));
  EXPECT_EQ(python.run(R"py(
import sys, numpy as np
f = np.load(sys.argv[1])
assert np.array_equal(f['f'].view('u4'), f['fb']) and np.array_equal(f['d'].view('u8'), f['db'])
)py",
                       folder.file("x.npz")),
            0);
}

TEST(npz, what_numpy_writes_is_read_stored_deflated_fortran_and_big_endian) {
  const Python python;
  if (!python.there()) GTEST_SKIP() << "no /usr/bin/python3 with numpy";
  TemporaryFolder folder;
  ASSERT_EQ(python.run(R"py(
import sys, numpy as np
a = np.arange(24, dtype='f4').reshape(2, 3, 4) / 8
arrays = dict(c=a, f=np.asfortranarray(a), big=a.astype('>f8'), i=a.astype('>i2'), text=np.array('h\u00e9'), t=a > 1, empty=np.zeros((0, 3), 'u8'), scalar=np.float64(2.5))
np.savez(sys.argv[1] + '/stored.npz', **arrays)
np.savez_compressed(sys.argv[1] + '/deflated.npz', **arrays, zeros=np.zeros((500, 500)))
np.save(sys.argv[1] + '/one.npy', np.asfortranarray(a))
)py",
                       folder.path().string()),
            0);
  std::vector<float> expected(24);
  for (std::size_t i = 0; i < 24; ++i) expected[i] = static_cast<float>(i) / 8;
  for (const char* name : {"stored.npz", "deflated.npz"}) {
    for (const NamedArray& entry : read_npz(folder.file(name))) {
      SCOPED_TRACE(entry.name);
      if (entry.name == "c" || entry.name == "f") {
        EXPECT_EQ(entry.array.bytes, bytes_of(expected));
      }
      if (entry.name == "big") {
        EXPECT_EQ(entry.array.number(23), 23 / 8.0);
      }
      if (entry.name == "i") {
        EXPECT_EQ(entry.array.number(23), 2.0);
      }
      if (entry.name == "text") {
        EXPECT_EQ(entry.array.text(), "h\xC3\xA9");
      }
      if (entry.name == "t") {
        EXPECT_EQ(entry.array.number(9), 1.0);
      }
      if (entry.name == "empty") {
        EXPECT_EQ(entry.array.count(), 0U);
      }
      if (entry.name == "scalar") {
        EXPECT_EQ(entry.array.number(0), 2.5);
      }
      if (entry.name == "zeros") {
        EXPECT_EQ(entry.array.count(), 250000U);
      }
    }
    EXPECT_EQ(read_npz(folder.file(name), {"scalar", "c"}).size(), 2U);
  }
  EXPECT_EQ(read_npz(folder.file("deflated.npz")).size(), 9U);
  EXPECT_EQ(read_npy(folder.file("one.npy")).bytes, bytes_of(expected));
}

TEST(npz, mutated_files_give_errors_and_never_more) {
  Frame frame = out_test::sample_frame(6, 4);
  const std::string good = frame_npz_bytes(frame, out_test::sample_camera(6, 4), identity, "{}");
  const std::vector<float> values(40, 1.5F);
  const std::string npy = npy_header(npy_type_of<float>(), {5, 8}) + bytes_of(values);
  out_test::Random random(11);
  int refused = 0, taken = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const bool zip = trial % 3 != 0;
    std::string file = zip ? good : npy;
    if (random.below(4) == 0) file.resize(random.below(file.size()));
    // the headers and the zip's directory are where lies matter: half of the changes go there
    for (std::size_t changes = 1 + random.below(6); changes-- > 0 && !file.empty();) {
      const std::size_t span = random.below(2) == 0 ? file.size() : std::min<std::size_t>(file.size(), 200);
      const std::size_t at =
          random.below(2) == 0 ? random.below(span) : file.size() - 1 - random.below(std::min<std::size_t>(file.size(), 3000));
      file[at] = static_cast<char>(random.below(3) == 0 ? 0xFF : random.next());
    }
    try {
      zip ? (void)parse_npz(file, "mutated") : (void)parse_npy(file, "mutated");
      ++taken;
    } catch (const Error& error) {
      EXPECT_TRUE(error.kind() == ErrorKind::bad_input || error.kind() == ErrorKind::limit) << error.what();
      EXPECT_EQ(std::string(error.what()).rfind("mutated", 0), 0U) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(taken, 0);
}

TEST(npz, a_bomb_is_refused_before_it_is_unpacked) {
  // an entry that says it unpacks to 3 GB from 40 bytes: the directory's size is changed by hand
  const std::vector<float> data(4, 0.F);
  std::string file = npz_bytes({npy_view("a", {4}, data)});
  const std::size_t directory = file.rfind("PK\x01\x02");
  ASSERT_NE(directory, std::string::npos);
  const std::uint32_t size = 3'000'000'000U;
  file[directory + 10] = 8;  // deflated
  file[26 - 18] = 8;
  std::memcpy(file.data() + directory + 24, &size, 4);
  std::memcpy(file.data() + 22, &size, 4);
  const Error error = error_of([&] { (void)parse_npz(file, "bomb.npz"); });
  EXPECT_EQ(error.kind(), ErrorKind::limit) << error.what();
}

/// A deflated archive of noise, which does not pack, and of zeros, which pack a thousandfold.
std::string packed_archive(std::size_t noise_bytes, std::size_t zero_bytes) {
  std::vector<std::uint8_t> noise(noise_bytes);
  out_test::Random random(3);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random.next() >> 24);
  const std::vector<std::uint8_t> zeros(zero_bytes);
  return npz_bytes({npy_view("noise", {noise_bytes}, noise), npy_view("zeros", {zero_bytes}, zeros)}, Packing::deflated);
}

TEST(npz, of_any_size_may_unpack_to_its_limit_and_to_no_byte_more) {
  constexpr auto limit = static_cast<std::size_t>(base::limit::unpacked_bytes.value);
  constexpr std::size_t header = 128;  // of each of the two arrays
  EXPECT_EQ(parse_npz(packed_archive(1, limit - 1 - 2 * header), "full.npz").size(), 2U);
  const Error error = error_of([&] { (void)parse_npz(packed_archive(1, limit - 2 * header), "over.npz"); });
  EXPECT_EQ(error.kind(), ErrorKind::limit) << error.what();
  EXPECT_NE(std::string(error.what()).find("over.npz: error: the arrays unpack to more than 67108864 bytes"), std::string::npos)
      << error.what();
}

TEST(npz, of_a_larger_file_may_unpack_to_a_multiple_of_its_size_and_to_little_more) {
  constexpr auto ratio = static_cast<std::size_t>(base::limit::unpacked_ratio.value);
  constexpr std::size_t noise = 1'000'000;
  // Zeros add a thousandth of their size: the file is 1.1 MB, and a hundred times that is more than the limit of small ones.
  const std::size_t size = packed_archive(noise, 100 * noise).size(), zeros = ratio * size - noise;
  ASSERT_GT(ratio * size, static_cast<std::size_t>(base::limit::unpacked_bytes.value));
  EXPECT_EQ(parse_npz(packed_archive(noise, zeros / 100 * 99), "full.npz").size(), 2U);
  const Error error = error_of([&] { (void)parse_npz(packed_archive(noise, zeros / 100 * 102), "over.npz"); });
  EXPECT_EQ(error.kind(), ErrorKind::limit) << error.what();
}
