// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any lines as the head of a request: nobody gets in without this machine's name and the key.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "view/request.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tofray::view::Admission admission{tofray::view::hosts_of(7170, {}), std::string(64, 'k'), false};
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> lines;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  std::vector<tofray::view::Header> headers;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    const std::size_t colon = std::min(lines[i].find(':'), lines[i].size());
    headers.push_back(
        {std::string_view(lines[i]).substr(0, colon), std::string_view(lines[i]).substr(std::min(colon + 1, lines[i].size()))});
  }
  const std::string target = lines.size() > 1 ? lines[1] : "";
  static constexpr std::string_view speaks[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};
  const auto of_reader = tofray::view::judged_reader({lines[0], target, 11, headers}, {admission.hosts, {}, speaks});
  if (of_reader.status == 101 && (text.find(":7170") == std::string::npos || text.find("foxglove.") == std::string::npos)) std::abort();
  const auto verdict = tofray::view::judged({lines[0], target, 11, headers}, admission, [](std::string_view one) { return one == "/"; });
  if (verdict.status != 101 && verdict.status != 200) return 0;
  bool named = false;
  for (const std::string& host : admission.hosts) named = named || text.find(host.substr(host.find(':'))) != std::string::npos;
  if (!named || (verdict.status == 101 && text.find(admission.token) == std::string::npos)) std::abort();
  return 0;
}
