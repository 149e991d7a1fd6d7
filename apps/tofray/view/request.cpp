// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/request.h"

#include <algorithm>
#include <optional>

#include "view/secret.h"

namespace tofray::view {

namespace {

constexpr std::size_t most_headers = 100, most_target = 8192;

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), small);
  return out;
}

bool same_word(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return small(x) == small(y); });
}

std::size_t count(const Request& request, std::string_view name) {
  return static_cast<std::size_t>(
      std::count_if(request.headers.begin(), request.headers.end(), [name](const Header& one) { return same_word(one.name, name); }));
}

/// The value of a header that comes once; nothing where it does not come.
std::optional<std::string_view> value(const Request& request, std::string_view name) {
  for (const Header& one : request.headers)
    if (same_word(one.name, name)) return one.value;
  return {};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The words of a list with commas.
std::vector<std::string_view> words_of(std::string_view list) {
  std::vector<std::string_view> out;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t end = std::min(list.find(',', from), list.size());
    out.push_back(trimmed(list.substr(from, end - from)));
    from = end + 1;
  }
  return out;
}

bool has_word(const Request& request, std::string_view name, std::string_view word) {
  const auto list = value(request, name);
  if (!list) return false;
  const auto words = words_of(*list);
  return std::any_of(words.begin(), words.end(), [word](std::string_view one) { return same_word(one, word); });
}

/// 16 bytes by base64.
bool is_key(std::string_view key) {
  const auto digit = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
  };
  return key.size() == 24 && key.ends_with("==") && std::all_of(key.begin(), key.begin() + 22, digit);
}

/// What a page of elsewhere may do: lead to the viewer's first page, and with --embed hold it in a frame. Browsers say so themselves;
/// pages of other ports are elsewhere, though browsers call these the same site.
bool from_elsewhere(const Request& request, bool embed) {
  const auto site = value(request, "Sec-Fetch-Site");
  if (!site || *site == "same-origin" || *site == "none") return false;
  const auto mode = value(request, "Sec-Fetch-Mode"), destination = value(request, "Sec-Fetch-Dest");
  const bool leads = request.target == "/" && mode == "navigate";
  return !(leads && (destination == "document" || (embed && destination == "iframe")));
}

/// The token is a subprotocol of the handshake: browsers let a page send nothing else there.
bool knows_token(const Request& request, const std::string& token) {
  const auto list = value(request, "Sec-WebSocket-Protocol");
  if (!list) return false;
  bool speaks = false;
  std::size_t tokens = 0, right = 0;
  for (const std::string_view one : words_of(*list)) {
    speaks = speaks || one == "tofray.v1";
    if (!one.starts_with("t.")) continue;
    ++tokens;
    right += same_secret(token, one.substr(2)) ? 1 : 0;
  }
  return speaks && tokens == 1 && right == 1;
}

Verdict handshake_verdict(const Request& request) {
  if (request.method != "GET") return {405, "a socket is opened by GET"};
  if (!has_word(request, "Upgrade", "websocket") || !has_word(request, "Connection", "upgrade")) return {426, "here is a WebSocket alone"};
  if (value(request, "Sec-WebSocket-Version") != "13") return {426, "the version of WebSocket is 13"};
  if (!is_key(value(request, "Sec-WebSocket-Key").value_or(""))) return {400, "no key of a WebSocket"};
  return {101, "", Route::socket};
}

Verdict socket_verdict(const Request& request, const Admission& admission) {
  if (!knows_token(request, admission.token)) return {401, "no token, or not this viewer's: open the address that tofray view printed"};
  return handshake_verdict(request);
}

/// Whether a page of this origin is one of this machine: of a server here, or a file.
bool of_this_machine(std::string_view origin) {
  if (origin == "file://") return true;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!origin.starts_with(scheme)) continue;
    const std::string_view host = origin.substr(scheme.size());
    for (const std::string_view name : {"localhost", "127.0.0.1", "[::1]"})
      if (host == name || (host.starts_with(name) && host[name.size()] == ':')) return true;
  }
  return false;
}

/// What is wrong with a request, whoever sends it.
Verdict malformed(const Request& request) {
  if (request.version != 11) return {400, "expected HTTP/1.1"};
  if (request.target.size() > most_target) return {414, "the target is too long"};
  if (request.headers.size() > most_headers) return {431, "more than 100 headers"};
  for (const char* name : {"Host", "Origin", "Upgrade", "Connection", "Sec-Fetch-Site", "Sec-Fetch-Mode", "Sec-Fetch-Dest",
                           "Content-Length", "Transfer-Encoding", "Sec-WebSocket-Protocol", "Sec-WebSocket-Version", "Sec-WebSocket-Key"})
    if (count(request, name) > 1) return {400, "a header comes twice"};
  if (count(request, "Host") != 1) return {400, "no Host"};
  if (value(request, "Transfer-Encoding") || value(request, "Content-Length").value_or("0") != "0") return {400, "a body is not taken"};
  if (!request.target.starts_with('/')) return {400, "expected a path"};
  return {};
}

}  // namespace

std::vector<std::string> hosts_of(int port, const std::vector<std::string>& further) {
  std::vector<std::string> out;
  const std::string behind = ":" + std::to_string(port);
  std::vector<std::string> names = {"127.0.0.1", "localhost", "[::1]"};
  names.insert(names.end(), further.begin(), further.end());
  for (const std::string& one : names) {
    const std::string name = lower(one);
    const std::size_t behind_address = name.starts_with('[') ? name.find(']') : 0;
    const bool has_port = name.find(':', behind_address == std::string::npos ? 0 : behind_address) != std::string::npos;
    out.push_back(has_port ? name : name + behind);
    if (port == 80 && !has_port) out.push_back(name);  // which browsers leave out
  }
  return out;
}

Verdict judged(const Request& request, const Admission& admission, bool (*is_file)(std::string_view target)) {
  if (const Verdict wrong = malformed(request); wrong.status != 200) return wrong;
  // Both are held against the list: a page that made its own name point here sends that name as either.
  const std::string host = lower(*value(request, "Host"));
  if (std::find(admission.hosts.begin(), admission.hosts.end(), host) == admission.hosts.end())
    return {421, "this is not a name of the viewer's; tofray view --allow-host adds one"};
  if (const auto origin = value(request, "Origin"); origin && *origin != "http://" + host) return {403, "a page of elsewhere may not"};
  if (from_elsewhere(request, admission.embed)) return {403, "a page of elsewhere may not"};
  if (request.method != "GET" && request.method != "HEAD") return {405, "expected GET or HEAD"};
  if (request.target == "/ws") return socket_verdict(request, admission);
  if (!is_file(request.target)) return {404, "there is no such file"};
  return {200, "", Route::file};
}

Verdict judged_reader(const Request& request, const ReaderAdmission& admission) {
  if (const Verdict wrong = malformed(request); wrong.status != 200) return wrong;
  const auto has = [](const std::vector<std::string>& all, std::string_view one) {
    return std::any_of(all.begin(), all.end(), [one](const std::string& known) { return same_word(known, one); });
  };
  if (!has(admission.hosts, *value(request, "Host")))
    return {421, "this is not a name of the stream's; tofray stream --allow-host adds one"};
  if (const auto origin = value(request, "Origin"); origin && !of_this_machine(lower(*origin)) && !has(admission.origins, *origin))
    return {403, "a page of elsewhere may not; tofray stream --allow-origin lets one in"};
  if (const Verdict wrong = handshake_verdict(request); wrong.status != 101) return wrong;
  if (chosen_protocol(request, admission.speaks).empty())
    return {400, "no subprotocol that is spoken here: foxglove.sdk.v1 or foxglove.websocket.v1"};
  return {101, "", Route::socket};
}

std::string_view chosen_protocol(const Request& request, std::span<const std::string_view> speaks) {
  const auto words = words_of(header_of(request, "Sec-WebSocket-Protocol"));
  for (const std::string_view one : speaks)
    if (std::find(words.begin(), words.end(), one) != words.end()) return one;
  return {};
}

std::string_view header_of(const Request& request, std::string_view name) { return value(request, name).value_or(std::string_view()); }

std::string content_policy(const std::vector<std::string>& hosts, bool embed) {
  std::string sockets;
  for (const std::string& host : hosts)
    if (!host.starts_with('[')) sockets += " ws://" + host;  // a policy's grammar has no such hosts; 'self' covers them
  return "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'" + sockets +
         "; worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors " +
         (embed ? "http://localhost:* http://127.0.0.1:*" : "'none'");
}

}  // namespace tofray::view
