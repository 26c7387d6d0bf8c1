#include "viewer/render/gl_objects.hpp"

#include <vector>

#include <curveskel/error.hpp>

namespace curveskel::viewer {
namespace {

std::string shader_log(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader, length, nullptr, log.data());
  return log;
}

GLuint compile(GLenum kind, std::string_view name, std::string_view source) {
  const GLuint shader = glCreateShader(kind);
  const auto* text = source.data();
  const auto length = static_cast<GLint>(source.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    throw Error(Fault::device, "the shader " + std::string(name) +
                                   " was refused by this OpenGL driver: " + shader_log(shader));
  }
  return shader;
}

GlTexture make_texture(const GlTarget::Form& form, GLenum internal, GLenum format, GLenum type) {
  GLuint name = 0;
  glGenTextures(1, &name);
  GlTexture texture(name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal), form.width, form.height, 0, format,
               type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

GlRenderbuffer make_samples(const GlTarget::Form& form, GLenum internal) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  GlRenderbuffer buffer(name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, form.samples, internal, form.width,
                                   form.height);
  return buffer;
}

}  // namespace

GlArray make_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return GlArray(name);
}

void GlBuffer::fill(GLenum target, const void* bytes, std::size_t size) {
  if (!name_) {
    GLuint name = 0;
    glGenBuffers(1, &name);
    name_ = GlName<BufferKind>(name);
  }
  glBindBuffer(target, name_.get());
  if (size > capacity_ || size * 4 < capacity_) {
    while (glGetError() != GL_NO_ERROR) {
    }
    glBufferData(target, static_cast<GLsizeiptr>(size), bytes, GL_DYNAMIC_DRAW);
    if (glGetError() == GL_OUT_OF_MEMORY) {
      throw Error(Fault::device, "OpenGL has no memory for " + std::to_string(size) +
                                     " bytes of a surface; close other programs or decimate it");
    }
    capacity_ = size;
  } else if (size > 0) {
    glBufferSubData(target, 0, static_cast<GLsizeiptr>(size), bytes);
  }
}

GlProgram::GlProgram(std::string_view name, std::string_view vertex, std::string_view fragment)
    : program_(glCreateProgram()) {
  const GLuint first = compile(GL_VERTEX_SHADER, name, vertex);
  const GLuint second = compile(GL_FRAGMENT_SHADER, name, fragment);
  glAttachShader(program_.get(), first);
  glAttachShader(program_.get(), second);
  glLinkProgram(program_.get());
  glDeleteShader(first);
  glDeleteShader(second);
  GLint good = 0;
  glGetProgramiv(program_.get(), GL_LINK_STATUS, &good);
  if (good == 0) {
    throw Error(Fault::device, "the shader " + std::string(name) + " was not linked by OpenGL");
  }
}

GLint GlProgram::place(const char* uniform) const {
  return glGetUniformLocation(program_.get(), uniform);
}
void GlProgram::set(const char* uniform, int value) const { glUniform1i(place(uniform), value); }
void GlProgram::set(const char* uniform, float value) const { glUniform1f(place(uniform), value); }
void GlProgram::set(const char* uniform, const glm::vec2& value) const {
  glUniform2fv(place(uniform), 1, &value[0]);
}
void GlProgram::set(const char* uniform, const glm::vec3& value) const {
  glUniform3fv(place(uniform), 1, &value[0]);
}
void GlProgram::set(const char* uniform, const glm::vec4& value) const {
  glUniform4fv(place(uniform), 1, &value[0]);
}
void GlProgram::set(const char* uniform, const glm::mat3& value) const {
  glUniformMatrix3fv(place(uniform), 1, GL_FALSE, &value[0][0]);
}
void GlProgram::set(const char* uniform, const glm::mat4& value) const {
  glUniformMatrix4fv(place(uniform), 1, GL_FALSE, &value[0][0]);
}

void GlTarget::shape(const Form& form) {
  if (framebuffer_ && form == form_) return;
  *this = GlTarget();
  form_ = form;
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  framebuffer_ = GlFramebuffer(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  if (form.samples > 1) {
    colour_samples_ = make_samples(form, form.colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              colour_samples_.get());
    if (form.depth) {
      depth_samples_ = make_samples(form, GL_DEPTH_COMPONENT32F);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                depth_samples_.get());
    }
  } else {
    colour_texture_ = make_texture(form, form.colour, GL_RGBA, GL_FLOAT);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           colour_texture_.get(), 0);
    if (form.depth) {
      depth_texture_ = make_texture(form, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                             depth_texture_.get(), 0);
    }
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(Fault::device, "OpenGL made no picture of " + std::to_string(form.width) + " x " +
                                   std::to_string(form.height) + " pixels; make it smaller");
  }
}

void GlTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, form_.width, form_.height);
}

void GlTarget::resolve_into(const GlTarget& other, bool with_depth) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.get());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, other.framebuffer_.get());
  const auto copy = [&](GLbitfield what) {
    glBlitFramebuffer(0, 0, form_.width, form_.height, 0, 0, other.form_.width, other.form_.height,
                      what, GL_NEAREST);
  };
  copy(GL_COLOR_BUFFER_BIT);
  if (with_depth) copy(GL_DEPTH_BUFFER_BIT);
}

std::string gl_name() {
  const auto* const name = glGetString(GL_RENDERER);
  return name == nullptr ? "?" : reinterpret_cast<const char*>(name);
}

void bind_texture(int unit, GLuint texture) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

}  // namespace curveskel::viewer
