// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/rapl.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace tofray::energy {

namespace {

namespace fs = std::filesystem;

/// A file's first line. @return the system's error number, 0 where there is none
int read_line(const std::string& path, std::string& line) {
  std::FILE* file = std::fopen(path.c_str(), "re");
  if (file == nullptr) return errno;
  char text[128] = "";
  errno = 0;
  const bool got = std::fgets(text, sizeof text, file) != nullptr;
  const int fault = got ? 0 : errno != 0 ? errno : EIO;
  std::fclose(file);
  line = text;
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
  return fault;
}

/// "intel-rapl:0", not its parts "intel-rapl:0:0", nor "intel-rapl-mmio:0", which is the same package once more.
bool is_top_zone(const std::string& name) {
  constexpr std::string_view start = "intel-rapl:";
  return name.starts_with(start) && name.size() > start.size() && name.find_first_not_of("0123456789", start.size()) == std::string::npos;
}

std::vector<std::string> top_zones(const std::string& root) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(root, error), end; !error && it != end; it.increment(error)) {
    if (is_top_zone(it->path().filename().native())) names.push_back(it->path().filename().native());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string why(int fault) {
  std::string text = std::generic_category().message(fault);
  if (fault == EACCES || fault == EPERM) text += " (on most systems only root may read it)";
  return text;
}

}  // namespace

std::uint64_t counted(std::uint64_t before, std::uint64_t now, std::uint64_t largest) {
  return now >= before ? now - before : now + (largest - before);
}

Rapl::Rapl(const std::string& root) {
  std::string packages;
  for (const std::string& name : top_zones(root)) {
    const std::string folder = (fs::path(root) / name).native();
    std::string label;
    if (read_line(folder + "/name", label) != 0 || !label.starts_with("package")) continue;
    Zone zone;
    zone.file = folder + "/energy_uj";
    if (!read(folder + "/max_energy_range_uj", zone.largest) || !read_counter(zone, zone.before)) return;
    packages += (packages.empty() ? "" : ", ") + label;
    zones_.push_back(zone);
  }
  measures(packages);
  if (zones_.empty()) cannot(root + " has no intel-rapl package: the kernel shows no RAPL counters (virtual machines mostly have none)");
}

bool Rapl::read(const std::string& file, std::uint64_t& number) {
  std::string line;
  const int fault = read_line(file, line);
  const char* const end = line.data() + line.size();
  if (fault != 0) {
    cannot(file + ": " + why(fault));
  } else if (const auto got = std::from_chars(line.data(), end, number); got.ec != std::errc() || got.ptr != end) {
    cannot(file + " does not hold a whole number");
  }
  return readable();
}

bool Rapl::read_counter(const Zone& zone, std::uint64_t& number) {
  if (read(zone.file, number) && number > zone.largest) cannot(zone.file + " is beyond max_energy_range_uj");
  return readable();
}

double Rapl::advance() {
  double sum = 0;
  for (Zone& zone : zones_) {
    std::uint64_t now = 0;
    if (!read_counter(zone, now)) return 0;
    sum += 1e-6 * static_cast<double>(counted(zone.before, now, zone.largest));
    zone.before = now;
  }
  return sum;
}

}  // namespace tofray::energy
