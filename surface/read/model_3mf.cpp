// https://3mf.io/spec has the core specification. The XML goes by in one pass, as a model may have
// millions of vertices.
#include "surface/read/model_3mf.hpp"

#include <expat.h>
#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

constexpr std::string_view core_namespace =
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr std::string_view production_namespace =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
constexpr char namespace_end = '|';

struct KnownName {
  std::string_view key;
  std::string_view name;
};
/// Extensions without which a mesh is another one; those not here only add colour and the like.
constexpr std::array<KnownName, 6> shape_extensions{{{"/beamlattice/", "beam lattice"},
                                                     {"/slice/", "slice"},
                                                     {"/securecontent/", "secure content"},
                                                     {"/volumetric/", "volumetric"},
                                                     {"/implicit/", "implicit"},
                                                     {"/displacement/", "displacement"}}};

struct LengthUnit {
  std::string_view name;
  double millimetres;
};
constexpr std::array<LengthUnit, 6> length_units{{{"micron", 0.001},
                                                  {"millimeter", 1},
                                                  {"centimeter", 10},
                                                  {"inch", 25.4},
                                                  {"foot", 304.8},
                                                  {"meter", 1000}}};

class Model3mfParser {
 public:
  Model3mfParser(const FileBytes& part, const Monitor& monitor)
      : part_(part), monitor_(monitor), parser_(XML_ParserCreateNS(nullptr, namespace_end)) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetStartElementHandler(parser_.get(), [](void* self, const char* name, const char** rest) {
      static_cast<Model3mfParser*>(self)->guarded([&](Model3mfParser& p) { p.open(name, rest); });
    });
    XML_SetStartNamespaceDeclHandler(
        parser_.get(), [](void* self, const char* prefix, const char* uri) {
          static_cast<Model3mfParser*>(self)->guarded([&](Model3mfParser& p) {
            p.namespaces_[prefix == nullptr ? "" : prefix] = uri == nullptr ? "" : uri;
          });
        });
    XML_SetStartDoctypeDeclHandler(
        parser_.get(), [](void* self, const char* /*name*/, const char* /*id*/, const char* /*id*/,
                          int /*internal*/) {
          static_cast<Model3mfParser*>(self)->guarded(
              [](const Model3mfParser& p) { p.fail("a DOCTYPE", "none, as 3MF has it"); });
        });
  }

  Model3mf parse() {
    constexpr std::size_t piece_bytes = std::size_t{1} << 20U;
    const std::string& text = part_.content;
    for (std::size_t at = 0; at < text.size(); at += piece_bytes) {
      const std::size_t size = std::min(piece_bytes, text.size() - at);
      const bool last = at + size == text.size();
      const XML_Status status =
          XML_Parse(parser_.get(), text.data() + at, static_cast<int>(size), last ? 1 : 0);
      if (error_) std::rethrow_exception(error_);
      if (status != XML_STATUS_OK) {
        fail(XML_ErrorString(XML_GetErrorCode(parser_.get())), "sound XML");
      }
      monitor_.report("read", static_cast<double>(at) / static_cast<double>(text.size()));
    }
    if (!has_model_) fail("no <model>", "one");
    for (const Object3mf& object : model_.objects) check_corners(object);
    return std::move(model_);
  }

 private:
  struct FreeParser {
    void operator()(XML_ParserStruct* parser) const { XML_ParserFree(parser); }
  };

  [[noreturn]] void fail(std::string_view found, std::string_view needed,
                         std::string_view remedy = "export the file again") const {
    FileBytes place{
        part_.path.string() + ", line " + std::to_string(XML_GetCurrentLineNumber(parser_.get())),
        {}};
    place.fail(found, needed, remedy);
  }

  /// Exceptions must not pass through the parser's C.
  template <typename Work>
  void guarded(const Work& work) {
    if (error_) return;
    try {
      work(*this);
    } catch (...) {
      error_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  /// The attributes of one element; a key is a local name, or "NAMESPACE|NAME".
  class Attributes {
   public:
    explicit Attributes(const char** pairs) : pairs_(pairs) {}
    [[nodiscard]] std::optional<std::string_view> find(std::string_view key) const {
      for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
        if (key == pair[0]) return pair[1];
      }
      return std::nullopt;
    }

   private:
    const char** pairs_;
  };

  void open(std::string_view name, const char** pairs) {
    if (!name.starts_with(core_namespace)) return;  // of an extension
    name.remove_prefix(std::min(core_namespace.size() + 1, name.size()));
    const Attributes attributes(pairs);
    if (name == "model") {
      open_model(attributes);
    } else if (!has_model_) {
      fail("an element before <model>", "<model>");
    } else if (name == "vertex") {
      for (const std::string_view key : {"x", "y", "z"}) {
        object().coordinates.push_back(number(attributes, key));
      }
    } else if (name == "triangle") {
      for (const std::string_view key : {"v1", "v2", "v3"}) {
        object().corners.push_back(vertex(attributes, key));
      }
    } else if (name == "object") {
      const std::string_view id = attributes.find("id").value_or("");
      if (!numbers_.emplace(id, model_.objects.size()).second) {
        fail("a second object " + in_quotes(id), "different ids");
      }
      const std::string_view type = attributes.find("type").value_or("model");
      model_.objects.emplace_back().is_support = type == "support" || type == "solidsupport";
    } else if (name == "component") {
      Placed3mf placed = placement(attributes);
      if (placed.object + 1 >= model_.objects.size()) {
        fail("an object that is a component of itself", "one that is defined before");
      }
      object().components.push_back(std::move(placed));
    } else if (name == "item") {
      Placed3mf placed = placement(attributes);
      if (!model_.objects[placed.object].is_support) model_.items.push_back(std::move(placed));
    }
  }

  void open_model(const Attributes& attributes) {
    if (has_model_) fail("a second <model>", "one");
    has_model_ = true;
    const std::string_view unit = attributes.find("unit").value_or("millimeter");
    const auto* const known = std::find_if(length_units.begin(), length_units.end(),
                                           [&](const LengthUnit& u) { return u.name == unit; });
    if (known == length_units.end()) {
      fail("the unit " + in_quotes(unit), "micron, millimeter, centimeter, inch, foot or meter");
    }
    model_.millimetres = known->millimetres;
    std::string_view required = attributes.find("requiredextensions").value_or("");
    while (!required.empty()) {
      const std::size_t end = std::min(required.find(' '), required.size());
      check_extension(std::string(required.substr(0, end)));
      required.remove_prefix(std::min(end + 1, required.size()));
    }
  }

  void check_extension(const std::string& prefix) const {
    const auto space = namespaces_.find(prefix);
    if (space == namespaces_.end()) return;
    for (const KnownName& extension : shape_extensions) {
      if (space->second.find(extension.key) != std::string::npos) {
        fail("3MF's " + std::string(extension.name) + " extension (" + space->second + ")",
             "meshes and components alone", "export it as a plain mesh, as 3MF, STL or OBJ");
      }
    }
  }

  [[nodiscard]] Object3mf& object() {
    if (model_.objects.empty()) fail("geometry outside of an object", "<object> round it");
    return model_.objects.back();
  }

  [[nodiscard]] Placed3mf placement(const Attributes& attributes) const {
    const std::string path =
        std::string(production_namespace) + namespace_end + std::string("path");
    if (const auto other = attributes.find(path)) {
      fail("3MF's production extension: a part in another file (" + in_quotes(*other) + ")",
           "all objects in one model file",
           "export the model as STL or OBJ, or as plain 3MF, in the program that wrote it");
    }
    Placed3mf placed;
    const std::string_view id = attributes.find("objectid").value_or("");
    const auto number_of = numbers_.find(std::string(id));
    if (number_of == numbers_.end()) fail("the object id " + in_quotes(id), "an object's before");
    placed.object = number_of->second;
    if (const auto text = attributes.find("transform")) placed.frame = transform(*text);
    return placed;
  }

  /// Twelve numbers by rows, for points that are rows: the last three are the translation.
  [[nodiscard]] Eigen::Affine3d transform(std::string_view text) const {
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    for (int k = 0; k < 12; ++k) {
      at = std::find_if_not(at, end, blank);
      if (at != end && *at == '+') ++at;
      const auto [next, error] = fast_float::from_chars(at, end, frame(k % 3, k / 3));
      if (error != std::errc() || !std::isfinite(frame(k % 3, k / 3))) {
        fail("the transform " + in_quotes(text), "twelve finite numbers");
      }
      at = next;
    }
    if (std::find_if_not(at, end, blank) != end) {
      fail("the transform " + in_quotes(text), "twelve finite numbers");
    }
    return frame;
  }

  [[nodiscard]] double number(const Attributes& attributes, std::string_view key) const {
    const std::string_view text = attributes.find(key).value_or("");
    double value = 0;
    const char* const end = text.data() + text.size();
    const char* const begin = text.starts_with('+') ? text.data() + 1 : text.data();
    const auto [next, error] = fast_float::from_chars(begin, end, value);
    if (error != std::errc() || next != end) {
      fail(in_quotes(text) + " as " + std::string(key), "a number");
    }
    return value;
  }

  [[nodiscard]] std::int32_t vertex(const Attributes& attributes, std::string_view key) const {
    const std::string_view text = attributes.find(key).value_or("");
    std::int32_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || next != end || value < 0) {
      fail(in_quotes(text) + " as " + std::string(key), "a vertex index from 0 on");
    }
    return value;
  }

  void check_corners(const Object3mf& of) const {
    const std::size_t vertices = of.coordinates.size() / 3;
    for (const std::int32_t corner : of.corners) {
      if (static_cast<std::size_t>(corner) >= vertices) {
        part_.fail("vertex index " + std::to_string(corner),
                   "indices from 0 to " + std::to_string(vertices) + " - 1",
                   "export the file again");
      }
    }
  }

  const FileBytes& part_;
  const Monitor& monitor_;
  std::unique_ptr<XML_ParserStruct, FreeParser> parser_;
  std::exception_ptr error_;
  std::unordered_map<std::string, std::string> namespaces_;  ///< by prefix
  std::unordered_map<std::string, std::size_t> numbers_;     ///< of objects, by id
  bool has_model_ = false;
  Model3mf model_;
};

}  // namespace

Model3mf parse_3mf_model(const FileBytes& part, const Monitor& monitor) {
  return Model3mfParser(part, monitor).parse();
}

}  // namespace curveskel
