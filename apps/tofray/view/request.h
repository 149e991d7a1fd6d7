// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Who may talk to the viewer (docs/decisions/0041-who-may-talk-to-the-viewer.md), and who may read a stream
/// (docs/decisions/0058-foxglove.md): all that is asked of a request before it is answered. Nothing here knows of sockets.
namespace tofray::view {

struct Header {
  std::string_view name, value;
};

/// The head of a request, as it came.
struct Request {
  std::string_view method, target;
  int version = 11;  ///< 11: HTTP/1.1
  std::span<const Header> headers;
};

/// Whom the viewer lets in.
struct Admission {
  std::vector<std::string> hosts;  ///< what Host may say, in small letters, with the port: "127.0.0.1:7170"
  std::string token;
  bool embed = false;  ///< a page of this machine may hold the viewer's in a frame
};

/// The hosts of a viewer on this machine's own addresses. @param further  --allow-host: NAME or NAME:PORT
std::vector<std::string> hosts_of(int port, const std::vector<std::string>& further);

enum class Route { none, file, socket };

struct Verdict {
  int status = 200;  ///< of HTTP; 101 where the socket may be opened
  const char* why = "";
  Route route = Route::none;
};

/// @param is_file  whether the viewer's page has a file of such a target; it sees targets that begin with "/" alone
Verdict judged(const Request& request, const Admission& admission, bool (*is_file)(std::string_view target));

/// Who may read a stream: programs, pages of this machine, and pages of the origins that are allowed.
struct ReaderAdmission {
  std::vector<std::string> hosts;            ///< as in Admission
  std::vector<std::string> origins;          ///< what Origin may say: "https://app.example.org"
  std::span<const std::string_view> speaks;  ///< subprotocols, the preferred one first
};

/// The verdict on a request for a socket at "/" or any other path, whose reader names a subprotocol that is spoken.
Verdict judged_reader(const Request& request, const ReaderAdmission& admission);

/// The first of these subprotocols that a request names; empty: none.
std::string_view chosen_protocol(const Request& request, std::span<const std::string_view> speaks);

/// What a header says, the first one of its name; empty: it does not come.
std::string_view header_of(const Request& request, std::string_view name);

/// Content-Security-Policy of every answer. @param hosts  as in Admission
std::string content_policy(const std::vector<std::string>& hosts, bool embed);

}  // namespace tofray::view
