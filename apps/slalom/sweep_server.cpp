#include "sweep_server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "../../src/report/html.hpp"
#include "http_server.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "slalom/base/error.hpp"
#include "slalom/sweep/trial_drive.hpp"
#include "worker_command.hpp"

namespace slalom::app {
namespace {

constexpr const char* kAnyway = "anyway";  ///< asks for a drive's page, whatever was recorded

/// Digits that no other program can guess.
std::string random_token() {
  unsigned char bytes[16];
  if (::getrandom(bytes, sizeof bytes, 0) != sizeof bytes) throw Error("no random numbers");
  std::string token;
  for (const auto byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

/// The parts of "drives/000123/report.html".
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '/')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// Types by extension of what a sweep and its drives leave to be looked at.
const std::map<std::string, std::string>& types() {
  static const std::map<std::string, std::string> all = {{".html", "text/html; charset=utf-8"},
                                                         {".csv", "text/csv; charset=utf-8"},
                                                         {".svg", "image/svg+xml"},
                                                         {".json", "application/json"},
                                                         {".yaml", "text/plain; charset=utf-8"}};
  return all;
}

std::string extension_of(const std::string& name) {
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(dot);
}

bool is_among(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of a trial's folder, 000123, the 123; 0 for other names.
std::int64_t trial_of(const std::string& name) {
  const bool digits = name.find_first_not_of("0123456789") == std::string::npos;
  return digits && !name.empty() && name.size() <= 9 ? std::stoll(name) : 0;
}

/// Whether these parts name something that `slalom` leaves in a sweep's folder, to be shown.
bool is_known(const std::vector<std::string>& parts) {
  const auto is_figure = [](const std::string& folder, const std::string& name) {
    return folder == "figures" && !name.starts_with('.') && extension_of(name) == ".svg";
  };
  const auto& last = parts.back();
  if (parts.size() == 1) return is_among(last, {"index.html", "trials.csv"});
  if (parts.size() == 2) return is_figure(parts[0], last);
  if (parts[0] != "drives" || trial_of(parts[1]) == 0) return false;
  if (parts.size() == 3)
    return is_among(last, {"report.html", "plant.csv", "plans.csv", "cycles.csv", "summary.json",
                           "resolved.yaml"});
  return parts.size() == 4 && is_figure(parts[2], last);
}

/// Opens a regular file below a folder, by way of no link; none where there is none.
Descriptor open_below(const std::filesystem::path& folder, const std::vector<std::string>& parts) {
  Descriptor at(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (std::size_t i = 0; i < parts.size() && at.number() >= 0; ++i) {
    const int kind = i + 1 < parts.size() ? O_DIRECTORY : O_NONBLOCK;
    at = Descriptor(
        ::openat(at.number(), parts[i].c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | kind));
  }
  struct stat facts {};
  if (at.number() >= 0 && (::fstat(at.number(), &facts) != 0 || !S_ISREG(facts.st_mode)))
    return Descriptor();
  return at;
}

/// A page before the drive's own, which says in what it is not what the sweep recorded.
std::string page_before(std::int64_t trial, const std::string& difference) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n<title>Trial {0}</title>\n"
      "<p>This drive of trial {0} is not, or not for certain, the one that the sweep recorded: "
      "{1}.\n"
      "<p>Drives that go by the clock differ from run to run, and a trial recorded as failed has "
      "no drive to compare with.\n<p><a href=\"report.html?{2}\">Open it anyway</a>\n</html>\n",
      trial, report::escape(difference), kAnyway);
}

/// Drives what was not kept, one at a time.
class Drives {
 public:
  explicit Drives(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What came of the trial's drive; nothing while it, or another one, is at work.
  std::optional<HttpAnswer> make(std::int64_t trial) {
    if (at_work_.valid()) {
      if (at_work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
      auto answer = at_work_.get();
      if (trial_ == trial) return answer;
    }
    trial_ = trial;
    at_work_ = std::async(std::launch::async, [this, trial] { return drive(trial); });
    return {};
  }

 private:
  HttpAnswer drive(std::int64_t trial) const {
    try {
      (void)sweep::trial_drive(folder_, trial, worker_command(), interrupted);
      return {};
    } catch (const InvalidValue& error) {
      return {404, {}, error.what()};
    } catch (const std::exception& error) {
      return {500, {}, error.what()};
    }
  }

  const std::filesystem::path folder_;
  std::int64_t trial_ = 0;
  std::future<HttpAnswer> at_work_;  // last: it ends first
};

/// Who may ask, and what is answered.
class Pages {
 public:
  Pages(const std::filesystem::path& folder, int port)
      : folder_(folder), port_(port), root_("/" + random_token() + "/"), drives_(folder) {}

  std::string address() const {
    return fmt::format("http://localhost:{}{}index.html", port_, root_);
  }

  std::optional<HttpAnswer> answer(const HttpRequest& request) {
    if (!is_own(request))
      return HttpAnswer{403, {}, "only this page's own requests are answered\n"};
    if (!is_among(request.method, {"GET", "HEAD"}))
      return HttpAnswer{405, {}, "only GET and HEAD are answered\n"};
    const auto query = request.target.find_first_of("?#");
    const auto path = request.target.substr(0, query);
    if (!path.starts_with(root_))
      return HttpAnswer{403, {}, "the address is the one that 'slalom study-report' printed\n"};
    const auto parts = parts_of(path.substr(root_.size()));
    if (!is_known(parts)) return HttpAnswer{404, {}, "no such page\n"};
    auto file = found(parts);
    const bool is_drive = parts.back() == "report.html";
    if (!file && is_drive && may_drive(request)) {
      auto made = drives_.make(trial_of(parts[1]));
      if (!made || made->status != 200) return made;
      file = found(parts);
      if (!file) return HttpAnswer{404, {}, "the drive did not come to its end\n"};
    }
    if (!file) return HttpAnswer{404, {}, "no such page\n"};
    const bool anyway = query != std::string::npos && request.target.substr(query + 1) == kAnyway;
    if (is_drive && !anyway)
      if (auto other = before(trial_of(parts[1]))) return other;
    return file;
  }

 private:
  std::optional<HttpAnswer> found(const std::vector<std::string>& parts) const {
    HttpAnswer answer;
    answer.file = open_below(folder_, parts);
    if (answer.file.number() < 0) return {};
    answer.type = types().at(extension_of(parts.back()));
    return answer;
  }

  /// What is answered before a drive that is not as recorded.
  std::optional<HttpAnswer> before(std::int64_t trial) const {
    try {
      const auto kept = sweep::kept_drive(folder_, trial);
      if (!kept || kept->difference.empty()) return {};
      return HttpAnswer{200, types().at(".html"), page_before(trial, kept->difference)};
    } catch (const Error& error) {
      return HttpAnswer{200, types().at(".html"), page_before(trial, error.what())};
    }
  }

  /// Not of a page elsewhere, whose name leads here (DNS rebinding) or which asks across origins.
  bool is_own(const HttpRequest& request) const {
    const auto host = request.header("host"), origin = request.header("origin");
    bool known_host = false, known_origin = origin.empty();
    for (const std::string name : {"localhost", "127.0.0.1"}) {
      const auto full = fmt::format("{}:{}", name, port_);
      known_host |= host == full || host == name;
      known_origin |= origin == "http://" + full;
    }
    return known_host && known_origin &&
           is_among(request.header("sec-fetch-site"), {"", "none", "same-origin"});
  }

  /// A look, or what a browser fetches in case it is needed, must not set a drive going.
  static bool may_drive(const HttpRequest& request) {
    return request.method == "GET" && request.header("sec-purpose").empty() &&
           request.header("purpose").empty();
  }

  const std::filesystem::path folder_;
  const int port_;
  const std::string root_;
  Drives drives_;
};

}  // namespace

void serve_sweep(const std::filesystem::path& folder, int port) {
  HttpServer server(port);
  Pages pages(folder, server.port());
  print(fmt::format("{} (Ctrl-C ends)\n", pages.address()));
  server.run([&](const HttpRequest& request) { return pages.answer(request); }, interrupted);
}

}  // namespace slalom::app
