// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/commands.h"

/// What options make of their values, and the options of single commands, each in a file of its own.
namespace tofray::app {

/// @throws Error (bad_input)
[[noreturn]] void refuse(const char* option, const std::string& value, const std::string& expected);

/// A whole number of low…high.
std::uint64_t whole(const char* option, const std::string& value, std::uint64_t low, std::uint64_t high, const std::string& expected);

/// A length, in metres where no unit is said.
double length_of(const char* option, const std::string& value, double low, double high, const char* example = "1.5mm");

std::vector<std::string> split(const std::string& text, char at);

/// Which of some words.
std::size_t word_of(const char* option, const std::string& value, const std::vector<std::string>& words);

double number_of(const char* option, const std::string& value, double low, double high, const std::string& expected);

/// Frames per second, 0.0001 to 100000.
void take_frame_rate(const char* option, Options& o, const std::string& value);

/// Distances as --at and --distance take them.
void add_distances(const char* name, Options& o, const std::string& value);

/// A table's file: .csv or .json.
void take_budget_file(Options& o, const std::string& value);

/// Numbers with commas between, as many as `into` has.
template <class T>
bool numbers_of(const std::string& value, std::vector<T>& into) {
  const std::vector<std::string> parts = split(value, ',');
  if (parts.size() != into.size()) return false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const char* const end = parts[i].data() + parts[i].size();
    const auto read = std::from_chars(parts[i].data(), end, into[i]);
    if (read.ec != std::errc() || read.ptr != end) return false;
  }
  return true;
}

std::vector<OptionSpec> message_specs();
std::vector<OptionSpec> measuring_specs();
std::vector<OptionSpec> dataset_specs();
std::vector<OptionSpec> sweep_specs();
std::vector<OptionSpec> stream_specs();

}  // namespace tofray::app
