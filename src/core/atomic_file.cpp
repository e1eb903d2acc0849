// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/atomic_file.hpp"

#include <cerrno>
#include <fstream>
#include <locale>
#include <random>
#include <string>
#include <system_error>

#include "rhmap/core/failure.hpp"

namespace rhmap {

namespace {

/// A file beside the target that goes away unless it took the target's place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : path_(target) {
    path_ += '.';
    path_ += std::to_string(std::random_device()());  // two writers never share one
    path_ += ".tmp";
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

  void moveTo(const std::filesystem::path& target) {
    std::error_code error;
    std::filesystem::rename(path_, target, error);
    if (error) failOnFile(target, "cannot be replaced: " + error.message());
    path_.clear();
  }

 private:
  std::filesystem::path path_;
};

std::string lastError() { return errno == 0 ? "unknown error" : std::generic_category().message(errno); }

}  // namespace

void writeFileWhole(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  TemporaryFile temporary(file);
  std::ofstream stream;
  stream.imbue(std::locale::classic());
  errno = 0;
  stream.open(temporary.path(), std::ios::binary | std::ios::trunc);
  if (!stream) failOnFile(file, "cannot be created: " + lastError());
  write(stream);
  if (stream) stream.flush();
  if (!stream) failOnFile(file, "cannot be written: " + lastError());
  stream.close();
  if (!stream) failOnFile(file, "cannot be closed: " + lastError());
  temporary.moveTo(file);
}

}  // namespace rhmap
