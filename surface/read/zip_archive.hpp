// The files in a ZIP archive. Internal to surface/.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

[[nodiscard]] bool is_zipped(const std::string& content);

/// An archive in memory; the file must outlive it.
class ZipArchive {
 public:
  /// Throws Error(Fault::input) where the content is no sound archive.
  explicit ZipArchive(const FileBytes& file);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  /// Names as the archive has them, in its order; no more than 100,000 are looked at.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] bool holds(const std::string& name) const;
  /// The unpacked content, whose path says "ARCHIVE, NAME". Memory grows with what is really
  /// unpacked and is checked against what there is. Throws Error(Fault::input) for a file that is
  /// missing, encrypted, broken, or too large for this machine.
  [[nodiscard]] FileBytes unpack(const std::string& name, const Monitor& monitor) const;

 private:
  struct Handle;
  const FileBytes& file_;
  std::unique_ptr<Handle> handle_;
  std::vector<std::string> names_;
};

}  // namespace curveskel
