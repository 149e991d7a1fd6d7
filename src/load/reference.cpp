// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/reference.h"

#include "model/lines.h"

namespace tofray::load {

namespace {

/// "camera.lens.f_number" belongs to "lens".
std::string section(const std::string& key) { return key.substr(0, key.find('.')); }

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string table(const model::FileForm& file) {
  const std::vector<model::Line> lines = model::lines_of(file);
  std::string out, before;
  for (const model::Line& line : lines) {
    const bool top = line.key.find('.') == std::string::npos;
    const std::string here = top ? "top level" : section(line.key);
    if (here != before) out += "\n### " + here + "\n\n| key | value, range | unless given | meaning | in code |\n|---|---|---|---|---|\n";
    before = here;
    const std::string fallback = line.required ? "required" : line.fallback.empty() ? "–" : "`" + line.fallback + "`";
    out += "| `" + line.key + "` | " + cell(line.value) + " | " + fallback + " | " + cell(line.doc) + " | " +
           (line.member.empty() ? "" : "`" + line.member + "`") + " |\n";
  }
  return out;
}

}  // namespace

std::string reference_page() {
  return "<!-- SPDX-FileCopyrightText: 2026 The tofray authors -->\n<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
         "# Every key of camera profiles and scenes\n\n"
         "Written by `tofray list keys` from the tables of `src/model`. Keys are as `--set` takes them: the first of a list is 0, a name\n"
         "that is free is NAME; in a scene's `camera:` section and in `--set camera.…`, the profile's keys stand in for the profile's "
         "values.\n"
         "\n## Camera profile\n" +
         table(model::camera_form()) + "\n## Scene\n" + table(model::scene_form());
}

}  // namespace tofray::load
