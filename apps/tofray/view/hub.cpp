// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/hub.h"

#include <algorithm>
#include <limits>

#include "files/json.h"
#include "view/client.h"
#include "view/state.h"

namespace tofray::view {

Hub::Hub(net::io_context& io, Session& session, Rate rate, Admission admission)
    : io_(io), session_(session), rate_(rate), admission_(std::move(admission)), ticker_(io) {}

void Hub::publish(std::shared_ptr<const Published> frame, SessionCounts counts) {
  net::post(io_, [this, frame = std::move(frame), counts] {
    counts_ = counts;
    const auto clients = clients_;
    for (const auto& [number, client] : clients) client->offer(frame);
    wanted(false);
    tell_counts();
  });
}

void Hub::greet(std::uint64_t client, std::string hello) {
  net::post(io_, [this, client, hello = std::move(hello)]() mutable {
    if (const auto found = clients_.find(client); found != clients_.end()) found->second->greet(std::move(hello));
  });
}

void Hub::tell(std::uint64_t client, std::string text) {
  net::post(io_, [this, client, text = std::move(text)]() mutable {
    if (const auto found = clients_.find(client); found != clients_.end())
      found->second->tell(std::make_shared<const std::string>(std::move(text)));
  });
}

void Hub::give(std::uint64_t client, std::string text, std::string arrays, std::uint8_t kind) {
  net::post(io_, [this, client, text = std::move(text), arrays = std::move(arrays), kind]() mutable {
    const auto found = clients_.find(client);
    if (found == clients_.end()) return;
    Client& page = *found->second;
    page.give(std::make_shared<const std::string>(std::move(text)), std::make_shared<const std::string>(std::move(arrays)), kind);
  });
}

void Hub::tell_all(std::string text) {
  net::post(io_, [this, text = std::make_shared<const std::string>(std::move(text))] {
    const auto clients = clients_;
    for (const auto& [number, client] : clients) client->tell(text);
  });
}

void Hub::own_rate(double hz) {
  net::post(io_, [this, hz] {
    own_hz_ = hz;
    wanted(false);
  });
}

void Hub::other(bool open) {
  net::post(io_, [this, open] {
    has_other_ = open;
    const auto clients = clients_;
    for (const auto& [number, client] : clients) client->forget_other();
    wanted(false);
  });
}

std::uint64_t Hub::join(Client& client) {
  clients_.emplace(next_, &client);
  session_.join(next_);
  return next_++;
}

void Hub::leave(std::uint64_t client) {
  clients_.erase(client);
  session_.leave(client);
  wanted(false);
}

double Hub::hz_of(const Rate& rate) const {
  if (rate.kind == Rate::Kind::number) return rate.hz;
  return rate.kind == Rate::Kind::own && own_hz_ > 0 ? own_hz_ : std::numeric_limits<double>::infinity();
}

void Hub::wanted(bool again) {
  Demand demand;
  for (const auto& [number, client] : clients_) {
    if (!client->looks()) continue;
    demand.ready = demand.ready || client->has_room();
    demand.rate_hz = std::max(demand.rate_hz, client->hz());
    if (std::find(demand.wants.begin(), demand.wants.end(), client->arrays()) == demand.wants.end())
      demand.wants.push_back(client->arrays());
  }
  session_.demand(std::move(demand), again);
}

void Hub::took(Client& client, const std::string& message) {
  struct Take {
    Hub& hub;
    Client& client;
    void operator()(Refused& refused) const {
      client.tell(std::make_shared<const std::string>(fault_lines(refused.id, refused.text, refused.more)));
    }
    void operator()(Want& want) const { client.want(std::move(want)); }
    void operator()(const Visible& one) const { client.show(one.visible); }
    void operator()(const Acknowledge& one) const { client.acknowledge(one); }
    void operator()(const Play& one) const { hub.session_.play(one.playing); }
    void operator()(const Seek& one) const { hub.session_.seek(one.frame); }
    void operator()(const PixelQuestion& one) const {
      const Client::Seen& seen = client.seen(one.side);
      hub.session_.ask({client.number(), one, seen.generation, seen.frame});
    }
    void operator()(const WhyQuestion& one) const {
      const Client::Seen& seen = client.seen(one.side);
      hub.session_.why({client.number(), one, seen.generation, seen.frame});
    }
    void operator()(Fit& one) const { hub.session_.fit(client.number(), std::move(one.array)); }
    void operator()(const Query& one) const { hub.session_.query(client.number(), one); }
    void operator()(Inquiry& one) const {
      const Side side = std::visit([](const auto& asked) { return asked.side; }, one);
      const Client::Seen& seen = client.seen(side);
      hub.session_.inquire({client.number(), std::move(one), side, seen.generation, seen.frame});
    }
    void operator()(Edit& one) const { hub.session_.edit(client.number(), std::move(one)); }
    void operator()(const Order& one) const { hub.session_.order(client.number(), one); }
  };
  Control control = parse_control(message);
  std::visit(Take{*this, client}, control);
}

/// Once a second at most, and only where there is something new.
void Hub::tell_counts() {
  if (ticking_) return;
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - told_at_).count();
  if (seconds < 1) {
    ticking_ = true;
    ticker_.expires_at(told_at_ + std::chrono::seconds(1));
    ticker_.async_wait([this](error_code error) {
      ticking_ = false;
      if (!error) tell_counts();
    });
    return;
  }
  if (counts_.computed == told_computed_) return;
  const double rate = seconds < 60 ? static_cast<double>(counts_.computed - told_computed_) / seconds : 0;
  told_computed_ = counts_.computed, told_at_ = now;
  const auto clients = clients_;
  for (const auto& [number, client] : clients) {
    files::Json json = files::Json::object();
    json.set("type", "stats").set("computed", counts_.computed).set("sent", client->sent()).set("dropped", client->dropped());
    json.set("compute_ms", counts_.compute_ms).set("fps", rate);
    client->tell(std::make_shared<const std::string>(files::json_text(json)));
  }
}

void Hub::close_all() {
  ticker_.cancel();
  const auto clients = clients_;
  for (const auto& [number, client] : clients) client->close(websocket::close_code::going_away);
}

}  // namespace tofray::view
