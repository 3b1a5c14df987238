#include "http_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>
#include <vector>

#include "slalom/base/error.hpp"

namespace slalom::app {
namespace {

constexpr std::size_t kMostConnections = 64;
constexpr std::size_t kMostHead = 8192;  ///< bytes of a head
constexpr std::size_t kPart = 1 << 16;   ///< bytes sent at once
constexpr double kHeadTime = 5;          ///< [s] for a whole head
constexpr double kStall = 20;            ///< [s] for the next bytes to be taken
constexpr double kEnding = 1;            ///< [s] for a client to close, or it may lose the answer
constexpr std::size_t kMostDrained = 1 << 18;
constexpr int kTick = 50;  ///< [ms]

const char* reason(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 413:
      return "Content Too Large";
    case 431:
      return "Request Header Fields Too Large";
    default:
      return "Internal Server Error";
  }
}

bool would_wait(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

HttpServer::HttpServer(int port)
    : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  const int yes = 1;  // and not SO_REUSEPORT, by which two servers would share a port
  ::setsockopt(listener_.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  socklen_t size = sizeof address;
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* plain = reinterpret_cast<sockaddr*>(&address);
  if (::bind(listener_.number(), plain, size) != 0 ||
      ::listen(listener_.number(), kMostConnections) != 0 ||
      ::getsockname(listener_.number(), plain, &size) != 0)
    throw Error(fmt::format("port {}: is taken; --serve 0 finds a free one", port));
  port_ = ntohs(address.sin_port);
}

void HttpServer::run(const Handler& handler, const std::function<bool()>& stop) {
  while (!stop()) {
    std::vector<pollfd> polled = {{listener_.number(), POLLIN, 0}};
    for (const auto& one : connections_) {
      const bool sends = one.state == State::writing;
      polled.push_back({one.socket.number(), static_cast<short>(sends ? POLLOUT : POLLIN), 0});
      // One that waits for its answer has nothing to say; that it is gone shows at the end.
      if (one.state == State::waiting) polled.back().events = 0;
    }
    if (::poll(polled.data(), polled.size(), kTick) < 0) continue;  // a signal
    std::size_t i = 1;
    for (auto& one : connections_) advance(one, polled[i++].revents, handler);
    connections_.remove_if([](const Connection& one) { return one.state == State::over; });
    if (polled[0].revents != 0) accept_all();
  }
}

void HttpServer::accept_all() {
  for (;;) {
    const int socket =
        ::accept4(listener_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket < 0) return;
    make_room();
    connections_.push_back({Descriptor(socket)});
  }
}

void HttpServer::make_room() {
  if (connections_.size() < kMostConnections) return;
  for (const auto state : {State::reading, State::ending, State::writing, State::waiting}) {
    const auto found = std::find_if(connections_.begin(), connections_.end(),
                                    [&](const Connection& one) { return one.state == state; });
    if (found == connections_.end()) continue;
    connections_.erase(found);
    return;
  }
}

void HttpServer::advance(Connection& one, short events, const Handler& handler) {
  if (events != 0) {
    if (one.state == State::reading) read_head(one);
    if (one.state == State::writing) write_some(one);
    if (one.state == State::ending) drain(one);
    if (one.state == State::waiting) one.state = State::over;  // it hung up
  }
  if (one.state == State::waiting || (one.state == State::reading && one.request)) {
    if (auto made = handler(*one.request))
      answer(one, std::move(*made));
    else
      one.state = State::waiting;
  }
  const double spent = std::chrono::duration<double>(Clock::now() - one.since).count();
  if ((one.state == State::reading && spent > kHeadTime) ||
      (one.state == State::writing && spent > kStall) ||
      (one.state == State::ending && spent > kEnding))
    one.state = State::over;
}

void HttpServer::read_head(Connection& one) {
  char buffer[kMostHead];
  const auto count = ::recv(one.socket.number(), buffer, sizeof buffer, 0);
  if (count < 0 && would_wait(errno)) return;
  if (count <= 0) {
    one.state = State::over;
    return;
  }
  one.in.append(buffer, static_cast<std::size_t>(count));
  const auto end = one.in.find("\r\n\r\n");
  if (end == std::string::npos || end > kMostHead) {
    if (one.in.size() > kMostHead) answer(one, {431, {}, "the head is too long\n"});
    return;
  }
  one.request = parse_http_request(std::string_view(one.in).substr(0, end));
  if (!one.request)
    answer(one, {400, {}, "no HTTP request\n"});
  else if (one.request->has_content())
    answer(one, {413, {}, "content is not taken\n"});
}

void HttpServer::answer(Connection& one, HttpAnswer made) {
  struct stat facts {};
  std::size_t length = made.text.size();
  one.file = std::move(made.file);
  if (one.file.number() >= 0 && ::fstat(one.file.number(), &facts) == 0)
    length = static_cast<std::size_t>(facts.st_size);
  one.out = fmt::format("HTTP/1.1 {} {}\r\nContent-Length: {}\r\nConnection: close\r\n",
                        made.status, reason(made.status), length);
  one.out += fmt::format("Content-Type: {}\r\n", made.type.empty() ? HttpAnswer().type : made.type);
  if (made.status == 405) one.out += "Allow: GET, HEAD\r\n";
  // Nothing of another origin may frame a page, read it or be told where it is.
  one.out +=
      "Cache-Control: no-cache\r\nX-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\n"
      "Cross-Origin-Resource-Policy: same-origin\r\nReferrer-Policy: no-referrer\r\n\r\n";
  if (one.request && one.request->method == "HEAD")
    one.file = Descriptor();
  else
    one.out += made.text;
  one.state = State::writing;
  one.since = Clock::now();
}

void HttpServer::write_some(Connection& one) {
  if (one.out.empty() && one.file.number() >= 0) {
    one.out.resize(kPart);
    const auto count = ::read(one.file.number(), one.out.data(), kPart);
    one.out.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count <= 0) one.file = Descriptor();
  }
  if (!one.out.empty()) {
    const auto count = ::send(one.socket.number(), one.out.data(), one.out.size(), MSG_NOSIGNAL);
    if (count < 0 && would_wait(errno)) return;
    if (count <= 0) {
      one.state = State::over;
      return;
    }
    one.out.erase(0, static_cast<std::size_t>(count));
    one.since = Clock::now();
  }
  if (!one.out.empty() || one.file.number() >= 0) return;
  ::shutdown(one.socket.number(), SHUT_WR);
  one.state = State::ending;
}

/// What a client still sends would make the system throw away the answer, were it not read.
void HttpServer::drain(Connection& one) {
  char buffer[kPart];
  const auto count = ::recv(one.socket.number(), buffer, sizeof buffer, 0);
  one.drained += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  if (count == 0 || (count < 0 && !would_wait(errno)) || one.drained > kMostDrained)
    one.state = State::over;
}

}  // namespace slalom::app
