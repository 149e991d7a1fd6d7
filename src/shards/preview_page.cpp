// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/base64.h"
#include "shards/summary.h"

namespace tofray::shards {

namespace {

/// Text as HTML shows it.
std::string shown_text(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  return out;
}

std::string percent(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? "–" : fmt::format("{:.1f} %", 100 * static_cast<double>(part) / static_cast<double>(all));
}

/// Which one it is, as `dataset scene` takes it.
std::string number_of(const ShownSample& one, const Plan& plan) {
  return plan.views == 1 ? std::to_string(one.sample) : fmt::format("{}-{}", one.sample, one.view);
}

std::string figure(const ShownSample& one, const Plan& plan, const std::string& more) {
  const std::string number = number_of(one, plan);
  std::string out = "<figure>";
  if (!one.png.empty())
    out += fmt::format("<img alt=\"depth of sample {0}\" src=\"data:image/png;base64,{1}\">", number, base::base64(one.png));
  return out + fmt::format("<figcaption>{} · {} valid{}</figcaption></figure>\n", number, percent(one.valid, one.pixels), more);
}

/// Bars from 0 on, one a bin; empty ones at either end are left out.
template <std::size_t n>
std::string histogram(const std::array<std::uint64_t, n>& counts, double low, double step, const char* name, const char* unit) {
  std::size_t first = 0, last = n;
  while (first < n && counts[first] == 0) ++first;
  while (last > first && counts[last - 1] == 0) --last;
  if (first == last) return {};
  const std::uint64_t most = *std::max_element(counts.begin(), counts.end());
  constexpr double width = 640, height = 140;
  const double each = width / static_cast<double>(last - first);
  std::string bars;
  for (std::size_t i = first; i < last; ++i) {
    const double tall = height * static_cast<double>(counts[i]) / static_cast<double>(most);
    bars += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>", each * static_cast<double>(i - first),
                        height - tall, std::max(each - 0.5, 0.5), tall);
  }
  return fmt::format(
      "<figure class=\"wide\"><svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"histogram of {}\">{}</svg>"
      "<figcaption>{}: {:.3g} to {:.3g} {}, {:.3g} {} a bar</figcaption></figure>\n",
      width, height, name, bars, name, low + step * static_cast<double>(first), low + step * static_cast<double>(last), unit, step, unit);
}

/// A line for each key: its values by their place in their law, which are as many in each bar where the sampler is right.
std::string laws(const dataset::Judgement& draws) {
  if (draws.empty()) return {};
  std::string rows;
  for (const auto& [path, one] : draws) {
    std::string bars;
    const std::uint64_t most = std::max<std::uint64_t>(1, *std::max_element(one.counts.begin(), one.counts.end()));
    for (std::size_t i = 0; i < one.counts.size(); ++i) {
      const double tall = 20 * static_cast<double>(one.counts[i]) / static_cast<double>(most);
      bars += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"7\" height=\"{:.1f}\"/>", 8 * i, 20 - tall, tall);
    }
    const std::string said = one.draws() < dataset::DrawCounts::least ? "too few to judge"
                             : one.misses()                           ? "<strong>misses its law</strong>"
                                                                      : "";
    rows += fmt::format(
        "<tr><td><code>{}</code></td><td>{}</td><td>{}</td><td>{:.1f}</td><td><svg class=\"bars\" viewBox=\"0 0 128 20\" role=\"img\" "
        "aria-label=\"places of {} in its law\">{}</svg></td><td>{}</td></tr>\n",
        shown_text(path), shown_text(one.form), one.draws(), one.chi_square(), shown_text(path), bars, said);
  }
  return fmt::format(
      "<h2>Draws</h2>\n<p>Values by their place in the law that they are drawn by, before any was refused: level, but for chance. χ² above "
      "{:.1f} "
      "of 15 degrees of freedom happens to right samplers once in a million "
      "times.</p>\n<table><tr><th>key</th><th>form</th><th>draws</th><th>χ²</th>"
      "<th>from 0 to 1</th><th></th></tr>\n{}</table>\n",
      dataset::DrawCounts::most, rows);
}

constexpr std::string_view style =
    "body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:72rem;padding:0 1rem;color:#17181c;background:#fff}"
    "figure{display:inline-block;margin:0 .75rem .75rem "
    "0;vertical-align:top}figure.wide{display:block}img{width:224px;image-rendering:pixelated;display:block}"
    "figcaption{font-size:.85rem}svg{width:100%;max-width:640px;border-bottom:1px solid "
    "currentColor}svg.bars{width:128px}rect{fill:#3b6ea5}"
    "code,pre{font-size:.85rem;overflow-x:auto}table{border-collapse:collapse}td,th{padding:.15rem .75rem .15rem 0;text-align:left}"
    "@media(prefers-color-scheme:dark){body{color:#e8e8ea;background:#17181c}rect{fill:#7fb0e6}}";

}  // namespace

std::string preview_page(const Summary& of) {
  const Plan& plan = of.plan;
  const Statistics& seen = of.statistics;
  const std::string name = shown_text(of.set.name);
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">"
      "<title>{0}</title><style>{1}</style></head><body>\n<h1>{0}</h1>\n",
      name, style);
  out += fmt::format(
      "<p>{} scenes of {}, {} frames, {:.1f} MB in {} shards; {} of all pixels have a depth. Licence: {}. Made by tofray "
      "{}.</p>\n",
      of.samples, plan.samples, seen.frames, 1e-6 * static_cast<double>(of.bytes), of.shards, percent(seen.valid, seen.pixels),
      of.set.license.empty() ? "not said" : shown_text(of.set.license), shown_text(plan.version));
  out += "<h2>Samples</h2>\n<p>Spread evenly over the set. Each picture has its own colours, from near (pale) to far (dark).</p>\n";
  for (const ShownSample& one : of.spread) out += figure(one, plan, "");
  out +=
      "<h2>Fewest valid pixels</h2>\n<p>Look here for scenes that make no sense: a camera inside a thing, nothing in view, too little "
      "light.</p>\n";
  for (const ShownSample& one : of.worst)
    out += figure(one, plan, fmt::format("<br><code>tofray dataset scene set.yaml {} | tofray check -</code>", number_of(one, plan)));
  out += "<h2>Depth</h2>\n" + histogram(seen.true_z, 0, Statistics::range_step_m, "true z of pixels that see something", "m");
  out += histogram(seen.error, -1000 * Statistics::error_step_m * Statistics::error_bins / 2, 1000 * Statistics::error_step_m,
                   "error of z, the outer bars with all beyond", "mm");
  std::string flags;
  const files::Json counts = seen.json();
  for (const auto& [flag, count] : *counts.find("flags")->members()) {
    std::uint64_t pixels = 0;
    if (count.unsigned_integer(pixels) && pixels > 0)
      flags += fmt::format("<tr><td><code>{}</code></td><td>{}</td></tr>", flag, percent(pixels, seen.pixels));
  }
  if (!flags.empty()) out += "<h2>Flags</h2>\n<table><tr><th>flag</th><th>of all pixels</th></tr>" + flags + "</table>\n";
  out += laws(seen.draws);
  if (!of.holes.empty()) {
    std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> by_reason;  // how many, the first one
    for (const auto& [sample, why] : of.holes) {
      const std::string line = why.substr(0, why.find('\n'));
      const std::size_t at = line.find("error: ");
      auto& one = by_reason.try_emplace(at == std::string::npos ? line : line.substr(at + 7), 0, sample).first->second;
      ++one.first;
    }
    out += "<h2>Scenes left out</h2>\n<table><tr><th>why</th><th>how many</th><th>the first one</th></tr>";
    for (const auto& [why, one] : by_reason)
      out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>", shown_text(why), one.first, one.second);
    out += "</table>\n";
  }
  out += "<h2>The set's file</h2>\n<pre>" + shown_text(plan.set_text) + "</pre>\n</body></html>\n";
  return out;
}

}  // namespace tofray::shards
