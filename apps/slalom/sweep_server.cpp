#include "sweep_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "interrupt.hpp"
#include "options.hpp"
#include "slalom/base/error.hpp"
#include "slalom/sweep/trial_drive.hpp"

namespace slalom::app {
namespace {

constexpr const char* kHost = "127.0.0.1";

/// Drives what was not kept, one at a time: the instruction set is the process's.
class Drives {
 public:
  explicit Drives(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Before the files themselves are looked for.
  httplib::Server::HandlerResponse make(const std::string& number, httplib::Response& response) {
    const std::lock_guard lock(mutex_);
    try {
      (void)sweep::trial_drive(folder_, std::stoll(number));
      return httplib::Server::HandlerResponse::Unhandled;
    } catch (const InvalidValue& error) {
      response.status = 404;
      response.set_content(error.what(), "text/plain; charset=utf-8");
    } catch (const Error& error) {
      response.status = 500;
      response.set_content(error.what(), "text/plain; charset=utf-8");
    }
    return httplib::Server::HandlerResponse::Handled;
  }

 private:
  const std::filesystem::path folder_;
  std::mutex mutex_;
};

/// Of /drives/000123/report.html the 123; empty for other paths.
std::string trial_of(const std::string& path) {
  const std::string begin = "/drives/", end = "/report.html";
  if (!path.starts_with(begin) || !path.ends_with(end) || path.size() <= begin.size() + end.size())
    return "";
  auto number = path.substr(begin.size(), path.size() - begin.size() - end.size());
  const bool digits = number.find_first_not_of("0123456789") == std::string::npos;
  return digits && number.size() <= 9 ? number : "";
}

}  // namespace

void serve_sweep(const std::filesystem::path& folder, int port) {
  httplib::Server server;
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;  // and not SO_REUSEPORT, by which two servers would share a port
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  Drives drives(folder);
  server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
    const auto trial = trial_of(request.path);
    return trial.empty() ? httplib::Server::HandlerResponse::Unhandled
                         : drives.make(trial, response);
  });
  server.set_mount_point("/", folder.string());
  const int bound = port == 0                          ? server.bind_to_any_port(kHost)
                    : server.bind_to_port(kHost, port) ? port
                                                       : -1;
  if (bound < 0) throw Error(fmt::format("port {}: is taken; --serve 0 finds a free one", port));
  print(fmt::format("http://localhost:{}/index.html (Ctrl-C ends)\n", bound));
  std::jthread watch([&](const std::stop_token& stop) {
    while (!interrupted() && !stop.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    server.stop();
  });
  server.listen_after_bind();
}

}  // namespace slalom::app
