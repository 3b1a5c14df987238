#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <optional>
#include <string>

#include "http_request.hpp"

namespace slalom::app {

/// A file descriptor, closed at its end; -1 is none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;

  int number() const { return number_; }

 private:
  int number_;
};

/// What a request is answered with: a text, or an open regular file from its beginning on.
struct HttpAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string text;
  Descriptor file = Descriptor();
};

/// A server for the pages of this machine's user: one thread, one request a connection, no content
/// taken, at most 64 connections. A client that does not send its head within some seconds, or does
/// not take what it asked for, is dropped; where all connections are taken, the one that has taken
/// longest over its head makes room for the next.
class HttpServer {
 public:
  /// Nothing: not yet, ask again.
  using Handler = std::function<std::optional<HttpAnswer>(const HttpRequest&)>;

  /// Listens at a port of 127.0.0.1; 0 takes a free one. Throws Error when it is taken.
  explicit HttpServer(int port);

  int port() const { return port_; }
  /// Answers requests until `stop`, which is asked several times a second.
  void run(const Handler& handler, const std::function<bool()>& stop);

 private:
  using Clock = std::chrono::steady_clock;
  enum class State { reading, waiting, writing, ending, over };
  struct Connection {
    Descriptor socket;
    State state = State::reading;
    Clock::time_point since = Clock::now();  ///< of the state, or of the last progress in it
    std::string in = {}, out = {};
    std::optional<HttpRequest> request = {};
    Descriptor file = Descriptor();
    std::size_t drained = 0;  ///< bytes read after the answer
  };

  void accept_all();
  void make_room();
  static void read_head(Connection& connection);
  static void answer(Connection& connection, HttpAnswer answer);
  static void write_some(Connection& connection);
  static void drain(Connection& connection);
  void advance(Connection& connection, short events, const Handler& handler);

  Descriptor listener_;
  int port_ = 0;
  std::list<Connection> connections_;  ///< the oldest first
};

}  // namespace slalom::app
