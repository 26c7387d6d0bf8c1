// OpenGL's names as values: each is deleted once, on the thread whose context made it.
#pragma once

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace curveskel::viewer {

/// Owns one OpenGL name; 0 = none.
template <typename Kind>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;
  ~GlName() {
    if (name_ != 0) Kind::drop(name_);
  }
  [[nodiscard]] GLuint get() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

struct BufferKind {
  static void drop(GLuint name) { glDeleteBuffers(1, &name); }
};
struct ArrayKind {
  static void drop(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureKind {
  static void drop(GLuint name) { glDeleteTextures(1, &name); }
};
struct RenderbufferKind {
  static void drop(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct FramebufferKind {
  static void drop(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct ProgramKind {
  static void drop(GLuint name) { glDeleteProgram(name); }
};

using GlArray = GlName<ArrayKind>;
using GlTexture = GlName<TextureKind>;
using GlRenderbuffer = GlName<RenderbufferKind>;
using GlFramebuffer = GlName<FramebufferKind>;

[[nodiscard]] GlArray make_array();

/// Bytes on the device; grows as needed and is reused while they fit.
class GlBuffer {
 public:
  /// Replaces the content. Throws Error(Fault::device) if OpenGL has no memory for it.
  void fill(GLenum target, const void* bytes, std::size_t size);
  [[nodiscard]] GLuint get() const { return name_.get(); }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

 private:
  GlName<BufferKind> name_;
  std::size_t capacity_ = 0;
};

template <typename Value>
void fill(GlBuffer& buffer, GLenum target, std::span<const Value> values) {
  buffer.fill(target, values.data(), values.size_bytes());
}

/// A vertex and a fragment shader, linked.
class GlProgram {
 public:
  /// Throws Error(Fault::device) with the compiler's log.
  GlProgram(std::string_view name, std::string_view vertex, std::string_view fragment);
  void use() const { glUseProgram(program_.get()); }
  // Of the program in use; a uniform that the compiler dropped is ignored.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const glm::vec2& value) const;
  void set(const char* uniform, const glm::vec3& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, const glm::mat3& value) const;
  void set(const char* uniform, const glm::mat4& value) const;

 private:
  [[nodiscard]] GLint place(const char* uniform) const;
  GlName<ProgramKind> program_;
};

/// Something to draw into: colour and depth, of one or several samples a pixel.
class GlTarget {
 public:
  struct Form {
    int width = 0;
    int height = 0;
    int samples = 1;
    GLenum colour = GL_RGBA8;
    bool depth = true;
    bool operator==(const Form&) const = default;
  };
  /// Made anew only where the form changes.
  void shape(const Form& form);
  void bind() const;
  [[nodiscard]] const Form& form() const { return form_; }
  [[nodiscard]] GLuint framebuffer() const { return framebuffer_.get(); }
  /// Of one sample only.
  [[nodiscard]] GLuint colour() const { return colour_texture_.get(); }
  [[nodiscard]] GLuint depth() const { return depth_texture_.get(); }
  /// Averages colours (and takes one of the depths) into a target of one sample.
  void resolve_into(const GlTarget& other, bool with_depth) const;

 private:
  Form form_;
  GlFramebuffer framebuffer_;
  GlTexture colour_texture_;
  GlTexture depth_texture_;
  GlRenderbuffer colour_samples_;
  GlRenderbuffer depth_samples_;
};

/// The name that the driver gives itself.
[[nodiscard]] std::string gl_name();

/// Binds a texture to a unit.
void bind_texture(int unit, GLuint texture);

}  // namespace curveskel::viewer
