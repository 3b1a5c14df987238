#include "file_set.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"

namespace slalom::io {
namespace fs = std::filesystem;
namespace {

/// Files by which a folder of results is known.
constexpr const char* kResults[] = {"plant.csv",    "plans.csv",     "cycles.csv",
                                    "summary.json", "resolved.yaml", "report.html",
                                    "plan.csv",     "plan.json",     "index.html"};

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

}  // namespace

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

  const auto aside = folder / fmt::format(".{}.{}.aside", path.filename().string(), ::getpid());
  const int descriptor = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path, errno);
  pending_.push_back({aside, path});
  int problem = 0;
  try {
    for (auto part = next_part(); problem == 0 && !part.empty(); part = next_part())
      problem = write_all(descriptor, part);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  problem = flush_and_close(descriptor, problem);
  if (problem != 0) fail(path, problem);
}

void FileSet::commit() {
  for (const auto& file : pending_)
    if (::rename(file.aside.c_str(), file.path.c_str()) != 0) fail(file.path, errno);
  std::set<fs::path> folders;
  for (const auto& file : pending_) folders.insert(folder_of(file.path));
  for (const auto& folder : folders) flush_folder(folder);
  pending_.clear();
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
  if (!force)
    for (const char* result : kResults)
      if (fs::exists(folder / result, error))
        throw Error(fmt::format("{}: holds results already ({}); use --force to replace them", name,
                                result));
  const bool existed = fs::exists(status);
  fs::create_directories(folder, error);
  if (error) fail(folder, error.value());

  // Better to learn now than after minutes of solving.
  const auto probe = folder / fmt::format(".slalom.{}.aside", ::getpid());
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int problem = descriptor < 0 ? errno : write_all(descriptor, "probe\n");
  if (descriptor >= 0) {
    problem = flush_and_close(descriptor, problem);
    ::unlink(probe.c_str());
  }
  if (problem == 0) return;
  if (!existed) fs::remove(folder, error);
  fail(folder, problem);
}

}  // namespace slalom::io
