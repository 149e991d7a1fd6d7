// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "stream/publisher.h"

/// Messages by the WebSocket of Foxglove, which Lichtblick and others speak as well
/// (https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md): what server and readers say. Nothing here knows of sockets.
namespace tofray::foxglove {

/// Subprotocols of the handshake, the preferred one first: later readers ask for the first one, older ones for the second. What is said here
/// is the same in both.
inline constexpr std::array<std::string_view, 2> protocols = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// A topic, as readers know it.
struct Channel {
  std::uint32_t id = 0;  ///< from 1 on
  stream::TopicForm topic;
};

/// The first text of a server. @param session  another one for each start of it
std::string server_info(const std::string& session);
/// @throws Error (bad_input) for a topic of a type that has no definition
std::string advertisement(const std::vector<Channel>& channels);
enum class Level : int { info = 0, warning = 1, error = 2 };
std::string status(Level level, const std::string& message);

/// What stands before the CDR of a message: opcode 1, the subscription, the time it was published [ns].
std::array<char, 13> data_head(std::uint32_t subscription, std::int64_t time_ns);
/// The time of the stream [ns]: opcode 2.
std::string time_message(std::int64_t time_ns);

struct Subscription {
  std::uint32_t id = 0;  ///< the reader's own
  std::uint32_t channel = 0;
  bool operator==(const Subscription&) const = default;
};
struct Subscribe {
  std::vector<Subscription> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
/// Well formed, and nothing that a stream does: a reader that publishes, asks for parameters or services.
struct Other {
  std::string op;
};
using Asked = std::variant<Subscribe, Unsubscribe, Other>;

/// What a reader's text asks for.
/// @throws Error (bad_input, limit) where it is none of the protocol
Asked asked_by(std::string_view text);

}  // namespace tofray::foxglove
