// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// `tofray budget` says what the library says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "files/json.h"
#include "support/pi.h"
#include "support/tool.h"
#include "tofray/budget.h"
#include "tofray/load.h"

namespace tofray::test {
namespace {

double number_of(const files::Json& json, const char* key) {
  double out = std::nan("");
  EXPECT_TRUE(json.find(key) != nullptr && json.find(key)->number(out)) << key;
  return out;
}

BudgetRow asked_row() {
  BudgetRequest request;
  request.distances_m = {1.5}, request.reflectivities = {0.3}, request.angle_rad = 20 * pi / 180, request.temperature_celsius = 60;
  request.pixel = {{5, 7}};
  AmbientCase light;
  light.ambient.spectrum = Ambient::Spectrum::sun_am15, light.ambient.quantity = Ambient::Quantity::illuminance_lx;
  light.ambient.amount = 5000;
  request.ambients = {light};
  return budget(load_camera("flexx2", {"MODE_9_30FPS", {{"lens.f_number", "1.5"}}, {}}), request).at(0);
}

// Every option reaches the library, in its unit.
TEST(budget_command, says_the_row_that_its_options_ask_for) {
  const Result result =
      run({"budget", "flexx2", "--mode", "MODE_9_30FPS", "--set", "lens.f_number=1.5", "--distance", "1.5m", "--reflectivity", "30%",
           "--ambient", "5klx", "--angle", "20deg", "--temperature", "60C", "--pixel", "5,7", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "budget");
  const files::Json& row = json.find("rows")->items()->at(0);
  const BudgetRow expected = asked_row();
  EXPECT_EQ(number_of(row, "sigma_m"), expected.sigma_m);
  EXPECT_EQ(number_of(row, "range_m"), expected.range_m);
  EXPECT_EQ(number_of(row, "dark_e"), expected.dark_e);
  EXPECT_EQ(number_of(row, "bias_m"), expected.bias_m);
  EXPECT_EQ(number_of(row, "share_ambient_shot"), expected.share.ambient_shot);
  EXPECT_EQ(number_of(row.find("frequencies")->items()->at(1), "sigma_m"), expected.frequencies[1].sigma_m);
  EXPECT_FALSE(*row.find("saturated")->boolean());
}

TEST(budget_command, writes_a_line_for_each_row) {
  const Folder folder;
  const Arguments asked = {"budget", "pico-flexx", "--distance", "0.1m:5m:50", "--reflectivity", "10%,80%", "--ambient", "none,20klx"};
  Arguments to_file = asked, to_stdout = asked;
  to_file.insert(to_file.end(), {"-o", "budget.csv"}), to_stdout.emplace_back("--csv");
  EXPECT_EQ(run(to_file, in_folder(folder.path())).out, "");
  const std::string text = run(to_stdout).out;
  EXPECT_EQ(content(folder / "budget.csv"), text);
  std::istringstream lines(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  ASSERT_EQ(all.size(), 201U);
  const auto commas = std::count(all[0].begin(), all[0].end(), ',');
  for (const std::string& line : all) EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas);
  EXPECT_TRUE(all[0].starts_with("ambient,z_m,range_m,")) << all[0];
  EXPECT_TRUE(all[1].starts_with("in the dark,0.1,0.1")) << all[1];
  EXPECT_TRUE(all[200].starts_with("at 20 klx,5,5")) << all[200];
}

TEST(budget_command, tells_people_what_marks_mean) {
  const std::string text = run({"budget", "pico-flexx", "--distance", "0.1m,1m,9m", "--reflectivity", "80%"}).out;
  EXPECT_TRUE(has(text, " saturated ")) << text;
  EXPECT_TRUE(has(text, "* low signal: range noise above 70 mm\n")) << text;
  EXPECT_TRUE(has(text, "! beyond the ambiguity range: ")) << text;
  EXPECT_TRUE(has(text, "a wall of 80 % in the dark: range noise within 70 mm up to ")) << text;
  EXPECT_FALSE(has(run({"budget", "pico-flexx", "--distance", "1m"}).out, "low signal"));
  EXPECT_TRUE(has(text, " e/J of the camera's illumination in the amplitude; ambient light adds nothing to it\n")) << text;
}

TEST(budget_command, finds_a_number_and_sets_it) {
  const Result result = run({"budget", "pico-flexx", "--need", "sigma 8mm at 2m, 50%", "--solve", "camera.illumination.0.power", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json solution = *files::parse_json(result.out, "budget").find("solution");
  const std::string power = *solution.find("text")->string();
  EXPECT_TRUE(power.ends_with(" mW") || power.ends_with(" W")) << power;
  BudgetRequest request;
  request.distances_m = {2}, request.reflectivities = {0.5};
  const Camera camera = load_camera("pico-flexx", {"", {{"illumination.0.power", power}}, {}});
  EXPECT_NEAR(budget(camera, request).at(0).sigma_m / 8e-3, 1, 1e-6);
  const Result text = run({"budget", "pico-flexx", "--need", "sigma 8mm at 2m, 50%", "--solve", "illumination.0.power"});
  EXPECT_TRUE(text.out.starts_with("illumination.0.power = ")) << text.out;
  EXPECT_TRUE(has(text.out, " makes the range noise 8 mm at 2 m, 50 %, in the dark\n")) << text.out;
}

TEST(budget_command, ends_with_1_where_no_number_will_do) {
  const Result result = run({"budget", "pico-flexx", "--need", "sigma 0.1mm at 1m, 50%", "--solve", "pixel.read_noise", "--json"});
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(
      result.err.starts_with("cannot be reached: 0.1 mm at 1 m, 50 %, in the dark by pixel.read_noise\n  range noise goes down to 3."))
      << result.err;
  EXPECT_FALSE(*files::parse_json(result.out, "budget").find("solution")->find("reached")->boolean());
}

TEST(budget_command, exposes_as_the_profile_says) {
  const auto row = [](const Arguments& more) {
    Arguments all = {"budget", "pico-flexx", "--distance", "0.15m", "--reflectivity", "80%", "--json"};
    all.insert(all.end(), more.begin(), more.end());
    return files::parse_json(run(all).out, "budget").find("rows")->items()->at(0);
  };
  EXPECT_TRUE(*row({}).find("saturated")->boolean());
  EXPECT_FALSE(*row({"--auto-exposure"}).find("saturated")->boolean());
  EXPECT_LT(number_of(row({"--auto-exposure"}), "exposure"), 0.5);
}

struct BadBudget {
  Arguments more;
  std::string says;
};
TEST(budget_command, refuses_what_makes_no_sense) {
  for (const BadBudget& bad :
       {BadBudget{{"--angle", "20"}, "--angle cannot be \"20\""}, BadBudget{{"--angle", "90deg"}, "-89 to 89 deg"},
        BadBudget{{"--temperature", "warm"}, "--temperature 60C"}, BadBudget{{"--distance", "1m:2m:1"}, "2 to 1000"},
        BadBudget{{"--distance", "0m"}, "0.01 to 1000 m"}, BadBudget{{"--pixel", "224,0"}, "the pixel's column is out of range"},
        BadBudget{{"-o", "budget.png"}, ".csv or .json"}, BadBudget{{"--need", "sigma 10mm at 3m, 10%"}, "--need needs --solve"},
        BadBudget{{"--solve", "lens.f_number"}, "--solve needs --need"},
        BadBudget{{"--need", "10mm at 3m", "--solve", "lens.f_number"}, "--need cannot be"},
        BadBudget{{"--need", "sigma 10mm at 3m, 10", "--solve", "lens.f_number"}, "--need cannot be"},
        BadBudget{{"--need", "sigma 10mm at 3m, 10%", "--solve", "lens.f_numbr"}, "did you mean \"lens.f_number\"?"},
        BadBudget{{"--need", "sigma 10mm at 3m, 10%", "--solve", "name"}, "whose value is one number"}}) {
    Arguments all = {"budget", "pico-flexx"};
    all.insert(all.end(), bad.more.begin(), bad.more.end());
    const Result result = run(all);
    EXPECT_EQ(result.code, 2) << bad.says;
    EXPECT_TRUE(has(result.err, bad.says)) << result.err;
    EXPECT_EQ(result.out, "");
  }
  EXPECT_TRUE(has(run({"budget", "room"}).err, "room is a scene"));
  EXPECT_TRUE(has(run({"complete", "--", "budget", "x", "--solve", "lens.f_n"}).out, "lens.f_number\t"));
}

}  // namespace
}  // namespace tofray::test
