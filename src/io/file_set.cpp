#include "file_set.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <set>
#include <thread>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"

namespace slalom::io {
namespace fs = std::filesystem;
namespace {

/// Files of one drive, plan or lap, which say nothing of the next one there. A folder is known by
/// them, or by the page of several, as one of results.
constexpr const char* kOfOne[] = {"plant.csv",    "plans.csv",     "cycles.csv",
                                  "summary.json", "resolved.yaml", "report.html",
                                  "plan.csv",     "plan.json",     "lap.csv"};
constexpr const char* kPage = "index.html";
constexpr const char* kFigures[] = {"figures/path.svg",         "figures/speed.svg",
                                    "figures/acceleration.svg", "figures/steering.svg",
                                    "figures/lateral.svg",      "figures/wheel_loads.svg",
                                    "figures/solve_time.svg"};

[[noreturn]] void fail(const fs::path& path, int error) {
  throw Error(fmt::format("{}: cannot be written ({})", path.string(), std::strerror(error)));
}

/// Writes all of `text`; 0 or the errno of what went wrong.
int write_all(int descriptor, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::write(descriptor, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0 ? ENOSPC : errno;
    done += static_cast<std::size_t>(count);
  }
  return 0;
}

/// Flushes and closes; `problem` is the first errno so far, and stays. A full disk may show as late
/// as here.
int flush_and_close(int descriptor, int problem) {
  if (problem == 0 && ::fsync(descriptor) != 0 && errno != EINVAL) problem = errno;
  if (::close(descriptor) != 0 && problem == 0) problem = errno;
  return problem;
}

/// Makes a rename survive a power cut; a file system that cannot is no reason to fail.
void flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Whether create_aside made a file of this name, or a version before it did.
bool is_aside(const std::string& name) {
  const std::string end = ".aside";
  if (!name.starts_with('.') || !name.ends_with(end)) return false;
  const auto stem = name.substr(0, name.size() - end.size());
  const auto dot = stem.rfind('.');
  return dot > 0 && dot + 1 < stem.size() &&
         stem.find_first_not_of("0123456789abcdef", dot + 1) == std::string::npos;
}

void remove_asides(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (is_aside(it->path().filename().string()) && !it->is_symlink() && it->is_regular_file(error))
      left.push_back(it->path());
  for (const auto& file : left) ::unlink(file.c_str());
}

/// A new file beside `path` and its descriptor, -1 with errno where there can be none. Nobody can
/// have put a link, or a file, there beforehand.
std::pair<fs::path, int> create_aside(const fs::path& path) {
  constexpr std::size_t kMostOfName = 150;  // so that names of any length have room
  for (;;) {
    std::uint64_t digits = 0;
    if (::getrandom(&digits, sizeof digits, 0) != sizeof digits) return {{}, -1};
    auto aside =
        folder_of(path) /
        fmt::format(".{}.{:016x}.aside", path.filename().string().substr(0, kMostOfName), digits);
    const int descriptor =
        ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return {std::move(aside), descriptor};
  }
}

}  // namespace

/// A folder in which files stand aside: locked, so that nobody takes them for leftovers. Where
/// there are no locks, leftovers stay.
class FileSet::Folder {
 public:
  explicit Folder(const fs::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) remove_asides(folder);
    // Not for long: who locks the folder for other reasons than ours looks for no leftovers.
    for (int i = 0; i < 20 && ::flock(descriptor_, LOCK_SH | LOCK_NB) != 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ~Folder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

 private:
  int descriptor_;
};

FileSet::FileSet() = default;

FileSet::~FileSet() {
  for (const auto& file : pending_) ::unlink(file.aside.c_str());
  // Only what this set made, and only while it is empty.
  for (auto it = made_folders_.rbegin(); it != made_folders_.rend(); ++it) ::rmdir(it->c_str());
}

void FileSet::add(const fs::path& path, const std::string& text) {
  const std::string* rest = &text;
  add(path, [&] { return rest == nullptr ? std::string() : *std::exchange(rest, nullptr); });
}

void FileSet::add(const fs::path& path, const std::function<std::string()>& next_part) {
  const auto folder = folder_of(path);
  std::error_code error;
  if (!fs::exists(folder, error)) {
    fs::create_directories(folder, error);
    if (error) fail(folder, error.value());
    made_folders_.push_back(folder);
  }
  if (fs::is_directory(path, error)) fail(path, EISDIR);
  if (const int problem = write_aside(path, next_part)) fail(path, problem);
}

int FileSet::write_aside(const fs::path& path, const std::function<std::string()>& next_part) {
  const auto folder = folder_of(path);
  folders_.try_emplace(folder, folder);
  const auto [aside, descriptor] = create_aside(path);
  if (descriptor < 0) return errno;
  pending_.push_back({aside, path});
  int problem = 0;
  try {
    for (auto part = next_part(); problem == 0 && !part.empty(); part = next_part())
      problem = write_all(descriptor, part);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  return flush_and_close(descriptor, problem);
}

void FileSet::replace_results(const fs::path& folder) {
  replaced_.push_back(folder);
}

/// Once the new files stand, so that there is a result at every moment. What cannot be removed is
/// no reason to fail: the results are there.
void FileSet::remove_replaced() const {
  std::set<fs::path> written;
  for (const auto& file : pending_) written.insert(file.path);
  for (const auto& folder : replaced_) {
    const auto remove = [&](const char* name) {
      if (written.count(folder / name) == 0) ::unlink((folder / name).c_str());
    };
    for (const char* name : kOfOne) remove(name);
    for (const char* name : kFigures) remove(name);
    ::rmdir((folder / "figures").c_str());  // which fails unless it is empty
  }
}

int FileSet::probe(const fs::path& folder) {
  FileSet files;
  bool written = false;
  return files.write_aside(folder / "slalom", [&] {
    return std::exchange(written, true) ? std::string() : std::string("probe\n");
  });
}

void FileSet::commit() {
  for (const auto& file : pending_)
    if (::rename(file.aside.c_str(), file.path.c_str()) != 0) fail(file.path, errno);
  remove_replaced();
  for (const auto& folder : folders_) flush_folder(folder.first);
  replaced_.clear();
  pending_.clear();
  folders_.clear();
  made_folders_.clear();
}

void write_file(const fs::path& path, const std::string& text) {
  FileSet files;
  files.add(path, text);
  files.commit();
}

void prepare_folder(const fs::path& folder, bool force) {
  std::error_code error;
  const auto name = folder.string();
  const auto status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status))
    throw Error(fmt::format("{}: is a file, expected a folder for results", name));
  const auto refuse = [&](const char* result) {
    if (fs::exists(folder / result, error))
      throw Error(
          fmt::format("{}: holds results already ({}); use --force to replace them", name, result));
  };
  if (!force) {
    for (const char* result : kOfOne) refuse(result);
    refuse(kPage);
  }
  const bool existed = fs::exists(status);
  fs::create_directories(folder, error);
  if (error) fail(folder, error.value());

  // Better to learn now than after minutes of solving.
  const int problem = FileSet::probe(folder);
  if (problem == 0) return;
  if (!existed) fs::remove(folder, error);
  fail(folder, problem);
}

}  // namespace slalom::io
