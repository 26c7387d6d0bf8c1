// EXT_meshopt_compression: buffer views whose content meshoptimizer has encoded.
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "surface/read/gltf_compression.hpp"
#include "surface/read/gltf_numbers.hpp"

namespace curveskel {
namespace {

/// One compressed buffer view.
class MeshoptView {
 public:
  MeshoptView(const FileBytes& file, const tinygltf::Model& model, std::size_t index,
              const tinygltf::Value& extension)
      : file_(file), index_(index) {
    if (!extension.IsObject()) refuse("no object");
    mode_ = text(extension, "mode", "");
    filter_ = text(extension, "filter", "NONE");
    count_ = size(extension, "count");
    stride_ = size(extension, "byteStride");
    const std::size_t offset = extension.Has("byteOffset") ? size(extension, "byteOffset") : 0;
    length_ = size(extension, "byteLength");
    const auto& buffer =
        gltf_element(file, model.buffers, static_cast<int>(size(extension, "buffer")), "buffer");
    if (offset > buffer.data.size() || length_ > buffer.data.size() - offset) {
      refuse(std::to_string(length_) + " bytes from " + std::to_string(offset) + " of " +
             std::to_string(buffer.data.size()));
    }
    data_ = buffer.data.data() + offset;
    check_numbers();
  }

  [[nodiscard]] std::vector<unsigned char> decode() const {
    std::vector<unsigned char> plain(count_ * stride_);
    int error = 0;
    if (mode_ == "ATTRIBUTES") {
      error = meshopt_decodeVertexBuffer(plain.data(), count_, stride_, data_, length_);
    } else if (mode_ == "TRIANGLES") {
      error = meshopt_decodeIndexBuffer(plain.data(), count_, stride_, data_, length_);
    } else {
      error = meshopt_decodeIndexSequence(plain.data(), count_, stride_, data_, length_);
    }
    if (error != 0) refuse("broken data");
    if (filter_ == "OCTAHEDRAL") meshopt_decodeFilterOct(plain.data(), count_, stride_);
    if (filter_ == "QUATERNION") meshopt_decodeFilterQuat(plain.data(), count_, stride_);
    if (filter_ == "EXPONENTIAL") meshopt_decodeFilterExp(plain.data(), count_, stride_);
    return plain;
  }

 private:
  static constexpr std::size_t most = 0x7fffffff;

  /// The ranges that the extension prescribes, and no more rows than so few bytes can say: of
  /// attributes a byte of each of 16 rows takes at least 2 bits, an index or triangle a byte.
  void check_numbers() const {
    const bool attributes = mode_ == "ATTRIBUTES";
    const bool triangles = mode_ == "TRIANGLES";
    const bool of_known_mode = attributes || triangles || mode_ == "INDICES";
    const bool of_known_filter =
        filter_ == "NONE" ||
        (attributes && ((filter_ == "OCTAHEDRAL" && (stride_ == 4 || stride_ == 8)) ||
                        (filter_ == "QUATERNION" && stride_ == 8) || filter_ == "EXPONENTIAL"));
    const bool of_right_stride = attributes ? stride_ > 0 && stride_ <= 256 && stride_ % 4 == 0
                                            : stride_ == 2 || stride_ == 4;
    if (!of_known_mode || !of_known_filter || !of_right_stride || (triangles && count_ % 3 != 0)) {
      refuse("mode " + in_quotes(mode_) + ", filter " + in_quotes(filter_) + ", stride " +
             std::to_string(stride_) + ", count " + std::to_string(count_));
    }
    const std::size_t rows = triangles ? count_ / 3 : count_;
    const std::size_t most_rows = attributes ? (length_ + 16) * 64 / stride_ + 16 : length_;
    if (rows > most_rows) {
      refuse(std::to_string(count_) + " rows in " + std::to_string(length_) + " bytes");
    }
  }

  [[nodiscard]] std::size_t size(const tinygltf::Value& extension, const std::string& name) const {
    const tinygltf::Value& value = extension.Get(name);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1;
    if (!(number >= 0 && number <= static_cast<double>(most))) refuse("no valid " + name);
    return static_cast<std::size_t>(number);
  }

  static std::string text(const tinygltf::Value& extension, const std::string& name,
                          const std::string& otherwise) {
    const tinygltf::Value& value = extension.Get(name);
    return value.IsString() ? value.Get<std::string>() : otherwise;
  }

  [[noreturn]] void refuse(const std::string& found) const {
    file_.fail(found + " in buffer view " + std::to_string(index_) + " (" +
                   std::string(meshopt_extension) + ")",
               "what the extension prescribes", "compress the file again, with gltfpack");
  }

  const FileBytes& file_;
  std::size_t index_;
  std::string mode_;
  std::string filter_;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  std::size_t length_ = 0;
  const unsigned char* data_ = nullptr;
};

}  // namespace

void decompress_meshopt(const FileBytes& file, tinygltf::Model& model, const Monitor& monitor) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    const auto extension = model.bufferViews[i].extensions.find(std::string(meshopt_extension));
    if (extension == model.bufferViews[i].extensions.end()) continue;
    monitor.report("read", 0.3);
    tinygltf::Buffer plain;
    plain.data = MeshoptView(file, model, i, extension->second).decode();
    tinygltf::BufferView& view = model.bufferViews[i];
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteOffset = 0;
    view.byteLength = plain.data.size();
    model.buffers.push_back(std::move(plain));
  }
}

}  // namespace curveskel
