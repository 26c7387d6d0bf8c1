#include "rig/dae/dae_look_materials.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/uri.hpp"
#include "rig/gltf/picture_places.hpp"

namespace curveskel {
namespace {

std::string without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(blanks) + 1 - begin));
}

std::string path_in(std::string_view uri) {
  std::string path = without_escapes(uri);
  constexpr std::string_view scheme = "file://";
  if (path.starts_with(scheme)) path.erase(0, scheme.size());
  return path;
}

/// The first descendant with that name, or nullptr.
const XmlElement* descendant(const XmlElement& element, std::string_view name) {
  for (const XmlElement& child : element.children) {
    if (child.name == name) return &child;
    if (const XmlElement* below = descendant(child, name)) return below;
  }
  return nullptr;
}

class DaeMaterialReader {
 public:
  DaeMaterialReader(const FileBytes& file, const DaeDocument& document, const DaeMaterialUse& use,
                    std::vector<std::string>& notes)
      : file_(file), document_(document), use_(use), notes_(notes) {}

  [[nodiscard]] DressedMaterial read() {
    const std::string_view id = use_.material.attribute("id");
    const std::string name(use_.material.attribute("name", id));
    const XmlElement* instance = use_.material.child("instance_effect");
    const XmlElement* effect =
        instance == nullptr ? nullptr : &document_.referred(*instance, "url");
    const XmlElement* profile = effect == nullptr ? nullptr : effect->child("profile_COMMON");
    const XmlElement* technique = profile == nullptr ? nullptr : profile->child("technique");
    if (technique == nullptr) return {name, std::nullopt};
    effect_ = effect;
    profile_ = profile;
    for (const char* kind : {"phong", "lambert", "blinn", "constant"}) {
      shader_ = technique->child(kind);
      if (shader_ != nullptr) break;
    }
    if (shader_ == nullptr) return {name, std::nullopt};
    return {name, look(*technique)};
  }

 private:
  [[nodiscard]] MaterialLook look(const XmlElement& technique) {
    MaterialLook look;
    look.base = picture_in(shader_->child("diffuse"));
    look.colour = colour_in(shader_->child("diffuse"));
    // Light of its own is all that one sees of a constant material.
    if (shader_->name == "constant") look.colour = std::array<double, 3>{0, 0, 0};
    look.light = picture_in(shader_->child("emission"));
    look.emission = colour_in(shader_->child("emission"));
    look.normals = normal_map(technique);
    look.opacity = opacity();
    const auto cutout = picture_in(shader_->child("transparent"));
    look.base_has_alpha = look.base && cutout && cutout->is_same_picture(*look.base);
    const double shine = first_number(shader_->child("shininess")).value_or(0);
    look.roughness = 1 - std::sqrt(std::max(shine, 0.0)) / 10;
    const XmlElement* sides = descendant(*effect_, "double_sided");
    const std::string said = sides == nullptr ? "" : without_blanks(sides->text);
    look.two_sided = said == "1" || said == "true";
    return look;
  }

  /// <newparam> of the profile or the effect.
  [[nodiscard]] const XmlElement* parameter(std::string_view sid) const {
    for (const XmlElement* owner : {profile_, effect_}) {
      for (const XmlElement* one : owner->all("newparam")) {
        if (one->attribute("sid") == sid) return one;
      }
    }
    return nullptr;
  }

  /// <color>, <float> and so on of a property, or of the parameter that it refers to.
  [[nodiscard]] std::optional<std::vector<double>> numbers_in(const XmlElement* property) const {
    if (property == nullptr) return std::nullopt;
    const XmlElement* reference = property->child("param");
    const XmlElement* owner =
        reference == nullptr ? property : parameter(reference->attribute("ref"));
    if (owner == nullptr) return std::nullopt;
    for (const char* kind : {"color", "float4", "float3", "float"}) {
      const XmlElement* given = owner->child(kind);
      if (given == nullptr) continue;
      std::vector<double> numbers = document_.numbers(*given);
      const bool are_there =
          !numbers.empty() && std::all_of(numbers.begin(), numbers.end(),
                                          [](double number) { return std::isfinite(number); });
      if (are_there) return numbers;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<double> first_number(const XmlElement* property) const {
    const auto numbers = numbers_in(property);
    return numbers ? std::optional(numbers->front()) : std::nullopt;
  }

  [[nodiscard]] std::optional<std::array<double, 3>> colour_in(const XmlElement* property) const {
    const auto numbers = numbers_in(property);
    if (!numbers || numbers->size() < 3) return std::nullopt;
    return std::array{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  }

  /// COLLADA 1.4.1 and 1.5, "Determining Transparency (Opacity)". Nobody has a material that is not
  /// seen at all: exporters that say so mean that it is.
  [[nodiscard]] double opacity() const {
    const double share = first_number(shader_->child("transparency")).value_or(1);
    const XmlElement* transparent = shader_->child("transparent");
    const auto colour = numbers_in(transparent);
    const std::string_view mode =
        transparent == nullptr ? "A_ONE" : transparent->attribute("opaque", "A_ONE");
    double result = share;
    if (colour) {
      const double alpha = colour->size() > 3 ? (*colour)[3] : 1;
      const double grey =
          colour->size() > 2 ? ((*colour)[0] + (*colour)[1] + (*colour)[2]) / 3 : alpha;
      if (mode == "A_ONE") result = share * alpha;
      if (mode == "A_ZERO") result = 1 - share * alpha;
      if (mode == "RGB_ONE") result = share * grey;
      if (mode == "RGB_ZERO") result = 1 - share * grey;
    }
    return result > 0 ? std::min(result, 1.0) : 1;
  }

  /// Of the extensions for bumps those that say that their pictures are normals.
  [[nodiscard]] std::optional<DressedPicture> normal_map(const XmlElement& technique) {
    for (const XmlElement* owner : {&technique, profile_, effect_}) {
      for (const XmlElement* extra : owner->all("extra")) {
        const XmlElement* bump = descendant(*extra, "bump");
        if (bump == nullptr) continue;
        if (bump->attribute("bumptype") == "NORMALMAP") return picture_in(bump);
        notes_.push_back("the bump map of " + in_quotes(use_.material.attribute("id")) +
                         " is left out: glTF has maps of normals alone");
        return std::nullopt;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<DressedPicture> picture_in(const XmlElement* property) const {
    const XmlElement* texture = property == nullptr ? nullptr : property->child("texture");
    if (texture == nullptr) return std::nullopt;
    const XmlElement* image = image_of(texture->attribute("texture"));
    const XmlElement* from = image == nullptr ? nullptr : image->child("init_from");
    if (from == nullptr) return std::nullopt;
    const XmlElement* reference = from->child("ref");  // of COLLADA 1.5
    DressedPicture result;
    result.name = path_in(without_blanks(reference == nullptr ? from->text : reference->text));
    if (result.name.empty()) return std::nullopt;
    result.path = picture_place(file_.path, file_.path.parent_path(), result.name);
    result.set = set_of(texture->attribute("texcoord"));
    return result;
  }

  /// The image of a sampler; of files that go without samplers, that with this id.
  [[nodiscard]] const XmlElement* image_of(std::string_view texture) const {
    const XmlElement* given = parameter(texture);
    const XmlElement* sampler = given == nullptr ? nullptr : given->child("sampler2D");
    if (sampler == nullptr) return image_with(texture);
    if (const XmlElement* image = sampler->child("instance_image")) {
      const std::string_view url = image->attribute("url");
      return image_with(url.substr(url.starts_with('#') ? 1 : 0));
    }
    const XmlElement* source = sampler->child("source");
    const XmlElement* surface =
        source == nullptr ? nullptr : parameter(without_blanks(source->text));
    const XmlElement* inner = surface == nullptr ? nullptr : surface->child("surface");
    const XmlElement* from = inner == nullptr ? nullptr : inner->child("init_from");
    return from == nullptr ? nullptr : image_with(without_blanks(from->text));
  }

  [[nodiscard]] const XmlElement* image_with(std::string_view id) const {
    const XmlElement* image = document_.find(id);
    return image != nullptr && image->name == "image" ? image : nullptr;
  }

  /// The set to which the mesh binds the name; the first where it binds none that is there.
  [[nodiscard]] std::size_t set_of(std::string_view name) const {
    if (use_.binding == nullptr) return 0;
    for (const XmlElement* bound : use_.binding->all("bind_vertex_input")) {
      if (bound->attribute("semantic") != name) continue;
      const std::string_view said = bound->attribute("input_set", "0");
      std::size_t set = 0;
      std::from_chars(said.data(), said.data() + said.size(), set);
      const auto at = std::find(use_.sets.begin(), use_.sets.end(), set);
      return at == use_.sets.end() ? 0 : static_cast<std::size_t>(at - use_.sets.begin());
    }
    return 0;
  }

  const FileBytes& file_;
  const DaeDocument& document_;
  const DaeMaterialUse& use_;
  std::vector<std::string>& notes_;
  const XmlElement* effect_ = nullptr;
  const XmlElement* profile_ = nullptr;
  const XmlElement* shader_ = nullptr;
};

}  // namespace

DressedMaterial dae_look_of(const FileBytes& file, const DaeDocument& document,
                            const DaeMaterialUse& use, std::vector<std::string>& notes) {
  return DaeMaterialReader(file, document, use, notes).read();
}

}  // namespace curveskel
