// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "files/npz.h"
#include "support/tool.h"

/// `tofray preview`: a frame as a picture, also for slides.
namespace tofray::test {
namespace {

/// A folder with the frames of a small sensor.
class preview_command : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(ran(with_small_sensor({"render", "corner", "-o", "one", "--seed", "3", "--bounces", "1", "--samples", "4"})).code, 0);
  }
  [[nodiscard]] Result ran(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }
  [[nodiscard]] std::string made(const char* name) const { return content(folder_ / name); }

  Folder folder_;
};

TEST_F(preview_command, of_a_file_is_the_picture_that_render_wrote) {
  ASSERT_EQ(ran({"preview", "one/frame.npz", "-o", "a.png"}).code, 0);
  EXPECT_EQ(made("a.png"), made("one/preview.png"));
  ASSERT_EQ(ran({"preview", "one", "--raw", "-o", "r.png"}).code, 0) << "a folder stands for its frame.npz";
  EXPECT_EQ(made("r.png"), made("one/raw.png"));
  const Arguments render = with_small_sensor({"render", "corner", "-o", "two", "--seed", "3", "--bounces", "1", "--samples", "4"});
  Arguments large = render;
  large.insert(large.end(), {"--scale", "2", "--theme", "light"});
  ASSERT_EQ(ran(large).code, 0);
  ASSERT_EQ(ran({"preview", "one", "-o", "b.png", "--scale", "2", "--theme", "light"}).code, 0);
  EXPECT_EQ(made("b.png"), made("two/preview.png"));
}

TEST_F(preview_command, of_a_frame_of_a_series_says_which_it_is) {
  ASSERT_EQ(ran(with_small_sensor({"render", "card", "-o", "film", "--frames", "2", "--emit", "npz,png"})).code, 0);
  for (const char* frame : {"0000", "0001"}) {
    ASSERT_EQ(ran({"preview", std::string("film/frame_") + frame + ".npz", "-o", "f.png"}).code, 0);
    EXPECT_EQ(made("f.png"), content(folder_ / (std::string("film/preview_") + frame + ".png")));
  }
  const Result result = ran({"preview", "film", "-o", "f.png"});
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has(result.err, "name one, as in `tofray preview film/frame_0000.npz`")) << result.err;
}

TEST_F(preview_command, of_a_scene_is_simulated_now) {
  ASSERT_EQ(ran(with_small_sensor({"preview", "corner", "-o", "a.png", "--seed", "3", "--bounces", "1", "--samples", "4"})).code, 0);
  EXPECT_EQ(made("a.png"), made("one/preview.png"));
  ASSERT_EQ(ran(with_small_sensor({"preview", "corner", "--raw", "-o", "r.png", "--seed", "3", "--bounces", "1", "--samples", "4"})).code,
            0);
  EXPECT_EQ(made("r.png"), made("one/raw.png"));
}

TEST_F(preview_command, becomes_what_the_name_ends_in) {
  const Result svg = ran({"preview", "one", "-o", "slide.svg"});
  ASSERT_EQ(svg.code, 0);
  EXPECT_EQ(svg.out, "");
  EXPECT_EQ(svg.err, "open slide.svg\n");
  EXPECT_TRUE(made("slide.svg").starts_with("<svg "));
  EXPECT_TRUE(has(made("slide.svg"), ">corner seen by pico-flexx MODE_9_5FPS_2000</text>"));
  const Result quiet = ran({"preview", "one", "-o", "slide.PDF", "-q"});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.err, "");
  EXPECT_TRUE(made("slide.PDF").starts_with("%PDF-"));
}

TEST_F(preview_command, without_a_file_shows_z_in_the_terminal) {
  const Result result = ran({"preview", "one"});
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(has(result.out, " m\n\ncorner seen by pico-flexx MODE_9_5FPS_2000\n")) << result.out;
  EXPECT_GT(std::count(result.out.begin(), result.out.end(), '\n'), 10);
}

TEST_F(preview_command, of_what_lacks_arrays_names_these) {
  ASSERT_EQ(ran(with_small_sensor({"render", "card", "-o", "few", "--arrays", "raw,z_m"})).code, 0);
  const Result result = ran({"preview", "few", "-o", "a.svg"});
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has(result.err, "few/frame.npz: error: the file has no amplitude_e, flags and noise_m\n")) << result.err;
  EXPECT_EQ(ran({"preview", "few", "--raw", "-o", "a.svg"}).code, 0);
  EXPECT_EQ(ran({"preview", "few", "--raw", "--set", "camera.lens.f_number=1", "-o", "a.svg"}).code, 2) << "a finished file";
  // Without the truth, noise stands in the place of the error.
  ASSERT_EQ(ran(with_small_sensor({"render", "card", "-o", "blind", "--arrays", "z_m,amplitude_e,flags,noise_m"})).code, 0);
  ASSERT_EQ(ran({"preview", "blind", "-o", "a.svg"}).code, 0);
  EXPECT_TRUE(has(made("a.svg"), ">noise [mm]</text>"));
}

TEST_F(preview_command, refuses_arrays_of_other_sizes_and_kinds) {
  const std::string image(4 * 6, '\0'), flags(2 * 6, '\0');
  const auto file = [&](const files::NpyShape& shape, const files::NpyType& type) {
    const std::string odd(4 * 6, '\0');
    write(folder_ / "odd.npz", files::npz_bytes({{"z_m", {'f', 4}, {2, 3}, image},
                                                 {"amplitude_e", type, shape, odd},
                                                 {"flags", {'u', 2}, {2, 3}, flags},
                                                 {"noise_m", {'f', 4}, {2, 3}, image}}));
    return ran({"preview", "odd.npz", "-o", "odd.svg"});
  };
  EXPECT_EQ(file({2, 3}, {'f', 4}).code, 0);
  EXPECT_TRUE(has(made("odd.svg"), ">odd</text>")) << "without meta the file's name is the caption";
  EXPECT_TRUE(has(file({3, 2}, {'f', 4}).err,
                  "array \"amplitude_e\" is no image of the picture's kind\n  got float32 of (3, 2), expected "
                  "float32 of (2, 3)"));
  EXPECT_EQ(file({2, 3}, {'i', 4}).code, 2);
  EXPECT_EQ(file({6}, {'f', 4}).code, 2);
}

}  // namespace
}  // namespace tofray::test
