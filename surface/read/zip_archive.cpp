#include "surface/read/zip_archive.hpp"

#include <zip.h>

#include <algorithm>
#include <cstdint>

#include "base/memory.hpp"

namespace curveskel {
namespace {

constexpr std::string_view zip_remedy =
    "the archive is truncated or broken: fetch or export it again";
constexpr zip_int64_t most_entries = 100000;

/// Closed at the end of its scope.
class OpenEntry {
 public:
  explicit OpenEntry(zip_file_t* entry) : entry_(entry) {}
  ~OpenEntry() {
    if (entry_ != nullptr) zip_fclose(entry_);
  }
  OpenEntry(const OpenEntry&) = delete;
  OpenEntry& operator=(const OpenEntry&) = delete;
  [[nodiscard]] zip_file_t* get() const { return entry_; }

 private:
  zip_file_t* entry_;
};

std::string zip_message(const zip_error_t* error) {
  zip_error_t copy = *error;
  copy.str = nullptr;
  std::string message = zip_error_strerror(&copy);
  zip_error_fini(&copy);
  return message;
}

}  // namespace

struct ZipArchive::Handle {
  zip_t* archive = nullptr;
  ~Handle() {
    if (archive != nullptr) zip_discard(archive);
  }
};

bool is_zipped(const std::string& content) { return content.starts_with("PK\x03\x04"); }

ZipArchive::ZipArchive(const FileBytes& file) : file_(file), handle_(std::make_unique<Handle>()) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source =
      zip_source_buffer_create(file.content.data(), file.content.size(), 0, &error);
  if (source != nullptr) {
    handle_->archive = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (handle_->archive == nullptr) zip_source_free(source);
  }
  const std::string message = zip_message(&error);
  zip_error_fini(&error);
  if (handle_->archive == nullptr) {
    file.fail("a ZIP archive that cannot be opened (" + message + ")", "a sound one", zip_remedy);
  }
  const zip_int64_t entries = std::min(zip_get_num_entries(handle_->archive, 0), most_entries);
  for (zip_int64_t i = 0; i < entries; ++i) {
    const char* name = zip_get_name(handle_->archive, static_cast<zip_uint64_t>(i), 0);
    names_.emplace_back(name == nullptr ? "" : name);
  }
}

ZipArchive::~ZipArchive() = default;

bool ZipArchive::holds(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

FileBytes ZipArchive::unpack(const std::string& name, const Monitor& monitor) const {
  constexpr std::size_t chunk_bytes = std::size_t{1} << 20U;
  FileBytes unpacked{file_.path.string() + ", " + name, {}};
  const OpenEntry entry(zip_fopen(handle_->archive, name.c_str(), 0));
  if (entry.get() == nullptr) {
    unpacked.fail(
        "that it cannot be unpacked (" + zip_message(zip_get_error(handle_->archive)) + ")",
        "a file in the archive, without a password", zip_remedy);
  }
  for (std::size_t used = 0;;) {
    if (used == unpacked.content.size()) {
      const std::size_t room = std::max(2 * used, chunk_bytes);
      // Twice, as the surface in it takes about as much again.
      require_memory(2 * static_cast<double>(room), available_memory_bytes(),
                     unpacked.path.string() + ", unpacked", Fault::input,
                     "it is too large for this machine, or no honest file");
      unpacked.content.resize(room);
    }
    const std::size_t wanted = std::min(chunk_bytes, unpacked.content.size() - used);
    const zip_int64_t got = zip_fread(entry.get(), unpacked.content.data() + used, wanted);
    if (got < 0) {
      unpacked.fail("that unpacking breaks off after " + std::to_string(used) + " bytes (" +
                        zip_message(zip_file_get_error(entry.get())) + ")",
                    "an intact archive", zip_remedy);
    }
    if (got == 0) {
      unpacked.content.resize(used);
      return unpacked;
    }
    used += static_cast<std::size_t>(got);
    monitor.report("read", 0);
  }
}

}  // namespace curveskel
