// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

/// Requests that strangers might send, and what each has to be answered with. In texts PORT, HOST (127.0.0.1:PORT), TOKEN and KEY stand for what they are.
namespace tofray::test {

struct Attack {
  const char* target = "/";
  std::vector<std::string> headers = {};  ///< "Name: value"
  int status = 200;
  const char* method = "GET";
  const char* version = "HTTP/1.1";
};

inline std::vector<Attack> attacks() {
  using Headers = std::vector<std::string>;
  const Headers upgrade = {"Host: HOST", "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                           "Sec-WebSocket-Key: KEY"};
  const auto socket = [&upgrade](Headers more) {
    Headers all = upgrade;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const auto without = [&upgrade](const char* name, Headers more) {
    Headers all;
    for (const std::string& one : upgrade)
      if (!one.starts_with(name)) all.push_back(one);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::string token = "Sec-WebSocket-Protocol: tofray.v1, t.TOKEN";
  return {
      // Names of this machine, and all others.
      {"/", {"Host: 127.0.0.1:PORT"}},
      {"/", {"Host: localhost:PORT"}},
      {"/", {"Host: LocalHost:PORT"}},
      {"/", {"Host: [::1]:PORT"}},
      {"/", {"hOsT: 127.0.0.1:PORT"}},
      {"/", {}, 400},
      {"/", {"Host:"}, 421},
      {"/", {"Host: 127.0.0.1"}, 421},
      {"/", {"Host: 127.0.0.1:80"}, 421},
      {"/", {"Host: 127.0.0.1:PORT0"}, 421},
      {"/", {"Host: 127.0.0.2:PORT"}, 421},
      {"/", {"Host: 0.0.0.0:PORT"}, 421},
      {"/", {"Host: 127.1:PORT"}, 421},
      {"/", {"Host: 2130706433:PORT"}, 421},
      {"/", {"Host: 0x7f000001:PORT"}, 421},
      {"/", {"Host: ::1:PORT"}, 421},
      {"/", {"Host: [::ffff:127.0.0.1]:PORT"}, 421},
      {"/", {"Host: [0:0:0:0:0:0:0:1]:PORT"}, 421},
      {"/", {"Host: localhost.:PORT"}, 421},
      {"/", {"Host: localhost"}, 421},
      {"/", {"Host: evil.example:PORT"}, 421},
      {"/", {"Host: evillocalhost:PORT"}, 421},
      {"/", {"Host: evil.localhost:PORT"}, 421},
      {"/", {"Host: evil127.0.0.1:PORT"}, 421},
      {"/", {"Host: localhost.evil.example:PORT"}, 421},
      {"/", {"Host: localhost:PORT@evil.example"}, 421},
      {"/", {"Host: user@localhost:PORT"}, 421},
      {"/", {"Host: localhost:PORT/"}, 421},
      {"/", {"Host: localhost:PORT, evil.example"}, 421},
      {"/", {"Host: HOST", "Host: HOST"}, 400},
      {"/", {"Host: HOST", "Host: evil.example"}, 400},
      {"/", {"Host: evil.example:PORT", "X-Forwarded-Host: HOST"}, 421},
      // Pages of elsewhere. Where a name was made to point here, Host and Origin are the same, and both wrong.
      {"/", {"Host: HOST", "Origin: http://HOST"}},
      {"/", {"Host: localhost:PORT", "Origin: http://localhost:PORT"}},
      {"/", {"Host: evil.example:PORT", "Origin: http://evil.example:PORT"}, 421},
      {"/", {"Host: HOST", "Origin: http://evil.example:PORT"}, 403},
      {"/", {"Host: HOST", "Origin: null"}, 403},
      {"/", {"Host: HOST", "Origin:"}, 403},
      {"/", {"Host: HOST", "Origin: https://HOST"}, 403},
      {"/", {"Host: HOST", "Origin: http://127.0.0.1"}, 403},
      {"/", {"Host: HOST", "Origin: http://localhost:PORT"}, 403},
      {"/", {"Host: HOST", "Origin: http://HOST/"}, 403},
      {"/", {"Host: HOST", "Origin: http://HOST.evil.example"}, 403},
      {"/", {"Host: HOST", "Origin: http://evil.example/http://HOST"}, 403},
      {"/", {"Host: HOST", "Origin: http://HOST", "Origin: http://evil.example"}, 400},
      {"/", {"Host: HOST", "Origin: file://"}, 403},
      {"/", {"Host: HOST", "Sec-Fetch-Site: same-origin", "Sec-Fetch-Mode: navigate", "Sec-Fetch-Dest: document"}},
      {"/", {"Host: HOST", "Sec-Fetch-Site: none", "Sec-Fetch-Mode: navigate", "Sec-Fetch-Dest: document"}},
      {"/", {"Host: HOST", "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: navigate", "Sec-Fetch-Dest: document"}},
      {"/", {"Host: HOST", "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: navigate", "Sec-Fetch-Dest: iframe"}, 403},
      {"/", {"Host: HOST", "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: no-cors", "Sec-Fetch-Dest: image"}, 403},
      {"/", {"Host: HOST", "Sec-Fetch-Site: same-site", "Sec-Fetch-Mode: cors", "Sec-Fetch-Dest: empty"}, 403},
      {"/", {"Host: HOST", "Sec-Fetch-Site: cross-site"}, 403},
      {"/", {"Host: HOST", "Sec-Fetch-Site: none", "Sec-Fetch-Site: cross-site"}, 400},
      {"/ws", socket({token, "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: websocket", "Sec-Fetch-Dest: websocket"}), 403},
      // Methods, paths and bodies.
      {"/", {"Host: HOST"}, 200, "HEAD"},
      {"/", {"Host: HOST"}, 405, "POST"},
      {"/", {"Host: HOST"}, 405, "OPTIONS"},
      {"/", {"Host: HOST"}, 405, "PUT"},
      {"/", {"Host: HOST"}, 405, "TRACE"},
      {"/", {"Host: evil.example"}, 421, "OPTIONS"},
      {"*", {"Host: HOST"}, 400, "OPTIONS"},
      {"http://HOST/", {"Host: HOST"}, 400},
      {"HOST", {"Host: HOST"}, 400, "CONNECT"},
      {"/../../etc/passwd", {"Host: HOST"}, 404},
      {"/%2e%2e/etc/passwd", {"Host: HOST"}, 404},
      {"//", {"Host: HOST"}, 404},
      {"/?x", {"Host: HOST"}, 404},
      {"/ws/", {"Host: HOST"}, 404},
      {"/WS", {"Host: HOST"}, 404},
      {"/", {"Host: HOST", "Content-Length: 5"}, 400},
      {"/", {"Host: HOST", "Transfer-Encoding: chunked"}, 400},
      {"/", {"Host: HOST", "Content-Length: 0"}},
      {"/", {"Host: HOST"}, 400, "GET", "HTTP/1.0"},
      {"/", {"Host: HOST"}, 400, "GET", "HTTP/2.0"},
      // The socket.
      {"/ws", socket({token}), 101},
      {"/ws", socket({token, "Origin: http://HOST"}), 101},
      {"/ws", socket({"Sec-WebSocket-Protocol: t.TOKEN,tofray.v1"}), 101},
      {"/ws", socket({}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v1"}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: t.TOKEN"}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v1, t."}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v1, t.TOKEN0"}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v1, t.0123"}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v1, t.PREFIX"}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v1, T.TOKEN"}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v1, t.x, t.TOKEN"}), 401},
      {"/ws", socket({"Sec-WebSocket-Protocol: tofray.v2, t.TOKEN"}), 401},
      {"/ws", socket({"Authorization: Bearer TOKEN"}), 401},
      {"/ws?t=TOKEN", socket({}), 404},
      {"/ws", socket({token, token}), 400},
      {"/ws", socket({token, "Origin: http://evil.example"}), 403},
      {"/ws", socket({token, "Origin: null"}), 403},
      {"/ws", without("Host", {token, "Host: evil.example:PORT", "Origin: http://evil.example:PORT"}), 421},
      {"/ws", without("Upgrade", {token}), 426},
      {"/ws", without("Upgrade", {token, "Upgrade: h2c"}), 426},
      {"/ws", without("Connection", {token}), 426},
      {"/ws", without("Sec-WebSocket-Version", {token, "Sec-WebSocket-Version: 12"}), 426},
      {"/ws", without("Sec-WebSocket-Version", {token}), 426},
      {"/ws", without("Sec-WebSocket-Key", {token}), 400},
      {"/ws", without("Sec-WebSocket-Key", {token, "Sec-WebSocket-Key: short"}), 400},
      {"/ws", socket({token, "Sec-WebSocket-Key: KEY"}), 400},
      {"/ws", socket({token}), 405, "HEAD"},
      {"/ws", socket({token}), 405, "POST"},
  };
}

/// With what the words stand for.
inline std::string filled(std::string text, int port, const std::string& token, const std::string& key) {
  const std::pair<std::string, std::string> words[] = {{"HOST", "127.0.0.1:PORT"},
                                                       {"PORT", std::to_string(port)},
                                                       {"TOKEN", token},
                                                       {"PREFIX", token.substr(0, token.size() - 1)},
                                                       {"KEY", key}};
  for (const auto& [word, value] : words)
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
      text.replace(at, word.size(), value);
  return text;
}

}  // namespace tofray::test
